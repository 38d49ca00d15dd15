/* SPDX-License-Identifier: BSD-3-Clause
 * Files that are written whole or not at all. */
#ifndef METAMER_ACCURACY_OUTPUT_H
#define METAMER_ACCURACY_OUTPUT_H

#include <stdio.h>

#include "metamer/base.h"

typedef struct output_file {
    FILE *stream;
    char path[4096], temporary[4112];
} output_file;

/* Opens `path` under a temporary name beside it. MTM_IO, MTM_LIMIT. On success end with output_close. */
MTM_CHECK mtm_status output_open(const char *path, output_file *file, mtm_error *error);

/* Puts the file in its place. MTM_IO; then nothing is left behind. */
MTM_CHECK mtm_status output_close(output_file *file, mtm_error *error);

#endif
