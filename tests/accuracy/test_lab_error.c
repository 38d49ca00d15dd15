/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "accuracy/lab_error.h"
#include "metamer/color.h"
#include "test.h"

static void the_cube_root_is_within_one_unit_in_the_last_place(void **state) {
    (void)state;
    double largest = 0;
    for (double x = 1e-9; x < 1e9; x *= 1.00137) {
        const double expected = (double)cbrtl(x); /* cbrt is off by up to 4 units in some C libraries */
        const double units = fabs(cube_root(x) - expected) / (nextafter(expected, INFINITY) - expected);
        if (units > largest) largest = units;
    }
    print_message("largest difference %.0f units in the last place\n", largest);
    assert_true(largest <= 1);
    for (int k = -100; k <= 100; k++) assert_true(cube_root(ldexp(27, 3 * k)) == ldexp(3, k));
}

/* CIE94 (CIE 116-1995) with the weights of the first color. */
static double cie94(mtm_lab a, mtm_lab b) {
    const double chroma = hypot(a.a, a.b);
    const double lightness_part = b.l - a.l;
    const double chroma_part = hypot(b.a, b.b) - chroma;
    const double hue_squared =
        fmax((b.a - a.a) * (b.a - a.a) + (b.b - a.b) * (b.b - a.b) - chroma_part * chroma_part, 0);
    const double chroma_weight = 1 + 0.045 * chroma;
    const double hue_weight = 1 + 0.015 * chroma;
    return sqrt(lightness_part * lightness_part +
                chroma_part * chroma_part / (chroma_weight * chroma_weight) +
                hue_squared / (hue_weight * hue_weight));
}

static mtm_lab lab_of(const double xyz[3], const double white[3], double exposure) {
    return mtm_lab_from_xyz((mtm_xyz){exposure * xyz[0], exposure * xyz[1], exposure * xyz[2]},
                            (mtm_xyz){white[0], white[1], white[2]});
}

static const double white[3] = {0.95, 1.0, 1.09};
static const double colors[][3] = {
    {0.2, 0.1, 0.05}, {0.3, 0.4, 0.2}, {0.18, 0.2, 0.7}, {0.004, 0.003, 0.006}, {0.19, 0.2, 0.218}};
enum { COLORS = sizeof colors / sizeof *colors };

static void small_errors_are_those_of_cie94(void **state) {
    (void)state;
    for (int n = 0; n < COLORS; n++)
        for (int exposed = 0; exposed < 2; exposed++) {
            const double exposure = exposed ? 2.5 : 1;
            const lab_target target = lab_target_of(colors[n], white, exposure);
            const double seen[3] = {1.01 * colors[n][0], 0.997 * colors[n][1], 1.004 * colors[n][2]};
            double gradient[3];
            const double error = lab_error(&target, seen, gradient) + 0.1;
            const double difference =
                cie94(lab_of(colors[n], white, exposure), lab_of(seen, white, exposure));
            assert_true(difference > 0.01);
            assert_float_equal(sqrt(error * error - 0.01), difference, 0.02 * difference);
        }
}

static void the_true_color_has_no_error(void **state) {
    (void)state;
    for (int n = 0; n < COLORS; n++) {
        const lab_target target = lab_target_of(colors[n], white, 1.3);
        double gradient[3];
        assert_float_equal(lab_error(&target, colors[n], gradient), 0, 1e-15);
        for (int i = 0; i < 3; i++) assert_float_equal(gradient[i], 0, 1e-9);
    }
}

/* Also below zero, where a reconstruction may come out, and on both sides of the knee of CIELAB. */
static void the_gradient_is_that_of_the_error(void **state) {
    (void)state;
    const double step = 1e-6;
    for (int n = 0; n < COLORS; n++) {
        const lab_target target = lab_target_of(colors[n], white, 1.7);
        const double seen[3] = {0.3, -0.01, 0.002};
        double gradient[3], ignored[3];
        (void)lab_error(&target, seen, gradient);
        for (int i = 0; i < 3; i++) {
            double above[3] = {seen[0], seen[1], seen[2]};
            double below[3] = {seen[0], seen[1], seen[2]};
            above[i] += step;
            below[i] -= step;
            const double slope =
                (lab_error(&target, above, ignored) - lab_error(&target, below, ignored)) / (2 * step);
            assert_float_equal(gradient[i], slope, 1e-6 * fabs(slope) + 1e-6);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cube_root_is_within_one_unit_in_the_last_place),
        cmocka_unit_test(small_errors_are_those_of_cie94),
        cmocka_unit_test(the_true_color_has_no_error),
        cmocka_unit_test(the_gradient_is_that_of_the_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
