/* SPDX-License-Identifier: BSD-3-Clause
 * Principal components of spectra, the flat spectrum among them. */
#ifndef METAMER_ACCURACY_PRINCIPAL_H
#define METAMER_ACCURACY_PRINCIPAL_H

enum { PRINCIPAL_SAMPLES = 61, PRINCIPAL_COMPONENTS = 9 }; /* 400, 405 … 700 nm */

/* Of a symmetric matrix: `values` falling, vectors[k] the unit vector of values[k], its entry of largest magnitude
 * positive. The matrix is destroyed. */
typedef double principal_matrix[PRINCIPAL_SAMPLES][PRINCIPAL_SAMPLES];
void principal_eigenvectors(principal_matrix matrix, double values[PRINCIPAL_SAMPLES],
                            principal_matrix vectors);

/* The constant 1/√61 first, then the leading right singular vectors of the spectra (`spectrum_count` rows of
 * PRINCIPAL_SAMPLES) without their part along it, not centered. `energy` (may be NULL) receives what of the spectra's sum
 * of squares lies along each. */
void principal_components(int spectrum_count, const double (*spectra)[PRINCIPAL_SAMPLES],
                          double components[PRINCIPAL_COMPONENTS][PRINCIPAL_SAMPLES],
                          double energy[PRINCIPAL_COMPONENTS]);

#endif
