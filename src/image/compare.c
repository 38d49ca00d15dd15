/* SPDX-License-Identifier: BSD-3-Clause
 * How far two pictures are apart, in encoded channels and in CIEDE2000, and that difference as a picture. */
#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "base/memory.h"
#include "metamer/color.h"
#include "metamer/image.h"

static const double psnr_cap_db = 200.0;

/* To 0..1; what is not a number counts as 0, the black that it is shown as. */
static double clip(double value) {
    return value > 0.0 ? fmin(value, 1.0) : 0.0;
}

static mtm_status check_sizes(const mtm_picture *a, const mtm_picture *b, mtm_error *error) {
    if (a->width == b->width && a->height == b->height) return MTM_OK;
    return mtm_fail(
        error, MTM_ARGUMENT,
        "the pictures have different sizes, %d x %d and %d x %d; only equal sizes can be compared", a->width,
        a->height, b->width, b->height);
}

static double encoded_difference(float a, float b) {
    return fabs(mtm_srgb_encode(clip(a)) - mtm_srgb_encode(clip(b)));
}

static mtm_lab lab_of(const float *rgba, mtm_xyz white) {
    const mtm_rgb rgb = {clip(rgba[0]), clip(rgba[1]), clip(rgba[2])};
    return mtm_lab_from_xyz(mtm_xyz_from_rgb(rgb), white);
}

static int compare_doubles(const void *a, const void *b) {
    const double left = *(const double *)a;
    const double right = *(const double *)b;
    return (left > right) - (left < right);
}

/* Sums in the order of the pixels, so that the numbers repeat. */
static void compare_channels(const mtm_picture *a, const mtm_picture *b, mtm_comparison *comparison) {
    double sum = 0.0;
    double square_sum = 0.0;
    for (size_t pixel = 0; pixel < comparison->pixels; pixel++) {
        for (size_t channel = 0; channel < 3; channel++) {
            const size_t i = pixel * 4 + channel;
            const double difference = encoded_difference(a->rgba[i], b->rgba[i]);
            comparison->max_error = fmax(comparison->max_error, difference);
            sum += difference;
            square_sum += difference * difference;
        }
    }
    const double count = 3.0 * (double)comparison->pixels;
    comparison->mean_error = sum / count;
    comparison->psnr_db =
        square_sum > 0.0 ? fmin(-10.0 * log10(square_sum / count), psnr_cap_db) : psnr_cap_db;
}

/* The 99th percentile is the nearest rank: the smallest difference that at least 99 % of the pixels keep. */
static void compare_colors(const mtm_picture *a, const mtm_picture *b, double *differences,
                           mtm_comparison *comparison) {
    const mtm_xyz white = mtm_white_d65();
    const size_t count = comparison->pixels;
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        differences[i] = mtm_ciede2000(lab_of(a->rgba + i * 4, white), lab_of(b->rgba + i * 4, white));
        sum += differences[i];
    }
    qsort(differences, count, sizeof *differences, compare_doubles);
    comparison->ciede2000_mean = sum / (double)count;
    comparison->ciede2000_p99 = differences[(count * 99 + 99) / 100 - 1];
    comparison->ciede2000_max = differences[count - 1];
}

mtm_status mtm_picture_compare(const mtm_picture *a, const mtm_picture *b, mtm_comparison *comparison,
                               mtm_error *error) {
    const mtm_status status = check_sizes(a, b, error);
    if (status != MTM_OK) return status;
    const size_t count = (size_t)a->width * (size_t)a->height;
    double *differences = mtm_allocate(count, sizeof *differences);
    if (differences == NULL) return mtm_fail_memory(error, "a comparison", count * sizeof *differences);
    *comparison = (mtm_comparison){.pixels = count};
    compare_channels(a, b, comparison);
    compare_colors(a, b, differences, comparison);
    free(differences);
    return MTM_OK;
}

mtm_status mtm_picture_difference(const mtm_picture *a, const mtm_picture *b, double gain,
                                  mtm_picture **difference, mtm_error *error) {
    mtm_status status = check_sizes(a, b, error);
    if (status == MTM_OK) status = mtm_picture_create(a->width, a->height, difference, error);
    if (status != MTM_OK) return status;
    const size_t floats = (size_t)a->width * (size_t)a->height * 4;
    for (size_t i = 0; i < floats; i++) {
        /* decoded, because a picture is linear and is encoded again when it is written */
        const double level = clip(encoded_difference(a->rgba[i], b->rgba[i]) * gain);
        (*difference)->rgba[i] = i % 4 == 3 ? 1.0F : (float)mtm_srgb_decode(level);
    }
    return MTM_OK;
}
