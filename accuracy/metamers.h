/* SPDX-License-Identifier: BSD-3-Clause
 * Whether models keep metamers equal under their light, and part them by the right amount under others. */
#ifndef METAMER_ACCURACY_METAMERS_H
#define METAMER_ACCURACY_METAMERS_H

#include "collection.h"
#include "model.h"
#include "statistics.h"

/* Pairs of reflectances that are equal under the first light, one after the other. */
typedef struct metamer_set {
    mtm_observer observer;
    collection_list lights, reflectances;
} metamer_set;

/* The pairs of tests/data/expected under D65 and six other lights. Errors: those of mtm_spectrum_table_read; MTM_MEMORY.
 * On success the caller calls metamer_set_free. */
MTM_CHECK mtm_status metamer_set_create(const char *source_folder, metamer_set *set, mtm_error *error);
void metamer_set_free(metamer_set *set);

typedef struct metamer_errors {
    error_summary spurious; /* CIEDE2000 of a pair in the model under D65, where it is 0 in truth */
    error_summary
        split_error;          /* how far the model's CIEDE2000 of a pair is from the true one, other lights */
    error_summary true_split; /* the true ones */
} metamer_errors;

MTM_CHECK mtm_status metamer_errors_measure(const model *made, const metamer_set *set, metamer_errors *errors,
                                            mtm_error *error);

#endif
