/* SPDX-License-Identifier: BSD-3-Clause
 * What the programs that measure share: a clock, and what many times come to. */
#ifndef METAMER_BENCH_TIMING_H
#define METAMER_BENCH_TIMING_H

/* Of a clock that only moves forward. */
double now_ms(void);

/* The median of `count` ≥ 1 times, which are sorted: the first is then the minimum. */
double median(int count, double *times_ms);

#endif
