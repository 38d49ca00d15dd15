/* SPDX-License-Identifier: BSD-3-Clause
 * Quadratic programs over curves by Mehrotra's predictor and corrector (J. Nocedal, S. J. Wright, Numerical Optimization,
 * 2nd edition, 2006, algorithm 16.4), which takes some 10 to 20 steps however many bounds are met, and up to some
 * dozens where sums contradict each other.
 *
 * With multipliers λ of the sums, y and z of the bounds, and v the value a sum is allowed to be taken for, the minimum has
 *   H(x − r) + l = Aᵀλ + y − z,   A x + diag(give) λ = v,   y(x − low) = 0,   z(high − x) = 0,
 * and the same with bounds on v, whose multipliers differ by λ. A step of Newton's method solves
 *   (H + D) Δx = Aᵀ Δλ + …,   A Δx + (diag(give) + E) Δλ = …,
 * D and E diagonal with what the bounds add. A bend w = D₂x has bounds like x itself, y and z again, and no cost; what they
 * add to H + D is D₂ᵀ·stiffness·D₂, as a cost would. It may be off by a `lag` D₂x − w on the way. H couples neighbors within a
 * curve only, so H + D is a banded matrix, and Δλ solves the small dense system A (H + D)⁻¹ Aᵀ + diag(give) + E:
 * O(samples·sums) for the first, O(sums²·samples + sums³) for the second. Nothing here becomes singular: `size` keeps H positive definite and `give` the small system. */
#include "base/qp.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/band.h"
#include "base/fail.h"
#include "base/linear.h"
#include "base/memory.h"

enum {
    LENGTH_MAX = MTM_QP_LENGTH_MAX,
    STEP_CAREFUL = 40, /* as many are hardly ever needed */
    STEP_LIMIT = 100,
};

/* A number x with bounds. An infinite bound has the multiplier 0. */
typedef struct bounded {
    double below, above;      /* x − low, high − x */
    double y, z;              /* the multipliers of the bounds */
    double low_aim, high_aim; /* what y·below and z·above are wanted to be after the step */
    double step, step_y, step_z;
} bounded;

typedef struct curve_state {
    mtm_band hessian, factor;
    bounded samples[LENGTH_MAX];
    int bend_count; /* length − 2, or 0 where the curve may bend as it likes */
    bounded bends[LENGTH_MAX];
    double lag[LENGTH_MAX];
    double pull[LENGTH_MAX];     /* H r − l: the right-hand side without bounds and sums */
    double residual[LENGTH_MAX]; /* of the gradient */
    int sum_count;
    int *sums;       /* those that have a term in this curve, in their order */
    double *weights; /* of these terms: a row of sum_count for every sample */
    double *moved;   /* (H + D)⁻¹ times each of the weights' columns */
    double *shared;  /* sum_count numbers */
} curve_state;

typedef struct sum_state {
    double value;   /* v */
    bounded bounds; /* of v, where it is not fixed */
    bool is_fixed;
    double residual; /* v − A x − give·λ; 0 of a sum without bounds */
} sum_state;

typedef struct solver {
    mtm_qp *program;
    curve_state *curves;
    sum_state *sums;
    double *system, *right; /* A (H + D)⁻¹ Aᵀ + diag(give) + E, and Δλ */
    int *lists;             /* the curves' lists of sums */
    double *numbers;        /* their weights, moved and shared */
} solver;

/* The second difference of x from i on, and its transpose: adds what a force on it does to the three samples. */
static double bend_at(const double *x, int i) {
    return x[i] - 2 * x[i + 1] + x[i + 2];
}

static void add_bend_force(double force, double *x, int i) {
    x[i] += force;
    x[i + 1] -= 2 * force;
    x[i + 2] += force;
}

/* H of a curve. */
static void fill_hessian(int n, const mtm_qp_curve *curve, mtm_band *hessian) {
    memset(hessian, 0, sizeof *hessian);
    for (int i = 0; i < n; i++) hessian->main[i] = curve->size;
    for (int i = 0; i + 1 < n; i++) mtm_band_add_slope(hessian, i, curve->slope);
    for (int i = 0; i + 2 < n; i++) mtm_band_add_bend(hessian, i, curve->curvature);
}

/* result[j] -= Σ matrix[i][j]·factors[i] */
static void take_rows(int n, int count, const double *matrix, const double *factors, double *result) {
    for (int i = 0; i < n; i++) mtm_take_away(count, factors[i], matrix + i * count, result);
}

