/* SPDX-License-Identifier: BSD-3-Clause
 * Colors as bilinear forms agree with the library's other way to them, and steps look as long as the metric says. */
#include <math.h>

#include "metamer/metamer.h"
#include "palette/view.h"
#include "test.h"

enum { N = MTM_SPECTRUM_SAMPLES };

static double next_number(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)*seed / 4294967296.0;
}

static mtm_spectrum random_spectrum(uint32_t *seed, double high) {
    mtm_spectrum spectrum;
    const double phase = 6 * next_number(seed), speed = 12 * next_number(seed);
    for (int i = 0; i < N; i++) spectrum.value[i] = high * (0.5 + 0.45 * sin(phase + speed * i / N));
    return spectrum;
}

static mtm_illumination illumination_of(const mtm_spectrum *light) {
    mtm_error error;
    mtm_observer observer;
    mtm_spectrum normalized;
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_light_normalize(light, &observer, &normalized, &error), error);
    return mtm_illumination_of(&normalized, &observer, 0);
}

/* Σ weights · samples. */
static double apply(const mtm_samples weights, const mtm_samples samples) {
    double sum = 0;
    for (int i = 0; i < N; i++) sum += weights[i] * samples[i];
    return sum;
}

static void assert_color(const mtm_color color, mtm_rgb expected) {
    assert_float_equal(color[0], expected.r, 1e-12);
    assert_float_equal(color[1], expected.g, 1e-12);
    assert_float_equal(color[2], expected.b, 1e-12);
}

/* The color of a reflectance under a light: from the cell, and as sums over either spectrum. */
static void check_view(const mtm_color_view *view, const mtm_spectrum *light, const mtm_spectrum *reflectance,
                       mtm_rgb expected) {
    mtm_samples samples;
    mtm_color color;
    mtm_color_weights weights;
    assert_true(mtm_samples_of_light(light, samples));
    mtm_color_view_cell(view, samples, reflectance->value, color);
    assert_color(color, expected);
    mtm_color_view_material(view, samples, weights);
    for (int c = 0; c < 3; c++) color[c] = apply(weights[c], reflectance->value);
    assert_color(color, expected);
    mtm_color_view_light(view, reflectance->value, weights);
    for (int c = 0; c < 3; c++) color[c] = apply(weights[c], samples);
    assert_color(color, expected);
}

static void full_spectra_are_seen_as_the_picture_shows_them(void **state) {
    (void)state;
    uint32_t seed = 1;
    mtm_error error;
    mtm_color_view view;
    assert_ok(mtm_color_view_full(&view, &error), error);
    for (int trial = 0; trial < 20; trial++) {
        const mtm_spectrum light = random_spectrum(&seed, 300), reflectance = random_spectrum(&seed, 1);
        const mtm_illumination illumination = illumination_of(&light);
        check_view(&view, &light, &reflectance, mtm_illuminate(&illumination, &reflectance));
    }
    mtm_color_view_free(&view);
}

/* Through a basis, its own matrix on its own coefficients says the same. */
static void check_basis(const char *name) {
    uint32_t seed = 2;
    mtm_error error;
    mtm_color_view view;
    mtm_basis *basis = NULL;
    assert_ok(mtm_color_view_basis(name, &view, &error), error);
    assert_ok(mtm_basis_create(name, 0, NULL, NULL, &basis, &error), error);
    for (int trial = 0; trial < 20; trial++) {
        double matrix[3 * MTM_DIMENSION_MAX], coefficients[MTM_DIMENSION_MAX];
        const mtm_spectrum light = random_spectrum(&seed, 300), reflectance = random_spectrum(&seed, 1);
        const mtm_illumination illumination = illumination_of(&light);
        assert_ok(mtm_basis_matrix(basis, &illumination, matrix, &error), error);
        assert_ok(mtm_basis_encode(basis, &reflectance, coefficients, &error), error);
        check_view(&view, &light, &reflectance,
                   mtm_basis_color(mtm_basis_dimension(basis), matrix, coefficients));
    }
    mtm_basis_destroy(basis);
    mtm_color_view_free(&view);
}

