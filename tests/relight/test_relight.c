/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination (paper section 5). */
#include "metamer/relight.h"

#include "fixture.h"

static mtm_image *make_image(int dimension) {
    mtm_error error;
    mtm_image *image = NULL;
    assert_ok(mtm_image_create(5, 3, dimension, "materials", NULL, NULL, &image, &error), error);
    for (int n = 0; n < 5 * 3; n++) {
        if (n == 7) continue; /* an empty pixel */
        for (int i = 0; i <= dimension; i++)
            image->pixels[n * image->lanes + i] =
                (float)(((n * 31 + i * 17) % 23) / 22.0 - (i < dimension ? 0.2 : 0));
    }
    return image;
}

static void a_pixel_is_the_matrix_times_its_coefficients(void **state) {
    (void)state;
    static const int dimensions[] = {1, 3, 4, 7, 15, 16, 81};
    for (size_t d = 0; d < sizeof dimensions / sizeof *dimensions; d++) {
        const int dimension = dimensions[d];
        mtm_error error;
        double matrix[3 * MTM_DIMENSION_MAX];
        for (int i = 0; i < 3 * dimension; i++) matrix[i] = sin(i + 1.0);
        mtm_image *image = make_image(dimension);
        mtm_picture *picture = NULL;
        mtm_relight_options options = mtm_relight_defaults();
        options.background = (mtm_rgb){0.25, 0.5, 0.75};
        options.thread_count = (int)d % 3;
        assert_ok(mtm_relight(image, matrix, &options, &picture, &error), error);
        for (int n = 0; n < 15; n++) {
            const float *pixel = image->pixels + n * image->lanes;
            const double background[3] = {0.25, 0.5, 0.75};
            for (int row = 0; row < 3; row++) {
                double expected = (1 - pixel[dimension]) * background[row];
                for (int i = 0; i < dimension; i++) expected += matrix[row * dimension + i] * pixel[i];
                assert_near(picture->rgba[4 * n + row], expected, 1e-5);
            }
            assert_near(picture->rgba[4 * n + 3], 1, 0);
        }
        mtm_picture_destroy(picture);
        mtm_image_destroy(image);
    }
}

static void without_background_the_picture_keeps_its_alpha(void **state) {
    (void)state;
    mtm_error error;
    const double matrix[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    mtm_image *image = make_image(3);
    mtm_picture *picture = NULL;
    mtm_relight_options options = mtm_relight_defaults();
    options.has_background = false;
    assert_ok(mtm_relight(image, matrix, &options, &picture, &error), error);
    for (int n = 0; n < 15; n++)
        for (int i = 0; i < 4; i++) assert_true(picture->rgba[4 * n + i] == image->pixels[4 * n + i]);
    mtm_picture_destroy(picture);
    mtm_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pixel_is_the_matrix_times_its_coefficients),
        cmocka_unit_test(without_background_the_picture_keeps_its_alpha),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
