/* SPDX-License-Identifier: BSD-3-Clause
 * Observers and white points; expected values with Y = 100. */
#include <math.h>

#include "expected.h"
#include "metamer/color.h"

static mtm_observer cie1931(void) {
    mtm_observer observer;
    mtm_error error;
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    return observer;
}

/* The white of a light, Y = 1. */
static mtm_xyz white_of(const mtm_spectrum *light) {
    const mtm_observer observer = cie1931();
    mtm_spectrum normalized;
    mtm_error error;
    assert_ok(mtm_light_normalize(light, &observer, &normalized, &error), error);
    return mtm_xyz_of(&normalized, &observer);
}

static void check_white(deviation *seen, const expected_table *expected, int row, mtm_xyz white,
                        const char *x_column, const char *z_column) {
    const double x = expected_value(expected, row, x_column);
    const double z = expected_value(expected, row, z_column);
    check_near(seen, 100 * white.x, x, 1e-7, expected->names[row], x_column);
    check_near(seen, 100 * white.y, 100, 1e-10, expected->names[row], "Y");
    check_near(seen, 100 * white.z, z, 1e-7, expected->names[row], z_column);
}

static void the_observer_has_its_published_values(void **state) {
    (void)state;
    const mtm_observer observer = cie1931();
    assert_string_equal(observer.name, "cie1931");
    assert_float_equal(observer.y.value[(555 - 380) / 5], 1, 1e-15);
    assert_float_equal(observer.x.value[(600 - 380) / 5], 1.0622, 1e-15);
    assert_float_equal(observer.z.value[(445 - 380) / 5], 1.7826, 1e-15);
}

static void an_unknown_observer_lists_the_known_ones(void **state) {
    (void)state;
    mtm_observer observer;
    mtm_error error;
    assert_fails(mtm_observer_get("cie1932", &observer, &error), MTM_ARGUMENT, error,
                 "unknown observer 'cie1932', expected one of: cie1931");
}

static void illuminants_have_the_expected_whites(void **state) {
    (void)state;
    expected_table *expected = read_expected("illuminants_white_cct.csv");
    deviation seen = {0};
    for (int row = 0; row < expected->row_count; row++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_illuminant(expected->names[row], &light, &error), error);
        const mtm_xyz white = white_of(&light);
        const double sum = white.x + white.y + white.z;
        check_white(&seen, expected, row, white, "X2", "Z2");
        check_near(&seen, white.x / sum, expected_value(expected, row, "x2"), 1e-7, expected->names[row],
                   "x2");
        check_near(&seen, white.y / sum, expected_value(expected, row, "y2"), 1e-7, expected->names[row],
                   "y2");
    }
    print_message("largest deviation %.2g\n", seen.largest);
    free(expected);
}

/* CIE 015:2018 gives x and y of these to four decimals, from sums at other steps: 3e-4 covers the difference. */
static void other_lamps_are_near_their_published_chromaticity(void **state) {
    (void)state;
    const struct {
        const char *name;
        double x, y;
    } published[] = {{"HP1", 0.533, 0.415},      {"HP2", 0.4778, 0.4158},      {"HP3", 0.4302, 0.4075},
                     {"HP4", 0.3812, 0.3797},    {"HP5", 0.3776, 0.3713},      {"LED-B1", 0.4560, 0.4078},
                     {"LED-B5", 0.3118, 0.3236}, {"LED-RGB1", 0.4557, 0.4211}, {"FL3.1", 0.4407, 0.4033},
                     {"FL3.15", 0.3127, 0.3288}};
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_illuminant(published[i].name, &light, &error), error);
        const mtm_xyz white = white_of(&light);
        const double sum = white.x + white.y + white.z;
        deviation seen = {0};
        check_near(&seen, white.x / sum, published[i].x, 3e-4, published[i].name, "x");
        check_near(&seen, white.y / sum, published[i].y, 3e-4, published[i].name, "y");
    }
}

static void daylight_has_the_expected_whites(void **state) {
    (void)state;
    expected_table *expected = read_expected("d_series.csv");
    deviation seen = {0};
    for (int row = 0; row < expected->row_count; row++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_daylight(expected_value(expected, row, "T_K"), &light, &error), error);
        check_white(&seen, expected, row, white_of(&light), "X", "Z");
    }
    print_message("largest deviation %.2g\n", seen.largest);
    free(expected);
}

static void black_bodies_have_the_expected_whites(void **state) {
    (void)state;
    expected_table *expected = read_expected("planck.csv");
    deviation seen = {0};
    for (int row = 0; row < expected->row_count; row++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_blackbody(expected_value(expected, row, "T_K"), &light, &error), error);
        check_white(&seen, expected, row, white_of(&light), "X", "Z");
    }
    print_message("largest deviation %.2g\n", seen.largest);
    free(expected);
}

static void a_light_without_luminance_is_refused(void **state) {
    (void)state;
    const mtm_observer observer = cie1931();
    const double levels[] = {0, -1, NAN, INFINITY, 1e-315};
    for (size_t i = 0; i < sizeof levels / sizeof *levels; i++) {
        const mtm_spectrum light = mtm_spectrum_constant(levels[i]);
        mtm_spectrum normalized;
        mtm_error error;
        assert_fails(mtm_light_normalize(&light, &observer, &normalized, &error), MTM_NUMERIC, error,
                     "luminance");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_observer_has_its_published_values),
        cmocka_unit_test(an_unknown_observer_lists_the_known_ones),
        cmocka_unit_test(illuminants_have_the_expected_whites),
        cmocka_unit_test(other_lamps_are_near_their_published_chromaticity),
        cmocka_unit_test(daylight_has_the_expected_whites),
        cmocka_unit_test(black_bodies_have_the_expected_whites),
        cmocka_unit_test(a_light_without_luminance_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
