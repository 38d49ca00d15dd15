/* SPDX-License-Identifier: BSD-3-Clause
 * What a basis costs: the time to render and to relight the engine scene, and the size of the image's file. */
#ifndef METAMER_ACCURACY_COST_H
#define METAMER_ACCURACY_COST_H

#include "engine.h"

enum { COST_BASES = 8, COST_RUNS_MAX = 31 };

typedef struct basis_cost {
    char basis[32];
    int dimension;
    double render_ms, relight_ms; /* medians */
    double file_mib;              /* EXR, 32-bit floats, ZIP */
} basis_cost;

/* Renders and relights `run_count` (1 … COST_RUNS_MAX) times, the bases taking turns, so that a busy machine slows them all.
 * A file is written into `out_folder` and removed. Errors: those of engine.h; MTM_IO. */
MTM_CHECK mtm_status cost_measure(const engine_options *options, const char *out_folder, int run_count,
                                  basis_cost costs[COST_BASES], mtm_error *error);

#endif
