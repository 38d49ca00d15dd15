/* SPDX-License-Identifier: BSD-3-Clause
 * A design as a picture for people. */
#ifndef METAMER_CLI_DESIGN_PLOT_H
#define METAMER_CLI_DESIGN_PLOT_H

#include "metamer/metamer.h"

/* Writes an SVG with the spectra of the materials and of the lights, and a table of swatches, a row for each material and a
 * column for each light: asked beside achieved. MTM_IO, MTM_MEMORY. */
mtm_status write_design_plot(const mtm_design *design, const char *path, mtm_error *error);

#endif
