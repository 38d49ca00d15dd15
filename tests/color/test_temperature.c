/* SPDX-License-Identifier: BSD-3-Clause
 * Correlated color temperatures against the tables of tests/data/expected/ and against black bodies themselves. */
#include <math.h>

#include "comma_locale.h"
#include "expected.h"
#include "metamer/color.h"

static mtm_color_temperature_result temperature_of(const mtm_spectrum *light) {
    mtm_color_temperature_result result;
    mtm_error error;
    assert_ok(mtm_color_temperature(light, &result, &error), error);
    return result;
}

static void illuminants_have_their_expected_temperature(void **state) {
    (void)state;
    expected_table *expected = read_expected("illuminants_white_cct.csv");
    deviation kelvin = {0};
    deviation duv = {0};
    for (int row = 0; row < expected->row_count; row++) {
        const char *name = expected->names[row];
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_illuminant(name, &light, &error), error);
        const mtm_color_temperature_result result = temperature_of(&light);
        check_near(&kelvin, result.kelvin, expected_value(expected, row, "CCT_exact_K"), 1e-2, name, "CCT");
        check_near(&duv, result.duv, expected_value(expected, row, "Duv"), 1e-8, name, "Duv");
    }
    print_message("largest deviation %.2g K, Duv %.2g\n", kelvin.largest, duv.largest);
    free(expected);
}

/* Daylight has another temperature than its name, which is of an older c2 and rounded at that. */
static void daylight_has_its_expected_temperature(void **state) {
    (void)state;
    expected_table *expected = read_expected("d_series.csv");
    deviation seen = {0};
    for (int row = 0; row < expected->row_count; row++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_daylight(expected_value(expected, row, "T_K"), &light, &error), error);
        check_near(&seen, temperature_of(&light).kelvin, expected_value(expected, row, "CCT_exact_K"), 1e-2,
                   expected->names[row], "CCT");
    }
    print_message("largest deviation %.2g K\n", seen.largest);
    free(expected);
}

static void black_bodies_have_their_own_temperature(void **state) {
    (void)state;
    expected_table *expected = read_expected("planck.csv");
    deviation seen = {0};
    for (int row = 0; row < expected->row_count; row++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_blackbody(expected_value(expected, row, "T_K"), &light, &error), error);
        check_near(&seen, temperature_of(&light).kelvin, expected_value(expected, row, "CCT_exact_K"), 1e-3,
                   expected->names[row], "CCT");
    }
    print_message("largest deviation %.2g K\n", seen.largest);
    free(expected);
}

/* Over the whole range, close to its ends too; the locus is slower where it is hot. */
static void every_black_body_is_found(void **state) {
    (void)state;
    for (double kelvin = 1000.001; kelvin < 1e5; kelvin *= 1.0137) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_blackbody(kelvin, &light, &error), error);
        const mtm_color_temperature_result result = temperature_of(&light);
        if (!(fabs(result.kelvin / kelvin - 1) < 1e-8) || !(fabs(result.duv) < 1e-12))
            fail_msg("%.9g K is found at %.9g K, Duv %g", kelvin, result.kelvin, result.duv);
    }
}

static void the_amount_of_light_does_not_matter(void **state) {
    (void)state;
    mtm_spectrum light;
    mtm_error error;
    assert_ok(mtm_illuminant("FL2", &light, &error), error);
    const mtm_spectrum bright = mtm_spectrum_scale(&light, 1e9);
    const mtm_spectrum dim = mtm_spectrum_scale(&light, 1e-9);
    assert_true(fabs(temperature_of(&bright).kelvin - temperature_of(&light).kelvin) < 1e-3);
    assert_true(fabs(temperature_of(&dim).kelvin - temperature_of(&light).kelvin) < 1e-3);
}

static void green_light_is_above_the_locus_and_purple_below(void **state) {
    (void)state;
    mtm_spectrum green;
    mtm_spectrum purple;
    mtm_error error;
    assert_ok(mtm_blackbody(4000, &green, &error), error);
    purple = green;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        const double bump = 0.3 * exp(-pow((i - 32) / 6.0, 2)); /* round 540 nm */
        green.value[i] *= 1 + bump;
        purple.value[i] *= 1 - bump;
    }
    assert_true(temperature_of(&green).duv > 0.005);
    assert_true(temperature_of(&purple).duv < -0.005);
}

static void refuse(const mtm_spectrum *light, const char *reason) {
    mtm_color_temperature_result result;
    mtm_error error;
    assert_fails(mtm_color_temperature(light, &result, &error), MTM_NUMERIC, error, reason);
}

static void lights_without_a_color_temperature_are_refused_with_the_reason(void **state) {
    (void)state;
    mtm_spectrum line = mtm_spectrum_constant(0);
    mtm_spectrum light;
    mtm_error error;
    refuse(&line, "luminance is 0");
    line.value[(530 - 380) / 5] = 1;
    refuse(&line, "from the Planckian locus");
    assert_ok(mtm_blackbody(990, &light, &error), error);
    refuse(&light, "below 1000 K");
    assert_ok(mtm_blackbody(500, &light, &error), error);
    refuse(&light, "below 1000 K");
    assert_ok(mtm_blackbody(1.1e5, &light, &error), error);
    refuse(&light, "above 100000 K");
    /* Bluer than any black body: the hottest have the power -4. */
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        light.value[i] = pow((MTM_WAVELENGTH_FIRST_NM + i * MTM_WAVELENGTH_STEP_NM) / 560.0, -5);
    refuse(&light, "above 100000 K");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(illuminants_have_their_expected_temperature),
        cmocka_unit_test(daylight_has_its_expected_temperature),
        cmocka_unit_test(black_bodies_have_their_own_temperature),
        cmocka_unit_test(every_black_body_is_found),
        cmocka_unit_test(the_amount_of_light_does_not_matter),
        cmocka_unit_test(green_light_is_above_the_locus_and_purple_below),
        cmocka_unit_test(lights_without_a_color_temperature_are_refused_with_the_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL) + run_group_in_comma_locale(tests);
}
