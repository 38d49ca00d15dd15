/* SPDX-License-Identifier: BSD-3-Clause
 * What `metamer info` says of a palette: what its lights tell apart, as JSON and for people. */
#ifndef METAMER_CLI_ANALYSIS_H
#define METAMER_CLI_ANALYSIS_H

#include <jansson.h>

#include "metamer/metamer.h"

/* The object "analysis" of docs/files.md, for who looks (`adapted_y` as in mtm_illumination_of). NULL where memory is
 * out. */
json_t *describe_analysis(const mtm_palette *palette, const mtm_observer *observer, double adapted_y);

/* The same in sentences, indented. */
void print_analysis(const json_t *analysis, int indent);

#endif
