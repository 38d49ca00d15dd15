/* SPDX-License-Identifier: BSD-3-Clause
 * The smoothest curve as a quadratic program (base/qp.h). That wants a small cost of |ρ|² as well, and lets a sum be had a
 * little less exactly. Both vanish in some rounds: the cost becomes that of the distance from the round before
 * (R. T. Rockafellar, Monotone Operators and the Proximal Point Algorithm, SIAM Journal on Control and Optimization 14,
 * 1976), and what the sums lack is added to what is wanted of them (M. J. D. Powell, A Method for Nonlinear Constraints in
 * Minimization Problems, in Optimization, ed. R. Fletcher, 1969). Each round leaves some 1/1000 of what was wrong. */
#include "color/smoothest.h"

#include <math.h>

#include "base/fail.h"
#include "base/qp.h"

enum {
    N = MTM_SPECTRUM_SAMPLES,
    SUMS = 3,
    ROUND_LIMIT = 8, /* colors of sRGB take up to 5 */
};

/* Adds what the sums lack to what is wanted of them; the most that one lacks. */
static double shift_targets(const mtm_spectrum rows[SUMS], const double target[SUMS],
                            const mtm_spectrum *curve, mtm_qp_sum sums[SUMS]) {
    double worst = 0;
    for (int k = 0; k < SUMS; k++) {
        double lack = target[k];
        for (int i = 0; i < N; i++) lack -= rows[k].value[i] * curve->value[i];
        sums[k].low += lack;
        sums[k].high = sums[k].low;
        worst = fmax(worst, fabs(lack));
    }
    return worst;
}

/* Moves the reference of |ρ − r|² to the curve: its linear part is −size·r. How far that is. */
static double shift_reference(double size, const mtm_spectrum *curve, double linear[N]) {
    double change = 0;
    for (int i = 0; i < N; i++) {
        change = fmax(change, fabs(curve->value[i] + linear[i] / size));
        linear[i] = -size * curve->value[i];
    }
    return change;
}

mtm_status mtm_smoothest_curve(const mtm_spectrum rows[3], const double target[3], mtm_spectrum *curve,
                               mtm_error *error) {
    static const double size = 1e-6, give = 1e-9;
    static const double lack_small = 1e-13, change_small = 1e-12, lack_usable = 1e-10;
    double linear[N] = {0};
    mtm_qp_curve unknown = {.slope = 1, .size = size, .linear = linear, .high = 1, .x = curve->value};
    mtm_qp_sum sums[SUMS];
    for (int k = 0; k < SUMS; k++) {
        sums[k] = (mtm_qp_sum){.term_count = 1, .low = target[k], .high = target[k], .give = give};
        sums[k].terms[0].weights = rows[k].value;
    }
    mtm_qp program = {.length = N, .curve_count = 1, .curves = &unknown, .sum_count = SUMS, .sums = sums};
    double lack = INFINITY;
    double change = INFINITY;
    for (int i = 0; i < N; i++) curve->value[i] = 0.5;
    for (int round = 0; round < ROUND_LIMIT && (lack > lack_small || change > change_small); round++) {
        const mtm_status status = mtm_qp_minimize(&program, error);
        if (status != MTM_OK) return status;
        lack = shift_targets(rows, target, curve, sums);
        change = shift_reference(size, curve, linear);
    }
    if (lack <= lack_usable) return MTM_OK;
    return mtm_fail(error, MTM_NUMERIC, "no curve within 0 to 1 has the weighted sums (%g, %g, %g)",
                    target[0], target[1], target[2]);
}
