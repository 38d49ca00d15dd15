/* SPDX-License-Identifier: BSD-3-Clause
 * The minimum of a quadratic program over curves in another way than src/base/qp.c: an active-set method on dense matrices
 * (J. Nocedal, S. J. Wright, Numerical Optimization, 2nd edition, 2006, section 16.5), slow and certain for small ones. */
#ifndef METAMER_DENSE_QP_H
#define METAMER_DENSE_QP_H

#include <math.h>
#include <stdlib.h>

#include "base/qp.h"
#include "test.h"

enum { DENSE_MAX = 120, DENSE_SUMS_MAX = 24 }; /* samples and sums together; sums */

static double clamp(double x, double low, double high) {
    return fmax(low, fmin(high, x));
}

/* The derivative of what a curve costs without bounds and sums, by its definition. */
static void fill_cost_gradient(int n, const mtm_qp_curve *curve, const double *x, double *gradient) {
    double d[MTM_QP_LENGTH_MAX];
    for (int i = 0; i < n; i++) d[i] = x[i] - (curve->reference != NULL ? curve->reference[i] : 0);
    for (int i = 0; i < n; i++)
        gradient[i] = curve->size * d[i] + (curve->linear != NULL ? curve->linear[i] : 0);
    for (int i = 0; i + 1 < n; i++) {
        gradient[i] -= curve->slope * (d[i + 1] - d[i]);
        gradient[i + 1] += curve->slope * (d[i + 1] - d[i]);
    }
    for (int i = 0; i + 2 < n; i++) {
        const double bend = curve->curvature * (d[i] - 2 * d[i + 1] + d[i + 2]);
        gradient[i] += bend;
        gradient[i + 1] -= 2 * bend;
        gradient[i + 2] += bend;
    }
}

/* The same program for the dense solver: the samples of all curves, then the values v that the sums are taken for. Each
 * is free, or held at a bound. */
typedef struct dense {
    int sample_count, sum_count, count;
    double hessian[DENSE_MAX][DENSE_MAX], pull[DENSE_MAX]; /* of the samples */
    double rows[DENSE_SUMS_MAX][DENSE_MAX], give[DENSE_SUMS_MAX], multiplier[DENSE_SUMS_MAX];
    double low[DENSE_MAX], high[DENSE_MAX], value[DENSE_MAX];
    bool is_held[DENSE_MAX];
    double matrix[DENSE_MAX][DENSE_MAX]; /* of the system that is being solved */
} dense;

static double dense_sum(const dense *d, int k, const double *value) {
    double sum = 0;
    for (int i = 0; i < d->sample_count; i++) sum += d->rows[k][i] * value[i];
    return sum;
}

/* The Hessian column by column, as the change of the gradient. */
static void fill_dense_curve(const mtm_qp *program, int c, dense *d) {
    const int n = program->length;
    const mtm_qp_curve *curve = &program->curves[c];
    double x[MTM_QP_LENGTH_MAX] = {0};
    double origin[MTM_QP_LENGTH_MAX], gradient[MTM_QP_LENGTH_MAX];
    fill_cost_gradient(n, curve, x, origin);
    for (int j = 0; j < n; j++) {
        x[j] = 1;
        fill_cost_gradient(n, curve, x, gradient);
        x[j] = 0;
        for (int i = 0; i < n; i++) d->hessian[c * n + i][c * n + j] = gradient[i] - origin[i];
        d->pull[c * n + j] = -origin[j];
        d->low[c * n + j] = curve->low;
        d->high[c * n + j] = curve->high;
        d->value[c * n + j] = clamp(0.5, curve->low, curve->high);
    }
}

static dense *create_dense(const mtm_qp *program) {
    dense *d = calloc(1, sizeof *d);
    assert_non_null(d);
    d->sample_count = program->curve_count * program->length;
    d->sum_count = program->sum_count;
    d->count = d->sample_count + d->sum_count;
    assert_in_range(d->count, 1, DENSE_MAX);
    for (int c = 0; c < program->curve_count; c++) fill_dense_curve(program, c, d);
    for (int k = 0; k < program->sum_count; k++) {
        const mtm_qp_sum *sum = &program->sums[k];
        const int v = d->sample_count + k;
        for (int t = 0; t < sum->term_count; t++)
            for (int i = 0; i < program->length; i++)
                d->rows[k][sum->terms[t].curve * program->length + i] += sum->terms[t].weights[i];
        d->give[k] = sum->give;
        d->low[v] = sum->low;
        d->high[v] = sum->high;
        d->value[v] = clamp(dense_sum(d, k, d->value), sum->low, sum->high);
        d->is_held[v] = d->value[v] == sum->low || d->value[v] == sum->high;
    }
    return d;
}

