/* SPDX-License-Identifier: BSD-3-Clause
 * One column of a table as a spectrum, and "FILE.csv:COLUMN". */
#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/nearest.h"
#include "metamer/spectrum.h"

static int find_column(const mtm_spectrum_table *table, const char *column) {
    for (int i = 0; i < table->column_count; i++)
        if (strcmp(table->names[i], column) == 0) return i;
    return -1;
}

mtm_status mtm_spectrum_table_column(const mtm_spectrum_table *table, const char *path, const char *column,
                                     mtm_spectrum_kind kind, mtm_spectrum *spectrum, mtm_error *error) {
    assert(table->column_count >= 1 && table->row_count >= 1);
    const int found = find_column(table, column);
    if (found < 0)
        return mtm_fail(
            error, MTM_ARGUMENT, "%s: unknown column '%.64s', did you mean '%.64s'?", path, column,
            mtm_nearest_name(column, (const char *const *)table->names, (size_t)table->column_count));
    double *values = mtm_allocate((size_t)table->row_count, sizeof *values);
    if (values == NULL) return mtm_fail_memory(error, path, (size_t)table->row_count * sizeof *values);
    for (int row = 0; row < table->row_count; row++)
        values[row] = table->values[(size_t)row * (size_t)table->column_count + (size_t)found];
    *spectrum = mtm_spectrum_resample(table->row_count, table->wavelength_nm, values, kind);
    free(values);
    return MTM_OK;
}

static mtm_status read_column(const char *path, const char *column, mtm_spectrum_kind kind,
                              mtm_spectrum *spectrum, mtm_error *error) {
    mtm_spectrum_table table;
    mtm_status status = mtm_spectrum_table_read(path, &table, error);
    if (status != MTM_OK) return status;
    status = mtm_spectrum_table_column(&table, path, column, kind, spectrum, error);
    mtm_spectrum_table_free(&table);
    return status;
}

mtm_status mtm_spectrum_read(const char *folder, const char *file_and_column, mtm_spectrum_kind kind,
                             mtm_spectrum *spectrum, mtm_error *error) {
    const char *colon = strrchr(file_and_column, ':');
    if (colon == NULL || colon == file_and_column || colon[1] == '\0')
        return mtm_fail(error, MTM_ARGUMENT, "spectrum '%s', expected FILE.csv:COLUMN", file_and_column);
    char *file = mtm_text_copy(file_and_column);
    if (file != NULL) file[colon - file_and_column] = '\0';
    char *path = file == NULL ? NULL : mtm_path_join(folder, file);
    const mtm_status status = path == NULL ? mtm_fail_memory(error, file_and_column, strlen(file_and_column))
                                           : read_column(path, colon + 1, kind, spectrum, error);
    free(path);
    free(file);
    return status;
}
