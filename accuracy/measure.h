/* SPDX-License-Identifier: BSD-3-Clause
 * All that the accuracy report tells, measured. */
#ifndef METAMER_ACCURACY_MEASURE_H
#define METAMER_ACCURACY_MEASURE_H

#include "engine.h"
#include "metamers.h"
#include "products.h"

/* What products are drawn from. The reflectances in the repository are those of ColorChecker and CES99 that no basis was
 * fitted to; *full* ones are half of the time those, half of the time such of the Munsell book. */
typedef enum measured_set {
    SET_HELD_OUT, /* held-out lights, a third of the draws of each class, on held-out reflectances */
    SET_PAIRS,    /* the same spectra, every pair of light and first reflectance once */
    SET_HOUSER,   /* 401 other lamps on held-out reflectances */
    SET_FULL,     /* as SET_HELD_OUT, with Munsell chips */
    SET_FULL_HOUSER,
    SET_OPSTELTEN, /* held-out lights on another collection */
    SET_CRI2012,
    SET_COUNT
} measured_set;

enum { SETS_IN_REPOSITORY = SET_FULL };

typedef struct measure_options {
    const char *source_folder;
    const char *more_folder; /* with the tables that are not in the repository; NULL: without them */
    int draw_count;          /* of a set, a multiple of LIGHT_CLASSES */
    engine_options engine;
} measure_options;

typedef struct measurements {
    measure_options options;
    int set_count; /* sets measured, from the first */
    int pair_count, metamer_count, light_count, reflectance_count, lamp_count;
    int more_reflectance_count;   /* of Munsell */
    bool is_missing[MODEL_COUNT]; /* the library refuses to make it: it is ill-conditioned */
    product_errors products[SET_COUNT][MODEL_COUNT];
    metamer_errors metamers[MODEL_COUNT];
    engine_errors engine;
} measurements;

/* Errors: those of reading the spectra and the scene; MTM_MEMORY. Release with free(). */
MTM_CHECK mtm_status measure_all(const measure_options *options, measurements **made, mtm_error *error);

/* Of one model. */
const product_errors *measured_products(const measurements *made, measured_set set, model_family family,
                                        int dimension);

#endif