/* Gauss' elimination with the largest pivot of each column; the solution replaces the right-hand side. */
static void solve_dense(int n, double matrix[DENSE_MAX][DENSE_MAX], double *right) {
    for (int p = 0; p < n; p++) {
        int largest = p;
        for (int i = p + 1; i < n; i++)
            if (fabs(matrix[i][p]) > fabs(matrix[largest][p])) largest = i;
        for (int j = 0; j < n; j++) {
            const double entry = matrix[p][j];
            matrix[p][j] = matrix[largest][j];
            matrix[largest][j] = entry;
        }
        const double swapped = right[p];
        right[p] = right[largest];
        right[largest] = swapped;
        for (int i = p + 1; i < n; i++) {
            const double factor = matrix[i][p] / matrix[p][p];
            for (int j = p; j < n; j++) matrix[i][j] -= factor * matrix[p][j];
            right[i] -= factor * right[p];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) right[i] -= matrix[i][j] * right[j];
        right[i] /= matrix[i][i];
    }
}

/* The minimum where what is held stays: the free samples and the multipliers of the held sums solve
 * H x − Aᵀλ = pull, A x + give·λ = v. All values go into `aim`. */
static void find_aim(dense *d, double *aim) {
    double right[DENSE_MAX];
    int open[DENSE_MAX];
    int n = 0;
    for (int i = 0; i < d->count; i++)
        if (d->is_held[i] == (i >= d->sample_count)) open[n++] = i;
    memcpy(aim, d->value, (size_t)d->count * sizeof *aim);
    for (int p = 0; p < n; p++) {
        const int k = open[p] - d->sample_count;
        right[p] = k < 0 ? d->pull[open[p]] : d->value[open[p]];
        for (int i = 0; i < d->sample_count; i++)
            if (d->is_held[i]) right[p] -= (k < 0 ? d->hessian[open[p]][i] : d->rows[k][i]) * d->value[i];
        for (int q = 0; q < n; q++) {
            const int l = open[q] - d->sample_count;
            if (k < 0) d->matrix[p][q] = l < 0 ? d->hessian[open[p]][open[q]] : -d->rows[l][open[p]];
            if (k >= 0) d->matrix[p][q] = l < 0 ? d->rows[k][open[q]] : (k == l ? d->give[k] : 0);
        }
    }
    solve_dense(n, d->matrix, right);
    memset(d->multiplier, 0, sizeof d->multiplier);
    for (int p = 0; p < n; p++) {
        if (open[p] < d->sample_count)
            aim[open[p]] = right[p];
        else
            d->multiplier[open[p] - d->sample_count] = right[p];
    }
    for (int k = 0; k < d->sum_count; k++)
        if (!d->is_held[d->sample_count + k]) aim[d->sample_count + k] = dense_sum(d, k, aim);
}

/* Goes to the aim, or to the first bound in the way and holds what met it; true where the aim was reached. */
static bool approach(dense *d, const double *aim) {
    double length = 1;
    int met = -1;
    for (int i = 0; i < d->count; i++) {
        if (d->is_held[i] || (aim[i] >= d->low[i] && aim[i] <= d->high[i])) continue;
        const double bound = aim[i] < d->low[i] ? d->low[i] : d->high[i];
        const double here = (bound - d->value[i]) / (aim[i] - d->value[i]);
        if (here >= length) continue;
        length = here;
        met = i;
    }
    for (int i = 0; i < d->count; i++)
        if (!d->is_held[i]) d->value[i] += length * (aim[i] - d->value[i]);
    if (met < 0) return true;
    d->value[met] = aim[met] < d->low[met] ? d->low[met] : d->high[met];
    d->is_held[met] = true;
    return false;
}

/* Frees what a bound holds back most from a lower cost; false where nothing is, which is the minimum. */
static bool release(dense *d) {
    double worst = 1e-11;
    int freed = -1;
    for (int i = 0; i < d->count; i++) {
        if (!d->is_held[i] || d->low[i] == d->high[i]) continue;
        double slope = i < d->sample_count ? -d->pull[i] : d->multiplier[i - d->sample_count];
        double scale = 1;
        for (int j = 0; j < d->sample_count && i < d->sample_count; j++)
            slope += d->hessian[i][j] * d->value[j];
        for (int k = 0; k < d->sum_count && i < d->sample_count; k++) {
            slope -= d->multiplier[k] * d->rows[k][i];
            scale += fabs(d->multiplier[k] * d->rows[k][i]);
        }
        const double gain = (d->value[i] == d->low[i] ? -slope : slope) / scale;
        if (gain <= worst) continue;
        worst = gain;
        freed = i;
    }
    if (freed >= 0) d->is_held[freed] = false;
    return freed >= 0;
}

static void minimize_dense(dense *d) {
    double aim[DENSE_MAX];
    for (int step = 0; step < 2000; step++) {
        find_aim(d, aim);
        if (approach(d, aim) && !release(d)) return;
    }
    fail_msg("the dense solver does not end");
}

#endif
