/* SPDX-License-Identifier: BSD-3-Clause
 * The triad a[i] = b[i] + 3 c[i] over arrays larger than caches: what memory gives (J. D. McCalpin, STREAM). */
#ifndef METAMER_CLI_BENCH_TRIAD_H
#define METAMER_CLI_BENCH_TRIAD_H

#include <stddef.h>

enum { BENCH_TRIAD_THREADS_MAX = 2 };

/* The three arrays one behind the other; NULL where memory ran out. Release with free. */
double *create_triad(void);

/* Milliseconds of one triad; 1 or 2 threads. */
double time_triad(double *arrays, int thread_count);

/* What one triad moves, as STREAM counts it: 24 bytes an element. */
double triad_bytes(void);

#endif
