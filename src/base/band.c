/* SPDX-License-Identifier: BSD-3-Clause
 * Banded matrices of five diagonals by LDLᵀ without pivoting (Golub, Van Loan, Matrix Computations, section 4.3). */
#include "base/band.h"

void mtm_band_add_slope(mtm_band *matrix, int i, double amount) {
    matrix->main[i] += amount;
    matrix->main[i + 1] += amount;
    matrix->next[i] -= amount;
}

void mtm_band_add_bend(mtm_band *matrix, int i, double amount) {
    matrix->main[i] += amount;
    matrix->main[i + 1] += 4 * amount;
    matrix->main[i + 2] += amount;
    matrix->next[i] -= 2 * amount;
    matrix->next[i + 1] -= 2 * amount;
    matrix->second[i] += amount;
}

void mtm_band_multiply(int n, const mtm_band *matrix, const double *x, double *product) {
    for (int i = 0; i < n; i++) product[i] = matrix->main[i] * x[i];
    for (int i = 0; i + 1 < n; i++) {
        product[i] += matrix->next[i] * x[i + 1];
        product[i + 1] += matrix->next[i] * x[i];
    }
    for (int i = 0; i + 2 < n; i++) {
        product[i] += matrix->second[i] * x[i + 2];
        product[i + 2] += matrix->second[i] * x[i];
    }
}

/* Afterwards `main` holds the inverse of D, `next` and `second` the entries of L. */
void mtm_band_factor(int n, mtm_band *matrix) {
    for (int i = 0; i < n; i++) {
        const double pivot = matrix->main[i];
        const double next = matrix->next[i];
        const double second = matrix->second[i];
        if (i + 1 < n) {
            matrix->next[i] = next / pivot;
            matrix->main[i + 1] -= matrix->next[i] * next;
            matrix->next[i + 1] -= matrix->next[i] * second;
        }
        if (i + 2 < n) {
            matrix->second[i] = second / pivot;
            matrix->main[i + 2] -= matrix->second[i] * second;
        }
        matrix->main[i] = 1 / pivot;
    }
}

void mtm_band_solve(int n, const mtm_band *factor, int count, double *x) {
    for (int i = 1; i < n; i++) {
        mtm_take_away(count, factor->next[i - 1], x + (i - 1) * count, x + i * count);
        if (i >= 2) mtm_take_away(count, factor->second[i - 2], x + (i - 2) * count, x + i * count);
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = 0; j < count; j++) x[i * count + j] *= factor->main[i];
        if (i + 1 < n) mtm_take_away(count, factor->next[i], x + (i + 1) * count, x + i * count);
        if (i + 2 < n) mtm_take_away(count, factor->second[i], x + (i + 2) * count, x + i * count);
    }
}
