/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination to 8-bit sRGB with every instruction set of this machine, against mtm_relight and the curve of
 * sRGB (IEC 61966-2-1). */
#define _XOPEN_SOURCE 700
#include <png.h>

#include "base/half.h"
#include "base/isa.h"
#include "fixture.h"

enum { PIXELS_MAX = 40 * 40 };

static const char *const isa_names[] = {"baseline", "x86-64-v3", "x86-64-v4"};
static const int dimensions[] = {1, 3, 5, 7, 12, 15, 16, 31, 81, 83};
enum { DIMENSIONS = sizeof dimensions / sizeof *dimensions };

static uint32_t next_random(uint32_t *random) {
    return (*random = *random * 1664525U + 1013904223U) >> 8;
}

static float random_float(uint32_t *random) {
    return (float)next_random(random) / (float)(1 << 24);
}

/* Coefficients from -0.2 to 0.8; about half of the pixels are empty, in runs. */
static mtm_image *make_image(int width, int height, int dimension) {
    mtm_error error;
    mtm_image *image = NULL;
    uint32_t random = (uint32_t)(width * 1000 + dimension);
    assert_ok(mtm_image_create(width, height, dimension, "materials", NULL, NULL, &image, &error), error);
    for (int n = 0; n < width * height; n++) {
        if (n / 29 % 2 == 1) continue;
        float *pixel = image->pixels + (ptrdiff_t)n * image->lanes;
        for (int i = 0; i < dimension; i++) pixel[i] = random_float(&random) - 0.2F;
        pixel[dimension] = random_float(&random) * 1.25F;
    }
    return image;
}

/* Sums between about -0.3 and 1.3. */
static void make_matrix(int dimension, double *matrix) {
    for (int i = 0; i < 3 * dimension; i++) matrix[i] = (1.5 + sin(i * 7.0)) / dimension;
}

static double clip(double value) {
    return value > 0 ? fmin(value, 1) : 0;
}

/* What the header of mtm_picture_write_png says, written down once more. */
static void encode_pixel(const float *pixel, bool is_opaque, unsigned char *rgba) {
    const double rgb[3] = {clip(pixel[0]), clip(pixel[1]), clip(pixel[2])};
    const double alpha = is_opaque ? 1 : fmax(clip(pixel[3]), fmax(rgb[0], fmax(rgb[1], rgb[2])));
    for (int i = 0; i < 3; i++)
        rgba[i] = (unsigned char)lrint(255 * mtm_srgb_encode(alpha > 0 ? rgb[i] / alpha : 0));
    rgba[3] = (unsigned char)lrint(255 * alpha);
}

static void make_expected(const mtm_image *image, const double *matrix, const mtm_relight_options *options,
                          unsigned char *rgba) {
    mtm_error error;
    mtm_picture *picture = NULL;
    assert_ok(mtm_relight(image, matrix, options, &picture, &error), error);
    for (int n = 0; n < image->width * image->height; n++)
        encode_pixel(picture->rgba + 4 * n, options->has_background, rgba + 4 * n);
    mtm_picture_destroy(picture);
}

/* Relit from `half` where that is not NULL, which holds what `image` holds. Every instruction set makes the expected
 * bytes and touches none behind them. */
static void check(const mtm_image *image, const mtm_half_image *half, const double *matrix,
                  const mtm_relight_options *options) {
    static unsigned char expected[PIXELS_MAX * 4];
    static unsigned char rgba[PIXELS_MAX * 4 + 64];
    const size_t bytes = (size_t)image->width * (size_t)image->height * 4;
    make_expected(image, matrix, options, expected);
    for (mtm_isa isa = MTM_ISA_BASELINE; isa <= mtm_isa_highest(); isa++) {
        assert_int_equal(setenv("METAMER_ISA", isa_names[isa], 1), 0);
        memset(rgba, 123, sizeof rgba);
        if (half == NULL)
            mtm_relight_bytes(image, matrix, options, rgba);
        else
            mtm_relight_half_bytes(half, matrix, options, rgba);
        for (size_t i = 0; i < bytes; i++)
            if (rgba[i] != expected[i])
                fail_msg("%s, %s, %d x %d, %d coefficients: byte %zu is %d, not %d", mtm_isa_name(),
                         half == NULL ? "floats" : "halves", image->width, image->height, image->dimension, i,
                         rgba[i], expected[i]);
        for (size_t i = bytes; i < bytes + 64; i++) assert_int_equal(rgba[i], 123);
    }
    assert_int_equal(unsetenv("METAMER_ISA"), 0);
}

