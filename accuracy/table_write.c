/* SPDX-License-Identifier: BSD-3-Clause
 * Tables of curves as CSV. */
#include "table_write.h"

#include <stdio.h>

#include "fail.h"
#include "metamer/spectrum.h"
#include "output.h"

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
    char path[PATH_BYTES];
    output_file file;
    const int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    if (length < 0 || length >= PATH_BYTES)
        return fail(error, MTM_LIMIT, "%.64s…: a path too long to be opened", path);
    const mtm_status status = output_open(path, &file, error);
    if (status != MTM_OK) return status;
    print_table(file.stream, first_nm, row_count, group_count, groups);
    return output_close(&file, error);
}
