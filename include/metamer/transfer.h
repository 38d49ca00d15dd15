/* SPDX-License-Identifier: BSD-3-Clause
 * The transfer function: from a physical value to extinction, emission and a mix of materials. */
#ifndef METAMER_TRANSFER_H
#define METAMER_TRANSFER_H

#include "metamer/basis.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Opacity, emission and material mix are linear in value between points and held outside. Two points of equal value
 * make a jump; the later one wins at the value itself. */
typedef struct mtm_transfer_point {
    double value;      /* physical */
    double opacity;    /* of one opacity length, 0 … 1; capped at 0.9999 */
    double emission;   /* light scattered over one opacity length, ≥ 0; used where has_emission */
    bool has_emission; /* false: as much as the opacity absorbs, τ · opacity length */
    int material;      /* index into the basis */
} mtm_transfer_point;

typedef struct mtm_transfer mtm_transfer;

/* Tabulates `point_count` ≥ 1 points in rising order of value, with the materials encoded in `basis`.
 * `opacity_length` > 0 is in world units: extinction τ = -ln(1 - opacity) / opacity_length, emission e = emission /
 * opacity_length, and e = τ between two points without emission of their own (paper eq. 5; Max, TVCG 1(2), 1995).
 * MTM_MEMORY. Release with mtm_transfer_destroy (NULL allowed). */
MTM_API MTM_CHECK mtm_status mtm_transfer_create(int point_count, const mtm_transfer_point *points,
                                                 double opacity_length, const mtm_basis *basis,
                                                 mtm_transfer **transfer, mtm_error *error);
MTM_API void mtm_transfer_destroy(mtm_transfer *transfer);

/* What the renderers see at a value: extinction and emission per world unit, and the d coefficients of the material
 * mix (NULL: not wanted). */
typedef struct mtm_classified {
    double extinction, emission;
} mtm_classified;
MTM_API mtm_classified mtm_transfer_classify(const mtm_transfer *transfer, double value, float *coefficients);

/* False where every value from `low` to `high` is invisible: neither extinction nor emission. */
MTM_API bool mtm_transfer_is_visible(const mtm_transfer *transfer, double low, double high);

#ifdef __cplusplus
}
#endif
#endif
