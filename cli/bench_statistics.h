/* SPDX-License-Identifier: BSD-3-Clause
 * Times of repeated runs, and what they come to. */
#ifndef METAMER_CLI_BENCH_STATISTICS_H
#define METAMER_CLI_BENCH_STATISTICS_H

enum { BENCH_RUNS_MAX = 256 };

/* Milliseconds of the timed runs, in their order. */
typedef struct bench_times {
    int count;
    double ms[BENCH_RUNS_MAX];
} bench_times;

typedef struct bench_summary {
    double median; /* the mean of the two in the middle where the count is even */
    double p95;    /* the 95th percentile by nearest rank: the ⌈0.95 n⌉-th of the sorted times */
    double spread; /* the interquartile range, both quartiles by nearest rank */
} bench_summary;

/* Of a clock that only moves forward. */
double now_ms(void);

/* Preconditions: fewer than BENCH_RUNS_MAX times so far; at least one. */
void add_time(bench_times *times, double ms);
bench_summary summarize_times(const bench_times *times);
/* Of any numbers, which it sorts; at least one. */
bench_summary summarize_values(int count, double *values);
double median_ms(const bench_times *times);

/* The share of the variance of y that the best line y = a + b·x explains (R², 0 … 1); 1 where y does not vary.
 * Precondition: x varies. */
double fit_line_quality(int count, const double *x, const double *y);

#endif
