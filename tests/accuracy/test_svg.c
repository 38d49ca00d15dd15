/* SPDX-License-Identifier: BSD-3-Clause
 * Where plots put things. */
#include "accuracy/svg.h"
#include "test.h"

static const svg_panel panel = {.left = 100,
                                .top = 50,
                                .width = 200,
                                .height = 100,
                                .x = {.low = 0, .high = 10},
                                .y = {.low = 0.1, .high = 10, .is_logarithmic = true}};

static void values_are_placed_along_the_axes(void **state) {
    (void)state;
    assert_float_equal(svg_place_x(&panel, 0), 100, 1e-9);
    assert_float_equal(svg_place_x(&panel, 2.5), 150, 1e-9);
    assert_float_equal(svg_place_y(&panel, 0.1), 150, 1e-9);
    assert_float_equal(svg_place_y(&panel, 1), 100, 1e-9);
    assert_float_equal(svg_place_y(&panel, 10), 50, 1e-9);
}

static void values_outside_stay_in_the_panel(void **state) {
    (void)state;
    assert_float_equal(svg_place_x(&panel, 11), 300, 1e-9);
    assert_float_equal(svg_place_y(&panel, 0), 150, 1e-9);
}

static void labels_are_moved_apart_in_their_order(void **state) {
    (void)state;
    double heights[] = {52, 50, 90, 51};
    svg_spread(4, heights, 10, 0, 200);
    assert_true(heights[1] < heights[3] && heights[3] < heights[0] && heights[0] < heights[2]);
    assert_true(heights[3] - heights[1] > 9.99 && heights[0] - heights[3] > 9.99);
    assert_float_equal(heights[2], 90, 0);
}

static void labels_stay_in_their_range(void **state) {
    (void)state;
    double heights[] = {99, 99, 98};
    svg_spread(3, heights, 10, 0, 100);
    for (int i = 0; i < 3; i++) assert_true(heights[i] <= 100);
    assert_true(heights[1] - heights[0] > 9.9 && heights[0] - heights[2] > 9.9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_placed_along_the_axes),
        cmocka_unit_test(values_outside_stay_in_the_panel),
        cmocka_unit_test(labels_are_moved_apart_in_their_order),
        cmocka_unit_test(labels_stay_in_their_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
