/* SPDX-License-Identifier: BSD-3-Clause
 * The transfer function as packets of rays read it: equally spaced rows over stored voxel values, summed up, so that
 * the mean over any interval of values is a difference of two sums (1-D pre-integration: Engel, Kraus, Ertl,
 * "High-quality pre-integrated volume rendering using hardware-accelerated pixel shading", Graphics Hardware 2001, with
 * the integral functions of its section 4; here over d coefficients, opacity-weighted). */
#ifndef METAMER_TRANSFER_ROWS_H
#define METAMER_TRANSFER_ROWS_H

#include "metamer/transfer.h"

/* Row i, 0 … count - 1, is the transfer function at the stored value first + i · spacing; beyond the ends the end rows
 * hold. A sum up to row i is over rows 0 … i - 1, in integer steps, so that differences are exact. Rows lo … hi - 1
 * have the mean (sum[hi] - sum[lo]) · step / (hi - lo). */
typedef struct mtm_transfer_rows {
    int count, lanes;
    double first, spacing;  /* stored values */
    int32_t *extinction;    /* count + 2 sums, the last one twice */
    int32_t *emission;      /* likewise */
    int32_t *highlight;     /* of the smaller of both */
    int32_t *coefficients;  /* (count + 1) × lanes: of emission · coefficients, 0 from the d-th on */
    float extinction_step;  /* per world unit */
    float emission_step;    /* likewise */
    float highlight_step;   /* likewise */
    float coefficient_step; /* likewise */
    int visible_begin, visible_end; /* all rows but begin … end - 1 have neither extinction nor emission */
    bool is_following; /* emission is extinction everywhere, so emission and highlight are extinction */
} mtm_transfer_rows;

/* Tabulates for voxels whose stored values are low … high, slope · stored + intercept the physical ones; integer
 * values fall on rows. MTM_MEMORY. Release with mtm_transfer_rows_free. */
MTM_CHECK mtm_status mtm_transfer_rows_create(const mtm_transfer *transfer, double slope, double intercept,
                                              double low, double high, bool is_integer,
                                              mtm_transfer_rows *rows, mtm_error *error);
void mtm_transfer_rows_free(mtm_transfer_rows *rows);

#endif
