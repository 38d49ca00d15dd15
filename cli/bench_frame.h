/* SPDX-License-Identifier: BSD-3-Clause
 * Frames: a volume under a transfer function from the views of an orbit, projected in some basis and lit. */
#ifndef METAMER_CLI_BENCH_FRAME_H
#define METAMER_CLI_BENCH_FRAME_H

#include "bench_statistics.h"
#include "metamer/metamer.h"

enum { BENCH_VIEWS = 8 /* run k looks from view k mod 8, turned by k · 45° */ };

/* What frames share: a prepared volume, and how it is looked at. The caller's, who lets it outlive its frames. */
typedef struct bench_subject {
    mtm_projector *projector;
    int point_count;
    const mtm_transfer_point *points;
    double opacity_length;
    mtm_camera camera; /* of the first view */
    mtm_render_options options;
    mtm_illumination illumination;
    bench_times prepare; /* mtm_projector_create */
} bench_subject;

/* The points of a transfer function by name, "smoke" or "solid", for materials 0 … 2. */
typedef struct bench_points {
    int count;
    mtm_transfer_point points[8];
} bench_points;
bench_points points_of(const char *transfer);

enum { BENCH_PSNR_DB = 50 /* how near the plain renderer pictures must be: 0.8 of 255 levels everywhere */ };

/* The common frame of a volume: 512 × 512 pixels, perspective of 30° from 1.75 times the longest edge (in voxels), step
 * 1, termination 0.01, Phong with a headlight, D65. `points` must live as long as the subject. */
mtm_status describe_subject(const mtm_volume *volume, const bench_points *points, int thread_count,
                            bench_subject *subject, mtm_error *error);

/* Prepares the subject's projector for the volume, `run_count` times; the last one is kept. */
mtm_status prepare_subject(const mtm_volume *volume, int run_count, bench_subject *subject, mtm_error *error);
void release_subject(bench_subject *subject);

/* Reflectances with one smooth bump each, their peaks spread over the visible wavelengths. */
void make_reflectances(int count, mtm_spectrum *reflectances);

/* A subject in a basis, and the times of its steps. Options may be changed between create_frame and time_frames, but for
 * the size of the picture. */
typedef struct bench_frame {
    bench_subject *subject;
    mtm_render_options options; /* begins as the subject's */
    const char *isa;            /* instruction set to run with; begins as the one that is chosen */
    mtm_basis *basis;
    mtm_transfer *transfer;
    mtm_image *image;
    unsigned char *rgba; /* the lit picture */
    double matrix[3 * MTM_DIMENSION_MAX];
    bench_times classify; /* mtm_transfer_create and mtm_projector_set_transfer */
    bench_times project;  /* mtm_projector_render */
    bench_times change;   /* both, as another transfer function needs them */
    bench_times relight;  /* mtm_relight_bytes, of an image that was lit once already */
    double fill;          /* share of the pixels that are not empty, the mean of the runs */
} bench_frame;

/* A frame of the subject in the basis of that name for these reflectances, its picture of width × height pixels.
 * MTM_MEMORY, and the errors of mtm_basis_create. Release with release_frame, after the subject's projector. */
mtm_status create_frame(bench_subject *subject, const char *basis, int material_count,
                        const mtm_spectrum *reflectances, int width, int height, bench_frame *frame,
                        mtm_error *error);
void release_frame(bench_frame *frame);

/* The camera of view 0, 1 …, a turn of the subject's. */
mtm_camera view_of(const bench_subject *subject, int view);

/* Gives the frame's transfer function to the subject's projector, in place of another frame's. */
mtm_status classify_frame(bench_frame *frame, mtm_error *error);

/* Runs every frame once untimed and then `run_count` times; in every run they take turns, and the turn begins with
 * another frame. METAMER_ISA is left as the last frame needs it. */
mtm_status time_frames(int count, bench_frame *frames, int run_count, const mtm_progress *progress,
                       mtm_error *error);

/* Makes the library run with the instruction set of that name from now on, through METAMER_ISA. */
void choose_isa(const char *name);

#endif
