/* SPDX-License-Identifier: BSD-3-Clause
 * Quadratic programs over curves: against an active-set method on dense matrices, the conditions that only the minimum
 * fulfils, and closed forms. */
#include "base/qp.h"

#include <math.h>
#include <stdlib.h>

#include "dense_qp.h"

enum {
    LENGTH = 81,
    CURVES = 5,
    SUMS = 24,
    PROGRAMS = 400,
};

/* A program with its numbers. */
typedef struct example {
    mtm_qp program;
    mtm_qp_curve curves[CURVES];
    mtm_qp_sum sums[SUMS];
    double x[CURVES][LENGTH], reference[CURVES][LENGTH], linear[CURVES][LENGTH];
    double weights[SUMS][MTM_QP_TERMS_MAX][LENGTH];
} example;

/* Numbers in 0 … 1 that look random and repeat (a linear congruence). */
static double next_number(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)*seed / 4294967296.0;
}

static double next_within(uint32_t *seed, double low, double high) {
    return low + (high - low) * next_number(seed);
}

static int next_choice(uint32_t *seed, int count) {
    return (int)(count * next_number(seed));
}

/* Curves in 0 … 1 with slope 1 and little size that begin at ½, and no sums yet. */
static example *create_example(int length, int curves) {
    example *e = calloc(1, sizeof *e);
    assert_non_null(e);
    e->program = (mtm_qp){.length = length, .curve_count = curves, .curves = e->curves, .sums = e->sums};
    for (int c = 0; c < curves; c++) {
        e->curves[c] = (mtm_qp_curve){.slope = 1, .size = 1e-3, .high = 1, .x = e->x[c]};
        for (int i = 0; i < length; i++) e->x[c][i] = 0.5;
    }
    return e;
}

/* A sum over the first `terms` curves, counted from `first` and round again, of weights that are still 0. */
static mtm_qp_sum *add_sum(example *e, int first, int terms, double low, double high, double give) {
    const int k = e->program.sum_count++;
    assert_in_range(k, 0, SUMS - 1);
    e->sums[k] = (mtm_qp_sum){.term_count = terms, .low = low, .high = high, .give = give};
    for (int t = 0; t < terms; t++) {
        e->sums[k].terms[t].curve = (first + t) % e->program.curve_count;
        e->sums[k].terms[t].weights = e->weights[k][t];
    }
    return &e->sums[k];
}

static void add_even_sum(example *e, int curve, double low, double high, double give) {
    double *weights = e->weights[e->program.sum_count][0];
    for (int i = 0; i < e->program.length; i++) weights[i] = 1;
    (void)add_sum(e, curve, 1, low, high, give);
}

static void minimize(example *e) {
    mtm_error error;
    assert_ok(mtm_qp_minimize(&e->program, &error), error);
}

static double sum_value(const mtm_qp *program, const mtm_qp_sum *sum) {
    double value = 0;
    for (int t = 0; t < sum->term_count; t++)
        for (int i = 0; i < program->length; i++)
            value += sum->terms[t].weights[i] * program->curves[sum->terms[t].curve].x[i];
    return value;
}

static double sum_lack(const mtm_qp *program, const mtm_qp_sum *sum) {
    const double value = sum_value(program, sum);
    return clamp(value, sum->low, sum->high) - value;
}

/* √Σ lack². */
static double distance(const mtm_qp *program) {
    double sum = 0;
    for (int k = 0; k < program->sum_count; k++) sum += pow(sum_lack(program, &program->sums[k]), 2);
    return sqrt(sum);
}

/* The conditions of Karush, Kuhn and Tucker, which hold at the minimum only: how much they are violated, the gradient
 * relative to the largest that a sum adds to it. */
