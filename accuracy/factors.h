/* SPDX-License-Identifier: BSD-3-Clause
 * The curves of the basis `factors`: a reflectance S is encoded as the d means Σ P·S, products of reflectances are
 * products of these, and the spectrum reconstructed is B·c, which a light E meets as the exact 3×d matrix XYZ·E·B. */
#ifndef METAMER_ACCURACY_FACTORS_H
#define METAMER_ACCURACY_FACTORS_H

#include "minimize.h"
#include "training.h"

enum { FACTORS_MIN = 3, FACTORS_MAX = 9 };

/* Row j belongs to coefficient j; only the first `dimension` rows count. Each row of `encode` is ≥ 0 with the sum 1;
 * at each wavelength the rows of `spectrum` have the sum 1. So white is encoded as ones, and ones are white. */
typedef struct factor_curves {
    int dimension;
    double encode[FACTORS_MAX][MTM_SPECTRUM_SAMPLES];
    double spectrum[FACTORS_MAX][MTM_SPECTRUM_SAMPLES];
} factor_curves;

/* The function that the fit minimizes, of factor_variable_count() variables: the mean color error of the training set
 * and a little roughness of the curves. */
typedef struct factor_objective factor_objective;

/* The training set must outlive it. MTM_MEMORY. */
MTM_CHECK mtm_status factor_objective_create(const training_set *training, int dimension,
                                             factor_objective **objective, mtm_error *error);
void factor_objective_destroy(factor_objective *objective);
int factor_variable_count(int dimension);

/* The value at the variables and its gradient; a minimize_function. */
double factor_objective_value(void *objective, const double *variables, double *gradient);

/* The variables that the fit starts from. */
void factor_start(int dimension, double *variables);

/* The curves that variables stand for. */
void factor_curves_of(int dimension, const double *variables, factor_curves *curves);

/* Fits the curves and puts them in the order of the wavelengths they look at. MTM_MEMORY. */
MTM_CHECK mtm_status factor_fit(const training_set *training, int dimension, factor_curves *curves,
                                minimize_result *result, mtm_error *error);

#endif
