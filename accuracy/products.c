/* SPDX-License-Identifier: BSD-3-Clause
 * How far models are off where a light meets reflectances or filters. Every light and reflectance is encoded once, then
 * the draws multiply what was encoded. */
#include "products.h"

#include <stdlib.h>
#include <string.h>

#include "fail.h"

/* A set as a model sees it. */
typedef struct coded_set {
    const model *made;
    const product_set *set;
    double *lights;       /* 3×d each */
    double *reflectances; /* d each */
    double *multipliers;  /* d×d each; NULL where coefficients multiply one by one */
    mtm_xyz *colors;      /* of every draw, as in product_truth */
    double *values;       /* one error of every draw */
} coded_set;

mtm_status product_set_create(const collection_list *lights, const collection_list *reflectances,
                              int draw_count, product_draw *draws, product_set *set, mtm_error *error) {
    *set = (product_set){
        .lights = lights, .reflectances = reflectances, .draw_count = draw_count, .draws = draws};
    mtm_status status = mtm_observer_get("cie1931", &set->observer, error);
    set->truths = calloc((size_t)draw_count, sizeof *set->truths);
    if (status == MTM_OK && set->truths == NULL) status = fail_memory(error, "products");
    for (int n = 0; n < draw_count && status == MTM_OK; n++) {
        mtm_spectrum stimulus = lights->items[draws[n].light].spectrum;
        set->truths[n].white = mtm_xyz_of(&stimulus, &set->observer);
        for (int i = 0; i < DRAW_REFLECTANCES; i++) {
            stimulus =
                mtm_spectrum_multiply(&stimulus, &reflectances->items[draws[n].reflectance[i]].spectrum);
            set->truths[n].products[i] = mtm_xyz_of(&stimulus, &set->observer);
        }
    }
    if (status != MTM_OK) product_set_free(set);
    return status;
}

void product_set_free(product_set *set) {
    free(set->draws);
    free(set->truths);
    *set = (product_set){.draw_count = 0};
}

static void free_codes(coded_set *coded) {
    free(coded->lights);
    free(coded->reflectances);
    free(coded->multipliers);
    free(coded->colors);
    free(coded->values);
}

static bool allocate_codes(coded_set *coded) {
    const product_set *set = coded->set;
    const size_t d = (size_t)coded->made->dimension;
    const size_t reflectance_count = (size_t)set->reflectances->count;
    const size_t draw_count = (size_t)set->draw_count;
    coded->lights = calloc((size_t)set->lights->count * 3 * d, sizeof *coded->lights);
    coded->reflectances = calloc(reflectance_count * d, sizeof *coded->reflectances);
    coded->colors = calloc(draw_count * DRAW_REFLECTANCES, sizeof *coded->colors);
    coded->values = calloc(draw_count, sizeof *coded->values);
    if (coded->made->has_matrix_products)
        coded->multipliers = calloc(reflectance_count * d * d, sizeof *coded->multipliers);
    return coded->lights != NULL && coded->reflectances != NULL && coded->colors != NULL &&
           coded->values != NULL && (coded->multipliers != NULL || !coded->made->has_matrix_products);
}

static mtm_status encode_all(coded_set *coded, mtm_error *error) {
    const product_set *set = coded->set;
    const int d = coded->made->dimension;
    mtm_status status = MTM_OK;
    for (int i = 0; i < set->lights->count && status == MTM_OK; i++)
        status = model_light(coded->made, &set->lights->items[i].spectrum, &set->observer,
                             &coded->lights[(size_t)i * 3 * d], error);
    for (int i = 0; i < set->reflectances->count && status == MTM_OK; i++) {
        const mtm_spectrum *reflectance = &set->reflectances->items[i].spectrum;
        status = model_encode(coded->made, reflectance, &coded->reflectances[(size_t)i * d], error);
        if (coded->multipliers != NULL)
            model_multiplier(coded->made, reflectance, &coded->multipliers[(size_t)i * d * d]);
    }
    return status;
}

