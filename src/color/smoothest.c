/* SPDX-License-Identifier: BSD-3-Clause
 * A strictly convex quadratic program by the dual active-set method of D. Goldfarb and A. Idnani, A Numerically
 * Stable Dual Method for Solving Strictly Convex Quadratic Programs, Mathematical Programming 27, 1983, section 3.
 *
 * The sum of squared steps is ½ρᵀDρ (up to its scale), D the second-difference matrix, which does not see
 * constants. On the curves that have the target sums, AᵀA adds a constant, so H = D + AᵀA has the same minimum and
 * is positive definite. With working constraints nⱼᵀρ = bⱼ (the three sums first, then bounds ±ρᵢ ≥ …) and
 * pⱼ = H⁻¹nⱼ the minimum on them is ρ = Σ pⱼwⱼ with G w = b, Gⱼₖ = nⱼᵀpₖ; a bound's wⱼ is its multiplier.
 * The method begins with the sums alone and adds a violated bound at a time, so no feasible start is needed, it
 * ends after finitely many sets, and it meets a contradiction where there is no such curve. */
#include "color/smoothest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/linear.h"
#include "base/memory.h"

enum {
    N = MTM_SPECTRUM_SAMPLES,
    SUMS = 3,
    WORKING_LIMIT = N, /* more than N independent constraints do not exist */
    STEP_LIMIT = 2000, /* colors of sRGB take up to some dozens */
};

static const double bound_tolerance = 1e-12;

typedef struct constraint {
    int sample;  /* of a bound; -1 for a sum */
    double sign; /* +1: ρ ≥ 0, -1: -ρ ≥ -1 */
    double level;
    double multiplier;
} constraint;

typedef struct program {
    const mtm_spectrum *rows;
    double inverse[N][N];              /* H⁻¹ */
    constraint working[WORKING_LIMIT]; /* the sums, then bounds in the order they came */
    double moved[WORKING_LIMIT][N];    /* pⱼ */
    int working_count;
    double factor[WORKING_LIMIT][WORKING_LIMIT]; /* Cholesky factor of G */
    double curve[N];
} program;

static double dot(const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < N; i++) sum += a[i] * b[i];
    return sum;
}

/* nⱼᵀv. */
static double along(const program *p, int j, const double *v) {
    const constraint *c = &p->working[j];
    return c->sample < 0 ? dot(p->rows[j].value, v) : c->sign * v[c->sample];
}

/* H = D + AᵀA, lower triangle. */
static void fill_hessian(const mtm_spectrum rows[SUMS], double hessian[N][N]) {
    for (int i = 0; i < N; i++) {
        for (int j = 0; j <= i; j++) {
            hessian[i][j] = i == j ? (i == 0 || i == N - 1 ? 1 : 2) : (i == j + 1 ? -1 : 0);
            for (int k = 0; k < SUMS; k++) hessian[i][j] += rows[k].value[i] * rows[k].value[j];
        }
    }
}

static bool invert_hessian(program *p) {
    double hessian[N][N];
    fill_hessian(p->rows, hessian);
    if (!mtm_cholesky_factor(N, N, hessian[0])) return false;
    for (int i = 0; i < N; i++) {
        p->inverse[i][i] = 1;
        mtm_cholesky_solve(N, N, hessian[0], p->inverse[i]);
    }
    return true;
}

/* Factors G anew. At most 81 unknowns and some dozen steps: updating the factor would not be worth its code. */
static bool factor_working_set(program *p) {
    for (int j = 0; j < p->working_count; j++)
        for (int k = 0; k <= j; k++) p->factor[j][k] = along(p, j, p->moved[k]);
    return mtm_cholesky_factor(p->working_count, WORKING_LIMIT, p->factor[0]);
}

static bool add_constraint(program *p, constraint added) {
    if (p->working_count == WORKING_LIMIT) return false;
    const int j = p->working_count++;
    p->working[j] = added;
    for (int i = 0; i < N; i++)
        p->moved[j][i] = added.sample < 0 ? dot(p->inverse[i], p->rows[j].value)
                                          : added.sign * p->inverse[added.sample][i];
    return factor_working_set(p);
}

static bool drop_constraint(program *p, int dropped) {
    const size_t after = (size_t)(--p->working_count - dropped);
    memmove(&p->working[dropped], &p->working[dropped + 1], after * sizeof *p->working);
    memmove(p->moved[dropped], p->moved[dropped + 1], after * sizeof *p->moved);
    return factor_working_set(p);
}

/* The minimum on the working set. */
static void solve_working_set(program *p) {
    double w[WORKING_LIMIT];
    for (int j = 0; j < p->working_count; j++) w[j] = p->working[j].sign * p->working[j].level;
    mtm_cholesky_solve(p->working_count, WORKING_LIMIT, p->factor[0], w);
    memset(p->curve, 0, sizeof p->curve);
    for (int j = 0; j < p->working_count; j++)
        for (int i = 0; i < N; i++) p->curve[i] += w[j] * p->moved[j][i];
}