/* On black, over a color, and with alpha. */
static void check_backgrounds(const mtm_image *image, const mtm_half_image *half, const double *matrix) {
    mtm_relight_options options = mtm_relight_defaults();
    options.thread_count = 1;
    check(image, half, matrix, &options);
    options.background = (mtm_rgb){0.25, 0.0021, 1.5};
    check(image, half, matrix, &options);
    options.has_background = false;
    check(image, half, matrix, &options);
}

/* From floats, and, with the image's numbers rounded in place, from halves. */
static void check_floats_and_halves(mtm_image *image, const double *matrix) {
    mtm_error error;
    mtm_half_image *half = NULL;
    check_backgrounds(image, NULL, matrix);
    assert_ok(mtm_half_image_create(image, &half, &error), error);
    for (int n = 0; n < image->width * image->height * image->lanes; n++)
        image->pixels[n] = mtm_float_of_half(half->pixels[n]);
    check_backgrounds(image, half, matrix);
    mtm_half_image_destroy(half);
}

static void every_dimension_gives_the_nearest_levels(void **state) {
    (void)state;
    double matrix[3 * MTM_DIMENSION_MAX];
    for (int d = 0; d < DIMENSIONS; d++) {
        mtm_image *image = make_image(37, 31, dimensions[d]);
        make_matrix(dimensions[d], matrix);
        check_floats_and_halves(image, matrix);
        mtm_image_destroy(image);
    }
}

static void every_width_gives_the_nearest_levels(void **state) {
    (void)state;
    double matrix[3 * MTM_DIMENSION_MAX];
    for (int width = 1; width <= 33; width++) {
        for (int d = 1; d < 4; d++) {
            mtm_image *image = make_image(width, 1, dimensions[d]);
            make_matrix(dimensions[d], matrix);
            check_floats_and_halves(image, matrix);
            mtm_image_destroy(image);
        }
    }
}

