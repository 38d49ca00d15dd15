/* SPDX-License-Identifier: BSD-3-Clause
 * Tables of curves as CSV. */
#include "table_write.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "fail.h"
#include "metamer/spectrum.h"

enum { PATH_BYTES = 4096 };

static void print_table(FILE *stream, int first_nm, int row_count, int group_count,
                        const table_columns *groups) {
    (void)fprintf(stream, "wavelength_nm");
    for (int g = 0; g < group_count; g++)
        for (int j = 0; j < groups[g].count; j++) (void)fprintf(stream, ",%s_%d", groups[g].prefix, j + 1);
    (void)fputc('\n', stream);
    for (int row = 0; row < row_count; row++) {
        (void)fprintf(stream, "%d", first_nm + MTM_WAVELENGTH_STEP_NM * row);
        for (int g = 0; g < group_count; g++)
            for (int j = 0; j < groups[g].count; j++)
                (void)fprintf(stream, ",%.12f", groups[g].values[j * groups[g].stride + row]);
        (void)fputc('\n', stream);
    }
}

mtm_status table_write(const char *folder, const char *name, int first_nm, int row_count, int group_count,
                       const table_columns *groups, mtm_error *error) {
    char path[PATH_BYTES], temporary[PATH_BYTES];
    const int length = snprintf(temporary, sizeof temporary, "%s/%s.part", folder, name);
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    if (length < 0 || length >= PATH_BYTES)
        return fail(error, MTM_LIMIT, "%.64s…: a path too long to be opened", temporary);
    FILE *stream = fopen(temporary, "w");
    if (stream == NULL) return fail(error, MTM_IO, "%s: cannot be written: %s", temporary, strerror(errno));
    print_table(stream, first_nm, row_count, group_count, groups);
    const bool had_error = ferror(stream) != 0;
    const bool is_closed = fclose(stream) == 0;
    if (!had_error && is_closed && rename(temporary, path) == 0) return MTM_OK;
    const mtm_status status = fail(error, MTM_IO, "%s: cannot be written: %s", path, strerror(errno));
    (void)remove(temporary);
    return status;
}
