/* SPDX-License-Identifier: BSD-3-Clause
 * The volumes that speed is measured on. All are 8-bit, with unit spacing whatever their files say, so that other
 * renderers can be given the same. */
#ifndef METAMER_CLI_BENCH_VOLUME_H
#define METAMER_CLI_BENCH_VOLUME_H

#include "metamer/metamer.h"

/* Reads the volume of that file name from the folders of the environment variable METAMER_DATA (separated by colons),
 * then from examples/<any>/ below the working folder. Where there is none, or one whose voxels are not uint8, a note on
 * standard error says so and *volume is NULL, with MTM_OK. Errors: those of mtm_volume_read and mtm_volume_create. */
mtm_status find_volume(const char *file, mtm_volume **volume, mtm_error *error);

/* The test signal of Marschner and Lobb, "An evaluation of reconstruction filters for volume rendering" (IEEE
 * Visualization 1994, eq. 5), fM = 6, α = 0.25, over [-1, 1]³ as 0 … 255; `edge` ≥ 2 voxels along each axis. MTM_MEMORY. */
mtm_status make_marschner_lobb(int edge, mtm_volume **volume, mtm_error *error);

#endif
