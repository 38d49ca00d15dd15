/* SPDX-License-Identifier: BSD-3-Clause
 * The tables of data/bases are what their README says, whatever made them; and the principal components are the best. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "accuracy/collection.h"
#include "accuracy/principal.h"
#include "accuracy/random.h"
#include "accuracy/training.h"
#include "test.h"

enum { N = PRINCIPAL_SAMPLES, K = PRINCIPAL_COMPONENTS };

static void read_base(const char *name, mtm_spectrum_table *table) {
    char path[1024];
    mtm_error error;
    (void)snprintf(path, sizeof path, "%s/data/bases/%s", METAMER_SOURCE_DIR, name);
    assert_ok(mtm_spectrum_table_read(path, table, &error), error);
}

static double value_at(const mtm_spectrum_table *table, int row, int column) {
    return table->values[row * table->column_count + column];
}

static void check_factors(int dimension) {
    char name[64];
    mtm_spectrum_table table;
    (void)snprintf(name, sizeof name, "factors_%d.csv", dimension);
    read_base(name, &table);
    assert_int_equal(table.column_count, 2 * dimension);
    assert_int_equal(table.row_count, MTM_SPECTRUM_SAMPLES);
    double centroid_before_nm = 0;
    for (int j = 0; j < dimension; j++) {
        double sum = 0;
        double centroid_nm = 0;
        for (int i = 0; i < table.row_count; i++) {
            assert_true(table.wavelength_nm[i] == MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * i);
            assert_true(value_at(&table, i, j) >= 0);
            sum += value_at(&table, i, j);
            centroid_nm += value_at(&table, i, j) * table.wavelength_nm[i];
        }
        assert_float_equal(sum, 1, 1e-9);
        assert_true(centroid_nm > centroid_before_nm);
        centroid_before_nm = centroid_nm;
        (void)snprintf(name, sizeof name, "encode_%d", j + 1);
        assert_string_equal(table.names[j], name);
        (void)snprintf(name, sizeof name, "spectrum_%d", j + 1);
        assert_string_equal(table.names[dimension + j], name);
    }
    for (int i = 0; i < table.row_count; i++) {
        double sum = 0;
        for (int j = 0; j < dimension; j++) sum += value_at(&table, i, dimension + j);
        assert_float_equal(sum, 1, 1e-9);
    }
    mtm_spectrum_table_free(&table);
}

static void factors_encode_white_as_ones_and_ones_are_white(void **state) {
    (void)state;
    for (int dimension = 3; dimension <= 9; dimension++) check_factors(dimension);
}

static void read_components(double components[K][N]) {
    mtm_spectrum_table table;
    read_base("reflectance_pca.csv", &table);
    assert_int_equal(table.row_count, N);
    assert_int_equal(table.column_count, K);
    assert_true(table.wavelength_nm[0] == 400 && table.wavelength_nm[N - 1] == 700);
    for (int k = 0; k < K; k++)
        for (int i = 0; i < N; i++) components[k][i] = value_at(&table, i, k);
    mtm_spectrum_table_free(&table);
}

static double dot(const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < N; i++) sum += a[i] * b[i];
    return sum;
}

/* The training reflectances from 400 to 700 nm; the number of them. */
static int read_spectra(double spectra[][N], int count_max) {
    collection all;
    collection_list list;
    mtm_error error;
    assert_ok(collection_read(METAMER_SOURCE_DIR, NULL, &all, &error), error);
    assert_ok(training_read_principal(METAMER_SOURCE_DIR, &all, &list, &error), error);
    assert_true(list.count > 200 && list.count <= count_max);
    const int count = list.count;
    for (int i = 0; i < count; i++) memcpy(spectra[i], &list.items[i].spectrum.value[4], sizeof spectra[0]);
    collection_list_free(&list);
    collection_free(&all);
    return count;
}

