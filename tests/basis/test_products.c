/* SPDX-License-Identifier: BSD-3-Clause
 * Encoding any spectrum, and products of coefficients (paper eq. 2). */
#include "fixture.h"

static const char *const multiplying[] = {
    "factors:3",   "factors:4",   "factors:5",      "factors:6",   "factors:7",   "factors:8",
    "factors:9",   "sharpened:3", "sharpened:4",    "sharpened:5", "sharpened:6", "sharpened:7",
    "sharpened:8", "sharpened:9", "wavelengths:31", "wavelengths",
};
enum { MULTIPLYING_COUNT = sizeof multiplying / sizeof *multiplying };

static mtm_xyz color_of(const mtm_basis *basis, const double *matrix, const double *coefficients) {
    const int d = mtm_basis_dimension(basis);
    mtm_xyz color = {0, 0, 0};
    for (int i = 0; i < d; i++) {
        color.x += matrix[i] * coefficients[i];
        color.y += matrix[d + i] * coefficients[i];
        color.z += matrix[2 * d + i] * coefficients[i];
    }
    return color;
}

/* M(E) to XYZ: the illumination's matrix to sRGB is taken out. */
static mtm_illumination xyz_illumination(const char *light) {
    mtm_illumination illumination = fixture_illumination(light);
    memset(illumination.rgb_from_xyz, 0, sizeof illumination.rgb_from_xyz);
    for (int i = 0; i < 3; i++) illumination.rgb_from_xyz[i][i] = 1;
    return illumination;
}

static void white_is_all_ones_and_changes_no_product(void **state) {
    (void)state;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    mtm_error error;
    fixture_reflectances(reflectances);
    for (int kind = 0; kind < MULTIPLYING_COUNT; kind++) {
        mtm_basis *basis = fixture_basis(multiplying[kind], NULL);
        double ones[MTM_DIMENSION_MAX];
        double a[MTM_DIMENSION_MAX];
        double product[MTM_DIMENSION_MAX];
        float in_lanes[MTM_DIMENSION_MAX];
        assert_ok(mtm_basis_encode(basis, &white, ones, &error), error);
        assert_ok(mtm_basis_encode(basis, &reflectances[1], a, &error), error);
        assert_ok(mtm_basis_multiply(basis, a, ones, product, &error), error);
        mtm_basis_encode_white(basis, in_lanes);
        for (int i = 0; i < mtm_basis_dimension(basis); i++) {
            assert_near(ones[i], 1, 1e-8);
            assert_near(in_lanes[i], 1, 1e-6);
            assert_near(product[i], a[i], 1e-8);
        }
        mtm_basis_destroy(basis);
    }
}

/* Where white is all ones, all ones have to look white: exactly where the light is exact. */
static void all_ones_reconstruct_to_white(void **state) {
    (void)state;
    mtm_error error;
    float rows[MTM_SPECTRUM_SAMPLES * MTM_DIMENSION_MAX];
    for (int kind = 0; kind < MULTIPLYING_COUNT; kind++) {
        mtm_basis *basis = fixture_basis(multiplying[kind], NULL);
        const int d = mtm_basis_dimension(basis);
        assert_ok(mtm_basis_reconstruction(basis, rows, &error), error);
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
            double sum = 0;
            for (int i = 0; i < d; i++) sum += rows[k * d + i];
            assert_near(sum, 1, 1e-6);
        }
        mtm_basis_destroy(basis);
    }
}

static void products_of_wavelengths_are_the_products_of_spectra(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    fixture_reflectances(reflectances);
    const mtm_illumination plain = xyz_illumination("FL11");
    mtm_illumination filtered = plain;
    filtered.light = mtm_spectrum_multiply(&plain.light, &reflectances[0]);
    filtered.light = mtm_spectrum_multiply(&filtered.light, &reflectances[2]);
    mtm_basis *basis = fixture_basis("wavelengths", NULL);
    double matrix[3 * MTM_DIMENSION_MAX], through[3 * MTM_DIMENSION_MAX], c[MTM_DIMENSION_MAX],
        filter[MTM_DIMENSION_MAX];
    assert_ok(mtm_basis_matrix(basis, &plain, matrix, &error), error);
    assert_ok(mtm_basis_matrix(basis, &filtered, through, &error), error);
    assert_ok(mtm_basis_encode(basis, &reflectances[1], c, &error), error);
    const mtm_xyz expected = color_of(basis, through, c);
    for (int i = 0; i < FIXTURE_MATERIALS; i += 2) {
        assert_ok(mtm_basis_encode(basis, &reflectances[i], filter, &error), error);
        assert_ok(mtm_basis_multiply(basis, c, filter, c, &error), error); /* in place */
    }
    const mtm_xyz color = color_of(basis, matrix, c);
    assert_near(color.x, expected.x, 1e-12);
    assert_near(color.y, expected.y, 1e-12);
    assert_near(color.z, expected.z, 1e-12);
    mtm_basis_destroy(basis);
}

