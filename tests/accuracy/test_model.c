/* SPDX-License-Identifier: BSD-3-Clause
 * The models that bases are compared with: what is true of each by construction. */
#include <math.h>

#include "accuracy/model.h"
#include "test.h"

static const char source_folder[] = METAMER_SOURCE_DIR;

static model create(model_family family, int dimension) {
    model made;
    mtm_error error;
    assert_ok(model_create(source_folder, (model_choice){family, dimension}, &made, &error), error);
    return made;
}

static mtm_spectrum illuminant(const char *name) {
    mtm_spectrum light;
    mtm_error error;
    assert_ok(mtm_illuminant(name, &light, &error), error);
    return light;
}

static mtm_observer observer(void) {
    mtm_observer found;
    mtm_error error;
    assert_ok(mtm_observer_get("cie1931", &found, &error), error);
    return found;
}

/* A bump round a wavelength. */
static mtm_spectrum reflectance(double center_nm) {
    mtm_spectrum made;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        const double offset = (MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * i - center_nm) / 60;
        made.value[i] = 0.1 + 0.7 * exp(-offset * offset);
    }
    return made;
}

/* The color that a model gives a light on one reflectance. */
static mtm_xyz color_of(const model *made, const mtm_spectrum *light, const mtm_spectrum *lit) {
    const mtm_observer eye = observer();
    double matrix[3 * MTM_DIMENSION_MAX];
    double coefficients[MTM_DIMENSION_MAX];
    mtm_error error;
    mtm_xyz color = {0, 0, 0};
    assert_ok(model_light(made, light, &eye, matrix, &error), error);
    assert_ok(model_encode(made, lit, coefficients, &error), error);
    for (int i = 0; i < made->dimension; i++) {
        color.x += matrix[i] * coefficients[i];
        color.y += matrix[made->dimension + i] * coefficients[i];
        color.z += matrix[2 * made->dimension + i] * coefficients[i];
    }
    return color;
}

static void assert_xyz_equal(mtm_xyz a, mtm_xyz b, double relative) {
    assert_float_equal(a.x, b.x, relative * b.y);
    assert_float_equal(a.y, b.y, relative * b.y);
    assert_float_equal(a.z, b.z, relative * b.y);
}

static void every_model_has_an_index_and_a_name_of_its_own(void **state) {
    (void)state;
    for (int i = 0; i < MODEL_COUNT; i++) {
        char name[MODEL_NAME_BYTES];
        const model_choice choice = model_choice_at(i);
        assert_int_equal(model_index(choice.family, choice.dimension), i);
        model_name(choice, name);
        for (int j = 0; j < i; j++) {
            char other[MODEL_NAME_BYTES];
            model_name(model_choice_at(j), other);
            assert_string_not_equal(name, other);
        }
    }
}

static void names_carry_the_dimension(void **state) {
    (void)state;
    char name[MODEL_NAME_BYTES];
    model_name((model_choice){FAMILY_FACTORS, 7}, name);
    assert_string_equal(name, "factors:7");
    model_name((model_choice){FAMILY_SHARPENED_EXACT, 5}, name);
    assert_string_equal(name, "sharpened:5, light exact");
    model_name((model_choice){FAMILY_RGB, 0}, name);
    assert_string_equal(name, "RGB");
}

/* White has the light's own color where the light is exact, and in RGB; there the inverse of a matrix shows too. */
static void white_shows_the_light(void **state) {
    (void)state;
    static const model_choice choices[] = {
        {FAMILY_RGB, 0},    {FAMILY_RGB_BRADFORD, 0},    {FAMILY_FACTORS, 7},
        {FAMILY_PEERCY, 7}, {FAMILY_SHARPENED_EXACT, 7}, {FAMILY_WAVELENGTHS, 0}};
    const mtm_observer eye = observer();
    const mtm_spectrum white = mtm_spectrum_constant(1);
    const mtm_spectrum light = illuminant("FL11");
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++) {
        model made = create(choices[i].family, choices[i].dimension);
        assert_xyz_equal(color_of(&made, &light, &white), mtm_xyz_of(&light, &eye), 1e-6);
        model_free(&made);
    }
}

static void rgb_is_exact_under_the_light_it_encodes(void **state) {
    (void)state;
    const mtm_observer eye = observer();
    const mtm_spectrum light = illuminant("D65");
    const mtm_spectrum lit = reflectance(610);
    const mtm_spectrum stimulus = mtm_spectrum_multiply(&light, &lit);
    model made = create(FAMILY_RGB_BRADFORD, 0);
    assert_xyz_equal(color_of(&made, &light, &lit), mtm_xyz_of(&stimulus, &eye), 1e-12);
    model_free(&made);
}

