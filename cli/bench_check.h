/* SPDX-License-Identifier: BSD-3-Clause
 * What is timed must be right: frames against the plain renderer, bytes against plain relighting. */
#ifndef METAMER_CLI_BENCH_CHECK_H
#define METAMER_CLI_BENCH_CHECK_H

#include "bench_frame.h"

/* The frame's first view with these options, lit. Release with mtm_picture_destroy. */
mtm_status render_first_view(bench_frame *frame, const mtm_render_options *options, mtm_picture **picture,
                             mtm_error *error);

/* The options with which the renderer is its own plain reference: one ray at a time, in double precision. */
mtm_render_options plain_options(const mtm_render_options *options);

/* Compares a small picture of every frame with the plain one (PSNR at least its subject's), and its bytes with plain relighting (all
 * equal). MTM_NUMERIC where they are farther apart; `name` says in the message what was checked. */
mtm_status check_frames(const char *name, int count, bench_frame *frames, mtm_error *error);

/* Compares bytes with what mtm_relight and sRGB's formula make of the image. MTM_NUMERIC where one differs. */
mtm_status check_bytes(const char *name, const mtm_image *image, const double *matrix,
                       const unsigned char *rgba, mtm_error *error);

#endif
