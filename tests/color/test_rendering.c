/* SPDX-License-Identifier: BSD-3-Clause
 * Color rendering indices against a table computed apart from the library, and against those the CIE publishes. */
#include "comma_locale.h"
#include "expected.h"
#include "metamer/color.h"

static mtm_color_rendering_result rendering_of(const char *illuminant) {
    mtm_color_rendering_result result;
    mtm_spectrum light;
    mtm_error error;
    assert_ok(mtm_illuminant(illuminant, &light, &error), error);
    assert_ok(mtm_color_rendering(&light, &result, &error), error);
    return result;
}

static void illuminants_have_their_expected_indices(void **state) {
    (void)state;
    expected_table *expected = read_expected("illuminants_cri.csv");
    deviation index = {0};
    deviation kelvin = {0};
    deviation duv = {0};
    for (int row = 0; row < expected->row_count; row++) {
        const char *name = expected->names[row];
        const mtm_color_rendering_result result = rendering_of(name);
        check_near(&kelvin, result.temperature.kelvin, expected_value(expected, row, "CCT_K"), 1e-2, name,
                   "CCT");
        check_near(&duv, result.temperature.duv, expected_value(expected, row, "Duv"), 1e-8, name, "Duv");
        check_near(&index, result.general, expected_value(expected, row, "Ra"), 1e-4, name, "Ra");
        for (int i = 0; i < MTM_TEST_COLORS; i++) {
            char column[8];
            (void)snprintf(column, sizeof column, "R%d", i + 1);
            check_near(&index, result.special[i], expected_value(expected, row, column), 1e-4, name, column);
        }
    }
    print_message("largest deviation %.2g, %.2g K, Duv %.2g\n", index.largest, kelvin.largest, duv.largest);
    free(expected);
}

/* CIE 015 prints them as whole numbers, from sums at other steps: half of one, and 0.3 for the steps. */
static void fluorescent_lamps_have_their_published_general_index(void **state) {
    (void)state;
    static const int published[] = {76, 64, 57, 51, 72, 59, 90, 95, 90, 81, 83, 83};
    deviation seen = {0};
    for (int i = 0; i < 12; i++) {
        char name[8];
        (void)snprintf(name, sizeof name, "FL%d", i + 1);
        check_near(&seen, rendering_of(name).general, published[i], 0.8, name, "Ra");
    }
    print_message("largest deviation %.2g\n", seen.largest);
}

/* Black bodies below 5000 K are their own references. */
static void a_black_body_renders_colors_as_itself(void **state) {
    (void)state;
    deviation seen = {0};
    for (double kelvin = 1000.001; kelvin < 5000; kelvin += 190) {
        mtm_color_rendering_result result;
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_blackbody(kelvin, &light, &error), error);
        assert_ok(mtm_color_rendering(&light, &result, &error), error);
        for (int i = 0; i < MTM_TEST_COLORS; i++)
            check_near(&seen, result.special[i], 100, 1e-6, "black body", "R");
    }
    print_message("largest deviation %.2g\n", seen.largest);
}

/* Daylight is, too, but is compared with that of its exact color temperature, up to 66 K off its nominal one. */
static void daylight_renders_colors_nearly_as_itself(void **state) {
    (void)state;
    deviation seen = {0};
    for (double kelvin = 5100; kelvin < 24900; kelvin += 700) {
        mtm_color_rendering_result result;
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_daylight(kelvin, &light, &error), error);
        assert_ok(mtm_color_rendering(&light, &result, &error), error);
        for (int i = 0; i < MTM_TEST_COLORS; i++)
            check_near(&seen, result.special[i], 100, 0.1, "daylight", "R");
    }
    print_message("largest deviation %.2g\n", seen.largest);
}

/* At 5000 K the reference changes from black body to daylight, so a black body keeps its 100 up to there only. */
static void the_reference_changes_at_5000_kelvin(void **state) {
    (void)state;
    double general[2];
    const double kelvin[2] = {4999.9, 5000.1};
    for (int i = 0; i < 2; i++) {
        mtm_color_rendering_result result;
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_blackbody(kelvin[i], &light, &error), error);
        assert_ok(mtm_color_rendering(&light, &result, &error), error);
        general[i] = result.general;
    }
    assert_true(general[0] > 99.999 && general[1] < 99 && general[1] > 95);
}

static void refuse(const mtm_spectrum *light, const char *reason) {
    mtm_color_rendering_result result;
    mtm_error error;
    assert_fails(mtm_color_rendering(light, &result, &error), MTM_NUMERIC, error, reason);
}

static void lights_without_a_reference_are_refused_with_the_reason(void **state) {
    (void)state;
    mtm_spectrum light = mtm_spectrum_constant(0);
    mtm_error error;
    light.value[30] = 1;
    refuse(&light, "from the Planckian locus");
    assert_ok(mtm_blackbody(26000, &light, &error), error);
    refuse(&light, "is 26000 K, and above 25000 K there is no daylight");
    assert_ok(mtm_blackbody(24999, &light, &error), error);
    mtm_color_rendering_result result;
    assert_ok(mtm_color_rendering(&light, &result, &error), error);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(illuminants_have_their_expected_indices),
        cmocka_unit_test(fluorescent_lamps_have_their_published_general_index),
        cmocka_unit_test(a_black_body_renders_colors_as_itself),
        cmocka_unit_test(daylight_renders_colors_nearly_as_itself),
        cmocka_unit_test(the_reference_changes_at_5000_kelvin),
        cmocka_unit_test(lights_without_a_reference_are_refused_with_the_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL) + run_group_in_comma_locale(tests);
}
