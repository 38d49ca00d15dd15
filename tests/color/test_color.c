/* SPDX-License-Identifier: BSD-3-Clause */
#include "metamer/color.h"

#include <math.h>
#include <stdio.h>

#include "test.h"

static mtm_xyz apply(double matrix[3][3], mtm_xyz v) {
    return (mtm_xyz){matrix[0][0] * v.x + matrix[0][1] * v.y + matrix[0][2] * v.z,
                     matrix[1][0] * v.x + matrix[1][1] * v.y + matrix[1][2] * v.z,
                     matrix[2][0] * v.x + matrix[2][1] * v.y + matrix[2][2] * v.z};
}

static void assert_xyz(mtm_xyz a, mtm_xyz b, double tolerance) {
    assert_float_equal(a.x, b.x, tolerance);
    assert_float_equal(a.y, b.y, tolerance);
    assert_float_equal(a.z, b.z, tolerance);
}

static void encoding_and_decoding_srgb_are_inverse(void **state) {
    (void)state;
    for (int i = 0; i <= 1000; i++) {
        const double value = i / 1000.0;
        /* The standard's two branches meet with a step of 3e-8, where a value may change its branch. */
        assert_float_equal(mtm_srgb_encode(mtm_srgb_decode(value)), value, 1e-7);
        assert_float_equal(mtm_srgb_decode(mtm_srgb_encode(value)), value, 1e-8);
    }
    for (int i = 0; i <= 255; i++)
        assert_int_equal(lround(255 * mtm_srgb_encode(mtm_srgb_decode(i / 255.0))), i);
}

static void srgb_has_its_published_values_and_clips(void **state) {
    (void)state;
    assert_float_equal(mtm_srgb_encode(0.18), 0.4613561295, 1e-9);
    assert_float_equal(mtm_srgb_decode(0.5), 0.2140411405, 1e-9);
    assert_float_equal(mtm_srgb_encode(0.001), 0.01292, 1e-15);
    assert_true(mtm_srgb_encode(-0.5) == 0 && mtm_srgb_encode(1) == 1 && mtm_srgb_encode(7) == 1);
    assert_true(mtm_srgb_decode(-0.5) == 0 && mtm_srgb_decode(1) == 1 && mtm_srgb_decode(7) == 1);
    assert_true(mtm_srgb_encode(NAN) == 0 && mtm_srgb_decode(NAN) == 0);
}

static void encoding_srgb_rises(void **state) {
    (void)state;
    for (int i = 1; i <= 100000; i++)
        assert_true(mtm_srgb_encode(i / 100000.0) > mtm_srgb_encode((i - 1) / 100000.0));
}

static void xyz_and_rgb_are_inverse(void **state) {
    (void)state;
    const mtm_xyz xyz = {0.3, 0.7, 0.11};
    assert_xyz(mtm_xyz_from_rgb(mtm_rgb_from_xyz(xyz)), xyz, 1e-15);
    double matrix[3][3];
    mtm_rgb_from_xyz_matrix(matrix);
    assert_true(matrix[0][0] == 3.2406 && matrix[1][2] == 0.0415 && matrix[2][1] == -0.2040);
    const mtm_xyz product = apply(matrix, xyz);
    const mtm_rgb rgb = mtm_rgb_from_xyz(xyz);
    assert_true(product.x == rgb.r && product.y == rgb.g && product.z == rgb.b);
    assert_xyz(mtm_xyz_from_rgb((mtm_rgb){1, 1, 1}), mtm_white_d65(), 2e-4);
}

static void hexadecimal_colors_are_read(void **state) {
    (void)state;
    mtm_rgb rgb;
    mtm_error error;
    assert_ok(mtm_rgb_parse("#FF8000", &rgb, &error), error);
    assert_true(rgb.r == 1 && rgb.b == 0);
    assert_float_equal(rgb.g, mtm_srgb_decode(128 / 255.0), 1e-15);
    assert_ok(mtm_rgb_parse("#0a0b0c", &rgb, &error), error);
    assert_float_equal(rgb.b, mtm_srgb_decode(12 / 255.0), 1e-15);
}

