/* SPDX-License-Identifier: BSD-3-Clause
 * Files that are written whole or not at all. */
#include "output.h"

#include <errno.h>
#include <string.h>

#include "fail.h"

mtm_status output_open(const char *path, output_file *file, mtm_error *error) {
    const int length = snprintf(file->path, sizeof file->path, "%s", path);
    if (length < 0 || length >= (int)sizeof file->path)
        return fail(error, MTM_LIMIT, "%.64s…: a path longer than %d bytes", path,
                    (int)sizeof file->path - 1);
    (void)snprintf(file->temporary, sizeof file->temporary, "%s.part", file->path);
    file->stream = fopen(file->temporary, "w");
    if (file->stream != NULL) return MTM_OK;
    return fail(error, MTM_IO, "%s: cannot be written: %s", file->temporary, strerror(errno));
}

mtm_status output_close(output_file *file, mtm_error *error) {
    const bool had_error = ferror(file->stream) != 0;
    const bool is_closed = fclose(file->stream) == 0;
    if (!had_error && is_closed && rename(file->temporary, file->path) == 0) return MTM_OK;
    const mtm_status status = fail(error, MTM_IO, "%s: cannot be written: %s", file->path, strerror(errno));
    (void)remove(file->temporary);
    return status;
}
