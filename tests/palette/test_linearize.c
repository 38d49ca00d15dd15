/* SPDX-License-Identifier: BSD-3-Clause
 * Goals as rows: exact where one of light and reflectance moves, right to first order where both do. */
#include <math.h>

#include "palette/linearize.h"
#include "test.h"

enum { N = MTM_SPECTRUM_SAMPLES, CURVES = 4 };

/* Two materials (curves 0 and 1) under two lights (2 and 3). */
typedef struct setup {
    mtm_color_view view;
    mtm_spectrum curves[CURVES];
    uint32_t seed;
} setup;

static double next_number(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)*seed / 4294967296.0;
}

static setup make_setup(uint32_t seed) {
    setup s = {.seed = seed};
    mtm_error error;
    assert_ok(mtm_color_view_full(&s.view, &error), error);
    for (int c = 0; c < CURVES; c++) {
        const double phase = 6 * next_number(&s.seed), speed = 9 * next_number(&s.seed);
        for (int i = 0; i < N; i++) s.curves[c].value[i] = 0.5 + 0.4 * sin(phase + speed * i / N);
    }
    return s;
}

static void cells_of(const setup *s, const mtm_goal *goal, unsigned moving, mtm_cell_spectra cells[2]) {
    const mtm_cell both[2] = {goal->cell, goal->other.material >= 0 ? goal->other : goal->cell};
    for (int k = 0; k < 2; k++) {
        const int material = both[k].material, light = 2 + both[k].light;
        cells[k] =
            (mtm_cell_spectra){s->curves[material].value, s->curves[light].value,
                               moving >> material & 1 ? material : -1, moving >> light & 1 ? light : -1};
    }
}

static double row_value(const mtm_goal_row *row, const mtm_spectrum *curves) {
    double sum = 0;
    for (int t = 0; t < row->term_count; t++)
        for (int i = 0; i < N; i++) sum += row->weights[t][i] * curves[row->curves[t]].value[i];
    return sum;
}

/* What the rows lack, as a length. */
static double rows_lack(const mtm_goal_row *rows, int count, const mtm_spectrum *curves) {
    double sum = 0;
    for (int r = 0; r < count; r++) {
        const double value = row_value(&rows[r], curves);
        const double lack = fmax(0, rows[r].low - value) + fmax(0, value - rows[r].high);
        sum += lack * lack;
    }
    return sqrt(sum);
}

static void nudge(setup *s, unsigned moving, double amount) {
    for (int c = 0; c < CURVES; c++)
        for (int i = 0; i < N && (moving >> c & 1); i++)
            s->curves[c].value[i] += amount * (next_number(&s->seed) - 0.5);
}

static const mtm_goal color_goal = {
    .kind = MTM_GOAL_COLOR, .cell = {0, 0}, .color = {0.3, 0.25, 0.2}, .other = {-1, -1}, .weight = 1};
static const mtm_goal same_goal = {.kind = MTM_GOAL_SAME, .cell = {0, 0}, .other = {1, 1}, .weight = 1};
static const mtm_goal constant_goal = {.kind = MTM_GOAL_SAME, .cell = {0, 0}, .other = {0, 1}, .weight = 1};
static const mtm_goal different_goal = {
    .kind = MTM_GOAL_DIFFERENT, .cell = {0, 0}, .other = {1, 1}, .least = 60, .weight = 1};
static const mtm_goal bright_goal = {
    .kind = MTM_GOAL_DIFFERENT, .cell = {0, 0}, .other = {-1, -1}, .least = 99, .weight = 1};

/* The rows lack what the goal misses, at the curves and after a large step of materials or of lights alone. */
static void check_exact(const mtm_goal *goal, unsigned moving) {
    setup s = make_setup(5);
    mtm_goal_row rows[MTM_GOAL_ROWS];
    mtm_cell_spectra cells[2];
    cells_of(&s, goal, moving, cells);
    const int count = mtm_goal_linearize(&s.view, goal, cells, s.curves, 0, rows);
    assert_int_equal(count, 3);
    assert_float_equal(rows_lack(rows, count, s.curves), mtm_goal_miss(&s.view, goal, cells), 1e-9);
    if (goal->kind == MTM_GOAL_COLOR) { /* its metric stays where it is */
        nudge(&s, moving, 0.5);
        assert_float_equal(rows_lack(rows, count, s.curves), mtm_goal_miss(&s.view, goal, cells), 1e-9);
    }
    mtm_color_view_free(&s.view);
}

