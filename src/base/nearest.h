/* SPDX-License-Identifier: BSD-3-Clause
 * "Did you mean …?" for names that are not known. */
#ifndef METAMER_BASE_NEAREST_H
#define METAMER_BASE_NEAREST_H

#include <stddef.h>

/* Number of single-character insertions, deletions and replacements from one text to the other, letter case
 * ignored; only the first 63 characters count. */
int mtm_edit_distance(const char *a, const char *b);

/* The one of `count` names (count ≥ 1) with the smallest edit distance, the first of equals; three letters or more
 * that begin a name count as one edit. */
const char *mtm_nearest_name(const char *name, const char *const *names, size_t count);

#endif
