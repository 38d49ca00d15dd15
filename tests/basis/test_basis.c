/* SPDX-License-Identifier: BSD-3-Clause
 * Bases against full spectra (paper eq. 1). */
#include "fixture.h"

static const char *const relightable[] = {"materials", "wavelengths"};
static const char *const lights[] = {"D65", "A", "FL11", "LED-RGB1"};

static mtm_rgb color_of(const mtm_basis *basis, const double *matrix, const float *coefficients) {
    const int d = mtm_basis_dimension(basis);
    mtm_rgb color = {0, 0, 0};
    for (int i = 0; i < d; i++) {
        color.r += matrix[i] * coefficients[i];
        color.g += matrix[d + i] * coefficients[i];
        color.b += matrix[2 * d + i] * coefficients[i];
    }
    return color;
}

static void assert_same_color(mtm_rgb a, mtm_rgb b, double tolerance) {
    assert_near(a.r, b.r, tolerance);
    assert_near(a.g, b.g, tolerance);
    assert_near(a.b, b.b, tolerance);
}

static void every_material_and_white_keep_their_color_under_every_light(void **state) {
    (void)state;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    const mtm_spectrum white = mtm_spectrum_constant(1);
    mtm_error error;
    fixture_reflectances(reflectances);
    for (int kind = 0; kind < 2; kind++) {
        mtm_basis *basis = fixture_basis(relightable[kind], NULL);
        for (int light = 0; light < 4; light++) {
            double matrix[3 * MTM_DIMENSION_MAX];
            float coefficients[MTM_DIMENSION_MAX];
            const mtm_illumination illumination = fixture_illumination(lights[light]);
            assert_ok(mtm_basis_matrix(basis, &illumination, matrix, &error), error);
            for (int i = 0; i < FIXTURE_MATERIALS; i++) {
                mtm_basis_encode_material(basis, i, coefficients);
                assert_same_color(color_of(basis, matrix, coefficients),
                                  mtm_illuminate(&illumination, &reflectances[i]), 1e-6);
            }
            mtm_basis_encode_white(basis, coefficients);
            assert_same_color(color_of(basis, matrix, coefficients), mtm_illuminate(&illumination, &white),
                              1e-6);
        }
        mtm_basis_destroy(basis);
    }
}

static void reconstruction_times_coefficients_is_the_reflectance(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    float rows[MTM_SPECTRUM_SAMPLES * MTM_DIMENSION_MAX];
    fixture_reflectances(reflectances);
    for (int kind = 0; kind < 2; kind++) {
        mtm_basis *basis = fixture_basis(relightable[kind], NULL);
        const int d = mtm_basis_dimension(basis);
        float coefficients[MTM_DIMENSION_MAX];
        mtm_basis_encode_material(basis, 1, coefficients);
        assert_ok(mtm_basis_reconstruction(basis, rows, &error), error);
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
            double sum = 0;
            for (int k = 0; k < d; k++) sum += rows[i * d + k] * coefficients[k];
            assert_near(sum, reflectances[1].value[i], 1e-6);
        }
        mtm_basis_destroy(basis);
    }
    const mtm_illumination light = fixture_illumination("A");
    mtm_basis *rgb = fixture_basis("rgb", &light);
    assert_fails(mtm_basis_reconstruction(rgb, rows, &error), MTM_ARGUMENT, error, "no spectra");
    mtm_basis_destroy(rgb);
}

static void rgb_is_the_color_under_its_own_light_and_refuses_others(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    double matrix[9];
    float coefficients[3];
    const mtm_illumination own = fixture_illumination("A");
    const mtm_illumination other = fixture_illumination("D65");
    mtm_basis *basis = fixture_basis("rgb", &own);
    fixture_reflectances(reflectances);
    assert_int_equal(mtm_basis_dimension(basis), 3);
    assert_ok(mtm_basis_matrix(basis, &own, matrix, &error), error);
    mtm_basis_encode_material(basis, 2, coefficients);
    assert_same_color(color_of(basis, matrix, coefficients), mtm_illuminate(&own, &reflectances[2]), 1e-6);
    assert_fails(mtm_basis_matrix(basis, &other, matrix, &error), MTM_ARGUMENT, error, "cannot be relit");
    mtm_basis_destroy(basis);
}

