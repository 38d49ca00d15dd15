/* SPDX-License-Identifier: BSD-3-Clause
 * What many numbers come to. */
#ifndef METAMER_ACCURACY_STATISTICS_H
#define METAMER_ACCURACY_STATISTICS_H

#include <stddef.h>

#include "metamer/color.h"

typedef struct error_summary {
    double mean, p95, max; /* p95: 95 % are below, linear between the two nearest ranks */
} error_summary;

/* Of `count` ≥ 1 values, which are sorted. The sum is taken in rising order, so that it does not depend on theirs. */
error_summary error_summarize(size_t count, double *values);

/* Of `count` ≥ 1 values, which are sorted. */
double median(int count, double *values);

/* A list that grows; the caller frees `values`. */
typedef struct error_list {
    size_t count, capacity;
    double *values;
} error_list;

MTM_CHECK mtm_status error_list_reserve(error_list *list, size_t more, mtm_error *error);

/* CIEDE2000 between two colors under a white, both brought to `exposure` times their luminance first. A model's color may
 * have negative parts, which no display shows: they count as 0. */
double color_error(mtm_xyz model, mtm_xyz truth, mtm_xyz white, double exposure);

#endif