/* What the bounds add to the diagonal. */
static double stiffness(const bounded *b) {
    return b->y / b->below + b->z / b->above;
}

/* What they add to the right-hand side. */
static double bound_pull(const bounded *b) {
    return b->low_aim / b->below - b->high_aim / b->above;
}

static void find_multiplier_steps(bounded *b) {
    if (b->y > 0) b->step_y = (b->low_aim - b->y * b->step) / b->below - b->y;
    if (b->z > 0) b->step_z = (b->high_aim + b->z * b->step) / b->above - b->z;
}

/* Aims at `gap` for both products, less what the step found before would add to them in second order, of which no more
 * than `limit` is believed. */
static void set_aims(bounded *b, double gap, double limit) {
    b->low_aim = b->y > 0 ? gap - fmax(-limit, fmin(limit, b->step * b->step_y)) : 0;
    b->high_aim = b->z > 0 ? gap + fmax(-limit, fmin(limit, b->step * b->step_z)) : 0;
}

/* The longest step at which the number stays within its bounds and their multipliers above 0, at most `longest`. */
static double limit_step(const bounded *b, double longest) {
    if (b->y > 0 && b->step < 0) longest = fmin(longest, -b->below / b->step);
    if (b->z > 0 && b->step > 0) longest = fmin(longest, b->above / b->step);
    if (b->y > 0 && b->step_y < 0) longest = fmin(longest, -b->y / b->step_y);
    if (b->z > 0 && b->step_z < 0) longest = fmin(longest, -b->z / b->step_z);
    return longest;
}

static void take_step(bounded *b, double length) {
    b->below += length * b->step;
    b->above -= length * b->step;
    b->y += length * b->step_y;
    b->z += length * b->step_z;
}

/* Puts a number well within its bounds. */
static double begin_bounded(bounded *b, double x, double low, double high) {
    static const double margin = 0.1;
    const double inset = low > -INFINITY && high < INFINITY ? margin * (high - low) : 1;
    const double inside = fmax(fmin(x, high - inset), low + inset);
    *b = (bounded){.below = inside - low, .above = high - inside, .y = low > -INFINITY, .z = high < INFINITY};
    return inside;
}

/* The numbers with bounds, one after the other; NULL behind the last: of each curve its samples and bends, then the sums
 * that are not fixed. */
static bounded *next_bounded(const solver *s, int *curve, int *index) {
    const mtm_qp *program = s->program;
    while (*curve < program->curve_count) {
        curve_state *state = &s->curves[*curve];
        const int i = (*index)++;
        if (i < program->length) return &state->samples[i];
        if (i < program->length + state->bend_count) return &state->bends[i - program->length];
        (*curve)++;
        *index = 0;
    }
    while (*index < program->sum_count) {
        sum_state *sum = &s->sums[(*index)++];
        if (!sum->is_fixed) return &sum->bounds;
    }
    return NULL;
}

/* The mean of y·below and z·above over the finite bounds, after a step of this length. */
static double mean_gap(const solver *s, double length) {
    double gap = 0;
    int count = 0;
    int curve = 0;
    int index = 0;
    for (const bounded *b; (b = next_bounded(s, &curve, &index)) != NULL;) {
        if (b->y > 0) gap += (b->y + length * b->step_y) * (b->below + length * b->step);
        if (b->z > 0) gap += (b->z + length * b->step_z) * (b->above - length * b->step);
        count += (b->y > 0) + (b->z > 0);
    }
    return count > 0 ? gap / count : 0;
}

static double longest_step(const solver *s) {
    double longest = INFINITY;
    int curve = 0;
    int index = 0;
    for (const bounded *b; (b = next_bounded(s, &curve, &index)) != NULL;) longest = limit_step(b, longest);
    return longest;
}

/* A sum that may have any value is left out. */
static bool is_bounded(const mtm_qp_sum *sum) {
    return sum->low > -INFINITY || sum->high < INFINITY;
}

/* The weights of a curve in a sum; NULL where it has none. A curve is at most once in a sum. */
static const double *find_term(const mtm_qp_sum *sum, int curve) {
    for (int t = 0; t < sum->term_count; t++)
        if (sum->terms[t].curve == curve) return sum->terms[t].weights;
    return NULL;
}

static double value_of_sum(const mtm_qp *program, const mtm_qp_sum *sum) {
    double value = 0;
    for (int t = 0; t < sum->term_count; t++)
        value += mtm_dot(program->length, sum->terms[t].weights, program->curves[sum->terms[t].curve].x);
    return value;
}

