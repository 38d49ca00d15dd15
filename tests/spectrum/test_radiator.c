/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "expected.h"
#include "metamer/spectrum.h"

enum { AT_450 = 14, AT_560 = 36, AT_650 = 54 };

static void black_bodies_have_the_expected_ratios(void **state) {
    (void)state;
    expected_table *expected = read_expected("planck.csv");
    deviation seen = {0};
    for (int row = 0; row < expected->row_count; row++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_blackbody(expected_value(expected, row, "T_K"), &light, &error), error);
        assert_float_equal(light.value[AT_560], 1, 1e-15);
        check_near(&seen, light.value[AT_450], expected_value(expected, row, "B450_over_B560"), 1e-8,
                   expected->names[row], "B450_over_B560");
        check_near(&seen, light.value[AT_650], expected_value(expected, row, "B650_over_B560"), 1e-8,
                   expected->names[row], "B650_over_B560");
    }
    print_message("largest deviation %.2g\n", seen.largest);
    free(expected);
}

/* Wien: the maximum is at c2 / (4.965114… T); the constant is the root of x = 5 (1 − e⁻ˣ). */
static void the_maximum_moves_as_wien_says(void **state) {
    (void)state;
    double root = 5;
    for (int i = 0; i < 30; i++) root = 5 * (1 - exp(-root));
    for (double kelvin = 3800; kelvin <= 7400; kelvin += 100) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_blackbody(kelvin, &light, &error), error);
        int highest = 0;
        for (int i = 1; i < MTM_SPECTRUM_SAMPLES; i++)
            if (light.value[i] > light.value[highest]) highest = i;
        const double maximum_nm = 1.4388e7 / (root * kelvin);
        const double highest_nm = MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * highest;
        assert_float_equal(highest_nm, maximum_nm, 0.5 * MTM_WAVELENGTH_STEP_NM + 0.1);
    }
}

static void extreme_temperatures_give_finite_lights(void **state) {
    (void)state;
    const double kelvin[] = {500, 1e6};
    for (int k = 0; k < 2; k++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_blackbody(kelvin[k], &light, &error), error);
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
            assert_true(isfinite(light.value[i]) && light.value[i] > 0);
    }
}

/* D65 was made from these components at 6504 K with M1 and M2 rounded to three decimals. */
static void daylight_at_6504_kelvin_is_nearly_d65(void **state) {
    (void)state;
    mtm_spectrum light, d65;
    mtm_error error;
    assert_ok(mtm_daylight(6504, &light, &error), error);
    assert_ok(mtm_illuminant("D65", &d65, &error), error);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        assert_float_equal(light.value[i], d65.value[i] / 100, 5e-4);
    assert_true(light.value[AT_560] == 1);
}

static void temperatures_out_of_range_are_refused(void **state) {
    (void)state;
    mtm_spectrum light;
    mtm_error error;
    assert_fails(mtm_blackbody(499, &light, &error), MTM_ARGUMENT, error,
                 "blackbody temperature 499 K, expected 500 to 1000000 K");
    assert_fails(mtm_blackbody(2e6, &light, &error), MTM_ARGUMENT, error, "2e+06 K");
    assert_fails(mtm_blackbody(NAN, &light, &error), MTM_ARGUMENT, error, "nan K");
    assert_fails(mtm_daylight(3999, &light, &error), MTM_ARGUMENT, error,
                 "daylight temperature 3999 K, expected 4000 to 25000 K");
    assert_fails(mtm_daylight(25001, &light, &error), MTM_ARGUMENT, error, "25001 K");
    assert_fails(mtm_daylight(NAN, &light, &error), MTM_ARGUMENT, error, "nan K");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(black_bodies_have_the_expected_ratios),
        cmocka_unit_test(the_maximum_moves_as_wien_says),
        cmocka_unit_test(extreme_temperatures_give_finite_lights),
        cmocka_unit_test(daylight_at_6504_kelvin_is_nearly_d65),
        cmocka_unit_test(temperatures_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
