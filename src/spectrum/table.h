/* SPDX-License-Identifier: BSD-3-Clause
 * The CSV reader on text in memory: what files, built-in tables and the fuzz target share. */
#ifndef METAMER_SPECTRUM_TABLE_H
#define METAMER_SPECTRUM_TABLE_H

#include "metamer/spectrum.h"

/* As mtm_spectrum_table_read, from `byte_count` bytes (no 0 needed after them); `path` only serves messages. */
MTM_CHECK mtm_status mtm_spectrum_table_parse(const char *text, size_t byte_count, const char *path,
                                              mtm_spectrum_table *table, mtm_error *error);

#endif
