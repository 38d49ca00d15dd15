/* SPDX-License-Identifier: BSD-3-Clause
 * What many errors come to, and the error of one color. */
#include <stdlib.h>

#include "accuracy/statistics.h"
#include "test.h"

/* Falling, so that sorting shows: 100, 99 … 0. The percentile that numpy gives by default. */
static void a_summary_is_mean_percentile_and_maximum(void **state) {
    (void)state;
    double values[101];
    for (int i = 0; i <= 100; i++) values[i] = 100 - i;
    const error_summary summary = error_summarize(101, values);
    assert_float_equal(summary.mean, 50, 1e-12);
    assert_float_equal(summary.p95, 95, 1e-12);
    assert_float_equal(summary.max, 100, 0);
}

static void a_percentile_between_ranks_is_linear(void **state) {
    (void)state;
    double two[] = {3, 1};
    double one[] = {7};
    assert_float_equal(error_summarize(2, two).p95, 2.9, 1e-12);
    assert_float_equal(error_summarize(1, one).p95, 7, 0);
}

static void a_median_is_the_middle(void **state) {
    (void)state;
    double odd[] = {9, 1, 4};
    double even[] = {9, 1, 4, 5};
    assert_float_equal(median(3, odd), 4, 0);
    assert_float_equal(median(4, even), 4.5, 1e-12);
}

static void a_list_grows_and_keeps_its_values(void **state) {
    (void)state;
    error_list list = {0};
    mtm_error error;
    for (int i = 0; i < 1000; i++) {
        assert_ok(error_list_reserve(&list, 1, &error), error);
        assert_true(list.count < list.capacity);
        list.values[list.count++] = i;
    }
    for (int i = 0; i < 1000; i++) assert_float_equal(list.values[i], i, 0);
    free(list.values);
}

static void equal_colors_have_no_error(void **state) {
    (void)state;
    const mtm_xyz white = mtm_white_d65();
    const mtm_xyz color = {0.3, 0.4, 0.2};
    assert_float_equal(color_error(color, color, white, 1), 0, 0);
}

/* Gray of Y = 0.18 against one of 0.2, at an exposure that makes them 0.9 and white. */
static void colors_are_compared_at_the_exposure(void **state) {
    (void)state;
    const mtm_xyz white = {1, 1, 1};
    const mtm_xyz a = {0.18, 0.18, 0.18};
    const mtm_xyz b = {0.2, 0.2, 0.2};
    const mtm_lab bright = mtm_lab_from_xyz((mtm_xyz){0.9, 0.9, 0.9}, white);
    const mtm_lab full = mtm_lab_from_xyz(white, white);
    assert_float_equal(color_error(a, b, white, 5), mtm_ciede2000(bright, full), 1e-12);
}

static void negative_parts_of_a_model_count_as_none(void **state) {
    (void)state;
    const mtm_xyz white = mtm_white_d65();
    const mtm_xyz truth = {0.1, 0.1, 0};
    assert_float_equal(color_error((mtm_xyz){0.1, 0.1, -0.3}, truth, white, 1), 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_summary_is_mean_percentile_and_maximum),
        cmocka_unit_test(a_percentile_between_ranks_is_linear),
        cmocka_unit_test(a_median_is_the_middle),
        cmocka_unit_test(a_list_grows_and_keeps_its_values),
        cmocka_unit_test(equal_colors_have_no_error),
        cmocka_unit_test(colors_are_compared_at_the_exposure),
        cmocka_unit_test(negative_parts_of_a_model_count_as_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
