/* SPDX-License-Identifier: BSD-3-Clause
 * What many numbers come to. */
#include "statistics.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "fail.h"

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Linear between the two ranks beside `share` of the way from the first to the last; the values are sorted. */
static double quantile(size_t count, const double *values, double share) {
    const double place = share * (double)(count - 1);
    const size_t below = (size_t)place;
    const size_t above = below + 1 < count ? below + 1 : below;
    return values[below] + (place - (double)below) * (values[above] - values[below]);
}

error_summary error_summarize(size_t count, double *values) {
    assert(count >= 1);
    qsort(values, count, sizeof *values, compare_doubles);
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += values[i];
    return (error_summary){sum / (double)count, quantile(count, values, 0.95), values[count - 1]};
}

double median(int count, double *values) {
    assert(count >= 1);
    qsort(values, (size_t)count, sizeof *values, compare_doubles);
    return quantile((size_t)count, values, 0.5);
}

mtm_status error_list_reserve(error_list *list, size_t more, mtm_error *error) {
    if (list->capacity - list->count >= more) return MTM_OK;
    const size_t capacity = 2 * list->capacity + more;
    double *values = realloc(list->values, capacity * sizeof *values);
    if (values == NULL) return fail_memory(error, "color errors");
    list->values = values;
    list->capacity = capacity;
    return MTM_OK;
}

static mtm_lab lab_at(mtm_xyz xyz, mtm_xyz white, double exposure) {
    return mtm_lab_from_xyz((mtm_xyz){xyz.x * exposure, xyz.y * exposure, xyz.z * exposure}, white);
}

double color_error(mtm_xyz model, mtm_xyz truth, mtm_xyz white, double exposure) {
    const mtm_xyz shown = {fmax(model.x, 0), fmax(model.y, 0), fmax(model.z, 0)};
    return mtm_ciede2000(lab_at(shown, white, exposure), lab_at(truth, white, exposure));
}