/* The bound that the curve violates most, the first of equals; false where it keeps all. */
static bool find_violated(const program *p, constraint *violated) {
    double worst = bound_tolerance;
    for (int i = 0; i < N; i++) {
        const bool is_low = p->curve[i] < 0.5;
        const double violation = is_low ? -p->curve[i] : p->curve[i] - 1;
        if (violation <= worst) continue;
        worst = violation;
        *violated = (constraint){.sample = i, .sign = is_low ? 1 : -1, .level = is_low ? 0 : 1};
    }
    return worst > bound_tolerance;
}

/* The step towards a violated bound: how the curve moves per unit of its multiplier, and the rate at which the
 * working multipliers fall (z and r of the paper). */
typedef struct step {
    double direction[N];
    double rate[WORKING_LIMIT];
} step;

static step find_step(const program *p, const constraint *violated) {
    step s;
    for (int i = 0; i < N; i++) s.direction[i] = violated->sign * p->inverse[violated->sample][i];
    for (int j = 0; j < p->working_count; j++) s.rate[j] = along(p, j, s.direction);
    mtm_cholesky_solve(p->working_count, WORKING_LIMIT, p->factor[0], s.rate);
    for (int j = 0; j < p->working_count; j++)
        for (int i = 0; i < N; i++) s.direction[i] -= s.rate[j] * p->moved[j][i];
    return s;
}

/* The working bound whose multiplier reaches 0 first, -1 for none, and the step length where it does. */
static int find_blocking(const program *p, const step *s, double *length) {
    int blocking = -1;
    *length = INFINITY;
    for (int j = SUMS; j < p->working_count; j++) {
        if (s->rate[j] <= 0 || p->working[j].multiplier / s->rate[j] >= *length) continue;
        *length = p->working[j].multiplier / s->rate[j];
        blocking = j;
    }
    return blocking;
}

/* The step length that puts the curve on the bound; infinite where the working set holds that sample fixed, which
 * shows as a slope of rounding size beside the 81 samples' free one. */
static double length_to_bound(const program *p, const constraint *violated, const step *s) {
    const double slope = violated->sign * s->direction[violated->sample];
    if (slope <= 1e-11 * p->inverse[violated->sample][violated->sample]) return INFINITY;
    return violated->sign * (violated->level - p->curve[violated->sample]) / slope;
}

/* Takes the violated bound into the working set, dropping bounds whose multipliers reach 0 on the way. False
 * where the bound contradicts the working set. */
static bool enforce(program *p, constraint violated) {
    for (int i = 0; i < STEP_LIMIT; i++) {
        const step s = find_step(p, &violated);
        double blocking_length = INFINITY;
        const int blocking = find_blocking(p, &s, &blocking_length);
        const double full_length = length_to_bound(p, &violated, &s);
        const double length = fmin(blocking_length, full_length);
        if (length == INFINITY) return false;
        for (int j = SUMS; j < p->working_count; j++) p->working[j].multiplier -= length * s.rate[j];
        violated.multiplier += length;
        if (full_length < INFINITY)
            for (int k = 0; k < N; k++) p->curve[k] += length * s.direction[k];
        if (full_length <= blocking_length) return add_constraint(p, violated);
        if (!drop_constraint(p, blocking)) return false;
    }
    return false;
}

static bool minimize(program *p, const double target[SUMS]) {
    if (!invert_hessian(p)) return false;
    for (int k = 0; k < SUMS; k++)
        if (!add_constraint(p, (constraint){.sample = -1, .sign = 1, .level = target[k]})) return false;
    solve_working_set(p);
    constraint violated;
    for (int i = 0; find_violated(p, &violated); i++) {
        if (i == STEP_LIMIT || !enforce(p, violated)) return false;
        solve_working_set(p); /* where the steps led, without their rounding */
    }
    return true;
}

static double on_bounds(double value) {
    if (value < bound_tolerance) return 0;
    return value > 1 - bound_tolerance ? 1 : value;
}

mtm_status mtm_smoothest_curve(const mtm_spectrum rows[3], const double target[3], mtm_spectrum *curve,
                               mtm_error *error) {
    program *p = mtm_allocate(1, sizeof *p);
    if (p == NULL) return mtm_fail_memory(error, "a smoothest reflectance", sizeof *p);
    p->rows = rows;
    const bool exists = minimize(p, target);
    for (int i = 0; i < N && exists; i++) curve->value[i] = on_bounds(p->curve[i]);
    free(p);
    return exists ? MTM_OK
                  : mtm_fail(error, MTM_NUMERIC, "no curve within 0 to 1 has the weighted sums (%g, %g, %g)",
                             target[0], target[1], target[2]);
}
