/* SPDX-License-Identifier: BSD-3-Clause
 * A convex quadratic program over curves: as smooth as can be, within bounds, with weighted sums in given ranges. With
 * `linear` and a small `size` it is a linear program: its best value is missed by at most ½·size·|x|². Of the numbers in
 * `linear`, 1e-6 is small and works; with a bound on bends 1e-4, since that leaves little else to hold the curve. */
#ifndef METAMER_BASE_QP_H
#define METAMER_BASE_QP_H

#include "base/band.h"
#include "metamer/base.h"

enum {
    MTM_QP_LENGTH_MAX = MTM_BAND_MAX, /* samples of a curve */
    MTM_QP_TERMS_MAX = 4,             /* curves of one sum */
};

/* A curve of unknowns x and what it costs: ½·slope·|D₁(x − r)|² + ½·curvature·|D₂(x − r)|² + ½·size·|x − r|² + linear·x,
 * where D₁ and D₂ take first and second differences of neighbors. */
typedef struct mtm_qp_curve {
    double slope, curvature; /* ≥ 0 */
    double size;             /* > 0, which makes the minimum unique */
    const double *reference; /* r; NULL: 0 */
    const double *linear;    /* NULL: 0 */
    double low, high;        /* of every sample, low < high; may be infinite */
    double bend; /* the largest |second difference|; 0: any. Below 1e-5·(high − low) it may not settle */
    double *x;   /* the result; before the call a finite guess */
} mtm_qp_curve;

/* A sum s = Σ weights·x over some curves, each at most once, wanted in low … high (equal: one value; may be infinite). What it lacks costs
 * ½·lack²/give, so with `give` → 0 the range is kept if any curves keep it; give > 0. */
typedef struct mtm_qp_sum {
    int term_count;
    struct {
        int curve;
        const double *weights; /* as many as a curve has samples */
    } terms[MTM_QP_TERMS_MAX];
    double low, high, give;
    double multiplier; /* the result: lack/give, ≥ 0 where the sum is low and ≤ 0 where it is high */
} mtm_qp_sum;

typedef struct mtm_qp {
    int length; /* samples of each curve, 3 … MTM_QP_LENGTH_MAX */
    int curve_count;
    mtm_qp_curve *curves;
    int sum_count;
    mtm_qp_sum *sums;
} mtm_qp;

/* Finds the one minimum, to about 1e-9 of each sample (rounding adds the largest multiplier times 1e-16 over `size`); the
 * same numbers every time. Sums that cannot all be kept share what they lack so that Σ lack²/give is least, and a sum
 * within its range has the multiplier 0. MTM_NUMERIC where numbers of too different size keep it from settling;
 * MTM_MEMORY. */
MTM_CHECK mtm_status mtm_qp_minimize(mtm_qp *program, mtm_error *error);

/* How far `sums` are from being kept together by any curves within their bounds, seen along the multipliers y of the
 * minimum: the least value of yᵀ(what is wanted − s) there, over |y|. Above 0 it proves that they contradict each other
 * (Farkas): those with a multiplier cannot all be kept. At most 0 proves nothing. */
double mtm_qp_contradiction(const mtm_qp *program);

#endif