static void bases_are_seen_as_their_matrices_show_them(void **state) {
    (void)state;
    check_basis("factors:7");
    check_basis("factors:3");
    check_basis("sharpened:7");
    check_basis("wavelengths");
}

static void a_basis_that_encodes_no_other_spectra_is_refused(void **state) {
    (void)state;
    mtm_error error;
    mtm_color_view view;
    assert_fails(mtm_color_view_basis("materials", &view, &error), MTM_ARGUMENT, error, "materials");
    assert_fails(mtm_color_view_basis("nonsense", &view, &error), MTM_ARGUMENT, error, "nonsense");
}

/* Over colors of the cube and directions, a step of a hundredth of a CIEDE2000 is as long as the metric says, to a percent. */
static void the_metric_measures_small_steps(void **state) {
    (void)state;
    uint32_t seed = 3;
    for (int trial = 0; trial < 200; trial++) {
        double metric[3][3];
        mtm_color color, moved, direction;
        double length = 0;
        for (int c = 0; c < 3; c++) {
            color[c] = trial == 0 ? 0 : 0.001 + next_number(&seed);
            direction[c] = next_number(&seed) - 0.5;
        }
        mtm_color_metric(color, metric);
        for (int i = 0; i < 3; i++) {
            double part = 0;
            for (int c = 0; c < 3; c++) part += metric[i][c] * direction[c];
            length += part * part;
        }
        length = sqrt(length);
        for (int c = 0; c < 3; c++) moved[c] = color[c] + direction[c] * 0.01 / length;
        const double seen = mtm_color_difference(color, moved);
        if (!(fabs(seen - 0.01) < 2e-4)) fail_msg("trial %d: %g instead of 0.01", trial, seen);
    }
}

static void slopes_of_differences_are_their_changes(void **state) {
    (void)state;
    uint32_t seed = 4;
    for (int trial = 0; trial < 100; trial++) {
        mtm_color a, b, by_a, by_b, moved_a, moved_b;
        double expected = 0;
        for (int c = 0; c < 3; c++) {
            a[c] = 0.05 + 0.9 * next_number(&seed);
            b[c] = 0.05 + 0.9 * next_number(&seed);
        }
        mtm_color_difference_slopes(a, b, by_a, by_b);
        for (int c = 0; c < 3; c++) {
            moved_a[c] = a[c] + 1e-5 * (c + 1);
            moved_b[c] = b[c] - 1e-5 * (c - 2);
            expected += by_a[c] * 1e-5 * (c + 1) - by_b[c] * 1e-5 * (c - 2);
        }
        const double change = mtm_color_difference(moved_a, moved_b) - mtm_color_difference(a, b);
        if (!(fabs(change - expected) < 1e-6 + 0.02 * fabs(expected)))
            fail_msg("trial %d: %g instead of %g", trial, change, expected);
    }
}

static void lights_are_scaled_to_the_luminance_of_white(void **state) {
    (void)state;
    mtm_samples samples;
    mtm_spectrum light = mtm_spectrum_constant(17);
    assert_true(mtm_samples_of_light(&light, samples));
    for (int i = 0; i < N; i++) assert_float_equal(samples[i], 1, 1e-12);
    light = mtm_spectrum_constant(0);
    assert_false(mtm_samples_of_light(&light, samples));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(full_spectra_are_seen_as_the_picture_shows_them),
        cmocka_unit_test(bases_are_seen_as_their_matrices_show_them),
        cmocka_unit_test(a_basis_that_encodes_no_other_spectra_is_refused),
        cmocka_unit_test(the_metric_measures_small_steps),
        cmocka_unit_test(slopes_of_differences_are_their_changes),
        cmocka_unit_test(lights_are_scaled_to_the_luminance_of_white),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
