/* SPDX-License-Identifier: BSD-3-Clause
 * Reads the tables of tests/data/expected/: CSV without quotes, whose first column may hold names. */
#ifndef METAMER_TEST_EXPECTED_H
#define METAMER_TEST_EXPECTED_H

#include "test.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/number.h"

enum { EXPECTED_ROWS = 64, EXPECTED_COLUMNS = 24, EXPECTED_NAME = 32 };

typedef struct expected_table {
    int row_count;
    int column_count;
    char names[EXPECTED_ROWS][EXPECTED_NAME]; /* the first column as text */
    char columns[EXPECTED_COLUMNS][EXPECTED_NAME];
    double values[EXPECTED_ROWS][EXPECTED_COLUMNS]; /* the first column too, where it holds numbers */
} expected_table;

static inline int split_cells(char *line, char *cells[EXPECTED_COLUMNS]) {
    int count = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char *cell = line; cell != NULL; count++) {
        assert_in_range(count, 0, EXPECTED_COLUMNS - 1);
        cells[count] = cell;
        cell = strchr(cell, ',');
        if (cell != NULL) *cell++ = '\0';
    }
    return count;
}

static inline expected_table *read_expected(const char *file) {
    char path[512];
    (void)snprintf(path, sizeof path, "%s/tests/data/expected/%s", METAMER_SOURCE_DIR, file);
    FILE *stream = fopen(path, "r");
    if (stream == NULL) fail_msg("%s is missing", path);
    expected_table *table = calloc(1, sizeof *table);
    char line[4096];
    char *cells[EXPECTED_COLUMNS];
    assert_non_null(table);
    assert_non_null(fgets(line, sizeof line, stream));
    table->column_count = split_cells(line, cells);
    for (int i = 0; i < table->column_count; i++)
        (void)snprintf(table->columns[i], EXPECTED_NAME, "%s", cells[i]);
    while (fgets(line, sizeof line, stream) != NULL) {
        const int row = table->row_count++;
        assert_in_range(row, 0, EXPECTED_ROWS - 1);
        assert_int_equal(split_cells(line, cells), table->column_count);
        (void)snprintf(table->names[row], EXPECTED_NAME, "%s", cells[0]);
        for (int i = 0; i < table->column_count; i++)
            if (!mtm_number_parse(cells[i], &table->values[row][i])) assert_int_equal(i, 0);
    }
    (void)fclose(stream);
    assert_in_range(table->row_count, 1, EXPECTED_ROWS);
    return table;
}

static inline double expected_value(const expected_table *table, int row, const char *column) {
    for (int i = 0; i < table->column_count; i++)
        if (strcmp(table->columns[i], column) == 0) return table->values[row][i];
    fail_msg("no column %s", column);
    return 0;
}

/* The largest deviation a test met, printed at its end so that a tightened tolerance can be chosen by the number. */
typedef struct deviation {
    double largest;
} deviation;

static inline void check_near(deviation *seen, double value, double expected, double tolerance,
                              const char *row, const char *column) {
    const double difference = value > expected ? value - expected : expected - value;
    if (!(difference <= tolerance)) fail_msg("%s, %s: %.10g, expected %.10g", row, column, value, expected);
    if (difference > seen->largest) seen->largest = difference;
}

#endif