static double optimality_error(const mtm_qp *program) {
    double worst = 0;
    for (int c = 0; c < program->curve_count; c++) {
        const mtm_qp_curve *curve = &program->curves[c];
        double gradient[LENGTH];
        double scale = 1;
        fill_cost_gradient(program->length, curve, curve->x, gradient);
        for (int k = 0; k < program->sum_count; k++)
            for (int t = 0; t < program->sums[k].term_count; t++)
                for (int i = 0; i < program->length && program->sums[k].terms[t].curve == c; i++) {
                    const double pull = program->sums[k].multiplier * program->sums[k].terms[t].weights[i];
                    gradient[i] -= pull;
                    scale = fmax(scale, fabs(pull));
                }
        for (int i = 0; i < program->length; i++) {
            assert_true(curve->x[i] >= curve->low && curve->x[i] <= curve->high);
            const double violation = curve->x[i] == curve->low    ? -gradient[i]
                                     : curve->x[i] == curve->high ? gradient[i]
                                                                  : fabs(gradient[i]);
            worst = fmax(worst, violation / scale);
        }
    }
    return worst;
}

/* How much lack = give·multiplier is violated, which is the condition of the sums: it says that a sum within its range
 * has the multiplier 0, and which sign the others have. */
static double sums_error(const mtm_qp *program) {
    double worst = 0;
    for (int k = 0; k < program->sum_count; k++) {
        const mtm_qp_sum *sum = &program->sums[k];
        double scale = 1; /* of what is summed: rounding is as large as that */
        for (int t = 0; t < sum->term_count; t++)
            for (int i = 0; i < program->length; i++)
                scale += fabs(sum->terms[t].weights[i] * program->curves[sum->terms[t].curve].x[i]);
        worst = fmax(worst, fabs(sum_lack(program, sum) - sum->give * sum->multiplier) / scale);
        const double slack =
            sum->multiplier > 0 ? sum_value(program, sum) - sum->low : sum->high - sum_value(program, sum);
        if (sum->multiplier != 0) worst = fmax(worst, fmin(fabs(sum->multiplier), slack) / scale);
    }
    return worst;
}

/* The largest difference of a sample from the dense solver's. */
static double difference_from_dense(const mtm_qp *program) {
    dense *d = create_dense(program);
    minimize_dense(d);
    double worst = 0;
    for (int c = 0; c < program->curve_count; c++)
        for (int i = 0; i < program->length; i++)
            worst = fmax(worst, fabs(d->value[c * program->length + i] - program->curves[c].x[i]));
    free(d);
    return worst;
}

static void choose_curve(example *e, int c, uint32_t *seed) {
    static const double bounds[][2] = {
        {0, 1}, {0, 20}, {-3, INFINITY}, {-INFINITY, 2}, {-INFINITY, INFINITY}};
    const double *chosen = bounds[next_choice(seed, 5)];
    mtm_qp_curve *curve = &e->curves[c];
    curve->low = chosen[0];
    curve->high = chosen[1];
    curve->slope = next_choice(seed, 2);
    curve->curvature = next_choice(seed, 2) * 3.0;
    curve->size = pow(10, next_within(seed, -3, 1));
    for (int i = 0; i < e->program.length; i++) {
        e->reference[c][i] = next_within(seed, -1, 3);
        e->linear[c][i] = next_within(seed, -1, 1);
    }
    curve->reference = next_choice(seed, 2) ? e->reference[c] : NULL;
    curve->linear = next_choice(seed, 2) ? e->linear[c] : NULL;
}

/* A sum with a range about the value that curves within their bounds have, so that all can be kept, moved by `shift`. */
static void choose_sum(example *e, double shift, double give, uint32_t *seed) {
    const int curves = e->program.curve_count;
    const int terms = 1 + next_choice(seed, curves < MTM_QP_TERMS_MAX ? curves : MTM_QP_TERMS_MAX);
    const double lowest = next_choice(seed, 2) - 1; /* half of the sums have no negative weights */
    for (int t = 0; t < terms; t++)
        for (int i = 0; i < e->program.length; i++)
            e->weights[e->program.sum_count][t][i] = next_within(seed, lowest, 1);
    mtm_qp_sum *sum = add_sum(e, next_choice(seed, curves), terms, 0, 0, give);
    const double value = sum_value(&e->program, sum) + next_within(seed, -shift, shift);
    const int kind = next_choice(seed, 4);
    sum->low = kind == 1 ? -INFINITY : kind == 2 ? value - 0.1 : value;
    sum->high = kind == 3 ? INFINITY : kind == 2 ? value + 0.1 : value;
}

