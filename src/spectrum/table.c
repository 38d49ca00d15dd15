/* SPDX-License-Identifier: BSD-3-Clause
 * Tables of spectra as CSV (RFC 4180 without line ends inside cells, plus blank lines and '#' comments). */
#include "spectrum/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/number.h"

enum {
    FILE_LIMIT_BYTES = 64 << 20,
    COLUMN_LIMIT = 4096,
    ROW_LIMIT = 100000,
    NUMBER_LIMIT = 128, /* characters of a number; a double never needs as many */
    QUOTED_LIMIT = 64,  /* characters of a cell that an error repeats */
};

/* A stretch of the text, from the first character to the one after the last. */
typedef struct span {
    const char *begin, *end;
} span;

typedef struct table_reader {
    span rest; /* the lines not read yet */
    int line;  /* number of the line read last, from 1 */
    int row_capacity;
    mtm_spectrum_table *table;
    const char *path;
    mtm_error *error;
} table_reader;

static int length_of(span text) {
    return (int)(text.end - text.begin);
}

static int quoted_length(span text) {
    return length_of(text) < QUOTED_LIMIT ? length_of(text) : QUOTED_LIMIT;
}

static bool is_blank(char character) {
    return character == ' ' || character == '\t' || character == '\r';
}

static span trim(span text) {
    while (text.begin < text.end && is_blank(*text.begin)) text.begin++;
    while (text.begin < text.end && is_blank(text.end[-1])) text.end--;
    return text;
}

/* The next line that holds cells, trimmed; false at the end of the text. */
static bool next_line(table_reader *reader, span *line) {
    while (reader->rest.begin < reader->rest.end) {
        span *rest = &reader->rest;
        const char *line_end = memchr(rest->begin, '\n', (size_t)(rest->end - rest->begin));
        const span whole = {rest->begin, line_end == NULL ? rest->end : line_end};
        rest->begin = line_end == NULL ? rest->end : line_end + 1;
        reader->line++;
        *line = trim(whole);
        if (line->begin < line->end && *line->begin != '#') return true;
    }
    return false;
}

/* The end of a quoted cell that begins at `begin`: the quote that is not doubled, or NULL. */
static const char *closing_quote(const char *begin, const char *end) {
    for (const char *at = begin; at < end; at++) {
        if (*at != '"') continue;
        if (at + 1 == end || at[1] != '"') return at;
        at++;
    }
    return NULL;
}

/* Takes a cell from the front of the line, blanks and quotes round it removed. `rest->begin` becomes NULL after
 * the last one. False where a quote is not closed or not followed by a comma. */
static bool take_cell(span *rest, span *cell) {
    const span line = trim(*rest);
    if (line.begin == line.end || *line.begin != '"') {
        const char *comma = memchr(rest->begin, ',', (size_t)(rest->end - rest->begin));
        *cell = trim((span){rest->begin, comma == NULL ? rest->end : comma});
        rest->begin = comma == NULL ? NULL : comma + 1;
        return true;
    }
    const char *quote = closing_quote(line.begin + 1, line.end);
    if (quote == NULL) return false;
    *cell = (span){line.begin + 1, quote};
    const span after = trim((span){quote + 1, line.end});
    rest->begin = after.begin == after.end ? NULL : after.begin + 1;
    return after.begin == after.end || *after.begin == ',';
}

/* Counts the cells of the line just read, so that what follows can rely on its form. */
static mtm_status count_cells(const table_reader *reader, span line, int *count) {
    int cells = 0;
    while (line.begin != NULL) {
        span cell;
        if (!take_cell(&line, &cell))
            return mtm_fail(
                reader->error, MTM_FORMAT,
                "%s:%d: the quotes of cell %d do not end it, expected a cell like \"name\" or name",
                reader->path, reader->line, cells + 1);
        if (++cells > COLUMN_LIMIT + 1)
            return mtm_fail(reader->error, MTM_LIMIT, "%s:%d: more than %d columns", reader->path,
                            reader->line, COLUMN_LIMIT);
    }
    *count = cells;
    return MTM_OK;
}

/* The cell as text of its own, doubled quotes made one. */
static char *copy_cell(span cell) {
    char *text = malloc((size_t)length_of(cell) + 1);
    if (text == NULL) return NULL;
    char *to = text;
    for (const char *from = cell.begin; from < cell.end; from++) {
        *to++ = *from;
        if (*from == '"' && from + 1 < cell.end && from[1] == '"') from++;
    }
    *to = '\0';
    return text;
}

