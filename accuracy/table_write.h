/* SPDX-License-Identifier: BSD-3-Clause
 * Tables of curves as CSV. */
#ifndef METAMER_ACCURACY_TABLE_WRITE_H
#define METAMER_ACCURACY_TABLE_WRITE_H

#include "metamer/base.h"

/* Columns "PREFIX_1" … "PREFIX_count". */
typedef struct table_columns {
    const char *prefix;
    int count;
    const double *values; /* column after column, `stride` numbers from one to the next */
    int stride;
} table_columns;

/* Writes `folder`/`name`, rows from `first_nm` in steps of the grid, numbers with twelve decimals; under a temporary
 * name first, so that no half of a file is ever left. MTM_IO, MTM_LIMIT. */
MTM_CHECK mtm_status table_write(const char *folder, const char *name, int first_nm, int row_count,
                                 int group_count, const table_columns *groups, mtm_error *error);

#endif
