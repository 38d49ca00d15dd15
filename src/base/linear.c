/* SPDX-License-Identifier: BSD-3-Clause
 * Cholesky's factorisation, row by row, Jacobi's rotations (both: Golub, Van Loan, Matrix Computations), and 3×3 matrices
 * by cofactors. */
#include "base/linear.h"

#include <assert.h>
#include <float.h>
#include <math.h>

bool mtm_cholesky_factor(int n, int stride, double *matrix) {
    assert(n >= 0 && stride >= n);
    for (int i = 0; i < n; i++) {
        double *row = matrix + (size_t)i * (size_t)stride;
        for (int j = 0; j < i; j++) {
            const double *above = matrix + (size_t)j * (size_t)stride;
            row[j] = (row[j] - mtm_dot(j, row, above)) / above[j];
        }
        const double pivot = row[i] - mtm_dot(i, row, row);
        if (!(pivot > n * DBL_EPSILON * fabs(row[i]))) return false;
        row[i] = sqrt(pivot);
    }
    return true;
}

void mtm_cholesky_solve(int n, int stride, const double *factor, double *b) {
    for (int i = 0; i < n; i++) {
        const double *row = factor + (size_t)i * (size_t)stride;
        b[i] = (b[i] - mtm_dot(i, row, b)) / row[i];
    }
    for (int i = n - 1; i >= 0; i--) {
        const double *row = factor + (size_t)i * (size_t)stride;
        b[i] /= row[i];
        for (int j = 0; j < i; j++) b[j] -= row[j] * b[i];
    }
}

/* The rotation by which the entry (p, q) becomes 0, its angle at most π/4. */
static void rotate(int n, double *a, double *vectors, int p, int q) {
    const double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]);
    const double tangent = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    const double cosine = 1 / sqrt(tangent * tangent + 1);
    const double sine = tangent * cosine;
    for (int k = 0; k < n; k++) {
        const double kp = a[k * n + p];
        const double kq = a[k * n + q];
        a[k * n + p] = cosine * kp - sine * kq;
        a[k * n + q] = sine * kp + cosine * kq;
        const double vp = vectors[k * n + p];
        const double vq = vectors[k * n + q];
        vectors[k * n + p] = cosine * vp - sine * vq;
        vectors[k * n + q] = sine * vp + cosine * vq;
    }
    for (int k = 0; k < n; k++) {
        const double pk = a[p * n + k];
        const double qk = a[q * n + k];
        a[p * n + k] = cosine * pk - sine * qk;
        a[q * n + k] = sine * pk + cosine * qk;
    }
}

void mtm_symmetric_eigen(int n, double *matrix, double *vectors) {
    enum { SWEEPS = 60 }; /* convergence is quadratic: a handful is usual */
    double largest = 0;
    for (int i = 0; i < n * n; i++) {
        vectors[i] = i % (n + 1) == 0;
        largest = fmax(largest, fabs(matrix[i]));
    }
    bool is_diagonal = false;
    for (int sweep = 0; sweep < SWEEPS && !is_diagonal; sweep++) {
        is_diagonal = true;
        for (int p = 0; p < n; p++)
            for (int q = p + 1; q < n; q++) {
                if (fabs(matrix[p * n + q]) <= DBL_EPSILON * largest) continue;
                rotate(n, matrix, vectors, p, q);
                is_diagonal = false;
            }
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
