/* SPDX-License-Identifier: BSD-3-Clause
 * The paper's basis: principal components, sharpened in intervals, scaled to white, the light as coefficients. */
#include "basis/sharpened.h"

#include <stdio.h>

#include "fixture.h"
#include "spectrum/embedded.h"

enum { FIRST = 4, SAMPLES = 61 /* 400 … 700 nm */ };

static void read_components(mtm_spectrum *components) {
    mtm_error error;
    for (int i = 0; i < MTM_FEW_DIMENSIONS_MAX; i++) {
        char column[16];
        (void)snprintf(column, sizeof column, "u_%d", i + 1);
        assert_ok(
            mtm_embedded_column("reflectance_pca", column, MTM_KIND_REFLECTANCE, &components[i], &error),
            error);
    }
}

static double product_within(const mtm_spectrum *a, const mtm_spectrum *b, int begin, int end) {
    double sum = 0;
    for (int k = begin; k < end; k++) sum += a->value[FIRST + k] * b->value[FIRST + k];
    return sum;
}

static mtm_basis *sharpened(int dimension) {
    char name[16];
    (void)snprintf(name, sizeof name, "sharpened:%d", dimension);
    return fixture_basis(name, NULL);
}

/* A spectrum of the subspace comes back, also beyond the components' own combinations of size 1. */
static void a_basis_spans_the_subspace_of_its_components(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum components[MTM_FEW_DIMENSIONS_MAX];
    float rows[MTM_SPECTRUM_SAMPLES * MTM_DIMENSION_MAX];
    read_components(components);
    for (int d = 3; d <= 9; d++) {
        mtm_basis *basis = sharpened(d);
        assert_ok(mtm_basis_reconstruction(basis, rows, &error), error);
        for (int component = 0; component < d; component++) {
            double c[MTM_DIMENSION_MAX];
            assert_ok(mtm_basis_encode(basis, &components[component], c, &error), error);
            for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
                double back = 0;
                for (int i = 0; i < d; i++) back += rows[k * d + i] * c[i];
                assert_near(back, components[component].value[k], 1e-6);
            }
        }
        mtm_basis_destroy(basis);
    }
}

/* L2 sharpening: of all spectra of the subspace and of the same total energy, none has more of it in the interval. */
static void each_column_is_the_sharpest_of_its_interval(void **state) {
    (void)state;
    enum { D = 7 };
    mtm_spectrum components[MTM_FEW_DIMENSIONS_MAX];
    uint32_t seed = 1;
    read_components(components);
    mtm_basis *basis = sharpened(D);
    for (int i = 0; i < D; i++) {
        const int begin = (int)ceil(SAMPLES * i / (double)D - 0.5);
        const int end = (int)ceil(SAMPLES * (i + 1) / (double)D - 0.5);
        const mtm_spectrum *column = &basis->columns[i];
        const double own =
            product_within(column, column, begin, end) / product_within(column, column, 0, SAMPLES);
        assert_true(own > 0.5);
        for (int repeat = 0; repeat < 500; repeat++) {
            mtm_spectrum other = *column;
            for (int j = 0; j < D; j++) {
                seed = seed * 1664525u + 1013904223u;
                const double amount = ((double)seed / 2147483648.0 - 1) * pow(10, -(repeat % 4));
                for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
                    other.value[k] += amount * components[j].value[k];
            }
            assert_true(product_within(&other, &other, begin, end) /
                            product_within(&other, &other, 0, SAMPLES) <=
                        own + 1e-12);
        }
    }
    mtm_basis_destroy(basis);
}

/* Eq. (2): the color is X · CMFᵀ · B · (ε ∘ σ), ε the light's own coefficients. */
static void the_light_is_coefficients_that_multiply(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    fixture_reflectances(reflectances);
    const mtm_illumination illumination = fixture_illumination("FL11");
    mtm_illumination equal_energy = illumination;
    equal_energy.light = mtm_spectrum_constant(1);
    mtm_basis *basis = sharpened(7);
    double matrix[21], light[7], material[7], product[7];
    assert_ok(mtm_basis_matrix(basis, &illumination, matrix, &error), error);
    assert_ok(mtm_basis_encode(basis, &illumination.light, light, &error), error);
    assert_ok(mtm_basis_encode(basis, &reflectances[1], material, &error), error);
    assert_ok(mtm_basis_multiply(basis, light, material, product, &error), error);
    mtm_spectrum reflected = mtm_spectrum_constant(0);
    double red = 0;
    for (int i = 0; i < 7; i++) {
        red += matrix[i] * material[i];
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
            reflected.value[k] += product[i] * basis->columns[i].value[k];
    }
    assert_near(red, mtm_illuminate(&equal_energy, &reflected).r, 1e-12);
    mtm_basis_destroy(basis);
}

/* All but the first component within the first interval: the columns of the other two are the same vector. */
static void an_ill_conditioned_basis_is_refused(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum components[3] = {mtm_spectrum_constant(1 / sqrt(SAMPLES)), mtm_spectrum_constant(0),
                                  mtm_spectrum_constant(0)};
    components[1].value[FIRST] = sqrt(0.5);
    components[1].value[FIRST + 1] = -sqrt(0.5);
    components[2].value[FIRST] = components[2].value[FIRST + 1] = sqrt(1 / 6.0);
    components[2].value[FIRST + 2] = -2 * sqrt(1 / 6.0);
    mtm_basis *basis = sharpened(3);
    assert_fails(mtm_basis_sharpen(basis, components, &error), MTM_NUMERIC, error, "ill-conditioned");
    mtm_basis_destroy(basis);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_basis_spans_the_subspace_of_its_components),
        cmocka_unit_test(each_column_is_the_sharpest_of_its_interval),
        cmocka_unit_test(the_light_is_coefficients_that_multiply),
        cmocka_unit_test(an_ill_conditioned_basis_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
