/* SPDX-License-Identifier: BSD-3-Clause
 * Cholesky's factorisation, row by row (Golub, Van Loan: Matrix Computations), and 3×3 matrices by cofactors. */
#include "base/linear.h"

#include <assert.h>
#include <float.h>
#include <math.h>

static double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

bool mtm_cholesky_factor(int n, int stride, double *matrix) {
    assert(n >= 0 && stride >= n);
    for (int i = 0; i < n; i++) {
        double *row = matrix + (size_t)i * (size_t)stride;
        for (int j = 0; j < i; j++) {
            const double *above = matrix + (size_t)j * (size_t)stride;
            row[j] = (row[j] - dot(j, row, above)) / above[j];
        }
        const double pivot = row[i] - dot(i, row, row);
        if (!(pivot > n * DBL_EPSILON * fabs(row[i]))) return false;
        row[i] = sqrt(pivot);
    }
    return true;
}

void mtm_cholesky_solve(int n, int stride, const double *factor, double *b) {
    for (int i = 0; i < n; i++) {
        const double *row = factor + (size_t)i * (size_t)stride;
        b[i] = (b[i] - dot(i, row, b)) / row[i];
    }
    for (int i = n - 1; i >= 0; i--) {
        const double *row = factor + (size_t)i * (size_t)stride;
        b[i] /= row[i];
        for (int j = 0; j < i; j++) b[j] -= row[j] * b[i];
    }
}

/* The cofactor of row i and column j, its sign given by the cyclic order of the others. */
static double cofactor(const mtm_matrix3 *matrix, int i, int j) {
    const double *upper = matrix->m[(i + 1) % 3];
    const double *lower = matrix->m[(i + 2) % 3];
    const int left = (j + 1) % 3;
    const int right = (j + 2) % 3;
    return upper[left] * lower[right] - upper[right] * lower[left];
}

bool mtm_matrix3_invert(mtm_matrix3 matrix, mtm_matrix3 *inverse) {
    double determinant = 0;
    for (int j = 0; j < 3; j++) determinant += matrix.m[0][j] * cofactor(&matrix, 0, j);
    if (determinant == 0 || !isfinite(determinant)) return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) inverse->m[i][j] = cofactor(&matrix, j, i) / determinant;
    return true;
}

mtm_matrix3 mtm_matrix3_multiply(mtm_matrix3 a, mtm_matrix3 b) {
    mtm_matrix3 product;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            product.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
    return product;
}
