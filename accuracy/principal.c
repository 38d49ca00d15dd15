/* SPDX-License-Identifier: BSD-3-Clause
 * Principal components by Jacobi's method: G. H. Golub, C. F. Van Loan, "Matrix Computations", 4th edition, 2013,
 * section 8.5, in cyclic order, so that the result repeats bit for bit. */
#include "principal.h"

#include <math.h>
#include <string.h>

enum { N = PRINCIPAL_SAMPLES, SWEEPS = 30 };

/* The rotation that makes matrix[p][q] zero. */
static void rotate(principal_matrix matrix, principal_matrix vectors, int p, int q) {
    if (matrix[p][q] == 0) return;
    const double tau = (matrix[q][q] - matrix[p][p]) / (2 * matrix[p][q]);
    const double root = sqrt(1 + tau * tau);
    const double tangent = tau >= 0 ? 1 / (tau + root) : 1 / (tau - root);
    const double cosine = 1 / sqrt(1 + tangent * tangent);
    const double sine = tangent * cosine;
    for (int i = 0; i < N; i++) {
        const double a = matrix[i][p];
        const double b = matrix[i][q];
        matrix[i][p] = cosine * a - sine * b;
        matrix[i][q] = sine * a + cosine * b;
    }
    for (int i = 0; i < N; i++) {
        const double a = matrix[p][i];
        const double b = matrix[q][i];
        matrix[p][i] = cosine * a - sine * b;
        matrix[q][i] = sine * a + cosine * b;
    }
    matrix[p][q] = matrix[q][p] = 0;
    for (int i = 0; i < N; i++) {
        const double a = vectors[p][i];
        const double b = vectors[q][i];
        vectors[p][i] = cosine * a - sine * b;
        vectors[q][i] = sine * a + cosine * b;
    }
}

static void swap_pairs(double values[N], principal_matrix vectors, int i, int j) {
    if (i == j) return;
    double row[N];
    const double value = values[i];
    values[i] = values[j];
    values[j] = value;
    memcpy(row, vectors[i], sizeof row);
    memcpy(vectors[i], vectors[j], sizeof row);
    memcpy(vectors[j], row, sizeof row);
}

static void make_largest_entry_positive(double vector[N]) {
    int largest = 0;
    for (int i = 1; i < N; i++)
        if (fabs(vector[i]) > fabs(vector[largest])) largest = i;
    if (vector[largest] > 0) return;
    for (int i = 0; i < N; i++) vector[i] = -vector[i];
}

void principal_eigenvectors(principal_matrix matrix, double values[N], principal_matrix vectors) {
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) vectors[i][j] = i == j;
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int p = 0; p < N; p++)
            for (int q = p + 1; q < N; q++) rotate(matrix, vectors, p, q);
    for (int i = 0; i < N; i++) values[i] = matrix[i][i];
    for (int i = 0; i < N; i++) {
        int largest = i;
        for (int j = i + 1; j < N; j++)
            if (values[j] > values[largest]) largest = j;
        swap_pairs(values, vectors, i, largest);
        make_largest_entry_positive(vectors[i]);
    }
}

void principal_components(int spectrum_count, const double (*spectra)[N],
                          double components[PRINCIPAL_COMPONENTS][N], double energy[PRINCIPAL_COMPONENTS]) {
    principal_matrix moments = {{0}};
    principal_matrix vectors;
    double values[N];
    double flat_energy = 0;
    for (int n = 0; n < spectrum_count; n++) {
        double sum = 0;
        for (int i = 0; i < N; i++) sum += spectra[n][i];
        flat_energy += sum * sum / N;
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++)
                moments[i][j] += (spectra[n][i] - sum / N) * (spectra[n][j] - sum / N);
    }
    principal_eigenvectors(moments, values, vectors);
    for (int i = 0; i < N; i++) components[0][i] = 1 / sqrt(N);
    memcpy(components[1], vectors, (PRINCIPAL_COMPONENTS - 1) * sizeof vectors[0]);
    if (energy == NULL) return;
    energy[0] = flat_energy;
    memcpy(energy + 1, values, (PRINCIPAL_COMPONENTS - 1) * sizeof *values);
}
