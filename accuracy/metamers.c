/* SPDX-License-Identifier: BSD-3-Clause
 * Whether models keep metamers equal under their light, and part them by the right amount under others. */
#include "metamers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fail.h"

static const char *const light_names[] = {"D65", "D50", "A", "FL2", "FL11", "LED-B1", "LED-RGB1"};
enum { LIGHT_COUNT = sizeof light_names / sizeof *light_names };

static mtm_status append_lights(metamer_set *set, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < LIGHT_COUNT && status == MTM_OK; i++) {
        collection_item item = {.part = PART_TEST};
        status = mtm_illuminant(light_names[i], &item.spectrum, error);
        if (status == MTM_OK)
            status = mtm_light_normalize(&item.spectrum, &set->observer, &item.spectrum, error);
        if (status == MTM_OK) status = collection_append(&set->lights, &item, error);
    }
    return status;
}

mtm_status metamer_set_create(const char *source_folder, metamer_set *set, mtm_error *error) {
    char path[4096];
    *set = (metamer_set){.lights = {.count = 0}};
    (void)snprintf(path, sizeof path, "%s/tests/data/expected/metamers_constructed_D65_spectra.csv",
                   source_folder);
    mtm_status status = mtm_observer_get("cie1931", &set->observer, error);
    if (status == MTM_OK) status = append_lights(set, error);
    if (status == MTM_OK)
        status = collection_append_file(path, "metamers", MTM_KIND_REFLECTANCE, PART_TEST, &set->reflectances,
                                        error);
    if (status != MTM_OK) metamer_set_free(set);
    return status;
}

void metamer_set_free(metamer_set *set) {
    collection_list_free(&set->lights);
    collection_list_free(&set->reflectances);
}

/* CIEDE2000 of a pair under a light. */
typedef struct split {
    double truth, model;
} split;

static mtm_status measure_split(const model *made, const metamer_set *set, int pair, int light, split *found,
                                mtm_error *error) {
    const mtm_spectrum *emission = &set->lights.items[light].spectrum;
    const mtm_xyz white = mtm_xyz_of(emission, &set->observer);
    double matrix[3 * MTM_DIMENSION_MAX];
    mtm_xyz truth[2];
    mtm_xyz modeled[2] = {{0, 0, 0}, {0, 0, 0}};
    mtm_status status = model_light(made, emission, &set->observer, matrix, error);
    for (int side = 0; side < 2 && status == MTM_OK; side++) {
        const mtm_spectrum *reflectance = &set->reflectances.items[2 * pair + side].spectrum;
        const mtm_spectrum stimulus = mtm_spectrum_multiply(emission, reflectance);
        double coefficients[MTM_DIMENSION_MAX];
        truth[side] = mtm_xyz_of(&stimulus, &set->observer);
        status = model_encode(made, reflectance, coefficients, error);
        if (status != MTM_OK) break;
        const mtm_rgb sums = mtm_basis_color(made->dimension, matrix, coefficients); /* matrix leads to XYZ */
        modeled[side] = (mtm_xyz){sums.r, sums.g, sums.b};
    }
    if (status == MTM_OK)
        *found =
            (split){color_error(truth[0], truth[1], white, 1), color_error(modeled[0], modeled[1], white, 1)};
    return status;
}

/* The splits of all pairs under lights `begin` … `end`-1: errors and, where wanted, true ones. */
static mtm_status summarize_splits(const model *made, const metamer_set *set, int begin, int end,
                                   error_summary *errors, error_summary *truths, mtm_error *error) {
    const int pair_count = set->reflectances.count / 2;
    const size_t count = (size_t)pair_count * (size_t)(end - begin);
    double *values = calloc(2 * count, sizeof *values);
    if (values == NULL) return fail_memory(error, "metamers");
    mtm_status status = MTM_OK;
    for (size_t n = 0; n < count && status == MTM_OK; n++) {
        split found = {0, 0};
        status = measure_split(made, set, (int)n % pair_count, begin + (int)n / pair_count, &found, error);
        values[n] = fabs(found.model - found.truth);
        values[count + n] = found.truth;
    }
    if (status == MTM_OK) {
        *errors = error_summarize(count, values);
        *truths = error_summarize(count, values + count);
    }
    free(values);
    return status;
}

mtm_status metamer_errors_measure(const model *made, const metamer_set *set, metamer_errors *errors,
                                  mtm_error *error) {
    error_summary none;
    mtm_status status = summarize_splits(made, set, 0, 1, &errors->spurious, &none, error);
    if (status == MTM_OK)
        status =
            summarize_splits(made, set, 1, LIGHT_COUNT, &errors->split_error, &errors->true_split, error);
    return status;
}
