/* SPDX-License-Identifier: BSD-3-Clause
 * 8-bit levels of sRGB against the curve itself (IEC 61966-2-1). With the argument "all", every float there is. */
#include <math.h>
#include <stdio.h>

#include "color/srgb_levels.h"
#include "metamer/color.h"
#include "test.h"

static uint32_t expected_level(double linear) {
    return (uint32_t)lrint(255 * mtm_srgb_encode(linear));
}

static float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static void check(const mtm_srgb_levels *levels, float linear) {
    const uint32_t expected = expected_level(linear);
    if (mtm_srgb_level(levels, linear) != expected || mtm_srgb_level_of_double(levels, linear) != expected)
        fail_msg("%a has level %u, not %u or %u", linear, expected, mtm_srgb_level(levels, linear),
                 mtm_srgb_level_of_double(levels, linear));
}

static void the_thresholds_are_those_of_the_curve(void **state) {
    (void)state;
    assert_true(mtm_srgb_thresholds[0] == 0);
    assert_true(isinf(mtm_srgb_thresholds[256]));
    for (uint32_t level = 1; level < 256; level++) {
        const double threshold = mtm_srgb_thresholds[level];
        assert_int_equal(expected_level(threshold * (1 - 1e-14)), level - 1);
        assert_int_equal(expected_level(threshold * (1 + 1e-14)), level);
    }
}

static void floats_round_as_the_curve_around_every_threshold(void **state) {
    (void)state;
    mtm_srgb_levels levels;
    mtm_srgb_levels_prepare(&levels);
    for (int level = 1; level < 256; level++) {
        const uint32_t bits = bits_of((float)mtm_srgb_thresholds[level]);
        for (uint32_t i = bits - 300; i < bits + 300; i++) check(&levels, float_of(i));
    }
}

static void floats_round_as_the_curve_everywhere(void **state) {
    (void)state;
    mtm_srgb_levels levels;
    mtm_srgb_levels_prepare(&levels);
    for (uint32_t i = 0; i < 0x3f900000U; i += 997) check(&levels, float_of(i)); /* 0 … 1.125 */
    for (uint32_t i = 0; i < 1000000; i++) check(&levels, float_of(i * 2654435761U));
    const float special[] = {NAN,   -NAN, INFINITY,       -INFINITY,     0,
                             -0.0F, 1,    0x1.fffffep-1F, 0x1.000002p0F, 0x1p-13F};
    for (size_t i = 0; i < sizeof special / sizeof *special; i++) check(&levels, special[i]);
}

static void doubles_round_at_the_threshold_itself(void **state) {
    (void)state;
    mtm_srgb_levels levels;
    mtm_srgb_levels_prepare(&levels);
    for (uint32_t level = 1; level < 256; level++) {
        const double threshold = mtm_srgb_thresholds[level];
        assert_int_equal(mtm_srgb_level_of_double(&levels, threshold), level);
        assert_int_equal(mtm_srgb_level_of_double(&levels, nextafter(threshold, 0)), level - 1);
    }
    assert_int_equal(mtm_srgb_level_of_double(&levels, NAN), 0);
    assert_int_equal(mtm_srgb_level_of_double(&levels, -1e300), 0);
    assert_int_equal(mtm_srgb_level_of_double(&levels, 1e300), 255);
}

static int check_every_float(void) {
    mtm_srgb_levels levels;
    mtm_srgb_levels_prepare(&levels);
    uint32_t wrong = 0;
    uint32_t bits = 0;
    do {
        const uint32_t expected = expected_level(float_of(bits));
        wrong += mtm_srgb_level(&levels, float_of(bits)) != expected;
        wrong += mtm_srgb_level_of_double(&levels, float_of(bits)) != expected;
    } while (++bits != 0);
    (void)printf("%u of 2^32 floats have a wrong level\n", wrong);
    return wrong != 0;
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_thresholds_are_those_of_the_curve),
        cmocka_unit_test(floats_round_as_the_curve_around_every_threshold),
        cmocka_unit_test(floats_round_as_the_curve_everywhere),
        cmocka_unit_test(doubles_round_at_the_threshold_itself),
    };
    if (argc == 2 && strcmp(argv[1], "all") == 0) return check_every_float();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
