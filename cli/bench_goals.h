/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench: random goals documents. Behind each stands a palette of physical spectra that is not shown. */
#ifndef METAMER_CLI_BENCH_GOALS_H
#define METAMER_CLI_BENCH_GOALS_H

#include "metamer/metamer.h"

typedef enum bench_goals_kind {
    BENCH_GOALS_REACHABLE, /* the hidden palette meets every goal */
    BENCH_GOALS_FREE,      /* as many goals on as many spectra, but random colors, which nothing may have */
} bench_goals_kind;

/* Document `index` of a kind as JSON text: 1 … 4 materials under 1 … 3 lights, some given, goals of all kinds. The same text
 * every time. Release with free(). MTM_MEMORY, and what the library's spectra give. */
MTM_CHECK mtm_status make_random_goals(bench_goals_kind kind, int index, char **text, mtm_error *error);

/* A document whose first `goal_count` cells, light by light, are to have the colors of a hidden palette. All materials are
 * designed; the lights are the illuminants, or designed, too, where that is NULL. At most BENCH_GRID_EDGE of each. Release and
 * errors as above. */
enum { BENCH_GRID_EDGE = 6 };
MTM_CHECK mtm_status make_grid_goals(int material_count, int light_count, const char *const *illuminants,
                                     int goal_count, char **text, mtm_error *error);

#endif
