/* SPDX-License-Identifier: BSD-3-Clause
 * The pictures of docs/accuracy.md. */
#ifndef METAMER_ACCURACY_PLOTS_H
#define METAMER_ACCURACY_PLOTS_H

#include "measure.h"

/* Writes basis-factors-7.svg, basis-sharpened-7.svg and accuracy.svg into `folder`. Errors: those of output.h and
 * mtm_basis_create. */
MTM_CHECK mtm_status plots_write(const measurements *made, const char *folder, mtm_error *error);

#endif