/* 1 to 4 curves of 5 to 20 samples and up to 8 sums. */
static example *create_random(uint32_t *seed, double shift, double give) {
    example *e = create_example(5 + next_choice(seed, 16), 1 + next_choice(seed, 4));
    for (int c = 0; c < e->program.curve_count; c++) {
        choose_curve(e, c, seed);
        for (int i = 0; i < e->program.length; i++)
            e->x[c][i] = next_within(seed, fmax(e->curves[c].low, -4), fmin(e->curves[c].high, 4));
    }
    const int sums = next_choice(seed, 9);
    for (int k = 0; k < sums; k++) choose_sum(e, shift, give, seed);
    return e;
}

/* What is coupled as in a palette: five curves of 81 samples, each with three sums that are a color under a light, three
 * sums over all first three curves with the same value, and three ranges; `give` as small as is used. */
static example *create_palette(double shift, uint32_t *seed) {
    example *e = create_example(LENGTH, CURVES);
    for (int k = 0; k < 21; k++) {
        const int terms = k < 15 ? 1 : k < 18 ? 3 : 2;
        const double peak = 15 + 25 * (k % 3);
        for (int t = 0; t < terms; t++)
            for (int i = 0; i < LENGTH; i++)
                e->weights[k][t][i] = exp(-pow((i - peak) / 9, 2)) * (0.02 + 0.05 * next_number(seed));
        mtm_qp_sum *sum = add_sum(e, k < 15 ? k / 3 : 0, terms, 0, 0, 1e-9);
        for (int c = 0; c < CURVES; c++)
            for (int i = 0; i < LENGTH; i++) e->x[c][i] = 0.5 + 0.45 * sin(0.1 * i * (c + 1) + c);
        sum->low = sum->high = sum_value(&e->program, sum) + next_within(seed, -shift, shift);
    }
    return e;
}

static void check_minimum(const example *e, double dense_tolerance) {
    assert_float_equal(optimality_error(&e->program), 0, 1e-9);
    assert_float_equal(sums_error(&e->program), 0, 1e-9);
    if (dense_tolerance > 0) assert_float_equal(difference_from_dense(&e->program), 0, dense_tolerance);
}

static void random_programs_have_the_minimum_of_the_dense_solver(void **state) {
    (void)state;
    uint32_t seed = 7;
    for (int p = 0; p < PROGRAMS; p++) {
        example *e = create_random(&seed, 0, pow(10, next_within(&seed, -9, 1)));
        minimize(e);
        check_minimum(e, 1e-8);
        free(e);
    }
}

/* Every other program has multipliers of 1e9, and that much more of rounding is in what the sums do not fix. */
static void sums_that_contradict_each_other_are_kept_as_nearly_as_the_dense_solver_does(void **state) {
    (void)state;
    uint32_t seed = 8;
    int contradictions = 0;
    for (int p = 0; p < PROGRAMS; p++) {
        example *e = create_random(&seed, 9, p % 2 ? 1e-9 : pow(10, next_within(&seed, -6, 1)));
        minimize(e);
        check_minimum(e, p % 2 ? 1e-5 : 1e-7);
        contradictions += e->program.sum_count > 0 && e->sums[0].give == 1e-9 && distance(&e->program) > 0.1;
        free(e);
    }
    assert_in_range(contradictions, 20, PROGRAMS);
}

