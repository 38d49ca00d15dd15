/* SPDX-License-Identifier: BSD-3-Clause
 * The rows of a suite: the same ones become a JSON document and a table for people. */
#include "bench_rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELL_BYTES = 64, NAME_BYTES = 64, LINE_WIDTH = 120 };

static const char ms_suffix[] = "_ms";

static bool holds_times(const char *column) {
    const size_t length = strlen(column);
    return length > strlen(ms_suffix) && strcmp(column + length - strlen(ms_suffix), ms_suffix) == 0;
}

/* "raycast_ms" and "p95": "raycast_p95_ms". */
static void name_statistic(const char *column, const char *statistic, char name[NAME_BYTES]) {
    (void)snprintf(name, NAME_BYTES, "%.*s_%s%s", (int)(strlen(column) - strlen(ms_suffix)), column,
                   statistic, ms_suffix);
}

bench_rows make_rows(const char *const *columns) {
    return (bench_rows){.columns = columns, .array = json_array()};
}

static void set_null(json_t *row, const char *column) {
    (void)json_object_set_new(row, column, json_null());
}

json_t *add_row(bench_rows *rows) {
    json_t *row = json_object();
    for (const char *const *column = rows->columns; *column != NULL; column++) {
        char name[NAME_BYTES];
        set_null(row, *column);
        if (!holds_times(*column)) continue;
        name_statistic(*column, "p95", name);
        set_null(row, name);
        name_statistic(*column, "spread", name);
        set_null(row, name);
    }
    if (json_array_append_new(rows->array, row) == 0) return row;
    json_decref(rows->array);
    rows->array = NULL;
    return NULL;
}

void set_text(json_t *row, const char *column, const char *text) {
    (void)json_object_set_new(row, column, json_string(text));
}

void set_count(json_t *row, const char *column, int value) {
    (void)json_object_set_new(row, column, json_integer(value));
}

void set_number(json_t *row, const char *column, double value) {
    if (isfinite(value)) (void)json_object_set_new(row, column, json_real(value));
}

void set_summary(json_t *row, const char *column, const bench_summary *summary) {
    char name[NAME_BYTES];
    set_number(row, column, summary->median);
    name_statistic(column, "p95", name);
    set_number(row, name, summary->p95);
    name_statistic(column, "spread", name);
    set_number(row, name, summary->spread);
}

void set_times(json_t *row, const char *column, const bench_times *times) {
    if (times->count == 0) return;
    const bench_summary summary = summarize_times(times);
    set_summary(row, column, &summary);
}

void set_ratio(json_t *row, const char *column, const bench_times *numerator,
               const bench_times *denominator) {
    if (numerator->count == 0 || denominator->count == 0) return;
    set_number(row, column, median_ms(numerator) / median_ms(denominator));
}

/* A value as people read it: four significant digits. */
static void format_cell(const json_t *value, char cell[CELL_BYTES]) {
    const double number = json_number_value(value);
    const int first_digit = number > 0 ? (int)floor(log10(number)) : 0; /* its power of ten */
    const int decimals = first_digit > 3 ? 0 : first_digit < -3 ? 6 : 3 - first_digit;
    cell[0] = '\0';
    if (json_is_string(value))
        (void)snprintf(cell, CELL_BYTES, "%s", json_string_value(value));
    else if (json_is_integer(value))
        (void)snprintf(cell, CELL_BYTES, "%.0f", number);
    else if (json_is_real(value))
        (void)snprintf(cell, CELL_BYTES, "%.*f", decimals, number);
    else
        (void)snprintf(cell, CELL_BYTES, "-");
}

/* Part `index` of a column's name, which stands above it word by word; false beyond the last. */
static bool find_word(const char *column, int index, char word[CELL_BYTES]) {
    for (; index > 0; index--) {
        column = strchr(column, '_');
        if (column == NULL) return false;
        column++;
    }
    (void)snprintf(word, CELL_BYTES, "%.*s", (int)strcspn(column, "_"), column);
    return true;
}

static bool is_column_empty(const bench_rows *rows, const char *column) {
    size_t index;
    json_t *row;
    json_array_foreach(rows->array, index, row) if (!json_is_null(json_object_get(row, column))) return false;
    return true;
}

static int measure_column(const bench_rows *rows, const char *column) {
    char text[CELL_BYTES];
    size_t width = 0;
    size_t index;
    json_t *row;
    for (int i = 0; find_word(column, i, text); i++) width = width > strlen(text) ? width : strlen(text);
    json_array_foreach(rows->array, index, row) {
        format_cell(json_object_get(row, column), text);
        width = width > strlen(text) ? width : strlen(text);
    }
    return (int)width;
}

/* The columns of one block of the table; the first of all leads every block. */
typedef struct table_block {
    const char *columns[LINE_WIDTH];
    int widths[LINE_WIDTH];
    int count;
} table_block;

/* Takes columns from *next on until the line is full. */
static table_block take_block(const bench_rows *rows, const char *const **next) {
    table_block block = {.columns = {rows->columns[0]}, .count = 1};
    int width = block.widths[0] = measure_column(rows, rows->columns[0]);
    for (; **next != NULL; (*next)++) {
        if (is_column_empty(rows, **next)) continue;
        const int added = measure_column(rows, **next);
        if (width + 2 + added > LINE_WIDTH && block.count > 1) break;
        width += 2 + added;
        block.columns[block.count] = **next;
        block.widths[block.count++] = added;
    }
    return block;
}

static void print_cell(const table_block *block, int column, bool is_left, const char *text) {
    const int width = is_left ? -block->widths[column] : block->widths[column];
    (void)printf("%s%*s", column == 0 ? "" : "  ", is_left && column + 1 == block->count ? 0 : width, text);
}

static void print_heading(const table_block *block) {
    bool has_more = true;
    for (int line = 0; has_more; line++) {
        has_more = false;
        for (int i = 0; i < block->count; i++) {
            char word[CELL_BYTES] = "";
            char following[CELL_BYTES];
            (void)find_word(block->columns[i], line, word);
            has_more |= find_word(block->columns[i], line + 1, following);
            print_cell(block, i, i == 0, word);
        }
        (void)printf("\n");
    }
}

static void print_block(const bench_rows *rows, const table_block *block) {
    size_t index;
    json_t *row;
    print_heading(block);
    json_array_foreach(rows->array, index, row) {
        for (int i = 0; i < block->count; i++) {
            char cell[CELL_BYTES];
            const json_t *value = json_object_get(row, block->columns[i]);
            format_cell(value, cell);
            print_cell(block, i, json_is_string(value), cell);
        }
        (void)printf("\n");
    }
}

void print_rows(const bench_rows *rows) {
    const char *const *next = rows->columns + 1;
    do {
        const table_block block = take_block(rows, &next);
        print_block(rows, &block);
        if (*next != NULL) (void)printf("\n");
    } while (*next != NULL);
}