/* The multipliers of a curve's sums, side by side. */
static void share_multipliers(const mtm_qp *program, const curve_state *state) {
    for (int p = 0; p < state->sum_count; p++) state->shared[p] = program->sums[state->sums[p]].multiplier;
}

/* The lags, and what the bounds of bends add to the gradient and to what it is summed from; the largest lag. */
static double find_lags(const mtm_qp_curve *curve, curve_state *state, double *scale) {
    double worst = 0;
    for (int i = 0; i < state->bend_count; i++) {
        const bounded *b = &state->bends[i];
        state->lag[i] = bend_at(curve->x, i) - (b->below - curve->bend);
        add_bend_force(b->y - b->z, state->residual, i);
        for (int k = 0; k < 3; k++) scale[i + k] += b->y + b->z;
        worst = fmax(worst, fabs(state->lag[i]));
    }
    return worst;
}

/* How far the gradient of a curve is from 0, relative to what it is summed from. */
static double find_gradient(const mtm_qp *program, const mtm_qp_curve *curve, curve_state *state) {
    const int n = program->length;
    double bent[LENGTH_MAX];
    double scale[LENGTH_MAX];
    mtm_band_multiply(n, &state->hessian, curve->x, bent);
    share_multipliers(program, state);
    for (int i = 0; i < n; i++) {
        const bounded *b = &state->samples[i];
        const double *weights = state->weights + i * state->sum_count;
        state->residual[i] =
            state->pull[i] - bent[i] + b->y - b->z + mtm_dot(state->sum_count, weights, state->shared);
        scale[i] = 1e-3 + fabs(state->pull[i]) + fabs(bent[i]) + b->y + b->z;
        for (int p = 0; p < state->sum_count; p++) scale[i] += fabs(state->shared[p] * weights[p]);
    }
    double worst = find_lags(curve, state, scale);
    for (int i = 0; i < n; i++) worst = fmax(worst, fabs(state->residual[i]) / scale[i]);
    return worst;
}

/* All residuals; the largest, relative to what it is summed from. */
static double find_residuals(solver *s) {
    const mtm_qp *program = s->program;
    double worst = 0;
    for (int c = 0; c < program->curve_count; c++)
        worst = fmax(worst, find_gradient(program, &program->curves[c], &s->curves[c]));
    for (int k = 0; k < program->sum_count; k++) {
        const mtm_qp_sum *sum = &program->sums[k];
        if (!is_bounded(sum)) continue;
        const double value = value_of_sum(program, sum);
        s->sums[k].residual = s->sums[k].value - value - sum->give * sum->multiplier;
        worst = fmax(worst, fabs(s->sums[k].residual) / (1 + fabs(value)));
    }
    return worst;
}

/* Adds A (H + D)⁻¹ Aᵀ of one curve to the lower triangle of the small system. */
static void add_to_system(const solver *s, const curve_state *state) {
    const int count = state->sum_count;
    const size_t stride = (size_t)s->program->sum_count;
    for (int p = 0; p < count; p++) {
        double *row = s->system + (size_t)state->sums[p] * stride;
        memset(state->shared, 0, (size_t)count * sizeof *state->shared);
        for (int i = 0; i < s->program->length; i++)
            mtm_take_away(p + 1, -state->weights[i * count + p], state->moved + i * count, state->shared);
        for (int q = 0; q <= p; q++) row[state->sums[q]] += state->shared[q];
    }
}

/* Factors H + D, and the small system. */
static bool factor_system(solver *s) {
    const mtm_qp *program = s->program;
    const int n = program->length;
    const size_t count = (size_t)program->sum_count;
    memset(s->system, 0, count * count * sizeof *s->system);
    for (int c = 0; c < program->curve_count; c++) {
        curve_state *state = &s->curves[c];
        state->factor = state->hessian;
        for (int i = 0; i < n; i++) state->factor.main[i] += stiffness(&state->samples[i]);
        for (int i = 0; i < state->bend_count; i++)
            mtm_band_add_bend(&state->factor, i, stiffness(&state->bends[i]));
        mtm_band_factor(n, &state->factor);
        memcpy(state->moved, state->weights, (size_t)(n * state->sum_count) * sizeof *state->moved);
        mtm_band_solve(n, &state->factor, state->sum_count, state->moved);
        add_to_system(s, state);
    }
    /* Sums that depend on each other need more than a `give` that is lost in rounding. The step is then not quite right,
     * but the residuals, which say what is left to do, are. */
    const double lift = 1 + 16 * program->sum_count * DBL_EPSILON;
    for (size_t k = 0; k < count; k++) {
        const sum_state *sum = &s->sums[k];
        s->system[k * count + k] += program->sums[k].give + (sum->is_fixed ? 0 : 1 / stiffness(&sum->bounds));
        s->system[k * count + k] *= lift;
    }
    return mtm_cholesky_factor(program->sum_count, program->sum_count, s->system);
}