static void other_forms_of_colors_are_refused(void **state) {
    (void)state;
    const char *const wrong[] = {"",         "#",       "red",  "ff8000",   "#ff800",
                                 "#ff80000", "#ff80g0", "#fff", " #ff8000", "#-1-1-1"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        mtm_rgb rgb;
        mtm_error error;
        char expected[64];
        (void)snprintf(expected, sizeof expected, "color '%s', expected the form #rrggbb", wrong[i]);
        assert_fails(mtm_rgb_parse(wrong[i], &rgb, &error), MTM_ARGUMENT, error, expected);
    }
}

static void white_is_lab_100_0_0_and_black_0_0_0(void **state) {
    (void)state;
    const mtm_xyz whites[] = {mtm_white_d65(), {1.1, 1, 0.35}, {95, 100, 108}};
    for (int i = 0; i < 3; i++) {
        const mtm_lab white = mtm_lab_from_xyz(whites[i], whites[i]);
        const mtm_lab black = mtm_lab_from_xyz((mtm_xyz){0, 0, 0}, whites[i]);
        assert_float_equal(white.l, 100, 1e-13);
        assert_float_equal(white.a, 0, 1e-13);
        assert_float_equal(white.b, 0, 1e-13);
        assert_float_equal(black.l, 0, 1e-13);
        assert_float_equal(black.a, 0, 1e-13);
        assert_float_equal(black.b, 0, 1e-13);
    }
}

/* Both branches of CIELAB meet at (6/29)³ with value and slope; below, L* is 903.3 Y. */
static void colors_a_display_cannot_show_are_clipped(void **state) {
    (void)state;
    const mtm_rgb clipped = mtm_rgb_clip((mtm_rgb){-0.2, 0.5, 1.7});
    assert_true(clipped.r == 0 && clipped.g == 0.5 && clipped.b == 1);
    const mtm_lab shown = mtm_lab_shown((mtm_rgb){-0.2, 0.5, 1.7});
    const mtm_lab expected = mtm_lab_from_xyz(mtm_xyz_from_rgb(clipped), mtm_white_d65());
    assert_true(shown.l == expected.l && shown.a == expected.a && shown.b == expected.b);
    assert_float_equal(mtm_lab_shown((mtm_rgb){9, 9, 9}).l, 100, 1e-2);
}

static void lab_is_smooth_where_its_branches_meet(void **state) {
    (void)state;
    const mtm_xyz white = mtm_white_d65();
    const double edge = pow(6.0 / 29, 3);
    const double step = 1e-6;
    const double below = mtm_lab_from_xyz((mtm_xyz){0, edge - step, 0}, white).l;
    const double middle = mtm_lab_from_xyz((mtm_xyz){0, edge, 0}, white).l;
    const double above = mtm_lab_from_xyz((mtm_xyz){0, edge + step, 0}, white).l;
    assert_float_equal(middle, 8, 1e-12);
    assert_float_equal((above - middle) / step, (middle - below) / step, 0.2);
    assert_float_equal(mtm_lab_from_xyz((mtm_xyz){0, 0.001, 0}, white).l, 0.001 * 24389 / 27, 1e-12);
}

static void lab_and_xyz_are_inverse_on_both_branches(void **state) {
    (void)state;
    static const double values[] = {0, 1e-5, 0.003, 0.008, 0.01, 0.2, 0.9, 1.3};
    enum { COUNT = sizeof values / sizeof *values };
    const mtm_xyz white = mtm_white_d65();
    for (int i = 0; i < COUNT * COUNT * COUNT; i++) {
        const mtm_xyz xyz = {values[i % COUNT], values[i / COUNT % COUNT], values[i / COUNT / COUNT]};
        const mtm_xyz back = mtm_xyz_from_lab(mtm_lab_from_xyz(xyz, white), white);
        /* cmocka compares in float, these are to agree in double */
        assert_true(fabs(back.x - xyz.x) < 1e-14 && fabs(back.y - xyz.y) < 1e-14 &&
                    fabs(back.z - xyz.z) < 1e-14);
    }
    assert_true(mtm_xyz_from_lab((mtm_lab){20, 0, 90}, white).z < 0);
}

static void lab_under_a_light_without_blue_is_finite(void **state) {
    (void)state;
    const mtm_lab lab = mtm_lab_from_xyz((mtm_xyz){0.5, 0.4, 0}, (mtm_xyz){1.2, 1, 0});
    assert_true(isfinite(lab.l) && isfinite(lab.a) && isfinite(lab.b));
    const mtm_lab white = mtm_lab_from_xyz((mtm_xyz){1.2, 1, 0}, (mtm_xyz){1.2, 1, 0});
    assert_true(fabs(white.l - 100) < 1e-12 && fabs(white.a) < 1e-12 && fabs(white.b) < 1e-12);
}

