/* SPDX-License-Identifier: BSD-3-Clause
 * Summing up the transfer function. */
#include "transfer/rows.h"

#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "base/memory.h"
#include "transfer/table.h"

enum {
    ROWS_MIN = 1024,  /* over the values at which the transfer function changes */
    ROWS_MAX = 65536, /* 2 MiB of 8 lanes: what a processor's cache can hold */
    ROWS_PER_GAP = 8, /* between two neighboring points */
};
static const double sum_limit =
    (1 << 30) - 128; /* steps, rounded to floats; differences of two fit an int32_t */

/* The narrowest gap between two points of different value, in positions. */
static double narrowest_gap(const mtm_transfer *transfer) {
    double narrowest = 1;
    for (int i = 0; i < transfer->segment_count; i++)
        if (transfer->segments[i].inverse_length > 0)
            narrowest = fmin(narrowest, 1.0 / transfer->segments[i].inverse_length);
    return narrowest;
}

/* Integers need no more than rows at 1/2^k of them; the rows begin and end one row outside of the points, where the
 * end points hold. */
static void place_rows(const mtm_transfer *transfer, double slope, double intercept, double low, double high,
                       bool is_integer, mtm_transfer_rows *rows) {
    const double stored_per_position = 1 / (transfer->scale * slope);
    const double a = (transfer->origin - intercept) / slope;
    const double b = a + stored_per_position;
    const double from = fmin(fmax(fmin(a, b), low), high);
    const double to = fmax(fmin(fmax(a, b), high), low);
    const double width = to - from;
    const double wanted =
        fmin(width / ROWS_MIN, narrowest_gap(transfer) * fabs(stored_per_position) / ROWS_PER_GAP);
    double spacing = fmax(wanted, width / (ROWS_MAX - 4));
    if (!(spacing > 0)) spacing = 1;
    if (is_integer) spacing = fmin(exp2(floor(log2(spacing))), 1);
    if (is_integer && width / spacing > ROWS_MAX) spacing = exp2(ceil(log2(width / ROWS_MAX)));
    rows->spacing = spacing;
    rows->first = (is_integer ? floor(from / spacing) * spacing : from) - spacing;
    rows->count = (int)ceil((to - rows->first) / spacing) + 2;
}

typedef struct row_sums {
    double extinction, emission, highlight;
    double coefficients[MTM_DIMENSION_MAX];
} row_sums;

/* What the transfer function holds at row i. */
static mtm_transfer_row look_up(const mtm_transfer *transfer, double slope, double intercept,
                                const mtm_transfer_rows *rows, int i) {
    const double value = slope * (rows->first + i * rows->spacing) + intercept;
    return mtm_transfer_look_up(transfer, mtm_transfer_clamp(mtm_transfer_position(transfer, value)));
}

static double coefficient(const mtm_transfer_row *row, int k) {
    const double first = row->segment->first[k];
    return first + (double)row->share * ((double)row->segment->last[k] - first);
}

static void add_row(const mtm_transfer_row *row, int dimension, row_sums *sums) {
    sums->extinction += row->extinction;
    sums->emission += row->emission;
    sums->highlight += fminf(row->extinction, row->emission);
    for (int k = 0; k < dimension; k++) sums->coefficients[k] += row->emission * coefficient(row, k);
}

/* The steps of the sums, so that none overflows: sums up to any row stay below sum_limit. */
static void choose_steps(const mtm_transfer *transfer, double slope, double intercept,
                         mtm_transfer_rows *rows) {
    row_sums sums = {0};
    double largest = 0;
    rows->is_following = true;
    for (int i = 0; i < rows->count; i++) {
        const mtm_transfer_row row = look_up(transfer, slope, intercept, rows, i);
        rows->is_following = rows->is_following && row.extinction == row.emission;
        if (row.extinction > 0 || row.emission > 0) {
            if (rows->visible_end == 0) rows->visible_begin = i;
            rows->visible_end = i + 1;
        }
        add_row(&row, transfer->dimension, &sums);
        for (int k = 0; k < transfer->dimension; k++) largest = fmax(largest, fabs(sums.coefficients[k]));
    }
    const double tiny = 1e-30;
    rows->extinction_step = (float)fmax(sums.extinction / sum_limit, tiny);
    rows->emission_step = (float)fmax(sums.emission / sum_limit, tiny);
    rows->highlight_step = (float)fmax(sums.highlight / sum_limit, tiny);
    rows->coefficient_step = (float)fmax(largest / sum_limit, tiny);
}

static int32_t steps_of(double sum, float step) {
    return (int32_t)lrint(sum / (double)step);
}

static void store_sums(const mtm_transfer *transfer, double slope, double intercept,
                       mtm_transfer_rows *rows) {
    row_sums sums = {0};
    for (int i = 0; i <= rows->count; i++) {
        rows->extinction[i] = steps_of(sums.extinction, rows->extinction_step);
        rows->emission[i] = steps_of(sums.emission, rows->emission_step);
        rows->highlight[i] = steps_of(sums.highlight, rows->highlight_step);
        int32_t *coefficients = rows->coefficients + (size_t)i * (size_t)rows->lanes;
        for (int k = 0; k < transfer->dimension; k++)
            coefficients[k] = steps_of(sums.coefficients[k], rows->coefficient_step);
        if (i == rows->count) break;
        const mtm_transfer_row row = look_up(transfer, slope, intercept, rows, i);
        add_row(&row, transfer->dimension, &sums);
    }
    rows->extinction[rows->count + 1] = rows->extinction[rows->count];
    rows->emission[rows->count + 1] = rows->emission[rows->count];
    rows->highlight[rows->count + 1] = rows->highlight[rows->count];
}

mtm_status mtm_transfer_rows_create(const mtm_transfer *transfer, double slope, double intercept, double low,
                                    double high, bool is_integer, mtm_transfer_rows *rows, mtm_error *error) {
    *rows = (mtm_transfer_rows){.lanes = transfer->lanes};
    place_rows(transfer, slope, intercept, low, high, is_integer, rows);
    const size_t sums = (size_t)rows->count + 2;
    rows->extinction = mtm_allocate(sums, sizeof *rows->extinction);
    rows->emission = mtm_allocate(sums, sizeof *rows->emission);
    rows->highlight = mtm_allocate(sums, sizeof *rows->highlight);
    rows->coefficients = mtm_allocate(sums * (size_t)rows->lanes, sizeof *rows->coefficients);
    if (rows->extinction == NULL || rows->emission == NULL || rows->highlight == NULL ||
        rows->coefficients == NULL) {
        const size_t bytes = sums * ((size_t)rows->lanes + 3) * sizeof *rows->coefficients;
        mtm_transfer_rows_free(rows);
        return mtm_fail_memory(error, "the transfer function", bytes);
    }
    choose_steps(transfer, slope, intercept, rows);
    store_sums(transfer, slope, intercept, rows);
    return MTM_OK;
}

void mtm_transfer_rows_free(mtm_transfer_rows *rows) {
    free(rows->extinction);
    free(rows->emission);
    free(rows->highlight);
    free(rows->coefficients);
    *rows = (mtm_transfer_rows){0};
}
