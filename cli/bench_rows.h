/* SPDX-License-Identifier: BSD-3-Clause
 * The rows of a suite: the same ones become a JSON document and a table for people. */
#ifndef METAMER_CLI_BENCH_ROWS_H
#define METAMER_CLI_BENCH_ROWS_H

#include <jansson.h>
#include <stdbool.h>

#include "bench_statistics.h"

/* A growing array of rows, each a JSON object with every column. A column whose name ends in "_ms" holds times and has
 * two more beside it, "_p95_ms" and "_spread_ms". */
typedef struct bench_rows {
    const char *const *columns; /* ended by NULL */
    json_t *array;              /* NULL after memory ran out */
} bench_rows;

bench_rows make_rows(const char *const *columns);

/* Adds a row whose columns are all null. The row belongs to the rows; NULL after memory ran out, which the calls below
 * take and ignore. */
json_t *add_row(bench_rows *rows);

/* Fill a column of the row; what is not a finite number, and times without a run, stay null. */
void set_text(json_t *row, const char *column, const char *text);
void set_count(json_t *row, const char *column, int value);
void set_number(json_t *row, const char *column, double value);
void set_times(json_t *row, const char *column, const bench_times *times);
void set_summary(json_t *row, const char *column, const bench_summary *summary);

/* numerator / denominator, the medians of both. */
void set_ratio(json_t *row, const char *column, const bench_times *numerator, const bench_times *denominator);

/* The rows as a table on standard output, medians only; columns that are empty in every row are left out, and what does
 * not fit beside the first column follows below. */
void print_rows(const bench_rows *rows);

#endif
