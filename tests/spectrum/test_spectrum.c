/* SPDX-License-Identifier: BSD-3-Clause */
#include "metamer/spectrum.h"

#include <math.h>

#include "test.h"

static double grid_wavelength_nm(int i) {
    return MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * i;
}

static void arithmetic_works_sample_by_sample(void **state) {
    (void)state;
    mtm_spectrum ramp;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) ramp.value[i] = i;
    const mtm_spectrum three = mtm_spectrum_constant(3);
    const mtm_spectrum product = mtm_spectrum_multiply(&ramp, &three);
    const mtm_spectrum scaled = mtm_spectrum_scale(&ramp, 3);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        assert_true(three.value[i] == 3);
        assert_true(product.value[i] == 3.0 * i);
        assert_true(scaled.value[i] == 3.0 * i);
    }
}

static void the_grid_resampled_is_itself(void **state) {
    (void)state;
    double wavelength_nm[MTM_SPECTRUM_SAMPLES];
    double value[MTM_SPECTRUM_SAMPLES];
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        wavelength_nm[i] = grid_wavelength_nm(i);
        value[i] = sin(1.7 * i);
    }
    for (int kind = MTM_KIND_LIGHT; kind <= MTM_KIND_OBSERVER; kind++) {
        const mtm_spectrum s =
            mtm_spectrum_resample(MTM_SPECTRUM_SAMPLES, wavelength_nm, value, (mtm_spectrum_kind)kind);
        assert_memory_equal(s.value, value, sizeof value);
    }
}

enum { UNEVEN_COUNT = 300 };

/* Steps from 0.1 to 3.9 nm, 300 of them from 360 nm to beyond 900 nm. */
static void fill_uneven(double wavelength_nm[UNEVEN_COUNT]) {
    double at = 360;
    for (int i = 0; i < UNEVEN_COUNT; i++) {
        wavelength_nm[i] = at;
        at += 2 + 1.9 * sin(2.3 * i);
    }
}

static void a_linear_curve_is_reproduced_from_any_wavelengths(void **state) {
    (void)state;
    double wavelength_nm[UNEVEN_COUNT];
    double value[UNEVEN_COUNT];
    fill_uneven(wavelength_nm);
    for (int i = 0; i < UNEVEN_COUNT; i++) value[i] = 0.25 * wavelength_nm[i] - 17;
    for (int kind = MTM_KIND_LIGHT; kind <= MTM_KIND_OBSERVER; kind++) {
        const mtm_spectrum s =
            mtm_spectrum_resample(UNEVEN_COUNT, wavelength_nm, value, (mtm_spectrum_kind)kind);
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
            assert_float_equal(s.value[i], 0.25 * grid_wavelength_nm(i) - 17, 1e-10);
    }
}

static void a_constant_stays_constant(void **state) {
    (void)state;
    double wavelength_nm[UNEVEN_COUNT];
    double value[UNEVEN_COUNT];
    fill_uneven(wavelength_nm);
    for (int i = 0; i < UNEVEN_COUNT; i++) value[i] = 0.7;
    for (int count = 1; count <= UNEVEN_COUNT; count += 13) {
        const mtm_spectrum light = mtm_spectrum_resample(count, wavelength_nm, value, MTM_KIND_LIGHT);
        const mtm_spectrum surface = mtm_spectrum_resample(count, wavelength_nm, value, MTM_KIND_REFLECTANCE);
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
            assert_float_equal(light.value[i], 0.7, 1e-14);
            assert_true(surface.value[i] == 0.7);
        }
    }
}

/* A 1 nm table with a line at 546 nm: a triangle of area 1 nm, of which the cell round 545 nm has everything. */
static void a_fine_light_keeps_the_power_of_its_lines(void **state) {
    (void)state;
    enum { COUNT = 471 };
    double wavelength_nm[COUNT];
    double value[COUNT] = {0};
    for (int i = 0; i < COUNT; i++) wavelength_nm[i] = 360 + i;
    value[546 - 360] = 1;
    const mtm_spectrum light = mtm_spectrum_resample(COUNT, wavelength_nm, value, MTM_KIND_LIGHT);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        assert_float_equal(light.value[i], grid_wavelength_nm(i) == 545 ? 0.2 : 0.0, 1e-15);
    const mtm_spectrum surface = mtm_spectrum_resample(COUNT, wavelength_nm, value, MTM_KIND_REFLECTANCE);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) assert_true(surface.value[i] == 0);
}

