/* SPDX-License-Identifier: BSD-3-Clause
 * Where plots put things. */
#include "drawing/svg.h"
#include <stdlib.h>
#include <string.h>

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

static void check_escaped(const char *text, const char *expected) {
    char *escaped = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&escaped, &size);
    assert_non_null(stream);
    svg_escape(stream, text);
    assert_int_equal(fclose(stream), 0);
    assert_string_equal(escaped, expected);
    free(escaped);
}

static void text_becomes_text_of_xml(void **state) {
    (void)state;
    check_escaped("a < b & c > \"d\"", "a &lt; b &amp; c &gt; \"d\"");
    check_escaped("gr\xc3\xbcn \xe3\x83\xa9 \xf0\x9f\x92\xa1", "gr\xc3\xbcn \xe3\x83\xa9 \xf0\x9f\x92\xa1");
    check_escaped("\x01\t\xef\xbf\xbf", "\xef\xbf\xbd\t\xef\xbf\xbd");
    check_escaped("\xc3", "\xef\xbf\xbd");
}

static void text_is_shortened_between_characters(void **state) {
    (void)state;
    char text[32];
    svg_shorten("short", 10, 100, sizeof text, text);
    assert_string_equal(text, "short");
    svg_shorten("aaaaaaaaaaaaaaaaaaaa", 10, 50, sizeof text, text);
    assert_true(svg_text_width(text, 10) <= 50);
    assert_string_equal(text + strspn(text, "a"), "\xe2\x80\xa6");
    svg_shorten("\xc3\xbc\xc3\xbc\xc3\xbc\xc3\xbc", 10, 1000, 7, text);
    assert_string_equal(text, "\xc3\xbc\xe2\x80\xa6");
    svg_shorten("wide", 10, 1, sizeof text, text);
    assert_string_equal(text, "\xe2\x80\xa6");
}

static void axes_end_at_ticks(void **state) {
    (void)state;
    double ticks[SVG_TICKS_MAX];
    svg_axis axis = {.tick_count = 0};
    svg_fit_axis(-0.1, 1.3, &axis, ticks);
    assert_float_equal(axis.low, -0.2, 1e-12);
    assert_float_equal(axis.high, 1.4, 1e-12);
    assert_int_equal(axis.tick_count, 9);
    assert_true(ticks[1] == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_placed_along_the_axes),
        cmocka_unit_test(values_outside_stay_in_the_panel),
        cmocka_unit_test(labels_are_moved_apart_in_their_order),
        cmocka_unit_test(labels_stay_in_their_range),
        cmocka_unit_test(text_becomes_text_of_xml),
        cmocka_unit_test(text_is_shortened_between_characters),
        cmocka_unit_test(axes_end_at_ticks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
