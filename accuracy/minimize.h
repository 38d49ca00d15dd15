/* SPDX-License-Identifier: BSD-3-Clause
 * The minimum of a smooth function of many variables. */
#ifndef METAMER_ACCURACY_MINIMIZE_H
#define METAMER_ACCURACY_MINIMIZE_H

#include "metamer/base.h"

/* The value at x (n numbers); writes the gradient (n numbers). */
typedef double (*minimize_function)(void *user, const double *x, double *gradient);

typedef struct minimize_options {
    int iterations_max;
    double decrease_min; /* stops where ten iterations lower the value by less than this share of it */
} minimize_options;

typedef struct minimize_result {
    double value;
    int iterations, evaluations;
} minimize_result;

/* Moves x downhill from where it starts. MTM_MEMORY. */
MTM_CHECK mtm_status minimize(int n, minimize_function function, void *user, const minimize_options *options,
                              double *x, minimize_result *result, mtm_error *error);

#endif
