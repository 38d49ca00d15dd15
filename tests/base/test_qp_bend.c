/* SPDX-License-Identifier: BSD-3-Clause
 * Curves that may bend only so much, and linear programs, against closed forms. */
#include <math.h>

#include "base/qp.h"
#include "fixture.h"

enum { LENGTH = 41 };

/* The curve with the largest Σ weights·x, two sums fixed. */
static void raise_curve(const double *weights, double bend, const double *first, double first_value,
                        const double *second, double second_value, double *x) {
    mtm_error error;
    double linear[LENGTH];
    for (int i = 0; i < LENGTH; i++) {
        linear[i] = -weights[i];
        x[i] = 0;
    }
    mtm_qp_curve curve = {.size = 1e-4, .linear = linear, .low = -10, .high = 10, .bend = bend, .x = x};
    mtm_qp_sum sums[] = {
        {.term_count = 1, .terms = {{0, first}}, .low = first_value, .high = first_value, .give = 1e-9},
        {.term_count = 1, .terms = {{0, second}}, .low = second_value, .high = second_value, .give = 1e-9}};
    mtm_qp program = {LENGTH, 1, &curve, 2, sums};
    assert_ok(mtm_qp_minimize(&program, &error), error);
}

/* Fixed at both ends, it is the parabola of that second difference. */
static void a_curve_that_is_raised_bends_as_much_as_it_may(void **state) {
    (void)state;
    static const double bends[] = {1e-3, 0.01, 0.03};
    double weights[LENGTH];
    double first[LENGTH] = {0};
    double last[LENGTH] = {0};
    first[0] = last[LENGTH - 1] = 1;
    for (int i = 0; i < LENGTH; i++) weights[i] = 1;
    for (int n = 0; n < 3; n++) {
        double x[LENGTH];
        raise_curve(weights, bends[n], first, 1, last, 3, x);
        for (int i = 0; i < LENGTH; i++) {
            const double line = 1 + 2.0 * i / (LENGTH - 1);
            assert_near(x[i], line + bends[n] / 2 * i * (LENGTH - 1 - i), 1e-6);
        }
    }
}

static void a_curve_without_a_bound_on_its_bends_has_corners(void **state) {
    (void)state;
    double weights[LENGTH];
    double first[LENGTH] = {0};
    double last[LENGTH] = {0};
    double x[LENGTH];
    first[0] = last[LENGTH - 1] = 1;
    for (int i = 0; i < LENGTH; i++) weights[i] = i % 2 ? 1 : -1;
    raise_curve(weights, 0, first, 1, last, 3, x);
    for (int i = 1; i + 1 < LENGTH; i++) assert_near(x[i], i % 2 ? 10 : -10, 1e-6);
}

/* Smooth curves are no different where the bound is not met. */
static void a_bound_that_is_not_met_changes_nothing(void **state) {
    (void)state;
    mtm_error error;
    double free_x[LENGTH] = {0};
    double bound_x[LENGTH] = {0};
    double weights[LENGTH] = {0};
    weights[LENGTH / 2] = 1;
    for (int n = 0; n < 2; n++) {
        mtm_qp_curve curve = {.curvature = 1, .size = 1e-3, .low = -1, .high = 1, .x = n ? bound_x : free_x};
        curve.bend = n ? 1 : 0;
        mtm_qp_sum sum = {.term_count = 1, .terms = {{0, weights}}, .low = 0.7, .high = 0.7, .give = 1e-9};
        mtm_qp program = {LENGTH, 1, &curve, 1, &sum};
        assert_ok(mtm_qp_minimize(&program, &error), error);
    }
    for (int i = 0; i < LENGTH; i++) assert_near(bound_x[i], free_x[i], 1e-8);
}

/* A linear program with one sum: the samples that are worth most are filled first. */
static void the_best_samples_of_a_linear_program_are_full(void **state) {
    (void)state;
    mtm_error error;
    double linear[LENGTH];
    double weights[LENGTH];
    double x[LENGTH] = {0};
    for (int i = 0; i < LENGTH; i++) {
        linear[i] = -(i * 17 % LENGTH);
        weights[i] = 1;
    }
    mtm_qp_curve curve = {.size = 1e-6, .linear = linear, .low = 0, .high = 1, .x = x};
    mtm_qp_sum sum = {.term_count = 1, .terms = {{0, weights}}, .low = 10.25, .high = 10.25, .give = 1e-9};
    mtm_qp program = {LENGTH, 1, &curve, 1, &sum};
    assert_ok(mtm_qp_minimize(&program, &error), error);
    for (int i = 0; i < LENGTH; i++) {
        const double rank = -linear[i] - (LENGTH - 11); /* above 0: one of the best ten */
        assert_near(x[i], rank > 0 ? 1 : rank == 0 ? 0.25 : 0, 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_curve_that_is_raised_bends_as_much_as_it_may),
        cmocka_unit_test(a_curve_without_a_bound_on_its_bends_has_corners),
        cmocka_unit_test(a_bound_that_is_not_met_changes_nothing),
        cmocka_unit_test(the_best_samples_of_a_linear_program_are_full),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
