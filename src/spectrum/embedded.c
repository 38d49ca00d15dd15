/* SPDX-License-Identifier: BSD-3-Clause
 * Columns of the tables that are built into the library. */
#include "spectrum/embedded.h"

#include <assert.h>
#include <string.h>

#include "spectrum/table.h"

static const mtm_embedded_table *find_table(const char *name) {
    const mtm_embedded_table *table = mtm_embedded_tables;
    while (table->name != NULL && strcmp(table->name, name) != 0) table++;
    assert(table->name != NULL);
    return table;
}

mtm_status mtm_embedded_table_read(const char *table_name, mtm_spectrum_table *table, mtm_error *error) {
    const mtm_embedded_table *embedded = find_table(table_name);
    return mtm_spectrum_table_parse(embedded->text, strlen(embedded->text), table_name, table, error);
}

mtm_status mtm_embedded_column(const char *table_name, const char *column, mtm_spectrum_kind kind,
                               mtm_spectrum *spectrum, mtm_error *error) {
    mtm_spectrum_table table;
    mtm_status status = mtm_embedded_table_read(table_name, &table, error);
    if (status != MTM_OK) return status;
    status = mtm_spectrum_table_column(&table, table_name, column, kind, spectrum, error);
    mtm_spectrum_table_free(&table);
    return status;
}
