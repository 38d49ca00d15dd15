/* SPDX-License-Identifier: BSD-3-Clause
 * The search for spectra that make the goals' misses small. */
#ifndef METAMER_PALETTE_SOLVE_H
#define METAMER_PALETTE_SOLVE_H

#include "palette/goals.h"
#include "palette/view.h"

/* A spectrum that is to be found. */
typedef struct mtm_unknown {
    bool is_light, is_anchored;
    int index; /* in the palette */
    double low, high;
    double curvature,
        size; /* penalties on second differences of what it is apart from the reference, and on that itself */
    mtm_samples reference;
} mtm_unknown;

/* What is looked for, given all that does not change during the search. */
typedef struct mtm_search {
    const mtm_goals *goals;
    const bool *is_left_out; /* one for each goal; NULL: all count */
    int view_count;
    const mtm_color_view *views; /* full spectra first, where they count */
    double view_give[2];         /* how much more than the first a view may miss */
    bool
        is_basis_vital; /* false: full spectra will do. So many cells as a large problem has are often more than a
                                  * basis has numbers for, which would be known only after all starts */
    int unknown_count;
    mtm_unknown *unknowns;
    mtm_samples luminance; /* weights whose sum with a light's samples is its luminance */
    mtm_spectrum *given;   /* materials then lights of the palette, those to be found zero */
} mtm_search;

/* Plans a search over the goals' designed spectra. `is_bounded` false: without bounds. MTM_MEMORY. Release with
 * mtm_search_free. */
MTM_CHECK mtm_status mtm_search_plan(const mtm_goals *goals, int view_count, const mtm_color_view *views,
                                     bool is_bounded, mtm_search *search, mtm_error *error);
void mtm_search_free(mtm_search *search);

/* Found spectra, one for each unknown, and the cost they have: Σ ½·weight·miss²/give over goals and views, a miss being in
 * CIEDE2000, and the penalties. */
typedef struct mtm_found {
    mtm_spectrum *spectra;
    double cost;
    double
        contradiction; /* of a convex problem that was finished: the goals are at least this far, in CIEDE2000 over all
                           * of them, from being kept together by any spectra within their bounds; else 0 */
} mtm_found;

/* How many starts are worth trying: 1 where the problem is convex. */
int mtm_search_start_count(const mtm_search *search);

/* From start `start` as far as alternation gets: materials under the lights there are, lights on these materials, again and
 * again. MTM_NUMERIC, MTM_MEMORY. */
MTM_CHECK mtm_status mtm_search_begin(const mtm_search *search, int start, mtm_found *found,
                                      mtm_error *error);

/* To the minimum near by: all unknowns together (Gauss–Newton with bounds and damping; Levenberg, Marquardt), where the
 * result is to be good, then materials and lights in turn until the goals are met as closely as they can be there. */
MTM_CHECK mtm_status mtm_search_finish(const mtm_search *search, mtm_found *found, bool is_thorough,
                                       mtm_error *error);

/* A spectrum of the palette in the state that was found. */
const double *mtm_search_material(const mtm_search *search, const mtm_found *found, int material);
const double *mtm_search_light(const mtm_search *search, const mtm_found *found, int light);

#endif
