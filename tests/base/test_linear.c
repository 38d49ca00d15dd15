/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/linear.h"

#include <math.h>

#include "test.h"

enum { SIZE = 40, STRIDE = 43 };

/* Numbers in -1 … 1 that look random and repeat (a linear congruence). */
static double next_number(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)*seed / 2147483648.0 - 1;
}

/* Bᵀ·B + 0.1·I of a random B is positive definite; the upper triangle holds what must not be read. */
static void fill_positive_definite(double matrix[SIZE][STRIDE], double full[SIZE][SIZE]) {
    uint32_t seed = 5;
    double b[SIZE][SIZE];
    for (int i = 0; i < SIZE; i++)
        for (int j = 0; j < SIZE; j++) b[i][j] = next_number(&seed);
    for (int i = 0; i < SIZE; i++) {
        for (int j = 0; j < SIZE; j++) {
            full[i][j] = i == j ? 0.1 : 0;
            for (int k = 0; k < SIZE; k++) full[i][j] += b[k][i] * b[k][j];
        }
        for (int j = 0; j < STRIDE; j++) matrix[i][j] = j <= i ? full[i][j] : NAN;
    }
}

static void a_positive_definite_system_is_solved(void **state) {
    (void)state;
    double matrix[SIZE][STRIDE], full[SIZE][SIZE], x[SIZE];
    fill_positive_definite(matrix, full);
    for (int i = 0; i < SIZE; i++) x[i] = sin(3.0 * i);
    assert_true(mtm_cholesky_factor(SIZE, STRIDE, matrix[0]));
    mtm_cholesky_solve(SIZE, STRIDE, matrix[0], x);
    for (int i = 0; i < SIZE; i++) {
        double residual = -sin(3.0 * i);
        for (int j = 0; j < SIZE; j++) residual += full[i][j] * x[j];
        assert_float_equal(residual, 0, 1e-12);
    }
}

static void a_matrix_that_is_not_positive_definite_is_refused(void **state) {
    (void)state;
    double indefinite[4] = {1, 0, 2, 1};
    double singular[4] = {1, 0, 1, 1};
    double not_a_number[4] = {1, 0, NAN, 1};
    double nothing = 0;
    assert_false(mtm_cholesky_factor(2, 2, indefinite));
    assert_false(mtm_cholesky_factor(2, 2, singular));
    assert_false(mtm_cholesky_factor(2, 2, not_a_number));
    assert_false(mtm_cholesky_factor(1, 1, &nothing));
    assert_true(mtm_cholesky_factor(0, 0, &nothing));
}

static void eigenvectors_are_orthonormal_and_keep_their_direction(void **state) {
    (void)state;
    double padded[SIZE][STRIDE], full[SIZE][SIZE], matrix[SIZE * SIZE], vectors[SIZE * SIZE];
    fill_positive_definite(padded, full);
    for (int i = 0; i < SIZE * SIZE; i++) matrix[i] = full[i / SIZE][i % SIZE];
    mtm_symmetric_eigen(SIZE, matrix, vectors);
    for (int k = 0; k < SIZE; k++)
        for (int i = 0; i < SIZE; i++) {
            double image = 0;
            double product = 0;
            for (int j = 0; j < SIZE; j++) {
                image += full[i][j] * vectors[j * SIZE + k];
                product += vectors[j * SIZE + i] * vectors[j * SIZE + k];
            }
            assert_float_equal(image, matrix[k * SIZE + k] * vectors[i * SIZE + k], 1e-12);
            assert_float_equal(product, i == k ? 1 : 0, 1e-13);
        }
}

/* Entries of 0 on the diagonal, a diagonal matrix and one row: nothing to divide by. */
static void eigenvalues_of_small_matrices_are_exact(void **state) {
    (void)state;
    double swap[4] = {0, 1, 1, 0}, diagonal[4] = {3, 0, 0, -2}, one = 5, vectors[4];
    mtm_symmetric_eigen(2, swap, vectors);
    assert_float_equal(swap[0], -swap[3], 1e-15);
    assert_float_equal(fabs(swap[0]), 1, 1e-15);
    mtm_symmetric_eigen(2, diagonal, vectors);
    assert_true(diagonal[0] == 3 && diagonal[3] == -2 && vectors[0] == 1 && vectors[1] == 0);
    mtm_symmetric_eigen(1, &one, vectors);
    assert_true(one == 5 && vectors[0] == 1);
}

/* Rank 1 has eigenvalues 0 again and again; tiny entries must not underflow into being ignored. */
static void eigenvalues_of_deficient_and_tiny_matrices_are_found(void **state) {
    (void)state;
    static const double scales[] = {1, 1e-170, 1e150};
    for (int k = 0; k < 3; k++) {
        double matrix[9], vectors[9];
        const double line[3] = {1, 2, -2};
        for (int i = 0; i < 9; i++) matrix[i] = scales[k] * line[i / 3] * line[i % 3];
        mtm_symmetric_eigen(3, matrix, vectors);
        double largest = 0;
        double rest = 0;
        for (int i = 0; i < 9; i++)
            if (i % 4 == 0 && fabs(matrix[i]) > largest)
                largest = fabs(matrix[i]);
            else if (i % 4 != 0)
                rest = fmax(rest, fabs(matrix[i]));
        assert_true(fabs(largest / scales[k] - 9) < 1e-13);
        assert_true(rest / scales[k] < 1e-13);
    }
}

static void a_3x3_matrix_times_its_inverse_is_one(void **state) {
    (void)state;
    const mtm_matrix3 matrix = {
        {{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}}};
    mtm_matrix3 inverse;
    assert_true(mtm_matrix3_invert(matrix, &inverse));
    const mtm_matrix3 product = mtm_matrix3_multiply(matrix, inverse);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) assert_float_equal(product.m[i][j], i == j ? 1 : 0, 1e-15);
}

static void a_singular_3x3_matrix_has_no_inverse(void **state) {
    (void)state;
    const mtm_matrix3 matrix = {{{1, 2, 3}, {2, 4, 6}, {0, 1, 0}}};
    mtm_matrix3 inverse = {{{7}}};
    assert_false(mtm_matrix3_invert(matrix, &inverse));
    assert_true(inverse.m[0][0] == 7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_positive_definite_system_is_solved),
        cmocka_unit_test(a_matrix_that_is_not_positive_definite_is_refused),
        cmocka_unit_test(eigenvectors_are_orthonormal_and_keep_their_direction),
        cmocka_unit_test(eigenvalues_of_small_matrices_are_exact),
        cmocka_unit_test(eigenvalues_of_deficient_and_tiny_matrices_are_found),
        cmocka_unit_test(a_3x3_matrix_times_its_inverse_is_one),
        cmocka_unit_test(a_singular_3x3_matrix_has_no_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