/* The step without the sums, into `step`, and what is then left of the sums, into `right`. */
static void find_free_step(solver *s) {
    const mtm_qp *program = s->program;
    const int n = program->length;
    for (int k = 0; k < program->sum_count; k++) {
        const sum_state *sum = &s->sums[k];
        s->right[k] = sum->residual;
        if (!sum->is_fixed)
            s->right[k] += (bound_pull(&sum->bounds) - program->sums[k].multiplier) / stiffness(&sum->bounds);
    }
    for (int c = 0; c < program->curve_count; c++) {
        curve_state *state = &s->curves[c];
        double step[LENGTH_MAX];
        for (int i = 0; i < n; i++) {
            const bounded *b = &state->samples[i];
            step[i] = state->residual[i] + bound_pull(b) - b->y + b->z;
        }
        for (int i = 0; i < state->bend_count; i++) {
            const bounded *b = &state->bends[i];
            add_bend_force(bound_pull(b) - b->y + b->z - stiffness(b) * state->lag[i], step, i);
        }
        mtm_band_solve(n, &state->factor, 1, step);
        for (int i = 0; i < n; i++) state->samples[i].step = step[i];
        memset(state->shared, 0, (size_t)state->sum_count * sizeof *state->shared);
        take_rows(n, state->sum_count, state->weights, step, state->shared);
        for (int p = 0; p < state->sum_count; p++) s->right[state->sums[p]] += state->shared[p];
    }
}

static void find_bend_steps(curve_state *state) {
    const bounded *x = state->samples;
    for (int i = 0; i < state->bend_count; i++)
        state->bends[i].step = x[i].step - 2 * x[i + 1].step + x[i + 2].step + state->lag[i];
}

/* The step of Newton's method towards the aims, with the factors there are; `right` then holds Δλ. */
static void find_step(solver *s) {
    const mtm_qp *program = s->program;
    find_free_step(s);
    mtm_cholesky_solve(program->sum_count, program->sum_count, s->system, s->right);
    for (int c = 0; c < program->curve_count; c++) {
        curve_state *state = &s->curves[c];
        for (int p = 0; p < state->sum_count; p++) state->shared[p] = s->right[state->sums[p]];
        for (int i = 0; i < program->length; i++)
            state->samples[i].step +=
                mtm_dot(state->sum_count, state->moved + i * state->sum_count, state->shared);
        find_bend_steps(state);
    }
    for (int k = 0; k < program->sum_count; k++) {
        bounded *b = &s->sums[k].bounds;
        if (!s->sums[k].is_fixed)
            b->step = (bound_pull(b) - program->sums[k].multiplier - s->right[k]) / stiffness(b);
    }
    int curve = 0;
    int index = 0;
    for (bounded *b; (b = next_bounded(s, &curve, &index)) != NULL;) find_multiplier_steps(b);
}

/* The same with these aims; how long it may be. */
static double find_step_towards(solver *s, double gap, double correction_limit) {
    int curve = 0;
    int index = 0;
    for (bounded *b; (b = next_bounded(s, &curve, &index)) != NULL;) set_aims(b, gap, correction_limit);
    find_step(s);
    return longest_step(s);
}

static void move(solver *s, double length) {
    mtm_qp *program = s->program;
    for (int c = 0; c < program->curve_count; c++) {
        for (int i = 0; i < program->length; i++) {
            program->curves[c].x[i] += length * s->curves[c].samples[i].step;
            take_step(&s->curves[c].samples[i], length);
        }
        for (int i = 0; i < s->curves[c].bend_count; i++) take_step(&s->curves[c].bends[i], length);
    }
    for (int k = 0; k < program->sum_count; k++) {
        program->sums[k].multiplier += length * s->right[k];
        if (s->sums[k].is_fixed) continue;
        s->sums[k].value += length * s->sums[k].bounds.step;
        take_step(&s->sums[k].bounds, length);
    }
}

