/* SPDX-License-Identifier: BSD-3-Clause
 * A part of a file as memory that nobody reads in: its pages come from the system's cache when they are touched.
 * POSIX.1-2008, mmap. */
#ifndef METAMER_BASE_MAPPING_H
#define METAMER_BASE_MAPPING_H

#include <stdbool.h>
#include <stdio.h>

enum { MTM_MAPPING_PADDING = 64 }; /* bytes behind the part that can be read, too, whatever they are */

typedef struct mtm_mapping {
    const void *bytes; /* NULL: nothing is mapped */
    void *pages;
    size_t page_bytes; /* of all pages together */
} mtm_mapping;

/* Maps `byte_count` > 0 bytes of the stream's file from `offset` on, read-only and private; the stream may be closed
 * afterwards. False, and nothing mapped, for what is no regular file or ends before the last of these bytes, and
 * where the system refuses. POSIX: reading bytes that a file has lost since then raises SIGBUS, and reading those of
 * a disk that fails may. */
bool mtm_mapping_open(FILE *stream, long long offset, size_t byte_count, mtm_mapping *mapping);

/* Does nothing where nothing is mapped. */
void mtm_mapping_close(mtm_mapping *mapping);

#endif
