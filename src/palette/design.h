/* SPDX-License-Identifier: BSD-3-Clause
 * What the parts of a design share. */
#ifndef METAMER_PALETTE_DESIGN_H
#define METAMER_PALETTE_DESIGN_H

#include "palette/solve.h"

/* Looks for the materials of the goals' searches in their tables: where measured reflectances meet all goals under given
 * lights and `may_measure`, the goals' palette takes them and they are not designed any more; else the nearest become
 * anchors where the goals name none. `origins` (one for each material) says "table.csv:column" of those taken. The errors
 * of reading tables; MTM_FORMAT for one that does not cover what is visible; MTM_MEMORY. */
MTM_CHECK mtm_status mtm_library_find(mtm_goals *goals, bool may_measure, char (*origins)[256],
                                      mtm_error *error);

/* What became of a goal with the spectra found, without is_met. `basis` NULL: there is none besides full spectra. */
mtm_goal_result mtm_goal_judge(const mtm_search *search, const mtm_found *found, const mtm_color_view *full,
                               const mtm_color_view *basis, const mtm_goal *goal);

/* Fills the design's problems: what cannot be at all, what blocks each other, what only the basis lacks. MTM_CANCELLED,
 * MTM_MEMORY. */
MTM_CHECK mtm_status mtm_design_explain(const mtm_search *search, const mtm_found *found,
                                        const mtm_color_view *full, const mtm_color_view *basis,
                                        const mtm_progress *progress, mtm_design *design, mtm_error *error);

#endif
