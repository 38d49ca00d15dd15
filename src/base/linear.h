/* SPDX-License-Identifier: BSD-3-Clause
 * Small dense linear systems in double precision with a fixed order of operations, so that results repeat. */
#ifndef METAMER_BASE_LINEAR_H
#define METAMER_BASE_LINEAR_H

#include "metamer/base.h"

/* Σ a[i]·b[i] in four partial sums, in this order: an addition need not wait for the one before. */
static inline double mtm_dot(int n, const double *a, const double *b) {
    double part[4] = {0, 0, 0, 0};
    int i = 0;
    for (; i + 4 <= n; i += 4)
        for (int k = 0; k < 4; k++) part[k] += a[i + k] * b[i + k];
    for (; i < n; i++) part[0] += a[i] * b[i];
    return (part[0] + part[1]) + (part[2] + part[3]);
}

/* Replaces the lower triangle (diagonal included) of the symmetric n×n `matrix`, row by row, `stride` ≥ n doubles
 * from row to row, by its Cholesky factor L, matrix = L·Lᵀ; what lies above the diagonal is neither read nor
 * written. False where a pivot is not above n·2⁻⁵² times its diagonal entry: not positive definite in double. */
MTM_CHECK bool mtm_cholesky_factor(int n, int stride, double *matrix);

/* Replaces the right-hand side b by the solution of L·Lᵀ x = b. */
void mtm_cholesky_solve(int n, int stride, const double *factor, double *b);

/* Eigenvalues and eigenvectors of the symmetric n×n `matrix`, row by row, by Jacobi's rotations: afterwards its
 * diagonal holds the eigenvalues, in no order, and column j of `vectors` (n×n) the unit vector of the j-th. Errors are
 * those of rounding the largest entry, so small eigenvalues beside large ones are known less well. */
void mtm_symmetric_eigen(int n, double *matrix, double *vectors);

/* A 3×3 matrix by value, m[row][column] (a pointer to an array cannot become const in C17). */
typedef struct mtm_matrix3 {
    double m[3][3];
} mtm_matrix3;

/* False (inverse untouched) where the determinant is 0 or not finite. */
MTM_CHECK bool mtm_matrix3_invert(mtm_matrix3 matrix, mtm_matrix3 *inverse);

/* a·b. */
mtm_matrix3 mtm_matrix3_multiply(mtm_matrix3 a, mtm_matrix3 b);

#endif
