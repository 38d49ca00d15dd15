/* SPDX-License-Identifier: BSD-3-Clause
 * Observers and white points; expected values with Y = 100. */
#include <math.h>

#include "comma_locale.h"
#include "expected.h"
#include "metamer/color.h"

static mtm_observer observer_called(const char *name) {
    mtm_observer observer;
    mtm_error error;
    assert_ok(mtm_observer_get(name, &observer, &error), error);
    assert_string_equal(observer.name, name);
    assert_false(observer.is_camera);
    return observer;
}

/* The white of a light, Y = 1. */
static mtm_xyz white_of(const mtm_spectrum *light, const char *observer_name) {
    const mtm_observer observer = observer_called(observer_name);
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

/* CIE 018 and CIE 170-2:2015. The observers of 2015 begin at 390 nm; before that there is nothing. */
static void observers_have_their_published_values(void **state) {
    (void)state;
    const struct {
        const char *name;
        int wavelength_nm;
        double x, y, z;
    } published[] = {
        {"cie1931", 380, 0.001368, 0.000039, 0.006450001},
        {"cie1931", 445, 0.348060, 0.029800, 1.782600},
        {"cie1931", 555, 0.5120501, 1.000000, 0.005749999},
        {"cie1931", 600, 1.062200, 0.631000, 0.000800},
        {"cie1964", 445, 0.386726, 0.074704, 2.027300},
        {"cie1964", 555, 0.616053, 0.999110, 0.001091},
        {"cie1964", 600, 1.123990, 0.658341, 0.000000},
        {"cie2015", 385, 0, 0, 0},
        {"cie2015", 390, 0.003769647, 0.0004146161, 0.0184726},
        {"cie2015", 450, 0.3224637, 0.06472352, 1.848545},
        {"cie2015", 600, 1.151033, 0.6918553, 3.549661e-05},
        {"cie2015_10deg", 385, 0, 0, 0},
        {"cie2015_10deg", 390, 0.00295242, 0.0004076779, 0.01318752},
        {"cie2015_10deg", 555, 0.6230892, 0.9997775, 0.001426627},
        {"cie2015_10deg", 600, 1.148163, 0.6629035, 2.175998e-05},
    };
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        const mtm_observer observer = observer_called(published[i].name);
        const int sample = (published[i].wavelength_nm - MTM_WAVELENGTH_FIRST_NM) / MTM_WAVELENGTH_STEP_NM;
        deviation seen = {0};
        check_near(&seen, observer.x.value[sample], published[i].x, 0, published[i].name, "x");
        check_near(&seen, observer.y.value[sample], published[i].y, 0, published[i].name, "y");
        check_near(&seen, observer.z.value[sample], published[i].z, 0, published[i].name, "z");
    }
}

/* By definition all three curves of an observer have the same integral, so that equal-energy white has x = y = 1/3; the
 * sums of the grid keep that to some digits (the worst to 3e-4). */
static void equal_energy_is_white_to_every_observer(void **state) {
    (void)state;
    const char *const names[] = {"cie1931", "cie1964", "cie2015", "cie2015_10deg"};
    const mtm_spectrum equal_energy = mtm_spectrum_constant(1);
    deviation seen = {0};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const mtm_xyz white = white_of(&equal_energy, names[i]);
        check_near(&seen, white.x, 1, 1e-3, names[i], "X");
        check_near(&seen, white.z, 1, 1e-3, names[i], "Z");
    }
    print_message("largest deviation %.2g\n", seen.largest);
}

static void an_unknown_observer_lists_the_known_ones(void **state) {
    (void)state;
    mtm_observer observer;
    mtm_error error;
    assert_fails(mtm_observer_get("cie1932", &observer, &error), MTM_ARGUMENT, error,
                 "unknown observer 'cie1932', expected one of: cie1931, cie1964, cie2015, cie2015_10deg");
}

static void check_illuminants(const char *observer, const char *columns[4]) {
    expected_table *expected = read_expected("illuminants_white_cct.csv");
    deviation seen = {0};
    for (int row = 0; row < expected->row_count; row++) {
        const char *name = expected->names[row];
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_illuminant(name, &light, &error), error);
        const mtm_xyz white = white_of(&light, observer);
        const double sum = white.x + white.y + white.z;
        check_white(&seen, expected, row, white, columns[0], columns[1]);
        check_near(&seen, white.x / sum, expected_value(expected, row, columns[2]), 1e-7, name, columns[2]);
        check_near(&seen, white.y / sum, expected_value(expected, row, columns[3]), 1e-7, name, columns[3]);
    }
    print_message("%s: largest deviation %.2g\n", observer, seen.largest);
    free(expected);
}

static void illuminants_have_the_expected_whites(void **state) {
    (void)state;
    check_illuminants("cie1931", (const char *[]){"X2", "Z2", "x2", "y2"});
    check_illuminants("cie1964", (const char *[]){"X10", "Z10", "x10", "y10"});
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
        const mtm_xyz white = white_of(&light, "cie1931");
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
        check_white(&seen, expected, row, white_of(&light, "cie1931"), "X", "Z");
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
        check_white(&seen, expected, row, white_of(&light, "cie1931"), "X", "Z");
    }
    print_message("largest deviation %.2g\n", seen.largest);
    free(expected);
}

static void a_light_without_luminance_is_refused(void **state) {
    (void)state;
    const mtm_observer observer = observer_called("cie1931");
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
        cmocka_unit_test(observers_have_their_published_values),
        cmocka_unit_test(equal_energy_is_white_to_every_observer),
        cmocka_unit_test(an_unknown_observer_lists_the_known_ones),
        cmocka_unit_test(illuminants_have_the_expected_whites),
        cmocka_unit_test(other_lamps_are_near_their_published_chromaticity),
        cmocka_unit_test(daylight_has_the_expected_whites),
        cmocka_unit_test(black_bodies_have_the_expected_whites),
        cmocka_unit_test(a_light_without_luminance_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL) + run_group_in_comma_locale(tests);
}
