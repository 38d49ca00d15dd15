/* SPDX-License-Identifier: BSD-3-Clause
 * docs/accuracy.md: what was measured, in words and tables. */
#ifndef METAMER_ACCURACY_DOCUMENT_H
#define METAMER_ACCURACY_DOCUMENT_H

#include "cost.h"
#include "measure.h"

/* How the costs were measured. */
typedef struct cost_setting {
    engine_options engine;
    int run_count;
} cost_setting;

/* Writes `path`. The same measurements give the same bytes but for the last section, which holds the costs. Errors:
 * those of output.h. */
MTM_CHECK mtm_status document_write(const measurements *made, const cost_setting *setting,
                                    const basis_cost costs[COST_BASES], const char *path, mtm_error *error);

#endif