/* Gives all bounds multipliers that make both products of all numbers `gap`. */
static void center(const solver *s, double gap) {
    int curve = 0;
    int index = 0;
    for (bounded *b; (b = next_bounded(s, &curve, &index)) != NULL;) {
        if (b->y > 0) b->y = gap / b->below;
        if (b->z > 0) b->z = gap / b->above;
    }
}

/* A step towards the minimum; false where rounding has eaten the system. Mehrotra's step alone may go round in circles, so
 * that a short one, and every one if the step is to be `careful`, gives way to one that only keeps to the middle of the
 * bounds. Where even that is very short the multipliers are far too small, as from 1 on where sums contradict each other
 * and multipliers become 1/give. */
static bool improve(solver *s, double gap, bool careful) {
    static const double length_short = 0.6, length_tiny = 0.01;
    static const double correction_limit = 10, middle = 0.3, growth = 1000; /* of the gap */
    if (!factor_system(s)) return false;
    double length = find_step_towards(s, 0, 0);
    const double ratio = gap > 0 ? mean_gap(s, fmin(1, length)) / gap : 0;
    /* Of the way to the first bound, so that none is met early; near the minimum, where steps are right, almost all of it,
     * which makes the last ones few. */
    const double nearly = 1 - fmax(1e-9, fmin(0.005, gap));
    if (!careful) length = nearly * find_step_towards(s, ratio * ratio * ratio * gap, correction_limit * gap);
    if (careful || length < length_short) length = nearly * find_step_towards(s, middle * gap, 0);
    move(s, fmin(1, length));
    if (length < length_tiny) center(s, growth * gap);
    return true;
}

static bool has_bends(const mtm_qp *program) {
    for (int c = 0; c < program->curve_count; c++)
        if (program->curves[c].bend > 0) return true;
    return false;
}

static mtm_status solve(solver *s, mtm_error *error) {
    static const double gap_small = 1e-26, residual_small = 1e-11, residual_usable = 1e-6;
    const bool is_stiff = has_bends(s->program);
    const double gap_usable = is_stiff ? 1e-6 : 1e-12;
    double residual = find_residuals(s);
    double lowest = residual;
    double gap = mean_gap(s, 0);
    for (int step = 0; step < STEP_LIMIT; step++) {
        if (!improve(s, gap, step >= STEP_CAREFUL)) break;
        const double before = residual;
        residual = find_residuals(s);
        lowest = fmin(lowest, residual);
        gap = mean_gap(s, 0);
        const bool has_stalled = residual <= residual_usable && residual > before / 2; /* by rounding */
        if (gap <= gap_small && (residual <= residual_small || has_stalled)) break;
        /* Near the end of a stiff program rounding takes over, and every further step makes it worse. */
        if (is_stiff && gap <= gap_usable && residual > fmax(2 * lowest, residual_small)) break;
    }
    if (residual < residual_usable && gap < gap_usable) return MTM_OK;
    return mtm_fail(error, MTM_NUMERIC, "a quadratic program of %d curves and %d sums does not settle",
                    s->program->curve_count, s->program->sum_count);
}

static void begin_curve(int n, const mtm_qp_curve *curve, curve_state *state) {
    fill_hessian(n, curve, &state->hessian);
    if (curve->reference != NULL) mtm_band_multiply(n, &state->hessian, curve->reference, state->pull);
    for (int i = 0; i < n; i++) {
        if (curve->linear != NULL) state->pull[i] -= curve->linear[i];
        curve->x[i] = begin_bounded(&state->samples[i], curve->x[i], curve->low, curve->high);
    }
    state->bend_count = curve->bend > 0 ? n - 2 : 0;
    for (int i = 0; i < state->bend_count; i++)
        (void)begin_bounded(&state->bends[i], bend_at(curve->x, i), -curve->bend, curve->bend);
}

static void begin(solver *s) {
    const mtm_qp *program = s->program;
    for (int c = 0; c < program->curve_count; c++)
        begin_curve(program->length, &program->curves[c], &s->curves[c]);
    for (int k = 0; k < program->sum_count; k++) {
        mtm_qp_sum *sum = &program->sums[k];
        sum_state *state = &s->sums[k];
        state->is_fixed = sum->low == sum->high || !is_bounded(sum);
        state->value = state->is_fixed
                           ? sum->low
                           : begin_bounded(&state->bounds, value_of_sum(program, sum), sum->low, sum->high);
        sum->multiplier = 0;
    }
}