static bool parse_cell(span cell, double *value) {
    char text[NUMBER_LIMIT + 1];
    if (length_of(cell) > NUMBER_LIMIT) return false;
    memcpy(text, cell.begin, (size_t)length_of(cell));
    text[length_of(cell)] = '\0';
    return mtm_number_parse(text, value) && isfinite(*value);
}

/* Adds a name to the table's columns, whose array has room for it. */
static mtm_status add_name(table_reader *reader, span cell) {
    mtm_spectrum_table *table = reader->table;
    const int column = table->column_count;
    if (cell.begin == cell.end)
        return mtm_fail(reader->error, MTM_FORMAT, "%s:%d: column %d has no name, expected one", reader->path,
                        reader->line, column + 2);
    char *name = copy_cell(cell);
    if (name == NULL) return mtm_fail_memory(reader->error, reader->path, (size_t)length_of(cell));
    table->names[table->column_count++] = name;
    for (int i = 0; i < column; i++)
        if (strcmp(table->names[i], name) == 0)
            return mtm_fail(reader->error, MTM_FORMAT,
                            "%s:%d: columns %d and %d are both called '%.*s', expected different names",
                            reader->path, reader->line, i + 2, column + 2, QUOTED_LIMIT, name);
    return MTM_OK;
}

static bool is_wavelength_header(span cell) {
    const char *name = "wavelength_nm";
    return length_of(cell) == (int)strlen(name) && strncasecmp(cell.begin, name, strlen(name)) == 0;
}

static mtm_status read_header(table_reader *reader) {
    span line;
    if (!next_line(reader, &line))
        return mtm_fail(reader->error, MTM_FORMAT,
                        "%s: the file is empty, expected a header row wavelength_nm,name,...", reader->path);
    int cell_count = 0;
    mtm_status status = count_cells(reader, line, &cell_count);
    if (status != MTM_OK) return status;
    span cell;
    (void)take_cell(&line, &cell);
    if (!is_wavelength_header(cell))
        return mtm_fail(reader->error, MTM_FORMAT,
                        "%s:%d: the header row begins with '%.*s', expected wavelength_nm", reader->path,
                        reader->line, quoted_length(cell), cell.begin);
    if (cell_count < 2)
        return mtm_fail(reader->error, MTM_FORMAT,
                        "%s:%d: the header row has no column beside wavelength_nm, expected at least one",
                        reader->path, reader->line);
    reader->table->names = mtm_allocate((size_t)cell_count - 1, sizeof(char *));
    if (reader->table->names == NULL)
        return mtm_fail_memory(reader->error, reader->path, (size_t)cell_count * sizeof(char *));
    while (line.begin != NULL && status == MTM_OK) {
        (void)take_cell(&line, &cell);
        status = add_name(reader, cell);
    }
    return status;
}

static bool grow(double **values, size_t count) {
    double *larger = realloc(*values, count * sizeof **values); /* the limits keep this product small */
    if (larger == NULL) return false;
    *values = larger;
    return true;
}

/* Makes room for one more row. Memory follows the rows that are there, never a number that a file claims. */
static mtm_status reserve_row(table_reader *reader) {
    mtm_spectrum_table *table = reader->table;
    if (table->row_count < reader->row_capacity) return MTM_OK;
    if (table->row_count == ROW_LIMIT)
        return mtm_fail(reader->error, MTM_LIMIT, "%s:%d: more than %d rows", reader->path, reader->line,
                        ROW_LIMIT);
    const int doubled = reader->row_capacity == 0 ? 128 : 2 * reader->row_capacity;
    const int capacity = doubled < ROW_LIMIT ? doubled : ROW_LIMIT;
    const size_t value_count = (size_t)capacity * (size_t)table->column_count;
    if (!grow(&table->wavelength_nm, (size_t)capacity) || !grow(&table->values, value_count))
        return mtm_fail_memory(reader->error, reader->path, value_count * sizeof(double));
    reader->row_capacity = capacity;
    return MTM_OK;
}

static mtm_status fail_number(const table_reader *reader, const char *column, span cell) {
    return mtm_fail(reader->error, MTM_FORMAT, "%s:%d: column '%.*s' is '%.*s', expected a finite number",
                    reader->path, reader->line, QUOTED_LIMIT, column, quoted_length(cell), cell.begin);
}