/* The middle of 400 … 700 nm is all there is: a light that is dark elsewhere loses nothing. */
static void the_cut_model_is_exact_within_its_range(void **state) {
    (void)state;
    const mtm_observer eye = observer();
    mtm_spectrum light = illuminant("A");
    const mtm_spectrum lit = reflectance(560);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        if (i < 4 || i > 64) light.value[i] = 0;
    const mtm_spectrum stimulus = mtm_spectrum_multiply(&light, &lit);
    model made = create(FAMILY_CUT, 0);
    assert_int_equal(made.dimension, 61);
    assert_xyz_equal(color_of(&made, &light, &lit), mtm_xyz_of(&stimulus, &eye), 1e-12);
    model_free(&made);
}

/* A line between two of its samples is lost, one on a sample counts twice. */
static void points_miss_lines(void **state) {
    (void)state;
    const mtm_observer eye = observer();
    const mtm_spectrum white = mtm_spectrum_constant(1);
    mtm_spectrum between = mtm_spectrum_constant(0);
    mtm_spectrum on = mtm_spectrum_constant(0);
    between.value[33] = 1;
    on.value[34] = 1;
    model made = create(FAMILY_POINTS, 0);
    assert_float_equal(color_of(&made, &between, &white).y, 0, 0);
    assert_float_equal(color_of(&made, &on, &white).y, 2 * mtm_xyz_of(&on, &eye).y, 1e-12);
    model_free(&made);
}

/* The components are orthonormal, so multiplying by white changes nothing. */
static void peercys_matrix_of_white_is_the_identity(void **state) {
    (void)state;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    double matrix[MODEL_DIMENSION_MAX * MODEL_DIMENSION_MAX];
    model made = create(FAMILY_PEERCY, 9);
    model_multiplier(&made, &white, matrix);
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 9; j++) assert_float_equal(matrix[9 * i + j], i == j, 1e-9);
    model_free(&made);
}

/* White is within the subspace, so its product with anything is that, encoded. */
static void peercys_matrix_encodes_the_product(void **state) {
    (void)state;
    const mtm_spectrum a = reflectance(500);
    double matrix[MODEL_DIMENSION_MAX * MODEL_DIMENSION_MAX];
    double white[MODEL_DIMENSION_MAX];
    double expected[MODEL_DIMENSION_MAX];
    const mtm_spectrum flat = mtm_spectrum_constant(1);
    mtm_error error;
    model made = create(FAMILY_PEERCY, 7);
    model_multiplier(&made, &a, matrix);
    assert_ok(model_encode(&made, &flat, white, &error), error);
    assert_ok(model_encode(&made, &a, expected, &error), error);
    for (int i = 0; i < 7; i++) {
        double product = 0;
        for (int j = 0; j < 7; j++) product += matrix[7 * i + j] * white[j];
        assert_float_equal(product, expected[i], 1e-9);
    }
    model_free(&made);
}

static void unsharpened_white_is_the_first_component(void **state) {
    (void)state;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    double coefficients[MODEL_DIMENSION_MAX];
    mtm_error error;
    model made = create(FAMILY_UNSHARPENED, 5);
    assert_ok(model_encode(&made, &white, coefficients, &error), error);
    for (int i = 0; i < 5; i++) assert_float_equal(coefficients[i], i == 0, 1e-9);
    model_free(&made);
}

/* Only the light tells the two apart: under equal energy, whose coefficients are ones, they agree. */
static void an_encoded_light_differs_from_an_exact_one_where_it_has_lines(void **state) {
    (void)state;
    const mtm_spectrum equal_energy = mtm_spectrum_constant(1);
    const mtm_spectrum lines = illuminant("FL11");
    const mtm_spectrum lit = reflectance(540);
    model exact = create(FAMILY_FACTORS, 7);
    model encoded = create(FAMILY_FACTORS_ENCODED, 7);
    assert_xyz_equal(color_of(&encoded, &equal_energy, &lit), color_of(&exact, &equal_energy, &lit), 1e-6);
    assert_true(fabs(color_of(&encoded, &lines, &lit).y / color_of(&exact, &lines, &lit).y - 1) > 0.01);
    model_free(&exact);
    model_free(&encoded);
}

static void a_missing_folder_is_an_error(void **state) {
    (void)state;
    model made;
    mtm_error error;
    assert_fails(model_create("no such folder", (model_choice){FAMILY_PEERCY, 7}, &made, &error), MTM_IO,
                 error, "no such folder/data/bases/reflectance_pca.csv");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_model_has_an_index_and_a_name_of_its_own),
        cmocka_unit_test(names_carry_the_dimension),
        cmocka_unit_test(white_shows_the_light),
        cmocka_unit_test(rgb_is_exact_under_the_light_it_encodes),
        cmocka_unit_test(the_cut_model_is_exact_within_its_range),
        cmocka_unit_test(points_miss_lines),
        cmocka_unit_test(peercys_matrix_of_white_is_the_identity),
        cmocka_unit_test(peercys_matrix_encodes_the_product),
        cmocka_unit_test(unsharpened_white_is_the_first_component),
        cmocka_unit_test(an_encoded_light_differs_from_an_exact_one_where_it_has_lines),
        cmocka_unit_test(a_missing_folder_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
