/* SPDX-License-Identifier: BSD-3-Clause
 * What is timed must be right: frames against the plain renderer, bytes against plain relighting. */
#include "bench_check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { CHECK_EDGE = 128 };

mtm_render_options plain_options(const mtm_render_options *options) {
    mtm_render_options plain = *options;
    plain.without = MTM_WITHOUT_PACKETS;
    return plain;
}

/* Straight alpha, at least the largest channel, as in mtm_picture_write_png. */
static void encode_pixel(const float rgba[4], unsigned char bytes[4]) {
    double clipped[4];
    for (int i = 0; i < 4; i++) clipped[i] = fmin(fmax(rgba[i], 0), 1);
    const double alpha = fmax(fmax(clipped[0], clipped[1]), fmax(clipped[2], clipped[3]));
    for (int i = 0; i < 3; i++)
        bytes[i] = (unsigned char)lround(255 * mtm_srgb_encode(alpha > 0 ? clipped[i] / alpha : 0));
    bytes[3] = (unsigned char)lrint(255 * alpha);
}

mtm_status check_bytes(const char *name, const mtm_image *image, const double *matrix,
                       const unsigned char *rgba, mtm_error *error) {
    const mtm_relight_options options = mtm_relight_defaults();
    const size_t pixel_count = (size_t)image->width * (size_t)image->height;
    mtm_picture *picture = NULL;
    mtm_status status = mtm_relight(image, matrix, &options, &picture, error);
    for (size_t i = 0; i < 4 * pixel_count && status == MTM_OK; i++) {
        unsigned char expected[4];
        encode_pixel(picture->rgba + i / 4 * 4, expected);
        if (rgba[i] == expected[i % 4]) continue;
        (void)snprintf(error->message, sizeof error->message,
                       "%s: byte %zu of pixel %zu is relit to %d, plain relighting gives %d", name, i % 4,
                       i / 4, rgba[i], expected[i % 4]);
        status = MTM_NUMERIC;
    }
    mtm_picture_destroy(picture);
    return status;
}

/* The first view before light. */
static mtm_status project_first_view(bench_frame *frame, const mtm_render_options *options, mtm_image **image,
                                     mtm_error *error) {
    const mtm_camera camera = view_of(frame->subject, 0);
    choose_isa(frame->isa);
    mtm_status status = classify_frame(frame, error);
    if (status == MTM_OK)
        status = mtm_image_create(options->width, options->height, frame->image->dimension,
                                  frame->image->basis, NULL, NULL, image, error);
    if (status == MTM_OK)
        status = mtm_projector_render(frame->subject->projector, &camera, options, NULL, *image, error);
    return status;
}

mtm_status render_first_view(bench_frame *frame, const mtm_render_options *options, mtm_picture **picture,
                             mtm_error *error) {
    const mtm_relight_options relight = mtm_relight_defaults();
    mtm_image *image = NULL;
    mtm_status status = project_first_view(frame, options, &image, error);
    if (status == MTM_OK) status = mtm_relight(image, frame->matrix, &relight, picture, error);
    mtm_image_destroy(image);
    return status;
}

static mtm_status check_picture(const char *name, bench_frame *frame, const mtm_render_options *options,
                                mtm_error *error) {
    const mtm_render_options plain = plain_options(options);
    mtm_picture *fast = NULL;
    mtm_picture *reference = NULL;
    mtm_comparison comparison = {0};
    mtm_status status = render_first_view(frame, options, &fast, error);
    if (status == MTM_OK) status = render_first_view(frame, &plain, &reference, error);
    if (status == MTM_OK) status = mtm_picture_compare(fast, reference, &comparison, error);
    if (status == MTM_OK && comparison.psnr_db < (double)BENCH_PSNR_DB) {
        (void)snprintf(error->message, sizeof error->message,
                       "%s: basis %s with %s is %.1f dB from the plain renderer, expected at least %.0f",
                       name, mtm_basis_name(frame->basis), frame->isa, comparison.psnr_db,
                       (double)BENCH_PSNR_DB);
        status = MTM_NUMERIC;
    }
    mtm_picture_destroy(reference);
    mtm_picture_destroy(fast);
    return status;
}

static mtm_status check_relit(const char *name, bench_frame *frame, const mtm_render_options *options,
                              mtm_error *error) {
    mtm_relight_options relight = mtm_relight_defaults();
    relight.thread_count = options->thread_count;
    mtm_image *image = NULL;
    mtm_status status = project_first_view(frame, options, &image, error);
    unsigned char *rgba = calloc((size_t)options->width * (size_t)options->height, 4);
    if (status == MTM_OK && rgba == NULL) {
        (void)snprintf(error->message, sizeof error->message, "%s: out of memory for a picture", name);
        status = MTM_MEMORY;
    }
    if (status == MTM_OK) {
        mtm_relight_bytes(image, frame->matrix, &relight, rgba);
        status = check_bytes(name, image, frame->matrix, rgba, error);
    }
    free(rgba);
    mtm_image_destroy(image);
    return status;
}

mtm_status check_frames(const char *name, int count, bench_frame *frames, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < count && status == MTM_OK; i++) {
        mtm_render_options options = frames[i].options;
        options.width = options.height = CHECK_EDGE;
        status = check_picture(name, &frames[i], &options, error);
        if (status == MTM_OK) status = check_relit(name, &frames[i], &options, error);
    }
    return status;
}
