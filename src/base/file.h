/* SPDX-License-Identifier: BSD-3-Clause
 * Whole-file reading with a limit, writing that never leaves half a file, and paths. */
#ifndef METAMER_BASE_FILE_H
#define METAMER_BASE_FILE_H

#include <stdio.h>

#include "metamer/base.h"

/* Reads a whole file of at most `limit_bytes` into *bytes (ended by a 0 that does not count, release with free()).
 * Errors: MTM_IO with the system's reason, MTM_LIMIT for a longer file, MTM_MEMORY. */
MTM_CHECK mtm_status mtm_file_read(const char *path, size_t limit_bytes, char **bytes, size_t *byte_count,
                                   mtm_error *error);

/* A file being written. The content goes to a temporary file beside the target, which mtm_output_commit renames;
 * a target that is no regular file (a device, a pipe) is written directly. */
typedef struct mtm_output {
    FILE *stream;
    char *target;    /* the file asked for, symbolic links followed */
    char *temporary; /* NULL when the target is written directly */
} mtm_output;

/* Opens `path` for writing. On success end with exactly one of the two calls below. */
MTM_CHECK mtm_status mtm_output_open(const char *path, mtm_output *output, mtm_error *error);

/* Flushes, closes and puts the file in its place; on failure nothing is left behind. */
MTM_CHECK mtm_status mtm_output_commit(mtm_output *output, mtm_error *error);

/* Gives up: closes and removes the temporary file. */
void mtm_output_abandon(mtm_output *output);

/* Writes `byte_count` bytes as the whole content of `path`, all or nothing. */
MTM_CHECK mtm_status mtm_file_write(const char *path, const void *bytes, size_t byte_count, mtm_error *error);

bool mtm_file_exists(const char *path); /* true for anything that is not a folder */

/* Paths as new text for free(), NULL when out of memory. */
char *mtm_path_folder(const char *path);                              /* "a/b.c" → "a", "b.c" → "." */
char *mtm_path_join(const char *folder, const char *file);            /* an absolute file stays as it is */
const char *mtm_path_name(const char *path);                          /* "a/b.c" → "b.c", inside `path` */
bool mtm_path_has_extension(const char *path, const char *extension); /* ".png", in any case */

#endif
