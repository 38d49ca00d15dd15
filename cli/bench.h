/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench: the suites, one file each, one row in the table of bench.c. */
#ifndef METAMER_CLI_BENCH_H
#define METAMER_CLI_BENCH_H

#include "bench_rows.h"
#include "task.h"

typedef struct bench_settings {
    int thread_count, run_count;
    int width, height;       /* of the pictures of the suite frames */
    bool is_post_classified; /* these without pre-integration */
    const char *only;        /* a part of the names of the rows that are wanted; NULL: all */
    progress_bar *bar;
} bench_settings;

typedef struct bench_suite {
    const char *name;
    const char *const *columns; /* ended by NULL; the first names the row */
    /* Adds the rows that are wanted. An error is also what MTM_NUMERIC stands for: something to be timed is wrong. */
    mtm_status (*run)(const bench_settings *settings, bench_rows *rows, mtm_error *error);
} bench_suite;

extern const bench_suite frames_suite, table1_suite, kernels_suite, scaling_suite, ablation_suite,
    design_suite;

enum { BENCH_PICTURE_EDGE = 512 /* pixels, where a row says nothing else */ };

bool is_row_wanted(const bench_settings *settings, const char *name);

#endif
