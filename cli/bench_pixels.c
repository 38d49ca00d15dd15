/* SPDX-License-Identifier: BSD-3-Clause
 * Spectral images made without a renderer, to time what comes after one. */
#include "bench_pixels.h"

#include <stdio.h>
#include <stdlib.h>

#include "bench_check.h"

/* Numerical Recipes' linear congruential generator; its high bits are the good ones. */
static void fill_randomly(mtm_image *image, double fill) {
    const size_t lanes = (size_t)image->lanes;
    const size_t row = (size_t)image->width * lanes;
    const int filled_rows = (int)(image->height * fill + 0.5);
    float *pixels = image->pixels + (size_t)((image->height - filled_rows) / 2) * row;
    uint32_t random = 1;
    for (size_t i = 0; i < (size_t)filled_rows * row; i++) {
        random = random * 1664525U + 1013904223U;
        if (i % lanes <= (size_t)image->dimension) pixels[i] = (float)(random >> 22) / 1024;
    }
}

mtm_status make_pixels(int width, int height, int dimension, double fill, bench_pixels *pixels,
                       mtm_error *error) {
    *pixels = (bench_pixels){.image = NULL};
    mtm_status status =
        mtm_image_create(width, height, dimension, "materials", NULL, NULL, &pixels->image, error);
    if (status != MTM_OK) return status;
    fill_randomly(pixels->image, fill);
    for (int i = 0; i < 3 * dimension; i++) pixels->matrix[i] = (1 + i % 5) / (3.0 * dimension);
    status = mtm_half_image_create(pixels->image, &pixels->half, error);
    pixels->rgba = calloc((size_t)width * (size_t)height, 4);
    if (status == MTM_OK && pixels->rgba == NULL) {
        (void)snprintf(error->message, sizeof error->message, "out of memory for a picture");
        status = MTM_MEMORY;
    }
    return status;
}

void free_pixels(bench_pixels *pixels) {
    mtm_image_destroy(pixels->image);
    mtm_half_image_destroy(pixels->half);
    free(pixels->rgba);
    *pixels = (bench_pixels){.image = NULL};
}

double time_pixels(bench_pixels *pixels, bool is_half, int thread_count) {
    mtm_relight_options options = mtm_relight_defaults();
    options.thread_count = thread_count;
    const double begin = now_ms();
    if (is_half)
        mtm_relight_half_bytes(pixels->half, pixels->matrix, &options, pixels->rgba);
    else
        mtm_relight_bytes(pixels->image, pixels->matrix, &options, pixels->rgba);
    return now_ms() - begin;
}

mtm_status check_pixels(int dimension, const char *isa, int thread_count, mtm_error *error) {
    bench_pixels pixels;
    char name[64];
    mtm_status status = make_pixels(61, 307, dimension, 0.5, &pixels, error);
    choose_isa(isa);
    for (int is_half = 0; is_half < 2 && status == MTM_OK; is_half++) {
        (void)snprintf(name, sizeof name, "%d coefficients, %s, %s", dimension,
                       is_half == 1 ? "half" : "float", isa);
        (void)time_pixels(&pixels, is_half == 1, thread_count);
        status = check_bytes(name, pixels.image, pixels.matrix, pixels.rgba, error);
    }
    free_pixels(&pixels);
    return status;
}