/* What of the spectra's squares lies along the vectors, which need not be orthonormal: Gram and Schmidt make them so. */
static double captured(int count, double spectra[][N], double components[K][N]) {
    double basis[K][N];
    double sum = 0;
    for (int k = 0; k < K; k++) {
        memcpy(basis[k], components[k], sizeof basis[k]);
        for (int l = 0; l < k; l++) {
            const double along = dot(basis[k], basis[l]);
            for (int i = 0; i < N; i++) basis[k][i] -= along * basis[l][i];
        }
        const double length = sqrt(dot(basis[k], basis[k]));
        for (int i = 0; i < N; i++) basis[k][i] /= length;
        for (int n = 0; n < count; n++) sum += pow(dot(spectra[n], basis[k]), 2);
    }
    return sum;
}

static void components_are_orthonormal_and_the_first_is_flat(void **state) {
    (void)state;
    double components[K][N];
    read_components(components);
    for (int i = 0; i < N; i++) assert_float_equal(components[0][i], 1 / sqrt(N), 1e-11);
    for (int k = 0; k < K; k++)
        for (int l = 0; l < K; l++) assert_float_equal(dot(components[k], components[l]), k == l, 1e-10);
}

/* No other eight directions beside the flat one keep more: moving them at random only loses. */
static void components_keep_as_much_as_nine_can(void **state) {
    (void)state;
    static double spectra[300][N];
    double components[K][N], moved[K][N];
    read_components(components);
    const int count = read_spectra(spectra, 300);
    const double best = captured(count, spectra, components);
    double whole = 0;
    for (int n = 0; n < count; n++) whole += dot(spectra[n], spectra[n]);
    assert_true(best < whole && best > 0.999 * whole);
    random_state random = 1;
    for (int trial = 0; trial < 200; trial++) {
        const double size = trial % 2 == 0 ? 1e-3 : 0.03;
        memcpy(moved, components, sizeof moved);
        for (int k = 1; k < K; k++)
            for (int i = 0; i < N; i++) moved[k][i] += random_between(&random, -size, size);
        assert_true(captured(count, spectra, moved) < best);
    }
}

/* Energies fall from the second on, each is the energy along its own component, and none lies across two. */
static void energies_are_those_along_the_components(void **state) {
    (void)state;
    static double spectra[300][N];
    double components[K][N], energy[K];
    const int count = read_spectra(spectra, 300);
    principal_components(count, (const double(*)[N])spectra, components, energy);
    for (int k = 0; k < K; k++) {
        double along = 0;
        double across = 0;
        for (int n = 0; n < count; n++) {
            along += pow(dot(spectra[n], components[k]), 2);
            if (k > 1) across += dot(spectra[n], components[k]) * dot(spectra[n], components[k - 1]);
        }
        assert_float_equal(energy[k], along, 1e-9 * energy[0]);
        if (k > 1) assert_float_equal(across, 0, 1e-9 * energy[0]);
        if (k > 1) assert_true(energy[k] < energy[k - 1]);
    }
}

/* −1, 2, −1 along the diagonal has the eigenvalues 4 sin²(kπ / 2(n+1)) with sine vectors. */
static void eigenvectors_of_the_second_difference_are_sines(void **state) {
    (void)state;
    static principal_matrix matrix, vectors;
    double values[N];
    const double pi = acos(-1);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) matrix[i][j] = i == j ? 2 : i - j == 1 || j - i == 1 ? -1 : 0;
    principal_eigenvectors(matrix, values, vectors);
    for (int k = 0; k < N; k++) {
        const double angle = (N - k) * pi / (N + 1);
        assert_float_equal(values[k], 4 * pow(sin(angle / 2), 2), 1e-12);
        double sine[N], largest = 0;
        for (int i = 0; i < N; i++) {
            sine[i] = sqrt(2.0 / (N + 1)) * sin((i + 1) * angle);
            if (fabs(vectors[k][i]) > fabs(largest)) largest = vectors[k][i];
        }
        assert_float_equal(fabs(dot(sine, vectors[k])), 1, 1e-12);
        assert_true(largest > 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_encode_white_as_ones_and_ones_are_white),
        cmocka_unit_test(components_are_orthonormal_and_the_first_is_flat),
        cmocka_unit_test(components_keep_as_much_as_nine_can),
        cmocka_unit_test(energies_are_those_along_the_components),
        cmocka_unit_test(eigenvectors_of_the_second_difference_are_sines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