static void bounds_weights_and_costs_may_be_of_different_size(void **state) {
    (void)state;
    uint32_t seed = 9;
    for (int p = 0; p < PROGRAMS; p++) {
        example *e = create_random(&seed, 0, 1e-9);
        const double cost = pow(10, next_within(&seed, -3, 3));
        for (int c = 0; c < e->program.curve_count; c++) {
            e->curves[c].slope *= cost;
            e->curves[c].curvature *= cost;
            e->curves[c].size *= cost;
        }
        for (int k = 0; k < e->program.sum_count; k++) {
            const double scale = pow(10, next_within(&seed, -3, 3));
            for (int t = 0; t < MTM_QP_TERMS_MAX; t++)
                for (int i = 0; i < LENGTH; i++) e->weights[k][t][i] *= scale;
            e->sums[k].low *= scale;
            e->sums[k].high *= scale;
        }
        minimize(e);
        check_minimum(e, 1e-6);
        free(e);
    }
}

static void curves_as_of_a_palette_fulfil_the_conditions_of_the_minimum(void **state) {
    (void)state;
    uint32_t seed = 5;
    for (int p = 0; p < 20; p++) {
        example *e = create_palette(p < 10 ? 0 : 0.05, &seed);
        minimize(e);
        check_minimum(e, 0);
        for (int k = 0; k < e->program.sum_count && p < 10; k++)
            assert_float_equal(sum_lack(&e->program, &e->sums[k]), 0, 1e-8);
        free(e);
    }
}

/* With one give for all sums their multipliers are the direction to what is wanted from the nearest that exists, and this
 * plane is what parts them (Farkas), so that its distance is theirs. */
static void contradiction_is_the_distance_of_what_is_wanted_from_what_exists(void **state) {
    (void)state;
    uint32_t seed = 6;
    for (int p = 0; p < PROGRAMS; p++) {
        const bool is_shifted = p % 2 != 0;
        example *e = create_example(5 + next_choice(&seed, 16), 1 + next_choice(&seed, 4));
        for (int c = 0; c < e->program.curve_count; c++)
            for (int i = 0; i < e->program.length; i++) e->x[c][i] = next_number(&seed);
        for (int k = 0; k < 6; k++) choose_sum(e, is_shifted ? 20 : 0, 1e-9, &seed);
        minimize(e);
        const double contradiction = mtm_qp_contradiction(&e->program);
        if (distance(&e->program) > 1e-6) {
            assert_float_equal(contradiction, distance(&e->program), 1e-7);
        } else {
            assert_true(contradiction < 1e-7);
        }
        if (!is_shifted) assert_true(distance(&e->program) < 1e-6);
        free(e);
    }
}

/* Whatever the curves are, the multipliers' combination of what the sums lack is at least the contradiction. */
static void no_curves_lack_less_than_the_contradiction(void **state) {
    (void)state;
    uint32_t seed = 4;
    example *e = create_palette(0.5, &seed);
    minimize(e);
    const double contradiction = mtm_qp_contradiction(&e->program);
    assert_true(contradiction > 0.1);
    double length = 0;
    for (int k = 0; k < e->program.sum_count; k++) length += pow(e->sums[k].multiplier, 2);
    for (int trial = 0; trial < 1000; trial++) {
        for (int c = 0; c < CURVES; c++)
            for (int i = 0; i < LENGTH; i++) e->x[c][i] = next_choice(&seed, 2);
        double lack = 0;
        for (int k = 0; k < e->program.sum_count; k++)
            lack += e->sums[k].multiplier * sum_lack(&e->program, &e->sums[k]) / sqrt(length);
        assert_true(lack >= contradiction);
    }
    free(e);
}

/* Twenty samples have sums of 0 to 20. Wanting 6 and 10 of the same samples leaves what lies between them as the gives
 * divide it; another curve that can have what is wanted of it has multipliers of ordinary size. */
