/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench: whether what a design reports is what its palette does. */
#ifndef METAMER_CLI_BENCH_DESIGN_CHECK_H
#define METAMER_CLI_BENCH_DESIGN_CHECK_H

#include "metamer/metamer.h"

/* Looks at every cell that the design reports as a picture would: mtm_palette_mix, then mtm_illuminate, and the same through
 * the design's basis. MTM_NUMERIC names the cell of `name` whose reported colors or differences are others; what making
 * the basis gives. */
MTM_CHECK mtm_status check_design(const char *name, const mtm_design *design, mtm_error *error);

#endif