static mtm_status read_row(table_reader *reader, span line) {
    mtm_spectrum_table *table = reader->table;
    int cell_count = 0;
    mtm_status status = count_cells(reader, line, &cell_count);
    if (status == MTM_OK && cell_count != table->column_count + 1)
        status =
            mtm_fail(reader->error, MTM_FORMAT, "%s:%d: the row has %d cells, expected %d as in the header",
                     reader->path, reader->line, cell_count, table->column_count + 1);
    if (status == MTM_OK) status = reserve_row(reader);
    if (status != MTM_OK) return status;
    double *wavelength_nm = &table->wavelength_nm[table->row_count];
    double *values = &table->values[(size_t)table->row_count * (size_t)table->column_count];
    span cell;
    (void)take_cell(&line, &cell);
    if (!parse_cell(cell, wavelength_nm)) return fail_number(reader, "wavelength_nm", cell);
    if (table->row_count > 0 && wavelength_nm[0] <= wavelength_nm[-1])
        return mtm_fail(reader->error, MTM_FORMAT,
                        "%s:%d: wavelength %g nm, expected one above the row before's %g nm", reader->path,
                        reader->line, wavelength_nm[0], wavelength_nm[-1]);
    for (int column = 0; column < table->column_count; column++) {
        (void)take_cell(&line, &cell);
        if (!parse_cell(cell, &values[column])) return fail_number(reader, table->names[column], cell);
    }
    table->row_count++;
    return MTM_OK;
}

/* A table that misses the grid has its wavelengths in another unit; holding its end value would hide that. */
static mtm_status check_range(const table_reader *reader) {
    const mtm_spectrum_table *table = reader->table;
    if (table->row_count == 0)
        return mtm_fail(reader->error, MTM_FORMAT,
                        "%s: no data after the header row, expected a row per wavelength", reader->path);
    const double first_nm = table->wavelength_nm[0];
    const double last_nm = table->wavelength_nm[table->row_count - 1];
    const int grid_last_nm = MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * (MTM_SPECTRUM_SAMPLES - 1);
    if (first_nm <= grid_last_nm && last_nm >= MTM_WAVELENGTH_FIRST_NM) return MTM_OK;
    return mtm_fail(reader->error, MTM_FORMAT, "%s: wavelengths %g to %g, expected some within %d to %d nm",
                    reader->path, first_nm, last_nm, MTM_WAVELENGTH_FIRST_NM, grid_last_nm);
}

static span skip_byte_order_mark(span text) {
    const char mark[] = {'\xEF', '\xBB', '\xBF'};
    if ((size_t)(text.end - text.begin) >= sizeof mark && memcmp(text.begin, mark, sizeof mark) == 0)
        text.begin += sizeof mark;
    return text;
}

mtm_status mtm_spectrum_table_parse(const char *text, size_t byte_count, const char *path,
                                    mtm_spectrum_table *table, mtm_error *error) {
    *table = (mtm_spectrum_table){0};
    if (byte_count > FILE_LIMIT_BYTES)
        return mtm_fail(error, MTM_LIMIT, "%s: %zu bytes, expected at most %d", path, byte_count,
                        FILE_LIMIT_BYTES);
    if (byte_count > 0 && memchr(text, '\0', byte_count) != NULL)
        return mtm_fail(error, MTM_FORMAT, "%s: contains a zero byte, expected CSV text", path);
    table_reader reader = {.table = table, .path = path, .error = error};
    if (byte_count > 0) reader.rest = skip_byte_order_mark((span){text, text + byte_count});
    mtm_status status = read_header(&reader);
    span line;
    while (status == MTM_OK && next_line(&reader, &line)) status = read_row(&reader, line);
    if (status == MTM_OK) status = check_range(&reader);
    if (status != MTM_OK) mtm_spectrum_table_free(table);
    return status;
}

mtm_status mtm_spectrum_table_read(const char *path, mtm_spectrum_table *table, mtm_error *error) {
    *table = (mtm_spectrum_table){0};
    char *text = NULL;
    size_t byte_count = 0;
    mtm_status status = mtm_file_read(path, FILE_LIMIT_BYTES, &text, &byte_count, error);
    if (status != MTM_OK) return status;
    status = mtm_spectrum_table_parse(text, byte_count, path, table, error);
    free(text);
    return status;
}

void mtm_spectrum_table_free(mtm_spectrum_table *table) {
    for (int i = 0; i < table->column_count; i++) free(table->names[i]);
    free(table->names);
    free(table->wavelength_nm);
    free(table->values);
    *table = (mtm_spectrum_table){0};
}
