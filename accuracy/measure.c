/* SPDX-License-Identifier: BSD-3-Clause
 * All that the accuracy report tells, measured. */
#include "measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

static const char munsell[] = "reflectance_munsell1269_matt";

/* The spectra to measure with, and the sets made of them. */
typedef struct material_store {
    collection spectra;
    collection_list lights; /* held out, class by class */
    index_pool classes[LIGHT_CLASSES];
    collection_list lamps;
    collection_list reflectances; /* held out: those in the repository, then Munsell's */
    index_pool reflectance_pools[2];
    collection_list others[SET_COUNT]; /* of SET_OPSTELTEN and SET_CRI2012 */
    product_set sets[SET_COUNT];
    metamer_set metamers;
} material_store;

static mtm_status append_test(const collection_list *from, bool is_munsell, collection_list *to,
                              mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < from->count && status == MTM_OK; i++) {
        const collection_item *item = &from->items[i];
        if (item->part == PART_TEST && (strcmp(item->table, munsell) == 0) == is_munsell)
            status = collection_append(to, item, error);
    }
    return status;
}

static double dot(const mtm_spectrum *a, const mtm_spectrum *b) {
    double sum = 0;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) sum += a->value[i] * b->value[i];
    return sum;
}

/* Whether a lamp is, but for its scale, about a light that bases were fitted to. */
static bool is_trained(const mtm_spectrum *lamp, const collection_list *lights) {
    static const double cosine_min = 0.999;
    for (int i = 0; i < lights->count; i++) {
        const mtm_spectrum *light = &lights->items[i].spectrum;
        const double cosine = dot(lamp, light) / sqrt(dot(lamp, lamp) * dot(light, light));
        if (lights->items[i].part == PART_TRAIN && cosine > cosine_min) return true;
    }
    return false;
}

/* Of the 401 lamps, those that are new: CIE illuminants are among them. */
static mtm_status read_lamps(const char *source_folder, const collection_list *lights, collection_list *lamps,
                             mtm_error *error) {
    mtm_observer observer;
    int kept = 0;
    mtm_status status = mtm_observer_get("cie1931", &observer, error);
    if (status == MTM_OK)
        status = collection_append_table(source_folder, "lights_houser401", MTM_KIND_LIGHT, PART_TEST, lamps,
                                         error);
    for (int i = 0; i < lamps->count && status == MTM_OK; i++) {
        if (is_trained(&lamps->items[i].spectrum, lights)) continue;
        lamps->items[kept] = lamps->items[i];
        status =
            mtm_light_normalize(&lamps->items[kept].spectrum, &observer, &lamps->items[kept].spectrum, error);
        kept++;
    }
    lamps->count = kept;
    return status;
}

static mtm_status read_other(const char *folder, const char *name, collection_list *list, mtm_error *error) {
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/%s_5nm.csv", folder, name);
    return collection_append_file(path, name, MTM_KIND_REFLECTANCE, PART_TEST, list, error);
}

static mtm_status read_spectra(const measure_options *options, material_store *store, mtm_error *error) {
    mtm_status status = collection_read(options->source_folder, options->more_folder, &store->spectra, error);
    for (int class = 0; class < LIGHT_CLASSES && status == MTM_OK; class ++) {
        store->classes[class].first = store->lights.count;
        status = collection_append_part(&store->spectra.lights, (collection_part)(PART_SMOOTH + class),
                                        &store->lights, error);
        store->classes[class].count = store->lights.count - store->classes[class].first;
    }
    for (int pool = 0; pool < 2 && status == MTM_OK; pool++) {
        store->reflectance_pools[pool].first = store->reflectances.count;
        status = append_test(&store->spectra.reflectances, pool == 1, &store->reflectances, error);
        store->reflectance_pools[pool].count =
            store->reflectances.count - store->reflectance_pools[pool].first;
    }
    if (status == MTM_OK)
        status = read_lamps(options->source_folder, &store->spectra.lights, &store->lamps, error);
    if (status == MTM_OK && options->more_folder != NULL)
        status = read_other(options->more_folder, "reflectance_opstelten215", &store->others[SET_OPSTELTEN],
                            error);
    if (status == MTM_OK && options->more_folder != NULL)
        status = read_other(options->more_folder, "reflectance_cri2012_real210", &store->others[SET_CRI2012],
                            error);
    if (status == MTM_OK) status = metamer_set_create(options->source_folder, &store->metamers, error);
    return status;
}

/* The same number of draws from every pool of lights; each with a seed of its own. */
static mtm_status create_set(const collection_list *lights, int light_pool_count,
                             const index_pool *light_pools, const collection_list *reflectances,
                             int reflectance_pool_count, const index_pool *reflectance_pools, int draw_count,
                             product_set *set, mtm_error *error) {
    const int share = draw_count / light_pool_count;
    product_draw *draws = calloc((size_t)(share * light_pool_count), sizeof *draws);
    if (draws == NULL) return fail_memory(error, "draws");
    for (int i = 0; i < light_pool_count; i++) {
        const draw_pools pools = {1, reflectance_pool_count, &light_pools[i], reflectance_pools};
        draw_products(&pools, (random_state)i + 1, share, &draws[i * share]);
    }
    return product_set_create(lights, reflectances, share * light_pool_count, draws, set, error);
}