static void coarse_wavelengths_are_exact_for_what_is_linear_between_them(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum bent;
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
        const int nm = 380 + 5 * k;
        bent.value[k] = nm <= 400 ? 0.2 : nm <= 530 ? 0.2 + 0.005 * (nm - 400) : 0.85;
    }
    const mtm_illumination illumination = xyz_illumination("FL11");
    mtm_basis *basis = fixture_basis("wavelengths:31", NULL);
    double matrix[3 * MTM_DIMENSION_MAX];
    double c[MTM_DIMENSION_MAX];
    assert_int_equal(mtm_basis_dimension(basis), 31);
    assert_ok(mtm_basis_encode(basis, &bent, c, &error), error);
    assert_ok(mtm_basis_matrix(basis, &illumination, matrix, &error), error);
    const mtm_spectrum stimulus = mtm_spectrum_multiply(&illumination.light, &bent);
    const mtm_xyz expected = mtm_xyz_of(&stimulus, &illumination.observer);
    const mtm_xyz color = color_of(basis, matrix, c);
    assert_near(color.x, expected.x, 1e-12);
    assert_near(color.y, expected.y, 1e-12);
    assert_near(color.z, expected.z, 1e-12);
    mtm_basis_destroy(basis);
}

static uint32_t next_random(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* Encoding curves are nowhere negative and sum to 1, so any reflectance stays within 0 … 1. */
static void factors_of_physical_reflectances_are_physical(void **state) {
    (void)state;
    mtm_error error;
    uint32_t seed = 3;
    for (int kind = 0; kind < 7; kind++) {
        mtm_basis *basis = fixture_basis(multiplying[kind], NULL);
        for (int repeat = 0; repeat < 200; repeat++) {
            mtm_spectrum spectrum;
            double c[MTM_DIMENSION_MAX];
            for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) spectrum.value[k] = next_random(&seed) & 1;
            assert_ok(mtm_basis_encode(basis, &spectrum, c, &error), error);
            for (int i = 0; i < mtm_basis_dimension(basis); i++) assert_true(c[i] >= 0 && c[i] <= 1 + 1e-9);
        }
        mtm_basis_destroy(basis);
    }
}

static void bases_without_products_say_so(void **state) {
    (void)state;
    mtm_error error;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    const mtm_illumination light = fixture_illumination("A");
    double c[MTM_DIMENSION_MAX] = {0};
    mtm_basis *materials = fixture_basis("materials", NULL);
    mtm_basis *rgb = fixture_basis("rgb", &light);
    assert_fails(mtm_basis_encode(materials, &white, c, &error), MTM_ARGUMENT, error, "materials");
    assert_fails(mtm_basis_multiply(materials, c, c, c, &error), MTM_ARGUMENT, error, "no products");
    assert_fails(mtm_basis_multiply(rgb, c, c, c, &error), MTM_ARGUMENT, error, "no products");
    assert_ok(mtm_basis_encode(rgb, &white, c, &error), error);
    const mtm_rgb color = mtm_illuminate(&light, &white);
    assert_near(c[0], color.r, 1e-12);
    assert_near(c[2], color.b, 1e-12);
    mtm_basis_destroy(materials);
    mtm_basis_destroy(rgb);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_is_all_ones_and_changes_no_product),
        cmocka_unit_test(all_ones_reconstruct_to_white),
        cmocka_unit_test(products_of_wavelengths_are_the_products_of_spectra),
        cmocka_unit_test(coarse_wavelengths_are_exact_for_what_is_linear_between_them),
        cmocka_unit_test(factors_of_physical_reflectances_are_physical),
        cmocka_unit_test(bases_without_products_say_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
