/* SPDX-License-Identifier: BSD-3-Clause
 * How far models are off where a light meets reflectances or filters, over many random draws. */
#ifndef METAMER_ACCURACY_PRODUCTS_H
#define METAMER_ACCURACY_PRODUCTS_H

#include "collection.h"
#include "model.h"
#include "random.h"
#include "statistics.h"

enum { LIGHT_CLASSES = 3, FILTERS_MAX = DRAW_REFLECTANCES - 1 };

/* What is true of a draw. XYZ are those of the light scaled to y = 1 on white. */
typedef struct product_truth {
    mtm_xyz white;
    mtm_xyz
        products[DRAW_REFLECTANCES]; /* of the light and the first reflectance, the first two, all three */
} product_truth;

/* Draws and what is true of them. The lists are the caller's. */
typedef struct product_set {
    const collection_list *lights, *reflectances;
    mtm_observer observer;
    int draw_count;
    product_draw *draws;
    product_truth *truths;
} product_set;

/* Takes `draws` over (also where it fails). MTM_MEMORY; MTM_ARGUMENT as mtm_observer_get. On success the caller calls
 * product_set_free. */
MTM_CHECK mtm_status product_set_create(const collection_list *lights, const collection_list *reflectances,
                                        int draw_count, product_draw *draws, product_set *set,
                                        mtm_error *error);
void product_set_free(product_set *set);

/* CIEDE2000 between the true colors and a model's. */
typedef struct product_errors {
    error_summary products[DRAW_REFLECTANCES]; /* a light on one, two, three reflectances */
    error_summary matched;                     /* on three, at the exposure of the first product */
    error_summary
        filtered[FILTERS_MAX]; /* through one, two filters on a reflectance; white is the filtered light */
    double class_mean[LIGHT_CLASSES]; /* of one product; 0 where the draws have no such light */
} product_errors;

MTM_CHECK mtm_status product_errors_measure(const model *made, const product_set *set, product_errors *errors,
                                            mtm_error *error);

#endif
