/* SPDX-License-Identifier: BSD-3-Clause
 * Goals as rows of quadratic programs. With material ρ and light E of a cell moved together, its color
 * c(ρ + δ, E + ε) = c + c(δ, E) + c(ρ, ε) + c(δ, ε), and the last term is left out. */
#include "palette/linearize.h"

#include <math.h>
#include <string.h>

enum { N = MTM_SPECTRUM_SAMPLES, CHANNELS = MTM_COLOR_CHANNELS };

/* CIEDE2000 by which colors are to differ more than was asked, so that what is nearly met is met. */
static const double margin = 0.05;

static void wanted_color(const mtm_goal *goal, mtm_color color) {
    const mtm_rgb rgb = mtm_rgb_from_xyz(goal->color);
    color[0] = rgb.r;
    color[1] = rgb.g;
    color[2] = rgb.b;
}

/* The color of the goal's cell, and the one it is compared with. */
static void compared_colors(const mtm_color_view *view, const mtm_goal *goal, const mtm_cell_spectra cells[2],
                            mtm_color own, mtm_color other) {
    mtm_color_view_cell(view, cells[0].light, cells[0].material, own);
    if (goal->kind == MTM_GOAL_COLOR)
        wanted_color(goal, other);
    else if (goal->other.material < 0)
        memset(other, 0, sizeof(mtm_color));
    else
        mtm_color_view_cell(view, cells[1].light, cells[1].material, other);
}

/* The metric in which a miss is measured: that of the wanted color, or of the middle of two that are to be the same. */
static void goal_metric(const mtm_goal *goal, const mtm_color own, const mtm_color other,
                        double metric[3][3]) {
    mtm_color middle;
    for (int c = 0; c < CHANNELS; c++)
        middle[c] = goal->kind == MTM_GOAL_COLOR ? other[c] : fmax(0, own[c] + other[c]) / 2;
    mtm_color_metric(middle, metric);
}

double mtm_goal_miss(const mtm_color_view *view, const mtm_goal *goal, const mtm_cell_spectra cells[2]) {
    mtm_color own;
    mtm_color other;
    double metric[3][3];
    compared_colors(view, goal, cells, own, other);
    if (goal->kind == MTM_GOAL_DIFFERENT)
        return fmax(0, goal->least + margin - mtm_color_difference(own, other));
    goal_metric(goal, own, other, metric);
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        double part = 0;
        for (int c = 0; c < CHANNELS; c++) part += metric[i][c] * (own[c] - other[c]);
        sum += part * part;
    }
    return sqrt(sum);
}

/* Adds factor · weights to the row's weights of a curve. */
static void add_weights(mtm_goal_row *row, int curve, double factor, const mtm_samples weights) {
    int term = 0;
    while (term < row->term_count && row->curves[term] != curve) term++;
    if (term == row->term_count) {
        row->term_count++;
        row->curves[term] = curve;
        memset(row->weights[term], 0, sizeof row->weights[term]);
    }
    for (int i = 0; i < N; i++) row->weights[term][i] += factor * weights[i];
}

/* How the color of a cell depends on what moves of it. */
typedef struct cell_slopes {
    mtm_color_weights material, light;
} cell_slopes;

static void find_slopes(const mtm_color_view *view, const mtm_cell_spectra *cell, cell_slopes *slopes) {
    if (cell->material_curve >= 0) mtm_color_view_material(view, cell->light, slopes->material);
    if (cell->light_curve >= 0) mtm_color_view_light(view, cell->material, slopes->light);
}

/* Adds the change of Σ factors · color of the cell to the row. */
static void add_cell(mtm_goal_row *row, const mtm_cell_spectra *cell, const cell_slopes *slopes,
                     const mtm_color factors) {
    for (int c = 0; c < CHANNELS; c++) {
        if (cell->material_curve >= 0)
            add_weights(row, cell->material_curve, factors[c], slopes->material[c]);
        if (cell->light_curve >= 0) add_weights(row, cell->light_curve, factors[c], slopes->light[c]);
    }
}

