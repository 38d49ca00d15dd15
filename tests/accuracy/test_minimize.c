/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "accuracy/minimize.h"
#include "test.h"

enum { N = 40 };

/* Rosenbrock's valley in N dimensions; its minimum is 0 at (1, …, 1). */
static double valley(void *user, const double *x, double *gradient) {
    double value = 0;
    ++*(int *)user;
    for (int i = 0; i < N; i++) gradient[i] = 0;
    for (int i = 0; i + 1 < N; i++) {
        const double a = x[i + 1] - x[i] * x[i];
        const double b = 1 - x[i];
        value += 100 * a * a + b * b;
        gradient[i] += -400 * a * x[i] - 2 * b;
        gradient[i + 1] += 200 * a;
    }
    return value;
}

static void the_valley_is_followed_to_its_end(void **state) {
    (void)state;
    const minimize_options options = {.iterations_max = 1000, .decrease_min = 1e-12};
    minimize_result result;
    mtm_error error;
    int calls = 0;
    double x[N];
    for (int i = 0; i < N; i++) x[i] = i % 2 == 0 ? -1.2 : 1;
    assert_ok(minimize(N, valley, &calls, &options, x, &result, &error), error);
    for (int i = 0; i < N; i++) assert_float_equal(x[i], 1, 1e-6);
    assert_true(result.value < 1e-12);
    assert_int_equal(result.evaluations, calls);
    assert_in_range(result.iterations, 40, 500); /* steepest descent needs thousands */
}

static void the_number_of_iterations_is_bounded(void **state) {
    (void)state;
    const minimize_options options = {.iterations_max = 7, .decrease_min = 0};
    minimize_result result;
    mtm_error error;
    int calls = 0;
    double x[N] = {0};
    double gradient[N];
    const double before = valley(&calls, x, gradient);
    assert_ok(minimize(N, valley, &calls, &options, x, &result, &error), error);
    assert_int_equal(result.iterations, 7);
    assert_true(result.value < before);
    assert_true(result.value == valley(&calls, x, gradient));
}

/* √(1 + x²) is so flat far out that full steps overshoot, and so steep that a first step of length 1 falls short. */
static double bowl(void *user, const double *x, double *gradient) {
    (void)user;
    const double value = sqrt(1 + x[0] * x[0]);
    gradient[0] = x[0] / value;
    return value;
}

static void steps_grow_and_shrink_as_needed(void **state) {
    (void)state;
    const minimize_options options = {.iterations_max = 100, .decrease_min = 0};
    minimize_result result;
    mtm_error error;
    double x[1] = {1e6};
    assert_ok(minimize(1, bowl, NULL, &options, x, &result, &error), error);
    assert_float_equal(x[0], 0, 1e-6);
    assert_true(result.evaluations < 300);
}

static void a_minimum_is_not_left(void **state) {
    (void)state;
    const minimize_options options = {.iterations_max = 100, .decrease_min = 0};
    minimize_result result;
    mtm_error error;
    double x[1] = {0};
    assert_ok(minimize(1, bowl, NULL, &options, x, &result, &error), error);
    assert_true(x[0] == 0 && result.value == 1 && result.iterations == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_valley_is_followed_to_its_end),
        cmocka_unit_test(the_number_of_iterations_is_bounded),
        cmocka_unit_test(steps_grow_and_shrink_as_needed),
        cmocka_unit_test(a_minimum_is_not_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
