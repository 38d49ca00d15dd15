/* SPDX-License-Identifier: BSD-3-Clause
 * What the curves of the basis `factors` are fitted to: random products of 1, 2 and 3 reflectances under a light, with
 * their true colors. */
#ifndef METAMER_ACCURACY_TRAINING_H
#define METAMER_ACCURACY_TRAINING_H

#include "collection.h"
#include "lab_error.h"
#include "random.h"

/* A light as the observer takes it: x̄E, ȳE, z̄E. */
typedef struct observed_light {
    double value[3][MTM_SPECTRUM_SAMPLES];
} observed_light;

typedef struct training_set {
    int light_count, reflectance_count, draw_count;
    observed_light *lights;
    mtm_spectrum *reflectances;
    product_draw *draws;
    lab_target
        *targets; /* draw_count × DRAW_REFLECTANCES: of the first reflectance, the first two, all three */
} training_set;

/* Made of the rows of `spectra` marked train, three further tables of data/spectra, and synthetic lights. Errors: those
 * of collection_append_table; MTM_MEMORY. On success the caller calls training_free. */
MTM_CHECK mtm_status training_create(const char *source_folder, const collection *spectra,
                                     training_set *training, mtm_error *error);
void training_free(training_set *training);

/* The reflectances that principal components are taken of: the rows of `spectra` marked train and Krinov's natural
 * formations, whose smooth spectra keep the sharpened basis well-conditioned up to d = 9. Errors: those of
 * collection_append_table; MTM_MEMORY. On success the caller calls collection_list_free. */
MTM_CHECK mtm_status training_read_principal(const char *source_folder, const collection *spectra,
                                             collection_list *list, mtm_error *error);

#endif
