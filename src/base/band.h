/* SPDX-License-Identifier: BSD-3-Clause
 * Symmetric matrices that couple a number with its two neighbors on either side, as costs on first and second differences
 * do. */
#ifndef METAMER_BASE_BAND_H
#define METAMER_BASE_BAND_H

enum { MTM_BAND_MAX = 128 /* rows */ };

/* The diagonal and the two beside it: next[i] is the entry (i, i+1), second[i] the entry (i, i+2). */
typedef struct mtm_band {
    double main[MTM_BAND_MAX], next[MTM_BAND_MAX], second[MTM_BAND_MAX];
} mtm_band;

/* Adds what the cost ½·amount·(x[i] − x[i+1])² or ½·amount·(x[i] − 2x[i+1] + x[i+2])² has for a matrix. */
void mtm_band_add_slope(mtm_band *matrix, int i, double amount);
void mtm_band_add_bend(mtm_band *matrix, int i, double amount);

/* product = matrix · x, n rows. */
void mtm_band_multiply(int n, const mtm_band *matrix, const double *x, double *product);

/* Replaces a positive definite matrix by its factors L·D·Lᵀ. */
void mtm_band_factor(int n, mtm_band *matrix);

/* Solves for `count` right-hand sides at once, side by side in each of the n rows of x. */
void mtm_band_solve(int n, const mtm_band *factor, int count, double *x);

/* row[j] -= factor · other[j] */
static inline void mtm_take_away(int count, double factor, const double *other, double *row) {
    for (int j = 0; j < count; j++) row[j] -= factor * other[j];
}

#endif