/* The exact mean over 5 nm of a 1 nm table: the cell's ends lie between samples, where the curve is read halfway.
 * For a line on the cell's border, each cell has its side of the triangle. */
static void the_mean_over_a_cell_is_exact_at_its_ends(void **state) {
    (void)state;
    const double wavelength_nm[] = {400, 541.5, 542.5, 543.5, 700};
    const double value[] = {0, 0, 1, 0, 0};
    const double fine[] = {400, 401, 402, 403, 541.5, 542.5, 543.5, 544, 544.5, 545};
    const double fine_value[] = {0, 0, 0, 0, 0, 1, 0, 0, 0, 0};
    const mtm_spectrum averaged = mtm_spectrum_resample(10, fine, fine_value, MTM_KIND_LIGHT);
    assert_float_equal(averaged.value[(540 - 380) / 5], 0.1, 1e-15);
    assert_float_equal(averaged.value[(545 - 380) / 5], 0.1, 1e-15);
    /* Two of four steps are short: the median is not below 5 nm, so this one is interpolated. */
    const mtm_spectrum read = mtm_spectrum_resample(5, wavelength_nm, value, MTM_KIND_LIGHT);
    assert_true(read.value[(545 - 380) / 5] == 0);
}

static void ends_are_held_but_observers_end_in_darkness(void **state) {
    (void)state;
    const double wavelength_nm[] = {400, 410, 420};
    const double fine_nm[] = {400, 401, 402};
    const double value[] = {2, 3, 5};
    const mtm_spectrum light = mtm_spectrum_resample(3, wavelength_nm, value, MTM_KIND_LIGHT);
    const mtm_spectrum fine = mtm_spectrum_resample(3, fine_nm, value, MTM_KIND_LIGHT);
    const mtm_spectrum surface = mtm_spectrum_resample(3, wavelength_nm, value, MTM_KIND_REFLECTANCE);
    const mtm_spectrum observer = mtm_spectrum_resample(3, wavelength_nm, value, MTM_KIND_OBSERVER);
    const double expected[] = {2, 2, 2, 2, 2, 2.5, 3, 4, 5, 5, 5};
    for (int i = 0; i < 11; i++) {
        assert_true(light.value[i] == expected[i]);
        assert_true(surface.value[i] == expected[i]);
        assert_true(observer.value[i] == (i < 4 || i > 8 ? 0 : expected[i]));
    }
    assert_true(light.value[80] == 5);
    assert_true(observer.value[80] == 0);
    assert_float_equal(fine.value[0], 2, 1e-15);
    assert_float_equal(fine.value[80], 5, 1e-15);
    /* 397.5 … 402.5 nm: 2 held for 2.5 nm, 2.5 and 4 for one each, 5 held for 0.5 nm. */
    assert_float_equal(fine.value[4], (2.5 * 2 + 2.5 + 4 + 0.5 * 5) / 5, 1e-14);
}

static void a_single_sample_is_held_everywhere(void **state) {
    (void)state;
    const double wavelength_nm = 500;
    const double value = 0.4;
    const mtm_spectrum light = mtm_spectrum_resample(1, &wavelength_nm, &value, MTM_KIND_LIGHT);
    const mtm_spectrum observer = mtm_spectrum_resample(1, &wavelength_nm, &value, MTM_KIND_OBSERVER);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        assert_true(light.value[i] == 0.4);
        assert_true(observer.value[i] == (i == 24 ? 0.4 : 0));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arithmetic_works_sample_by_sample),
        cmocka_unit_test(the_grid_resampled_is_itself),
        cmocka_unit_test(a_linear_curve_is_reproduced_from_any_wavelengths),
        cmocka_unit_test(a_constant_stays_constant),
        cmocka_unit_test(a_fine_light_keeps_the_power_of_its_lines),
        cmocka_unit_test(the_mean_over_a_cell_is_exact_at_its_ends),
        cmocka_unit_test(ends_are_held_but_observers_end_in_darkness),
        cmocka_unit_test(a_single_sample_is_held_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
