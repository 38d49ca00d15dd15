/* SPDX-License-Identifier: BSD-3-Clause
 * The clock, medians and percentiles, and the fit of a line (least squares). */
#include "bench_statistics.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

double now_ms(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

void add_time(bench_times *times, double ms) {
    assert(times->count < BENCH_RUNS_MAX);
    times->ms[times->count++] = ms;
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* `percent` 1 … 100. In integers, so that no rounding moves a rank. */
static double nearest_rank(int count, const double *sorted, int percent) {
    return sorted[(percent * count + 99) / 100 - 1];
}

bench_summary summarize_values(int count, double *values) {
    assert(count > 0);
    qsort(values, (size_t)count, sizeof *values, compare_doubles);
    return (bench_summary){
        .median = 0.5 * (values[(count - 1) / 2] + values[count / 2]),
        .p95 = nearest_rank(count, values, 95),
        .spread = nearest_rank(count, values, 75) - nearest_rank(count, values, 25),
    };
}

bench_summary summarize_times(const bench_times *times) {
    bench_times sorted = *times;
    return summarize_values(sorted.count, sorted.ms);
}

double median_ms(const bench_times *times) {
    return summarize_times(times).median;
}

double fit_line_quality(int count, const double *x, const double *y) {
    double mean_x = 0;
    double mean_y = 0;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (int i = 0; i < count; i++) {
        mean_x += x[i];
        mean_y += y[i];
    }
    mean_x /= count;
    mean_y /= count;
    for (int i = 0; i < count; i++) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    return yy > 0 ? xy * xy / (xx * yy) : 1;
}