static mtm_status multiply_by(const coded_set *coded, int reflectance, double *product, mtm_error *error) {
    const int d = coded->made->dimension;
    if (coded->multipliers == NULL)
        return model_multiply(coded->made, product, &coded->reflectances[(size_t)reflectance * d], product,
                              error);
    const double *matrix = &coded->multipliers[(size_t)reflectance * d * d];
    double before[MTM_DIMENSION_MAX];
    memcpy(before, product, (size_t)d * sizeof *before);
    for (int i = 0; i < d; i++) {
        product[i] = 0;
        for (int j = 0; j < d; j++) product[i] += matrix[i * d + j] * before[j];
    }
    return MTM_OK;
}

static mtm_xyz color_of(int d, const double *light, const double *coefficients) {
    mtm_xyz color = {0, 0, 0};
    for (int i = 0; i < d; i++) {
        color.x += light[i] * coefficients[i];
        color.y += light[d + i] * coefficients[i];
        color.z += light[2 * d + i] * coefficients[i];
    }
    return color;
}

static mtm_status multiply_draw(const coded_set *coded, int n, mtm_error *error) {
    const product_draw *draw = &coded->set->draws[n];
    const int d = coded->made->dimension;
    double product[MTM_DIMENSION_MAX];
    mtm_status status = MTM_OK;
    memcpy(product, &coded->reflectances[(size_t)draw->reflectance[0] * d], (size_t)d * sizeof *product);
    for (int i = 0; i < DRAW_REFLECTANCES && status == MTM_OK; i++) {
        if (i > 0) status = multiply_by(coded, draw->reflectance[i], product, error);
        coded->colors[n * DRAW_REFLECTANCES + i] =
            color_of(d, &coded->lights[(size_t)draw->light * 3 * d], product);
    }
    return status;
}

/* The errors of product `i` of all draws. What the eye is adapted to is the light behind `filter_count` reflectances;
 * `is_matched` brings the product to the exposure of the first. */
static error_summary collect(const coded_set *coded, int i, int filter_count, bool is_matched) {
    const int count = coded->set->draw_count;
    for (int n = 0; n < count; n++) {
        const product_truth *truth = &coded->set->truths[n];
        const mtm_xyz white = filter_count == 0 ? truth->white : truth->products[filter_count - 1];
        const double exposure = is_matched ? truth->products[0].y / truth->products[i].y : 1;
        coded->values[n] =
            color_error(coded->colors[n * DRAW_REFLECTANCES + i], truth->products[i], white, exposure);
    }
    return error_summarize((size_t)count, coded->values);
}

/* One product, the mean of each class of lights. */
static void collect_classes(const coded_set *coded, double mean[LIGHT_CLASSES]) {
    const product_set *set = coded->set;
    int counts[LIGHT_CLASSES] = {0};
    for (int n = 0; n < set->draw_count; n++) {
        const int class = (int)set->lights->items[set->draws[n].light].part - (int)PART_SMOOTH;
        if (class < 0 || class >= LIGHT_CLASSES) continue;
        mean[class] += color_error(coded->colors[n * DRAW_REFLECTANCES], set->truths[n].products[0],
                                   set->truths[n].white, 1);
        counts[class]++;
    }
    for (int class = 0; class < LIGHT_CLASSES; class ++)
        if (counts[class] > 0) mean[class] /= counts[class];
}

static void collect_all(const coded_set *coded, product_errors *errors) {
    *errors = (product_errors){.matched = collect(coded, DRAW_REFLECTANCES - 1, 0, true)};
    for (int i = 0; i < DRAW_REFLECTANCES; i++) errors->products[i] = collect(coded, i, 0, false);
    for (int i = 0; i < FILTERS_MAX; i++) errors->filtered[i] = collect(coded, i + 1, i + 1, false);
    collect_classes(coded, errors->class_mean);
}

mtm_status product_errors_measure(const model *made, const product_set *set, product_errors *errors,
                                  mtm_error *error) {
    coded_set coded = {.made = made, .set = set};
    mtm_status status = allocate_codes(&coded) ? MTM_OK : fail_memory(error, "products");
    if (status == MTM_OK) status = encode_all(&coded, error);
    for (int n = 0; n < set->draw_count && status == MTM_OK; n++) status = multiply_draw(&coded, n, error);
    if (status == MTM_OK) collect_all(&coded, errors);
    free_codes(&coded);
    return status;
}