/* Every light with every reflectance in the repository; the reflectances that follow it are the second and third. */
static mtm_status create_pairs(material_store *store, mtm_error *error) {
    const int light_count = store->lights.count;
    const int count = store->reflectance_pools[0].count;
    product_draw *draws = calloc((size_t)(light_count * count), sizeof *draws);
    if (draws == NULL) return fail_memory(error, "draws");
    for (int n = 0; n < light_count * count; n++) {
        draws[n].light = n / count;
        for (int i = 0; i < DRAW_REFLECTANCES; i++) draws[n].reflectance[i] = (n + i) % count;
    }
    return product_set_create(&store->lights, &store->reflectances, light_count * count, draws,
                              &store->sets[SET_PAIRS], error);
}

/* A set of `pool_count` of the reflectances' pools. */
static mtm_status create_held_out(const measure_options *options, material_store *store, measured_set set,
                                  int pool_count, mtm_error *error) {
    return create_set(&store->lights, LIGHT_CLASSES, store->classes, &store->reflectances, pool_count,
                      store->reflectance_pools, options->draw_count, &store->sets[set], error);
}

static mtm_status create_houser(const measure_options *options, material_store *store, measured_set set,
                                int pool_count, mtm_error *error) {
    const index_pool all = {0, store->lamps.count};
    return create_set(&store->lamps, 1, &all, &store->reflectances, pool_count, store->reflectance_pools,
                      options->draw_count, &store->sets[set], error);
}

static mtm_status create_other(const measure_options *options, material_store *store, measured_set set,
                               mtm_error *error) {
    const index_pool all = {0, store->others[set].count};
    return create_set(&store->lights, LIGHT_CLASSES, store->classes, &store->others[set], 1, &all,
                      options->draw_count, &store->sets[set], error);
}

static mtm_status create_sets(const measure_options *options, material_store *store, mtm_error *error) {
    mtm_status status = create_held_out(options, store, SET_HELD_OUT, 1, error);
    if (status == MTM_OK) status = create_pairs(store, error);
    if (status == MTM_OK) status = create_houser(options, store, SET_HOUSER, 1, error);
    if (status != MTM_OK || options->more_folder == NULL) return status;
    status = create_held_out(options, store, SET_FULL, 2, error);
    if (status == MTM_OK) status = create_houser(options, store, SET_FULL_HOUSER, 2, error);
    if (status == MTM_OK) status = create_other(options, store, SET_OPSTELTEN, error);
    if (status == MTM_OK) status = create_other(options, store, SET_CRI2012, error);
    return status;
}

static void free_store(material_store *store) {
    for (int set = 0; set < SET_COUNT; set++) {
        product_set_free(&store->sets[set]);
        collection_list_free(&store->others[set]);
    }
    metamer_set_free(&store->metamers);
    collection_list_free(&store->reflectances);
    collection_list_free(&store->lamps);
    collection_list_free(&store->lights);
    collection_free(&store->spectra);
}

static mtm_status measure_model(const material_store *store, int index, measurements *made,
                                mtm_error *error) {
    model tested;
    mtm_status status = model_create(made->options.source_folder, model_choice_at(index), &tested, error);
    made->is_missing[index] = status == MTM_NUMERIC;
    if (status != MTM_OK) return made->is_missing[index] ? MTM_OK : status;
    for (int set = 0; set < made->set_count && status == MTM_OK; set++)
        status = product_errors_measure(&tested, &store->sets[set], &made->products[set][index], error);
    if (status == MTM_OK)
        status = metamer_errors_measure(&tested, &store->metamers, &made->metamers[index], error);
    model_free(&tested);
    return status;
}

static measurements *allocate_measurements(const measure_options *options, const material_store *store) {
    measurements *all = calloc(1, sizeof *all);
    if (all == NULL) return NULL;
    all->options = *options;
    all->set_count = options->more_folder == NULL ? SETS_IN_REPOSITORY : SET_COUNT;
    all->pair_count = store->sets[SET_PAIRS].draw_count;
    all->metamer_count = store->metamers.reflectances.count / 2;
    all->light_count = store->lights.count;
    all->reflectance_count = store->reflectance_pools[0].count;
    all->more_reflectance_count = store->reflectance_pools[1].count;
    all->lamp_count = store->lamps.count;
    return all;
}

mtm_status measure_all(const measure_options *options, measurements **made, mtm_error *error) {
    material_store store = {.spectra = {{0}, {0}}};
    measurements *all = NULL;
    mtm_status status = read_spectra(options, &store, error);
    if (status == MTM_OK) status = create_sets(options, &store, error);
    if (status == MTM_OK && (all = allocate_measurements(options, &store)) == NULL)
        status = fail_memory(error, "measurements");
    for (int index = 0; index < MODEL_COUNT && status == MTM_OK; index++)
        status = measure_model(&store, index, all, error);
    free_store(&store);
    if (status == MTM_OK) status = engine_measure(&options->engine, &all->engine, error);
    if (status == MTM_OK)
        *made = all;
    else
        free(all);
    return status;
}

const product_errors *measured_products(const measurements *made, measured_set set, model_family family,
                                        int dimension) {
    return &made->products[set][model_index(family, dimension)];
}
