/* SPDX-License-Identifier: BSD-3-Clause
 * L-BFGS: J. Nocedal, "Updating Quasi-Newton Matrices with Limited Storage", Mathematics of Computation 35, 1980;
 * J. Nocedal, S. J. Wright, "Numerical Optimization", 2nd edition, 2006, algorithms 7.4 and 7.5.
 * Steps by bisection to the weak Wolfe conditions: A. S. Lewis, M. L. Overton, "Nonsmooth optimization via
 * quasi-Newton methods", Mathematical Programming 141, 2013, algorithm 2.6.
 * All sums run over the index in order, so that a result repeats bit for bit. */
#include "minimize.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

enum { MEMORY = 20, WINDOW = 10, TRIALS_MAX = 40 };

/* A point with the value and the gradient there. */
typedef struct point {
    double *x, *gradient;
    double value;
} point;

typedef struct search {
    int n;
    minimize_function function;
    void *user;
    double *numbers; /* the memory of all arrays below */
    point here, trial;
    double *direction;
    int pair_count;           /* of all iterations; pair i is kept at i % MEMORY */
    double *step[MEMORY];     /* x after − x before */
    double *change[MEMORY];   /* gradient after − gradient before */
    double curvature[MEMORY]; /* step · change */
    int evaluations;
} search;

static double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void add_scaled(int n, double factor, const double *a, double *sum) {
    for (int i = 0; i < n; i++) sum[i] += factor * a[i];
}

static bool create_search(search *s, int n) {
    const int array_count = 5 + 2 * MEMORY;
    s->n = n;
    s->numbers = calloc((size_t)array_count * (size_t)n, sizeof *s->numbers);
    if (s->numbers == NULL) return false;
    double *next = s->numbers;
    double **const arrays[] = {&s->here.x, &s->here.gradient, &s->trial.x, &s->trial.gradient, &s->direction};
    for (int i = 0; i < 5; i++, next += n) *arrays[i] = next;
    for (int i = 0; i < MEMORY; i++, next += n) s->step[i] = next;
    for (int i = 0; i < MEMORY; i++, next += n) s->change[i] = next;
    return true;
}

/* direction = −H·gradient by the two loops of algorithm 7.4, H from the pairs kept. Without any, a step of length 1. */
static void find_direction(search *s) {
    const int n = s->n;
    const int first = s->pair_count > MEMORY ? s->pair_count - MEMORY : 0;
    double *d = s->direction;
    double alpha[MEMORY];
    for (int i = 0; i < n; i++) d[i] = -s->here.gradient[i];
    for (int pair = s->pair_count - 1; pair >= first; pair--) {
        const int k = pair % MEMORY;
        alpha[k] = dot(n, s->step[k], d) / s->curvature[k];
        add_scaled(n, -alpha[k], s->change[k], d);
    }
    double scale = 1 / sqrt(dot(n, d, d));
    if (s->pair_count > 0) {
        const int last = (s->pair_count - 1) % MEMORY;
        scale = s->curvature[last] / dot(n, s->change[last], s->change[last]);
    }
    for (int i = 0; i < n; i++) d[i] *= scale;
    for (int pair = first; pair < s->pair_count; pair++) {
        const int k = pair % MEMORY;
        const double beta = dot(n, s->change[k], d) / s->curvature[k];
        add_scaled(n, alpha[k] - beta, s->step[k], d);
    }
}

static void evaluate_trial(search *s, double length) {
    for (int i = 0; i < s->n; i++) s->trial.x[i] = s->here.x[i] + length * s->direction[i];
    s->trial.value = s->function(s->user, s->trial.x, s->trial.gradient);
    s->evaluations++;
}

/* Leaves in `trial` a point that is lower and less steep; false where none is found. */
static bool find_trial(search *s) {
    const double descent = dot(s->n, s->here.gradient, s->direction);
    double low = 0;
    double high = INFINITY;
    double length = 1;
    if (!(descent < 0)) return false;
    for (int trial = 0; trial < TRIALS_MAX; trial++) {
        evaluate_trial(s, length);
        if (!(s->trial.value <= s->here.value + 1e-4 * length * descent))
            high = length;
        else if (dot(s->n, s->trial.gradient, s->direction) < 0.9 * descent)
            low = length;
        else
            return true;
        length = isinf(high) ? 2 * low : 0.5 * (low + high);
    }
    return false;
}

/* Makes `trial` the point where the search stands and remembers the way there. */
static void move_to_trial(search *s) {
    const int k = s->pair_count % MEMORY;
    for (int i = 0; i < s->n; i++) {
        s->step[k][i] = s->trial.x[i] - s->here.x[i];
        s->change[k][i] = s->trial.gradient[i] - s->here.gradient[i];
    }
    s->curvature[k] = dot(s->n, s->step[k], s->change[k]);
    if (s->curvature[k] > 0) s->pair_count++;
    const point left = s->here;
    s->here = s->trial;
    s->trial = left;
}

mtm_status minimize(int n, minimize_function function, void *user, const minimize_options *options, double *x,
                    minimize_result *result, mtm_error *error) {
    search s = {.function = function, .user = user};
    if (!create_search(&s, n)) return fail_memory(error, "minimize");
    memcpy(s.here.x, x, (size_t)n * sizeof *x);
    s.here.value = function(user, s.here.x, s.here.gradient);
    s.evaluations = 1;
    double window_value = s.here.value;
    int iteration = 0;
    while (iteration < options->iterations_max) {
        find_direction(&s);
        if (!find_trial(&s)) break;
        move_to_trial(&s);
        if (++iteration % WINDOW != 0) continue;
        if (window_value - s.here.value < options->decrease_min * window_value) break;
        window_value = s.here.value;
    }
    memcpy(x, s.here.x, (size_t)n * sizeof *x);
    *result = (minimize_result){s.here.value, iteration, s.evaluations};
    free(s.numbers);
    return MTM_OK;
}