static void bradford_maps_white_to_white(void **state) {
    (void)state;
    const mtm_xyz a = {1.0985, 1, 0.3558};
    const mtm_xyz d65 = mtm_white_d65();
    double there[3][3], back[3][3], same[3][3];
    mtm_bradford(a, d65, there);
    mtm_bradford(d65, a, back);
    mtm_bradford(a, a, same);
    assert_xyz(apply(there, a), d65, 1e-14);
    const mtm_xyz color = {0.2, 0.3, 0.4};
    assert_xyz(apply(back, apply(there, color)), color, 1e-14);
    assert_xyz(apply(same, color), color, 1e-14);
}

static mtm_xyz line_of(int wavelength_nm) {
    mtm_error error;
    mtm_observer observer;
    mtm_spectrum line = mtm_spectrum_constant(0);
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    line.value[(wavelength_nm - MTM_WAVELENGTH_FIRST_NM) / MTM_WAVELENGTH_STEP_NM] = 1;
    const mtm_xyz xyz = mtm_xyz_of(&line, &observer);
    return (mtm_xyz){xyz.x / xyz.y, 1, xyz.z / xyz.y};
}

/* Bradford's first cone has a negative response around 470 nm and is 0 beside it. White still becomes white, and the
 * adaptation of colors near it stays near: no entry beyond what x, y or z of the white ask for. */
static void adaptation_from_lines_is_bounded(void **state) {
    (void)state;
    const mtm_xyz d65 = mtm_white_d65();
    for (int nm = 400; nm <= 640; nm += 5) {
        double matrix[3][3];
        const mtm_xyz white = line_of(nm);
        mtm_bradford(white, d65, matrix);
        assert_xyz(apply(matrix, white), d65, 1e-9);
        const double least = fmin(white.x, fmin(white.y, white.z));
        for (int i = 0; i < 9; i++) assert_true(fabs(matrix[i / 3][i % 3]) < 100 + 2 / least);
    }
}

/* Deep red light has no z, and nothing it shows has any. */
static void adaptation_from_light_without_z_leaves_z_alone(void **state) {
    (void)state;
    double matrix[3][3];
    mtm_bradford((mtm_xyz){2.5, 1, 0}, mtm_white_d65(), matrix);
    const mtm_xyz adapted = apply(matrix, (mtm_xyz){1.25, 0.5, 0});
    assert_xyz(adapted, (mtm_xyz){0.5 * mtm_white_d65().x, 0.5, 0}, 1e-14);
}

/* D50 to D65, as published for ICC profiles (B. Lindbloom) from whites to five digits. */
static void bradford_has_its_published_matrix(void **state) {
    (void)state;
    const double published[3][3] = {{0.9555766, -0.0230393, 0.0631636},
                                    {-0.0282895, 1.0099416, 0.0210077},
                                    {0.0122982, -0.0204830, 1.3299098}};
    double matrix[3][3];
    mtm_bradford((mtm_xyz){0.96422, 1, 0.82521}, (mtm_xyz){0.95047, 1, 1.08883}, matrix);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) assert_float_equal(matrix[i][j], published[i][j], 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(encoding_and_decoding_srgb_are_inverse),
        cmocka_unit_test(srgb_has_its_published_values_and_clips),
        cmocka_unit_test(encoding_srgb_rises),
        cmocka_unit_test(xyz_and_rgb_are_inverse),
        cmocka_unit_test(hexadecimal_colors_are_read),
        cmocka_unit_test(other_forms_of_colors_are_refused),
        cmocka_unit_test(white_is_lab_100_0_0_and_black_0_0_0),
        cmocka_unit_test(colors_a_display_cannot_show_are_clipped),
        cmocka_unit_test(lab_is_smooth_where_its_branches_meet),
        cmocka_unit_test(lab_and_xyz_are_inverse_on_both_branches),
        cmocka_unit_test(lab_under_a_light_without_blue_is_finite),
        cmocka_unit_test(bradford_maps_white_to_white),
        cmocka_unit_test(adaptation_from_lines_is_bounded),
        cmocka_unit_test(adaptation_from_light_without_z_leaves_z_alone),
        cmocka_unit_test(bradford_has_its_published_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