/* What the row's sum is at the curves as they are. */
static double present_sum(const mtm_goal_row *row, const mtm_spectrum *curves) {
    double sum = 0;
    for (int t = 0; t < row->term_count; t++)
        for (int i = 0; i < N; i++) sum += row->weights[t][i] * curves[row->curves[t]].value[i];
    return sum;
}

/* Colors that are the same have no direction in which they differ fastest: one of eight is chosen. */
static void parting_direction(int turn, double direction[3]) {
    static const double directions[8][3] = {{0, 1, 0},     {0, -1, 0},      {0, 0, 1},     {0, 0, -1},
                                            {0.6, 0.8, 0}, {-0.6, -0.8, 0}, {0, 0.7, 0.7}, {0, -0.7, 0.7}};
    memcpy(direction, directions[turn % 8], sizeof directions[0]);
}

/* The derivatives of the difference by both colors. */
static void parting_slopes(const mtm_color own, const mtm_color other, double difference, int turn,
                           mtm_color by_own, mtm_color by_other) {
    static const double same = 0.5; /* CIEDE2000 */
    if (difference > same) {
        mtm_color_difference_slopes(own, other, by_own, by_other);
        return;
    }
    double metric[3][3];
    double direction[3];
    mtm_color_metric(own, metric);
    parting_direction(turn, direction);
    for (int c = 0; c < CHANNELS; c++) {
        by_own[c] = 0;
        for (int i = 0; i < 3; i++) by_own[c] += direction[i] * metric[i][c];
        by_other[c] = -by_own[c];
    }
}

static int linearize_difference(const mtm_goal *goal, const mtm_cell_spectra cells[2],
                                const cell_slopes slopes[2], const mtm_color own, const mtm_color other,
                                const mtm_spectrum *curves, int turn, mtm_goal_row *row) {
    mtm_color by_own;
    mtm_color by_other;
    const double difference = mtm_color_difference(own, other);
    parting_slopes(own, other, difference, turn, by_own, by_other);
    row->term_count = 0;
    add_cell(row, &cells[0], &slopes[0], by_own);
    if (goal->other.material >= 0) add_cell(row, &cells[1], &slopes[1], by_other);
    row->low = present_sum(row, curves) + goal->least + margin - difference;
    row->high = INFINITY;
    return row->term_count > 0 ? 1 : 0;
}

int mtm_goal_linearize(const mtm_color_view *view, const mtm_goal *goal, const mtm_cell_spectra cells[2],
                       const mtm_spectrum *curves, int turn, mtm_goal_row rows[MTM_GOAL_ROWS]) {
    mtm_color own;
    mtm_color other;
    cell_slopes slopes[2];
    double metric[3][3];
    compared_colors(view, goal, cells, own, other);
    for (int k = 0; k < 2; k++) find_slopes(view, &cells[k], &slopes[k]);
    if (goal->kind == MTM_GOAL_DIFFERENT)
        return linearize_difference(goal, cells, slopes, own, other, curves, turn, rows);
    goal_metric(goal, own, other, metric);
    for (int i = 0; i < 3; i++) {
        const mtm_color opposite = {-metric[i][0], -metric[i][1], -metric[i][2]};
        double lack = 0;
        for (int c = 0; c < CHANNELS; c++) lack += metric[i][c] * (other[c] - own[c]);
        rows[i].term_count = 0;
        add_cell(&rows[i], &cells[0], &slopes[0], metric[i]);
        if (goal->kind == MTM_GOAL_SAME) add_cell(&rows[i], &cells[1], &slopes[1], opposite);
        rows[i].low = rows[i].high = present_sum(&rows[i], curves) + lack;
    }
    return rows[0].term_count > 0 ? MTM_GOAL_ROWS : 0;
}

void mtm_samples_luminance(mtm_samples weights) {
    mtm_observer observer;
    double sum = 0;
    memset(weights, 0, sizeof(mtm_samples));
    if (mtm_observer_get("cie1931", &observer, NULL) != MTM_OK) return; /* built in, always there */
    for (int i = 0; i < N; i++) sum += observer.y.value[i];
    for (int i = 0; i < N; i++) weights[i] = observer.y.value[i] / sum;
}
