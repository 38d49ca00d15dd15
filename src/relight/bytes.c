/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination (paper section 5) to 8-bit sRGB in one pass, bands of rows in parallel. */
#include "base/parallel.h"
#include "metamer/relight.h"
#include "relight/bytes_kernel.h"

enum { BAND_PIXELS = 8192 }; /* about: a task should outweigh its claim */

static const mtm_bytes_kernel *const kernels[] = MTM_ISA_LIST(mtm_bytes_kernel);

typedef struct band_job {
    int width, height, band_rows;
    const unsigned char *pixels; /* float or half */
    size_t pixel_bytes;
    unsigned char *rgba;
    void (*relight)(const mtm_bytes_pass *pass, const void *pixels, size_t count, unsigned char *rgba);
    mtm_bytes_pass pass;
} band_job;

/* A band's rows lie one behind the other, as pixels of one long row. */
static void relight_band(void *context, int band) {
    const band_job *job = context;
    const int first_row = band * job->band_rows;
    const int rows = first_row + job->band_rows <= job->height ? job->band_rows : job->height - first_row;
    const size_t first = (size_t)first_row * (size_t)job->width;
    const size_t count = (size_t)rows * (size_t)job->width;
    job->relight(&job->pass, job->pixels + first * job->pixel_bytes, count, job->rgba + first * 4);
}

static void prepare_pass(mtm_bytes_pass *pass) {
    unsigned char empty[4] = {0, 0, 0, 255};
    mtm_srgb_levels_prepare(&pass->levels);
    for (int i = 0; i < 3; i++)
        empty[i] = (unsigned char)mtm_srgb_level(&pass->levels, pass->relight.background[i]);
    if (pass->relight.is_opaque) memcpy(&pass->empty, empty, sizeof empty);
}

static void relight_bands(band_job *job, int thread_count) {
    prepare_pass(&job->pass);
    job->band_rows = job->width < BAND_PIXELS ? BAND_PIXELS / job->width : 1;
    const int band_count = (job->height + job->band_rows - 1) / job->band_rows;
    const mtm_status status = mtm_parallel_for(thread_count, band_count, relight_band, job, NULL);
    (void)status; /* without a progress callback nothing can stop it */
}

void mtm_relight_bytes(const mtm_image *image, const double *matrix, const mtm_relight_options *options,
                       unsigned char *rgba) {
    band_job job = {.width = image->width,
                    .height = image->height,
                    .pixels = (const unsigned char *)image->pixels,
                    .pixel_bytes = (size_t)image->lanes * sizeof *image->pixels,
                    .rgba = rgba,
                    .relight = kernels[mtm_isa_chosen()]->relight_floats,
                    .pass.relight = mtm_relight_pass_of(image->dimension, image->lanes, matrix, options)};
    relight_bands(&job, options->thread_count);
}

void mtm_relight_half_bytes(const mtm_half_image *image, const double *matrix,
                            const mtm_relight_options *options, unsigned char *rgba) {
    band_job job = {.width = image->width,
                    .height = image->height,
                    .pixels = (const unsigned char *)image->pixels,
                    .pixel_bytes = (size_t)image->lanes * sizeof *image->pixels,
                    .rgba = rgba,
                    .relight = kernels[mtm_isa_chosen()]->relight_halves,
                    .pass.relight = mtm_relight_pass_of(image->dimension, image->lanes, matrix, options)};
    relight_bands(&job, options->thread_count);
}
