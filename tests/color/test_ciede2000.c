/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "expected.h"
#include "metamer/color.h"

static mtm_lab lab_of(const expected_table *table, int row, const char *l, const char *a, const char *b) {
    return (mtm_lab){expected_value(table, row, l), expected_value(table, row, a),
                     expected_value(table, row, b)};
}

static void check_pairs(const char *file, const char *column, double tolerance) {
    expected_table *expected = read_expected(file);
    deviation seen = {0};
    for (int row = 0; row < expected->row_count; row++) {
        const mtm_lab first = lab_of(expected, row, "L1", "a1", "b1");
        const mtm_lab second = lab_of(expected, row, "L2", "a2", "b2");
        const double published = expected_value(expected, row, column);
        check_near(&seen, mtm_ciede2000(first, second), published, tolerance, expected->names[row], column);
        check_near(&seen, mtm_ciede2000(second, first), published, tolerance, expected->names[row],
                   "swapped");
    }
    print_message("%s: %d pairs, largest deviation %.2g\n", file, expected->row_count, seen.largest);
    free(expected);
}

/* Published with four decimals: half of the last one, and what rounding adds. */
static void the_34_pairs_of_sharma_have_their_published_difference(void **state) {
    (void)state;
    check_pairs("ciede2000_sharma34.csv", "dE00_published", 5.1e-5);
}

static void random_pairs_have_the_expected_difference(void **state) {
    (void)state;
    check_pairs("delta_e_random50.csv", "dE2000", 1e-7);
}

static void a_color_does_not_differ_from_itself(void **state) {
    (void)state;
    const mtm_lab colors[] = {{0, 0, 0}, {100, 0, 0}, {50, 80, -120}, {50, -1, 0}};
    for (int i = 0; i < 4; i++) assert_true(mtm_ciede2000(colors[i], colors[i]) == 0);
}

static void grays_differ_by_weighted_lightness_alone(void **state) {
    (void)state;
    /* Means of L* of 50: the weight is 1. */
    assert_float_equal(mtm_ciede2000((mtm_lab){45, 0, 0}, (mtm_lab){55, 0, 0}), 10, 1e-12);
}

static mtm_lab lab_of_hue(double degrees) {
    const double radians = degrees * (3.14159265358979323846 / 180);
    return (mtm_lab){50, 40 * cos(radians), 40 * sin(radians)};
}

/* At 180 degrees the mean hue is the one of a slightly smaller difference, on whichever side rounding falls. */
static void opposite_hues_have_the_difference_of_nearly_opposite_ones(void **state) {
    (void)state;
    for (double degrees = 0.5; degrees < 180; degrees += 0.7) {
        const mtm_lab color = lab_of_hue(degrees);
        const mtm_lab opposite = {50, -color.a, -color.b};
        const double nearly = mtm_ciede2000(color, lab_of_hue(degrees + 180 - 1e-6));
        assert_float_equal(mtm_ciede2000(color, opposite), nearly, 1e-5);
        assert_float_equal(mtm_ciede2000(opposite, color), nearly, 1e-5);
    }
}

static void gray_differs_alike_from_all_hues_of_a_chroma(void **state) {
    (void)state;
    const double first = mtm_ciede2000((mtm_lab){50, 0, 0}, (mtm_lab){50, 0, 40});
    assert_true(first > 10);
    assert_float_equal(mtm_ciede2000((mtm_lab){50, 0, 0}, (mtm_lab){50, 0, -40}), first, 1e-12);
    assert_float_equal(mtm_ciede2000((mtm_lab){50, 0, -40}, (mtm_lab){50, 0, 0}), first, 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_34_pairs_of_sharma_have_their_published_difference),
        cmocka_unit_test(random_pairs_have_the_expected_difference),
        cmocka_unit_test(a_color_does_not_differ_from_itself),
        cmocka_unit_test(grays_differ_by_weighted_lightness_alone),
        cmocka_unit_test(opposite_hues_have_the_difference_of_nearly_opposite_ones),
        cmocka_unit_test(gray_differs_alike_from_all_hues_of_a_chroma),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
