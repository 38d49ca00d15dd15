/* SPDX-License-Identifier: BSD-3-Clause
 * The triad a[i] = b[i] + 3 c[i] over arrays larger than caches: what memory gives (J. D. McCalpin, STREAM). */
#include "bench_triad.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

#include "bench_statistics.h"

enum { TRIAD_COUNT = 1 << 23 /* doubles: 64 MiB an array */ };

typedef struct triad_part {
    double *a;
    size_t count;
} triad_part;

double *create_triad(void) {
    double *arrays = malloc(3 * (size_t)TRIAD_COUNT * sizeof *arrays);
    for (size_t i = 0; arrays != NULL && i < 3 * (size_t)TRIAD_COUNT; i++) arrays[i] = 1; /* pages exist */
    return arrays;
}

static void *run_triad(void *argument) {
    const triad_part *part = argument;
    double *a = part->a;
    const double *b = a + TRIAD_COUNT;
    const double *c = b + TRIAD_COUNT;
    for (size_t i = 0; i < part->count; i++) a[i] = b[i] + 3 * c[i];
    return NULL;
}

double time_triad(double *arrays, int thread_count) {
    const size_t count = TRIAD_COUNT / (size_t)thread_count;
    triad_part parts[BENCH_TRIAD_THREADS_MAX] = {{arrays, count}, {arrays + count, count}};
    pthread_t thread;
    const double begin = now_ms();
    const bool is_started = thread_count == 2 && pthread_create(&thread, NULL, run_triad, &parts[1]) == 0;
    (void)run_triad(&parts[0]);
    if (is_started)
        (void)pthread_join(thread, NULL);
    else if (thread_count == 2)
        (void)run_triad(&parts[1]);
    return now_ms() - begin;
}

double triad_bytes(void) {
    return 24.0 * TRIAD_COUNT;
}