static void names_are_checked(void **state) {
    (void)state;
    mtm_error error;
    mtm_basis *basis = NULL;
    mtm_spectrum reflectances[90];
    for (int i = 0; i < 90; i++) reflectances[i] = mtm_spectrum_constant(0.5);
    assert_fails(mtm_basis_create("wavelength", 1, reflectances, NULL, &basis, &error), MTM_ARGUMENT, error,
                 "wavelengths");
    assert_fails(mtm_basis_create("materials:7", 1, reflectances, NULL, &basis, &error), MTM_ARGUMENT, error,
                 "no dimension");
    static const char *const dimensions[] = {
        "factors:2",  "factors:10", "factors:",    "factors:7x",   "factors:-7",     "factors:+7",
        "factors: 7", "factors:0",  "sharpened:2", "sharpened:10", "wavelengths:30", "factors:4294967303"};
    for (size_t i = 0; i < sizeof dimensions / sizeof *dimensions; i++)
        assert_fails(mtm_basis_create(dimensions[i], 1, reflectances, NULL, &basis, &error), MTM_ARGUMENT,
                     error, "the dimension of");
    assert_fails(mtm_basis_create("rgb", 1, reflectances, NULL, &basis, &error), MTM_ARGUMENT, error,
                 "light");
    assert_fails(mtm_basis_create("auto", 90, reflectances, NULL, &basis, &error), MTM_LIMIT, error, "90");
    assert_ok(mtm_basis_create("auto", 2, reflectances, NULL, &basis, &error), error);
    assert_string_equal(mtm_basis_name(basis), "materials");
    assert_int_equal(mtm_basis_dimension(basis), 3);
    assert_int_equal(mtm_basis_material_count(basis), 2);
    mtm_basis_destroy(basis);
    mtm_basis_destroy(NULL);
}

static void names_in_files_state_the_dimension(void **state) {
    (void)state;
    static const struct {
        const char *asked, *name;
        int dimension;
    } cases[] = {{"factors", "factors:7", 7},
                 {"factors:03", "factors:3", 3},
                 {"sharpened", "sharpened:7", 7},
                 {"sharpened:9", "sharpened:9", 9},
                 {"wavelengths", "wavelengths", 81},
                 {"wavelengths:81", "wavelengths", 81},
                 {"wavelengths:31", "wavelengths:31", 31}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mtm_basis *basis = fixture_basis(cases[i].asked, NULL);
        assert_string_equal(mtm_basis_name(basis), cases[i].name);
        assert_int_equal(mtm_basis_dimension(basis), cases[i].dimension);
        mtm_basis_destroy(basis);
    }
}

static void auto_is_what_fits_eight_lanes(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum reflectances[7];
    for (int i = 0; i < 7; i++) reflectances[i] = mtm_spectrum_constant(0.5);
    for (int count = 6; count <= 7; count++) {
        mtm_basis *basis = NULL;
        assert_ok(mtm_basis_create("auto", count, reflectances, NULL, &basis, &error), error);
        assert_string_equal(mtm_basis_name(basis), count == 6 ? "materials" : "factors:7");
        assert_int_equal(mtm_lanes(mtm_basis_dimension(basis)), 8);
        mtm_basis_destroy(basis);
    }
}

static void the_largest_palette_fits_the_lanes(void **state) {
    (void)state;
    mtm_error error;
    mtm_basis *basis = NULL;
    mtm_spectrum reflectances[82];
    for (int i = 0; i < 82; i++) reflectances[i] = mtm_spectrum_constant(i / 82.0);
    assert_ok(mtm_basis_create("materials", 82, reflectances, NULL, &basis, &error), error);
    assert_int_equal(mtm_basis_dimension(basis), MTM_DIMENSION_MAX);
    assert_int_equal(mtm_lanes(MTM_DIMENSION_MAX), 84);
    mtm_basis_destroy(basis);
}

static void lanes_are_4_8_16_or_the_next_multiple_of_4(void **state) {
    (void)state;
    static const int expected[][2] = {{1, 4}, {3, 4}, {4, 8}, {7, 8}, {8, 16}, {15, 16}, {16, 20}, {81, 84}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_int_equal(mtm_lanes(expected[i][0]), expected[i][1]);
}

static void adaptation_makes_white_white_under_every_light(void **state) {
    (void)state;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    for (int i = 0; i < 4; i++) {
        const mtm_illumination plain = fixture_illumination(lights[i]);
        const mtm_spectrum bright = mtm_spectrum_scale(&plain.light, 2);
        const mtm_illumination adapted = mtm_illumination_of(&bright, &plain.observer, 2);
        assert_same_color(mtm_illuminate(&adapted, &white), (mtm_rgb){2, 2, 2}, 1e-3); /* intensity stays */
    }
    const mtm_spectrum dark = mtm_spectrum_constant(0);
    const mtm_illumination plain = fixture_illumination("A");
    const mtm_illumination none = mtm_illumination_of(&dark, &plain.observer, 1);
    assert_same_color(mtm_illuminate(&none, &white), (mtm_rgb){0, 0, 0}, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_material_and_white_keep_their_color_under_every_light),
        cmocka_unit_test(reconstruction_times_coefficients_is_the_reflectance),
        cmocka_unit_test(rgb_is_the_color_under_its_own_light_and_refuses_others),
        cmocka_unit_test(names_are_checked),
        cmocka_unit_test(names_in_files_state_the_dimension),
        cmocka_unit_test(auto_is_what_fits_eight_lanes),
        cmocka_unit_test(the_largest_palette_fits_the_lanes),
        cmocka_unit_test(lanes_are_4_8_16_or_the_next_multiple_of_4),
        cmocka_unit_test(adaptation_makes_white_white_under_every_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
