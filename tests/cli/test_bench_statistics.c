/* SPDX-License-Identifier: BSD-3-Clause
 * What many times come to: median, 95th percentile, interquartile range, and how well a line fits. */
#include "bench_statistics.h"

#include <math.h>

#include "test.h"

/* 1, 2 … count, shuffled: 7 has no divisor in common with the counts below. */
static bench_times times_up_to(int count) {
    bench_times times = {.count = 0};
    for (int i = 0; i < count; i++) add_time(&times, 1 + (i * 7 + 3) % count);
    return times;
}

static void expect_summary(int count, double median, double p95, double spread) {
    const bench_times times = times_up_to(count);
    const bench_times before = times;
    const bench_summary summary = summarize_times(&times);
    assert_true(summary.median == median);
    assert_true(summary.p95 == p95);
    assert_true(summary.spread == spread);
    assert_true(median_ms(&times) == median);
    assert_memory_equal(times.ms, before.ms, (size_t)count * sizeof *times.ms); /* runs keep their order */
}

static void percentiles_are_those_of_the_nearest_rank(void **state) {
    (void)state;
    expect_summary(1, 1, 1, 0);
    expect_summary(2, 1.5, 2, 1);
    expect_summary(4, 2.5, 4, 2);
    expect_summary(5, 3, 5, 2);
    expect_summary(10, 5.5, 10, 5);
    expect_summary(20, 10.5, 19, 10);
    expect_summary(100, 50.5, 95, 50);
    expect_summary(BENCH_RUNS_MAX, 128.5, 244, 128);
}

static void the_clock_moves_forward(void **state) {
    (void)state;
    double last = now_ms();
    const double first = last;
    for (int i = 0; i < 1000000 && last <= first; i++) {
        const double now = now_ms();
        assert_true(now >= last);
        last = now;
    }
    assert_true(last > first);
}

/* F. J. Anscombe, "Graphs in statistical analysis", American Statistician 27(1), 1973: data set 1, multiple R² .667. */
static void the_quality_of_a_line_is_its_share_of_the_variance(void **state) {
    static const double x[] = {10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
    static const double y[] = {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
    static const double on_a_line[] = {4, 3.2, 5.2, 3.6, 4.4, 5.6, 2.4, 1.6, 4.8, 2.8, 2};
    static const double even[] = {3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3};
    static const double symmetric[] = {1, 0, 1};
    static const double middle[] = {-1, 0, 1};
    (void)state;
    assert_true(fabs(fit_line_quality(11, x, y) - 0.66654) <= 1e-5);
    assert_true(fabs(fit_line_quality(11, x, on_a_line) - 1) <= 1e-12);
    assert_true(fabs(fit_line_quality(11, x, even) - 1) <= 0);
    assert_true(fabs(fit_line_quality(3, middle, symmetric) - 0) <= 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(percentiles_are_those_of_the_nearest_rank),
        cmocka_unit_test(the_clock_moves_forward),
        cmocka_unit_test(the_quality_of_a_line_is_its_share_of_the_variance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
