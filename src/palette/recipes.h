/* SPDX-License-Identifier: BSD-3-Clause
 * What recipes are made from: rows of a goals document that stand for several goals. */
#ifndef METAMER_PALETTE_RECIPES_H
#define METAMER_PALETTE_RECIPES_H

#include "palette/goals_read.h"

/* A row that names a recipe, while it is read. */
typedef struct mtm_recipe_row {
    mtm_goals_reader *reader;
    const json_t *object;
    double weight; /* of each of its goals */
} mtm_recipe_row;

/* Materials or lights that a row names, by index. */
typedef struct mtm_recipe_list {
    int count;
    int index[MTM_LIGHTS_MAX];
} mtm_recipe_list;

/* The names at a key that must be there, each once. Later calls do nothing after a failure. */
void mtm_recipe_names(const mtm_recipe_row *row, mtm_spectrum_kind kind, const char *key, int least,
                      mtm_recipe_list *list);

/* Each adds one goal. */
void mtm_recipe_color(const mtm_recipe_row *row, int material, int light, mtm_xyz color);
void mtm_recipe_black(const mtm_recipe_row *row, int material, int light);
void mtm_recipe_same(const mtm_recipe_row *row, mtm_cell cell, mtm_cell other);
void mtm_recipe_different(const mtm_recipe_row *row, mtm_cell cell, mtm_cell other, double least);

/* A picture of the paper: its materials and lights have names and colors of their own, and its goals are a table. */
typedef enum mtm_figure_aim {
    MTM_FIGURE_COLOR, /* the material has its color */
    MTM_FIGURE_BLACK,
    MTM_FIGURE_SAME, /* the color of the other cell */
} mtm_figure_aim;

typedef struct mtm_figure_step {
    mtm_figure_aim aim;
    mtm_cell cell, other;
} mtm_figure_step;

enum { MTM_FIGURE_NAMES_MAX = 3, MTM_FIGURE_STEPS_MAX = 9 };

typedef struct mtm_figure {
    const char *materials[MTM_FIGURE_NAMES_MAX + 1]; /* ended by NULL; also the keys of "colors" */
    const char *colors[MTM_FIGURE_NAMES_MAX];
    const char *lights[MTM_FIGURE_NAMES_MAX + 1];
    int step_count;
    mtm_figure_step steps[MTM_FIGURE_STEPS_MAX];
} mtm_figure;

extern const mtm_figure mtm_figure_2, mtm_figure_5, mtm_figure_6, mtm_figure_7;

void mtm_figure_read(const mtm_recipe_row *row, const mtm_figure *figure);

#endif
