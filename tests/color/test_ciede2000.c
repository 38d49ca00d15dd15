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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_34_pairs_of_sharma_have_their_published_difference),
        cmocka_unit_test(random_pairs_have_the_expected_difference),
        cmocka_unit_test(a_color_does_not_differ_from_itself),
        cmocka_unit_test(grays_differ_by_weighted_lightness_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
