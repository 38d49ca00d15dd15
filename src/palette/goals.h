/* SPDX-License-Identifier: BSD-3-Clause
 * What a goals document holds once it is read: recipes are goals by then. */
#ifndef METAMER_PALETTE_GOALS_H
#define METAMER_PALETTE_GOALS_H

#include <math.h>

#include "metamer/palette.h"

enum {
    MTM_GOALS_MAX = 256,         /* goals of a document, recipes expanded */
    MTM_WISHES_MAX = 8,          /* goals that fix the color of one cell */
    MTM_DESIGNED_MAX = 32,       /* spectra that one document may ask for */
    MTM_LIBRARY_TABLES_MAX = 16, /* tables of one search */
};

/* How a spectrum of the palette is to come about. */
typedef struct mtm_spectrum_wish {
    bool is_designed;    /* else the palette's own stays */
    bool is_physical;    /* reflectances 0 … 1, lights not negative */
    double smoothness;   /* a factor of the usual penalty on second differences */
    double pull;         /* 0: no anchor; else how strongly it is drawn to it, 1 is usual */
    mtm_spectrum anchor; /* of a light: in any scale */
} mtm_spectrum_wish;

/* "from_library": the materials are looked for in tables of measured reflectances first. */
typedef struct mtm_library_search {
    int material_count;
    int materials[MTM_DESIGNED_MAX];
    int table_count;
    char *tables[MTM_LIBRARY_TABLES_MAX]; /* as the document names them */
} mtm_library_search;

struct mtm_goals {
    char *folder; /* where its files are; NULL: it has none */
    char basis[32];
    double tolerance;    /* CIEDE2000 up to which a goal counts as met */
    mtm_palette palette; /* with zeros for what is designed */
    mtm_spectrum_wish *materials, *lights;
    int goal_count;
    mtm_goal *goals;
    int search_count;
    mtm_library_search *searches;
};

/* Whether a goal compares its cell with another one, not with a color. */
static inline bool mtm_goal_has_other(const mtm_goal *goal) {
    return goal->kind != MTM_GOAL_COLOR && goal->other.material >= 0;
}

/* How far a goal is from being met where its colors differ so much, in CIEDE2000. */
static inline double mtm_goal_lack(const mtm_goal *goal, double difference) {
    return goal->kind == MTM_GOAL_DIFFERENT ? fmax(0, goal->least - difference) : difference;
}

#endif
