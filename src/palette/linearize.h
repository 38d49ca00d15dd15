/* SPDX-License-Identifier: BSD-3-Clause
 * Goals as weighted sums of the samples of spectra, for small steps of these. */
#ifndef METAMER_PALETTE_LINEARIZE_H
#define METAMER_PALETTE_LINEARIZE_H

#include "metamer/palette.h"
#include "palette/view.h"

enum {
    MTM_GOAL_ROWS = 3,   /* sums of a goal, at most */
    MTM_GOAL_CURVES = 4, /* spectra in a goal: two materials, two lights */
};

/* The spectra of a cell, and which of the curves that may move they are; -1: they do not move. */
typedef struct mtm_cell_spectra {
    const double *material, *light;
    int material_curve, light_curve;
} mtm_cell_spectra;

/* A sum of weighted samples that is wanted in low … high, in units of CIEDE2000. */
typedef struct mtm_goal_row {
    int term_count;
    int curves[MTM_GOAL_CURVES];
    mtm_samples weights[MTM_GOAL_CURVES];
    double low, high;
    double give; /* the caller's */
} mtm_goal_row;

/* How far the goal is from being met in this view: CIEDE2000 in the metric of the wanted color, or what lacks of `least` and a
 * little more. */
double mtm_goal_miss(const mtm_color_view *view, const mtm_goal *goal, const mtm_cell_spectra cells[2]);

/* The goal as up to MTM_GOAL_ROWS rows that hold for small steps of the curves from `curves` (for any steps, where only
 * materials or only lights move, and nothing is to differ). Returns their number; 0 where nothing of it moves. `turn`
 * chooses the direction in which colors are parted that are the same so far. */
int mtm_goal_linearize(const mtm_color_view *view, const mtm_goal *goal, const mtm_cell_spectra cells[2],
                       const mtm_spectrum *curves, int turn, mtm_goal_row rows[MTM_GOAL_ROWS]);

/* The weights whose sum with a light's samples is its luminance: 1 where it has Y = 1. */
void mtm_samples_luminance(mtm_samples weights);

#endif
