/* SPDX-License-Identifier: BSD-3-Clause
 * Reading gzip data out of the middle of a file (RFC 1952), through zlib. */
#ifndef METAMER_VOLUME_GUNZIP_H
#define METAMER_VOLUME_GUNZIP_H

#include <stdio.h>

#include "metamer/base.h"

/* DEFLATE codes at most 258 bytes in 2 bits. */
enum { MTM_GUNZIP_RATIO_LIMIT = 1032 };

/* Decompresses from where the stream stands: leaves out `skip_bytes`, then writes `byte_count` bytes. Members that
 * follow each other count as one; data beyond the bytes asked for are ignored.
 * MTM_FORMAT for fewer bytes and, with zlib's reason, for damaged data and a wrong checksum; MTM_IO; MTM_MEMORY.
 * `path` begins the messages. */
MTM_CHECK mtm_status mtm_gunzip(FILE *stream, const char *path, unsigned long long skip_bytes, void *bytes,
                                size_t byte_count, mtm_error *error);

#endif