/* Gives each curve the list of the sums that it is part of, in their order, and the matrix of its weights in them. */
static void list_sums(solver *s) {
    const mtm_qp *program = s->program;
    const int n = program->length;
    int *list = s->lists;
    double *numbers = s->numbers;
    for (int c = 0; c < program->curve_count; c++) {
        curve_state *state = &s->curves[c];
        state->sums = list;
        for (int k = 0; k < program->sum_count; k++)
            if (is_bounded(&program->sums[k]) && find_term(&program->sums[k], c) != NULL)
                state->sums[state->sum_count++] = k;
        state->weights = numbers;
        state->moved = state->weights + n * state->sum_count;
        state->shared = state->moved + n * state->sum_count;
        for (int p = 0; p < state->sum_count; p++) {
            const double *weights = find_term(&program->sums[state->sums[p]], c);
            for (int i = 0; i < n; i++) state->weights[i * state->sum_count + p] = weights[i];
        }
        list += state->sum_count;
        numbers = state->shared + state->sum_count;
    }
}

static void release(solver *s) {
    free(s->curves);
    free(s->sums);
    free(s->system);
    free(s->right);
    free(s->lists);
    free(s->numbers);
}

static bool allocate(solver *s) {
    const size_t sums = (size_t)s->program->sum_count;
    size_t terms = 0;
    for (size_t k = 0; k < sums; k++) terms += (size_t)s->program->sums[k].term_count;
    s->curves = mtm_allocate((size_t)s->program->curve_count, sizeof *s->curves);
    s->sums = mtm_allocate(sums, sizeof *s->sums);
    s->system = mtm_allocate(sums * sums, sizeof *s->system);
    s->right = mtm_allocate(sums, sizeof *s->right);
    s->lists = mtm_allocate(terms, sizeof *s->lists);
    s->numbers = mtm_allocate(terms * (2 * (size_t)s->program->length + 1), sizeof *s->numbers);
    return s->curves != NULL && s->sums != NULL && s->system != NULL && s->right != NULL &&
           s->lists != NULL && s->numbers != NULL;
}

/* What is nearer to a bound than can be told from being on it is put there, and a sum that is within its range more surely
 * than at an end of it gets the multiplier 0. */
static void settle(const solver *s) {
    static const double near = 1e-12;
    const mtm_qp *program = s->program;
    for (int c = 0; c < program->curve_count; c++) {
        const mtm_qp_curve *curve = &program->curves[c];
        for (int i = 0; i < program->length; i++) {
            const bounded *sample =
                &s->curves[c].samples[i]; /* whose distances are known better than those of x */
            curve->x[i] = fmax(curve->low, fmin(curve->high, curve->x[i]));
            if (sample->below < near) curve->x[i] = curve->low;
            if (sample->above < near) curve->x[i] = curve->high;
        }
    }
    for (int k = 0; k < program->sum_count; k++) {
        const bounded *b = &s->sums[k].bounds;
        if (!s->sums[k].is_fixed && b->y <= b->below && b->z <= b->above) program->sums[k].multiplier = 0;
    }
}

mtm_status mtm_qp_minimize(mtm_qp *program, mtm_error *error) {
    assert(program->length >= 3 && program->length <= LENGTH_MAX);
    solver s = {.program = program};
    mtm_status status = MTM_OK;
    if (allocate(&s)) {
        list_sums(&s);
        begin(&s);
        status = solve(&s, error);
    } else {
        status = mtm_fail_memory(error, "a quadratic program",
                                 (size_t)program->sum_count * (size_t)program->sum_count * sizeof *s.system);
    }
    if (status == MTM_OK) settle(&s);
    release(&s);
    return status;
}

double mtm_qp_contradiction(const mtm_qp *program) {
    double wanted = 0;
    double length = 0;
    for (int k = 0; k < program->sum_count; k++) {
        const mtm_qp_sum *sum = &program->sums[k];
        if (sum->multiplier == 0) continue;
        wanted += sum->multiplier * (sum->multiplier > 0 ? sum->low : sum->high);
        length += sum->multiplier * sum->multiplier;
    }
    for (int c = 0; c < program->curve_count && length > 0; c++) {
        const mtm_qp_curve *curve = &program->curves[c];
        for (int i = 0; i < program->length; i++) {
            double slope = 0;
            for (int k = 0; k < program->sum_count; k++) {
                const double *weights = find_term(&program->sums[k], c);
                if (weights != NULL) slope += program->sums[k].multiplier * weights[i];
            }
            if (slope != 0) wanted -= slope * (slope > 0 ? curve->high : curve->low);
        }
    }
    return length > 0 ? wanted / sqrt(length) : 0;
}
