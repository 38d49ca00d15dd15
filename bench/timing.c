/* SPDX-License-Identifier: BSD-3-Clause
 * The clock and the median. */
#include "timing.h"

#include <stdlib.h>
#include <time.h>

double now_ms(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double median(int count, double *times_ms) {
    qsort(times_ms, (size_t)count, sizeof *times_ms, compare_doubles);
    return count % 2 == 1 ? times_ms[count / 2] : 0.5 * (times_ms[count / 2 - 1] + times_ms[count / 2]);
}
