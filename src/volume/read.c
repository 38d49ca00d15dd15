/* SPDX-License-Identifier: BSD-3-Clause
 * Reading a volume of any known format. A new format is one file and one row of the table. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "base/fail.h"
#include "metamer/volume.h"
#include "volume/nrrd.h"
#include "volume/open.h"

enum { MAGIC_BYTES = 16 };

/* One format: known by the first bytes of a file, read from a stream that stands at the file's start. */
typedef struct volume_reader {
    const char *magic;
    mtm_status (*read)(FILE *stream, const char *path, mtm_volume **volume, mtm_error *error);
} volume_reader;

static const volume_reader readers[] = {
    {"NRRD", mtm_nrrd_read},
};

static const char known_formats[] = "NRRD";

mtm_status mtm_open_regular(const char *path, FILE **stream, mtm_error *error) {
    struct stat state;
    const bool is_found = stat(path, &state) == 0;
    if (is_found && !S_ISREG(state.st_mode))
        return mtm_fail(error, MTM_IO, "%s: cannot be opened: it is a %s, no regular file", path,
                        S_ISDIR(state.st_mode) ? "folder" : "device or pipe");
    *stream = is_found ? fopen(path, "rb") : NULL;
    if (*stream != NULL) return MTM_OK;
    return mtm_fail(error, MTM_IO, "%s: cannot be opened: %s", path, strerror(errno));
}

static mtm_status read_stream(FILE *stream, const char *path, mtm_volume **volume, mtm_error *error) {
    char magic[MAGIC_BYTES + 1] = {0};
    const size_t count = fread(magic, 1, MAGIC_BYTES, stream);
    if (ferror(stream) || fseeko(stream, 0, SEEK_SET) != 0)
        return mtm_fail(error, MTM_IO, "%s: cannot be read: %s", path, strerror(errno));
    if (count == 0) return mtm_fail(error, MTM_FORMAT, "%s: is empty, expected a volume", path);
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        if (strncmp(magic, readers[i].magic, strlen(readers[i].magic)) == 0)
            return readers[i].read(stream, path, volume, error);
    return mtm_fail(error, MTM_FORMAT, "%s: does not begin as a volume of a known format (%s)", path,
                    known_formats);
}

mtm_status mtm_volume_read(const char *path, mtm_volume **volume, mtm_error *error) {
    FILE *stream = NULL;
    mtm_status status = mtm_open_regular(path, &stream, error);
    if (status != MTM_OK) return status;
    status = read_stream(stream, path, volume, error);
    (void)fclose(stream);
    return status;
}