/* Where rounding is hardest: the floats round the thresholds of the levels, as they are. */
static void floats_next_to_a_threshold_round_as_the_curve(void **state) {
    (void)state;
    mtm_error error;
    const double matrix[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    mtm_image *image = NULL;
    assert_ok(mtm_image_create(32, 32, 3, "rgb", NULL, NULL, &image, &error), error);
    for (int n = 0; n < 32 * 32; n++) {
        float *pixel = image->pixels + (ptrdiff_t)n * image->lanes;
        const float near = (float)mtm_srgb_decode((n / 4 + 0.5) / 255);
        uint32_t bits;
        memcpy(&bits, &near, sizeof bits);
        for (uint32_t i = 0; i < 3; i++) {
            const uint32_t neighbor = bits + (uint32_t)(n % 4) * 3 + i - 5;
            memcpy(&pixel[i], &neighbor, sizeof neighbor);
        }
        pixel[3] = n % 2 == 0 ? 1 : near;
    }
    check_floats_and_halves(image, matrix);
    mtm_image_destroy(image);
}

/* The quotient of a color and alpha next to a threshold, often nearer than the next float. */
static void straight_color_next_to_a_threshold_rounds_as_the_curve(void **state) {
    (void)state;
    mtm_error error;
    const double matrix[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    mtm_image *image = NULL;
    uint32_t random = 3;
    mtm_relight_options options = mtm_relight_defaults();
    options.has_background = false;
    assert_ok(mtm_image_create(40, 40, 3, "rgb", NULL, NULL, &image, &error), error);
    for (int n = 0; n < 40 * 40; n++) {
        float *pixel = image->pixels + (ptrdiff_t)n * image->lanes;
        pixel[3] = 0.5F + 0.5F * random_float(&random);
        for (int i = 0; i < 3; i++)
            pixel[i] = (float)(pixel[3] * mtm_srgb_decode((next_random(&random) % 255 + 0.5) / 255));
    }
    check(image, NULL, matrix, &options);
    mtm_image_destroy(image);
}

static void coefficients_that_are_no_colors_are_clipped(void **state) {
    (void)state;
    const float special[] = {NAN,    -NAN,           INFINITY, -INFINITY, 3e38F,     -3e38F,
                             1e-45F, -0.0F,          -1e-30F,  65504,     1,         0,
                             -5,     0x1.fffffep-1F, 0.5F,     1.25F,     0.0031308F};
    const int count = (int)(sizeof special / sizeof *special);
    double matrix[3 * MTM_DIMENSION_MAX];
    for (int d = 0; d < 5; d++) {
        mtm_image *image = make_image(40, 33, dimensions[d]);
        uint32_t random = 7;
        for (int n = 0; n < 40 * 33 * image->lanes; n++) {
            const int lane = n % image->lanes;
            if (lane > dimensions[d] || next_random(&random) % 4 != 0) continue;
            image->pixels[n] = special[next_random(&random) % (uint32_t)count];
        }
        make_matrix(dimensions[d], matrix);
        check_floats_and_halves(image, matrix);
        mtm_image_destroy(image);
    }
}

/* Whichever it is of the numbers of a block, and whichever bit of it is not 0. */
static void one_number_is_enough_for_a_pixel(void **state) {
    (void)state;
    const float values[] = {0x1p-24F, 0x1p-14F, 0.25F, 2, -2};
    double matrix[3 * 7];
    make_matrix(7, matrix);
    for (int i = 0; i < 16 * 8; i++) {
        mtm_image *image = make_image(16, 1, 7);
        memset(image->pixels, 0, sizeof(float) * 16 * 8);
        image->pixels[i] = values[i % 5];
        check_floats_and_halves(image, matrix);
        mtm_image_destroy(image);
    }
}

static void the_bytes_are_those_of_the_png(void **state) {
    (void)state;
    mtm_error error;
    double matrix[3 * 7];
    static unsigned char rgba[40 * 40 * 4];
    static unsigned char levels[40 * 40 * 4];
    make_matrix(7, matrix);
    mtm_image *image = make_image(40, 40, 7);
    for (int has_background = 0; has_background < 2; has_background++) {
        mtm_picture *picture = NULL;
        mtm_relight_options options = mtm_relight_defaults();
        options.has_background = has_background == 1;
        assert_ok(mtm_relight(image, matrix, &options, &picture, &error), error);
        assert_ok(mtm_picture_write_png(picture, "relight_bytes.png", NULL, &error), error);
        png_image file = {.version = PNG_IMAGE_VERSION};
        assert_true(png_image_begin_read_from_file(&file, "relight_bytes.png"));
        file.format = PNG_FORMAT_RGBA;
        assert_true(png_image_finish_read(&file, NULL, levels, 0, NULL));
        mtm_relight_bytes(image, matrix, &options, rgba);
        assert_memory_equal(rgba, levels, sizeof rgba);
        mtm_picture_destroy(picture);
    }
    mtm_image_destroy(image);
}

static void the_bytes_do_not_depend_on_the_number_of_threads(void **state) {
    (void)state;
    double matrix[3 * 7];
    make_matrix(7, matrix);
    mtm_image *image = make_image(333, 301, 7);
    mtm_relight_options options = mtm_relight_defaults();
    const size_t bytes = (size_t)333 * 301 * 4;
    unsigned char *one = malloc(bytes);
    unsigned char *many = malloc(bytes);
    assert_true(one != NULL && many != NULL);
    options.thread_count = 1;
    mtm_relight_bytes(image, matrix, &options, one);
    for (options.thread_count = 0; options.thread_count < 9; options.thread_count += 2) {
        memset(many, 0, bytes);
        mtm_relight_bytes(image, matrix, &options, many);
        assert_memory_equal(one, many, bytes);
    }
    free(one);
    free(many);
    mtm_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_dimension_gives_the_nearest_levels),
        cmocka_unit_test(every_width_gives_the_nearest_levels),
        cmocka_unit_test(floats_next_to_a_threshold_round_as_the_curve),
        cmocka_unit_test(straight_color_next_to_a_threshold_rounds_as_the_curve),
        cmocka_unit_test(coefficients_that_are_no_colors_are_clipped),
        cmocka_unit_test(one_number_is_enough_for_a_pixel),
        cmocka_unit_test(the_bytes_are_those_of_the_png),
        cmocka_unit_test(the_bytes_do_not_depend_on_the_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