static void colors_are_exact_where_materials_or_lights_move(void **state) {
    (void)state;
    check_exact(&color_goal, 1u << 0);
    check_exact(&color_goal, 1u << 2);
    check_exact(&same_goal, 1u << 0 | 1u << 1);
    check_exact(&same_goal, 1u << 2 | 1u << 3);
    check_exact(&constant_goal, 1u << 0);
}

/* The error of the linear rows falls with the square of the step. */
static void check_first_order(const mtm_goal *goal, unsigned moving) {
    double errors[2];
    for (int k = 0; k < 2; k++) {
        setup s = make_setup(6);
        mtm_goal_row rows[MTM_GOAL_ROWS];
        mtm_cell_spectra cells[2];
        cells_of(&s, goal, moving, cells);
        const int count = mtm_goal_linearize(&s.view, goal, cells, s.curves, 0, rows);
        assert_true(count > 0);
        nudge(&s, moving, k == 0 ? 0.02 : 0.002);
        errors[k] = fabs(rows_lack(rows, count, s.curves) - mtm_goal_miss(&s.view, goal, cells));
        mtm_color_view_free(&s.view);
    }
    if (!(errors[1] < errors[0] / 30 || errors[1] < 1e-9)) fail_msg("errors %g and %g", errors[0], errors[1]);
}

static void all_goals_are_right_to_first_order(void **state) {
    (void)state;
    const unsigned all = 15;
    check_first_order(&color_goal, all);
    check_first_order(&different_goal, all);
    check_first_order(&bright_goal, all);
}

/* Colors that are the same have a direction to part in, another one in another turn. */
static void equal_colors_are_parted_in_turns(void **state) {
    (void)state;
    setup s = make_setup(7);
    mtm_goal_row first[MTM_GOAL_ROWS], second[MTM_GOAL_ROWS];
    mtm_cell_spectra cells[2];
    s.curves[1] = s.curves[0];
    s.curves[3] = s.curves[2];
    cells_of(&s, &different_goal, 15, cells);
    assert_int_equal(mtm_goal_linearize(&s.view, &different_goal, cells, s.curves, 0, first), 1);
    assert_int_equal(mtm_goal_linearize(&s.view, &different_goal, cells, s.curves, 1, second), 1);
    assert_float_equal(row_value(&first[0], s.curves), 0, 1e-9);
    assert_float_equal(first[0].low, 60, 0.1);
    double product = 0, length = 0;
    for (int i = 0; i < N; i++) {
        product += first[0].weights[0][i] * second[0].weights[0][i];
        length += first[0].weights[0][i] * first[0].weights[0][i];
    }
    assert_true(length > 0);
    assert_true(product < 0.5 * length);
    mtm_color_view_free(&s.view);
}

static void what_does_not_move_has_no_rows(void **state) {
    (void)state;
    setup s = make_setup(8);
    mtm_goal_row rows[MTM_GOAL_ROWS];
    mtm_cell_spectra cells[2];
    cells_of(&s, &same_goal, 0, cells);
    assert_int_equal(mtm_goal_linearize(&s.view, &same_goal, cells, s.curves, 0, rows), 0);
    assert_true(mtm_goal_miss(&s.view, &same_goal, cells) > 0);
    mtm_color_view_free(&s.view);
}

static void the_luminance_of_white_light_is_one(void **state) {
    (void)state;
    mtm_samples weights, samples;
    mtm_spectrum light;
    mtm_error error;
    double sum = 0;
    mtm_samples_luminance(weights);
    assert_ok(mtm_illuminant("FL11", &light, &error), error);
    assert_true(mtm_samples_of_light(&light, samples));
    for (int i = 0; i < N; i++) sum += weights[i] * samples[i];
    assert_float_equal(sum, 1, 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colors_are_exact_where_materials_or_lights_move),
        cmocka_unit_test(all_goals_are_right_to_first_order),
        cmocka_unit_test(equal_colors_are_parted_in_turns),
        cmocka_unit_test(what_does_not_move_has_no_rows),
        cmocka_unit_test(the_luminance_of_white_light_is_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
