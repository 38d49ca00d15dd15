/* SPDX-License-Identifier: BSD-3-Clause
 * What the readers of a goals document's parts share. */
#ifndef METAMER_PALETTE_GOALS_READ_H
#define METAMER_PALETTE_GOALS_READ_H

#include "base/json.h"
#include "palette/goals.h"

typedef struct mtm_goals_reader {
    mtm_json_reader *json;
    mtm_goals *goals;
    double smoothness;                  /* of designed spectra that name none */
    int designed_count;                 /* of materials and lights together */
    bool lists_materials, lists_lights; /* the document has the list; else recipes bring what they name */
} mtm_goals_reader;

/* An array of known keys and how many they are, as two arguments. */
#define KEYS(array) (array), sizeof(array) / sizeof *(array)

extern const mtm_json_range mtm_goals_factor;     /* weights, pulls, smoothness */
extern const mtm_json_range mtm_goals_difference; /* CIEDE2000 */

/* Adds a physical designed material (or light, by its kind) of that name, for a document without the list. */
void mtm_goals_bring(mtm_goals_reader *reader, mtm_spectrum_kind kind, const char *key, const char *name);

/* The index of a material (or light, by its kind), -1 where there is none. */
int mtm_goals_find(const mtm_goals_reader *reader, mtm_spectrum_kind kind, const char *name);

/* The same where there must be one: fails at `key`, which has the name, and gives -1. */
int mtm_goals_need(mtm_goals_reader *reader, mtm_spectrum_kind kind, const char *key, const char *name);

/* The color that a value at `key` (NULL: the present place) writes as "#rrggbb". */
bool mtm_goals_read_color(mtm_goals_reader *reader, const char *key, const json_t *value, mtm_xyz *color);

/* Adds a goal; fails where there are too many. */
void mtm_goals_add(mtm_goals_reader *reader, const mtm_goal *goal);

/* A row of "goals" that speaks of one cell. */
void mtm_goals_read_cell(mtm_goals_reader *reader, const json_t *row);

/* A row of "goals" that names a recipe: first the materials and lights that the document does not list, after all rows
 * have done so the goals. */
void mtm_recipe_bring(mtm_goals_reader *reader, const json_t *row);
void mtm_recipe_read(mtm_goals_reader *reader, const json_t *row);

#endif