static void only_sums_that_contradict_each_other_have_large_multipliers(void **state) {
    (void)state;
    example *e = create_example(20, 2);
    add_even_sum(e, 0, 6, 6, 1e-9);
    add_even_sum(e, 0, 10, 10, 3e-9);
    add_even_sum(e, 1, 8, 8, 1e-9);
    add_even_sum(e, 0, 3, 12, 1e-9);
    minimize(e);
    for (int i = 0; i < 20; i++) assert_float_equal(e->x[0][i], 7.0 / 20, 1e-8);
    for (int i = 0; i < 20; i++) assert_float_equal(e->x[1][i], 8.0 / 20, 1e-8);
    assert_float_equal(e->sums[0].multiplier * 1e-9, -1, 1e-8);
    assert_float_equal(e->sums[1].multiplier * 3e-9, 3, 1e-8);
    assert_float_equal(e->sums[2].multiplier, 1e-3 * 8 / 20, 1e-6);
    assert_true(e->sums[3].multiplier == 0);
    assert_float_equal(mtm_qp_contradiction(&e->program), 4 / sqrt(2), 1e-8);
    free(e);
}

static void a_sum_beyond_the_bounds_puts_all_samples_on_them(void **state) {
    (void)state;
    for (int side = 0; side < 2; side++) {
        for (int power = -12; power <= 2; power++) {
            const double give = pow(10, power);
            example *e = create_example(20, 1);
            e->curves[0].size = 1e-6;
            add_even_sum(e, 0, side == 0 ? -INFINITY : 30, side == 0 ? -10 : INFINITY, give);
            minimize(e);
            for (int i = 0; i < 20; i++) assert_true(e->x[0][i] == side);
            assert_float_equal(mtm_qp_contradiction(&e->program), 10, 1e-7);
            free(e);
        }
    }
}

/* Without bounds the minimum solves (H + Σ w wᵀ/give) x = H r − l + Σ w·value/give. */
static void curves_without_bounds_solve_a_linear_system(void **state) {
    (void)state;
    uint32_t seed = 3;
    for (int p = 0; p < 50; p++) {
        example *e = create_random(&seed, 0, 0.1);
        for (int c = 0; c < e->program.curve_count; c++) {
            e->curves[c].low = -INFINITY;
            e->curves[c].high = INFINITY;
        }
        for (int k = 0; k < e->program.sum_count; k++) e->sums[k].low = e->sums[k].high = next_number(&seed);
        minimize(e);
        dense *d = create_dense(&e->program);
        for (int i = 0; i < d->sample_count; i++)
            for (int k = 0; k < d->sum_count; k++) {
                d->pull[i] += d->rows[k][i] * e->sums[k].low / 0.1;
                for (int j = 0; j < d->sample_count; j++)
                    d->hessian[i][j] += d->rows[k][i] * d->rows[k][j] / 0.1;
            }
        solve_dense(d->sample_count, d->hessian, d->pull);
        for (int i = 0; i < d->sample_count; i++)
            assert_float_equal(e->x[i / e->program.length][i % e->program.length], d->pull[i], 1e-8);
        free(d);
        free(e);
    }
}

/* Twice the same sum, sums that add up to another one, weights of 0, and a sum that may have any value. */
static void sums_may_depend_on_each_other(void **state) {
    (void)state;
    uint32_t seed = 2;
    for (int p = 0; p < 100; p++) {
        example *e = create_random(&seed, 0, pow(10, -6 - p % 7));
        if (e->program.sum_count < 4) choose_sum(e, 0, 1e-9, &seed);
        const mtm_qp_sum first = e->sums[0];
        for (int k = 0; k < 3; k++) e->sums[e->program.sum_count++] = first;
        mtm_qp_sum *empty = add_sum(e, 0, 1, 0, 0, first.give);
        mtm_qp_sum *any = add_sum(e, 0, 1, -INFINITY, INFINITY, first.give);
        any->terms[0].weights = first.terms[0].weights;
        minimize(e);
        check_minimum(e, 1e-7);
        assert_true(fabs(empty->multiplier) < 1e-9 && any->multiplier == 0);
        free(e);
    }
}

static void the_minimum_does_not_depend_on_the_guess(void **state) {
    (void)state;
    uint32_t seed = 12;
    for (int p = 0; p < 100; p++) {
        example *e = create_random(&seed, 0, 1e-6);
        for (int c = 0; c < e->program.curve_count; c++)
            for (int i = 0; i < e->program.length; i++) e->x[c][i] = next_within(&seed, -1e4, 1e4);
        minimize(e);
        check_minimum(e, 1e-8);
        free(e);
    }
}

