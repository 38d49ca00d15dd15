/* SPDX-License-Identifier: BSD-3-Clause
 * IEEE 754 binary16 against its definition. */
#include <math.h>

#include "base/half.h"
#include "test.h"

/* ± fraction · 2^exponent (IEEE 754-2019, section 3.4). */
static double value_of(uint32_t half) {
    const int exponent = (int)(half >> 10 & 31);
    const int fraction = (int)(half & 1023);
    double magnitude = exponent == 0 ? ldexp(fraction, -24) : ldexp(1024 + fraction, exponent - 25);
    if (exponent == 31) magnitude = fraction == 0 ? INFINITY : NAN;
    return half >> 15 == 1 ? -magnitude : magnitude;
}

static void every_half_is_its_value_as_float(void **state) {
    (void)state;
    static uint16_t halves[65536];
    static float floats[65536];
    for (uint32_t i = 0; i < 65536; i++) halves[i] = (uint16_t)i;
    mtm_floats_of_halves(65535, halves, floats);
    for (uint32_t i = 0; i < 65535; i++) {
        const double expected = value_of(i);
        const float single = mtm_float_of_half((uint16_t)i);
        assert_true(isnan(expected) ? isnan(floats[i]) && isnan(single)
                                    : floats[i] == expected && single == expected);
        assert_int_equal(signbit(single) != 0, i >> 15);
    }
    assert_true(floats[65535] == 0);
}

static void every_half_comes_back(void **state) {
    (void)state;
    for (uint32_t i = 0; i < 65536; i++) {
        const uint32_t back = mtm_half_of_float(mtm_float_of_half((uint16_t)i));
        if (isnan(value_of(i)))
            assert_true(isnan(value_of(back)));
        else
            assert_int_equal(back, i);
    }
}

/* Between neighbors: below the middle down, above it up, in it to the even one. */
static void floats_between_halves_round_to_the_nearest(void **state) {
    (void)state;
    for (uint32_t i = 0; i < 0x7c00; i++) {
        const double above = i + 1 == 0x7c00 ? 65536 : value_of(i + 1);
        const float middle = (float)(0.5 * (value_of(i) + above)); /* exact */
        assert_int_equal(mtm_half_of_float(nextafterf(middle, 0)), i);
        assert_int_equal(mtm_half_of_float(middle), i + i % 2);
        assert_int_equal(mtm_half_of_float(nextafterf(middle, INFINITY)), i + 1);
        assert_int_equal(mtm_half_of_float(-middle), 0x8000 + i + i % 2);
    }
    assert_int_equal(mtm_half_of_float(3e38F), 0x7c00);
    assert_int_equal(mtm_half_of_float(INFINITY), 0x7c00);
    assert_int_equal(mtm_half_of_float(-INFINITY), 0xfc00);
    assert_int_equal(mtm_half_of_float(1e-45F), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_half_is_its_value_as_float),
        cmocka_unit_test(every_half_comes_back),
        cmocka_unit_test(floats_between_halves_round_to_the_nearest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
