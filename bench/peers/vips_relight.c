/* SPDX-License-Identifier: BSD-3-Clause
 * Lights a spectral image with libvips: seven float bands to linear sRGB by a matrix (recomb), then to 8-bit sRGB
 * (scRGB2sRGB), from memory to memory. The image is noise, as in `metamer bench`; libvips skips no empty pixels.
 * Usage: vips_relight WIDTH HEIGHT THREADS. For each line of standard input the image is lit once and a line is written:
 * {"ms": […]}. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <vips/vips.h>

enum { BANDS = 7, EDGE_MAX = 32768, THREADS_MAX = 256, LINE_BYTES = 256 };

static double now_ms(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static float *make_pixels(int width, int height) {
    const size_t count = (size_t)width * (size_t)height * BANDS;
    float *pixels = malloc(count * sizeof *pixels);
    unsigned random = 1;
    for (size_t i = 0; pixels != NULL && i < count; i++) {
        random = random * 1664525U + 1013904223U;
        pixels[i] = (float)(random >> 8) / 16777216.0F;
    }
    return pixels;
}

static VipsImage *make_matrix(void) {
    double matrix[3 * BANDS];
    for (int i = 0; i < 3 * BANDS; i++) matrix[i] = (1 + i % 5) / (3.0 * BANDS);
    return vips_image_new_matrix_from_array(BANDS, 3, matrix, 3 * BANDS);
}

/* False after an error of libvips. The bytes are written to memory that libvips allocates, as its users have it. */
static bool relight(const float *pixels, int width, int height, VipsImage *matrix) {
    const size_t bytes = (size_t)width * (size_t)height * BANDS * sizeof *pixels;
    VipsImage *image = vips_image_new_from_memory(pixels, bytes, width, height, BANDS, VIPS_FORMAT_FLOAT);
    VipsImage *linear = NULL;
    VipsImage *encoded = NULL;
    void *result = NULL;
    size_t result_bytes = 0;
    bool is_good = image != NULL && vips_recomb(image, &linear, matrix, NULL) == 0;
    if (is_good) {
        linear->Type = VIPS_INTERPRETATION_scRGB;
        is_good = vips_scRGB2sRGB(linear, &encoded, NULL) == 0;
    }
    if (is_good) result = vips_image_write_to_memory(encoded, &result_bytes);
    is_good = result != NULL && result_bytes == (size_t)width * (size_t)height * 3;
    g_free(result);
    g_clear_object(&encoded);
    g_clear_object(&linear);
    g_clear_object(&image);
    return is_good;
}

int main(int argc, char **argv) {
    const int width = argc == 4 ? atoi(argv[1]) : 0;
    const int height = argc == 4 ? atoi(argv[2]) : 0;
    const int thread_count = argc == 4 ? atoi(argv[3]) : 0;
    char line[LINE_BYTES];
    if (width < 1 || width > EDGE_MAX || height < 1 || height > EDGE_MAX || thread_count < 1 ||
        thread_count > THREADS_MAX) {
        (void)fprintf(stderr, "usage: vips_relight WIDTH HEIGHT THREADS\n");
        return 2;
    }
    float *pixels = make_pixels(width, height);
    if (pixels == NULL || VIPS_INIT(argv[0]) != 0) return 1;
    vips_cache_set_max(0);
    vips_concurrency_set(thread_count);
    VipsImage *matrix = make_matrix();
    bool is_good = true;
    while (is_good && fgets(line, sizeof line, stdin) != NULL) {
        const double begin = now_ms();
        is_good = relight(pixels, width, height, matrix);
        (void)printf("{\"ms\": [%.4f]}\n", now_ms() - begin);
        (void)fflush(stdout);
    }
    if (!is_good) (void)fprintf(stderr, "vips_relight: %s\n", vips_error_buffer());
    g_object_unref(matrix);
    free(pixels);
    vips_shutdown();
    return is_good ? 0 : 1;
}