static void the_minimum_repeats_bit_by_bit(void **state) {
    (void)state;
    uint32_t seed = 13, again = 13;
    example *first = create_palette(0.01, &seed);
    example *second = create_palette(0.01, &again);
    minimize(first);
    minimize(second);
    assert_memory_equal(first->x, second->x, sizeof first->x);
    for (int k = 0; k < first->program.sum_count; k++)
        assert_true(first->sums[k].multiplier == second->sums[k].multiplier);
    free(first);
    free(second);
}

/* The largest Σ value·x with Σ weight·x = budget and 0 ≤ x ≤ 1 takes the samples in the order of value/weight, the last
 * one in part (Dantzig's knapsack). Proximal steps, each about the minimum before, get there (Rockafellar, 1976). */
static void proximal_steps_solve_a_linear_program(void **state) {
    (void)state;
    enum { N = 40 };
    uint32_t seed = 14;
    example *e = create_example(N, 1);
    double *weights = e->weights[0][0];
    for (int i = 0; i < N; i++) weights[i] = next_within(&seed, 0.5, 2);
    for (int i = 0; i < N; i++) e->linear[0][i] = -next_within(&seed, 0.1, 1);
    double left = 17.3;
    (void)add_sum(e, 0, 1, left, left, 1e-9);
    e->curves[0] = (mtm_qp_curve){
        .size = 1e-3, .linear = e->linear[0], .reference = e->reference[0], .high = 1, .x = e->x[0]};
    for (int step = 0; step < 8; step++) {
        memcpy(e->reference[0], e->x[0], sizeof e->x[0]);
        minimize(e);
    }
    bool is_taken[N] = {false};
    for (int taken = 0; taken < N; taken++) {
        int best = -1;
        for (int i = 0; i < N; i++)
            if (!is_taken[i] &&
                (best < 0 || e->linear[0][i] / weights[i] < e->linear[0][best] / weights[best]))
                best = i;
        const double part = clamp(left / weights[best], 0, 1);
        assert_float_equal(e->x[0][best], part, 1e-9);
        left -= part * weights[best];
        is_taken[best] = true;
    }
    free(e);
}

static void numbers_of_too_different_size_are_refused(void **state) {
    (void)state;
    mtm_error error;
    example *e = create_example(5, 1);
    add_even_sum(e, 0, 1, 1, 1e-9);
    e->weights[0][0][2] = 1e200;
    assert_fails(mtm_qp_minimize(&e->program, &error), MTM_NUMERIC, error,
                 "1 curves and 1 sums does not settle");
    free(e);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_programs_have_the_minimum_of_the_dense_solver),
        cmocka_unit_test(sums_that_contradict_each_other_are_kept_as_nearly_as_the_dense_solver_does),
        cmocka_unit_test(bounds_weights_and_costs_may_be_of_different_size),
        cmocka_unit_test(curves_as_of_a_palette_fulfil_the_conditions_of_the_minimum),
        cmocka_unit_test(contradiction_is_the_distance_of_what_is_wanted_from_what_exists),
        cmocka_unit_test(no_curves_lack_less_than_the_contradiction),
        cmocka_unit_test(only_sums_that_contradict_each_other_have_large_multipliers),
        cmocka_unit_test(a_sum_beyond_the_bounds_puts_all_samples_on_them),
        cmocka_unit_test(curves_without_bounds_solve_a_linear_system),
        cmocka_unit_test(sums_may_depend_on_each_other),
        cmocka_unit_test(the_minimum_does_not_depend_on_the_guess),
        cmocka_unit_test(the_minimum_repeats_bit_by_bit),
        cmocka_unit_test(proximal_steps_solve_a_linear_program),
        cmocka_unit_test(numbers_of_too_different_size_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
