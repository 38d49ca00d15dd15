/* SPDX-License-Identifier: BSD-3-Clause
 * The CSV reader on any bytes: it refuses with a message or gives a table that every column can be taken from. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "spectrum/table.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool holds) {
    if (!holds) abort();
}

static void check_table(const mtm_spectrum_table *table) {
    require(table->column_count >= 1 && table->row_count >= 1);
    for (int row = 1; row < table->row_count; row++)
        require(table->wavelength_nm[row] > table->wavelength_nm[row - 1]);
    for (int column = 0; column < table->column_count; column++) {
        mtm_spectrum spectrum;
        mtm_error error;
        require(mtm_spectrum_table_column(table, "fuzz", table->names[column], MTM_KIND_LIGHT, &spectrum,
                                          &error) == MTM_OK);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    mtm_spectrum_table table;
    mtm_error error = {{0}};
    if (mtm_spectrum_table_parse((const char *)data, size, "fuzz", &table, &error) == MTM_OK) {
        check_table(&table);
        mtm_spectrum_table_free(&table);
    } else {
        require(strlen(error.message) > 0);
    }
    return 0;
}
