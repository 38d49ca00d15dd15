/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "metamer/color.h"
#include "metamer/image.h"
#include "test.h"

static mtm_picture *grey_picture(int width, int height, double encoded) {
    mtm_error error;
    mtm_picture *picture = NULL;
    assert_ok(mtm_picture_create(width, height, &picture, &error), error);
    for (int i = 0; i < width * height * 4; i++)
        picture->rgba[i] = i % 4 == 3 ? 1.0F : (float)mtm_srgb_decode(encoded);
    return picture;
}

static void equal_pictures_have_no_difference(void **state) {
    (void)state;
    mtm_error error;
    mtm_comparison comparison;
    mtm_picture *picture = grey_picture(5, 3, 0.5);
    assert_ok(mtm_picture_compare(picture, picture, &comparison, &error), error);
    assert_true(comparison.max_error == 0.0 && comparison.mean_error == 0.0);
    assert_true(comparison.psnr_db == 200.0);
    assert_true(comparison.ciede2000_mean == 0.0 && comparison.ciede2000_p99 == 0.0);
    assert_true(comparison.ciede2000_max == 0.0);
    assert_int_equal(comparison.pixels, 15);
    mtm_picture_destroy(picture);
}

static void one_channel_off_by_a_tenth_counts_as_its_share(void **state) {
    (void)state;
    mtm_error error;
    mtm_comparison comparison;
    mtm_picture *a = grey_picture(10, 10, 0.5);
    mtm_picture *b = grey_picture(10, 10, 0.5);
    b->rgba[4 * 37 + 1] = (float)mtm_srgb_decode(0.6);
    assert_ok(mtm_picture_compare(a, b, &comparison, &error), error);
    assert_float_equal(comparison.max_error, 0.1, 1e-6);
    assert_float_equal(comparison.mean_error, 0.1 / 300.0, 1e-8);
    assert_float_equal(comparison.psnr_db, -10.0 * log10(0.01 / 300.0), 1e-4);
    assert_true(comparison.ciede2000_max > 1.0);
    assert_float_equal(comparison.ciede2000_mean, comparison.ciede2000_max / 100.0, 1e-9);
    assert_true(comparison.ciede2000_p99 == 0.0); /* 99 of 100 pixels are equal */
    b->rgba[4 * 38 + 1] = (float)mtm_srgb_decode(0.6);
    assert_ok(mtm_picture_compare(a, b, &comparison, &error), error);
    assert_true(comparison.ciede2000_p99 == comparison.ciede2000_max);
    mtm_picture_destroy(a);
    mtm_picture_destroy(b);
}

static void a_constant_difference_has_its_own_psnr(void **state) {
    (void)state;
    mtm_error error;
    mtm_comparison comparison;
    mtm_picture *a = grey_picture(7, 4, 0.25);
    mtm_picture *b = grey_picture(7, 4, 0.5);
    assert_ok(mtm_picture_compare(a, b, &comparison, &error), error);
    assert_float_equal(comparison.max_error, 0.25, 1e-6);
    assert_float_equal(comparison.mean_error, 0.25, 1e-6);
    assert_float_equal(comparison.psnr_db, 20.0 * log10(4.0), 1e-4);
    assert_float_equal(comparison.ciede2000_mean, comparison.ciede2000_max, 1e-9);
    mtm_picture_destroy(a);
    mtm_picture_destroy(b);
}

static void values_outside_and_no_numbers_are_clipped_and_alpha_does_not_count(void **state) {
    (void)state;
    mtm_error error;
    mtm_comparison comparison;
    mtm_picture *a = grey_picture(1, 1, 0.0);
    mtm_picture *b = grey_picture(1, 1, 0.0);
    const float left[4] = {-3.0F, 7.0F, NAN, 0.25F};
    const float right[4] = {0.0F, 1.0F, 0.0F, 1.0F};
    memcpy(a->rgba, left, sizeof left);
    memcpy(b->rgba, right, sizeof right);
    assert_ok(mtm_picture_compare(a, b, &comparison, &error), error);
    assert_true(comparison.max_error == 0.0);
    assert_true(comparison.ciede2000_max == 0.0);
    mtm_picture_destroy(a);
    mtm_picture_destroy(b);
}

static void the_difference_picture_shows_the_gained_difference(void **state) {
    (void)state;
    mtm_error error;
    mtm_picture *difference = NULL;
    mtm_picture *a = grey_picture(2, 1, 0.5);
    mtm_picture *b = grey_picture(2, 1, 0.5);
    a->rgba[2] = (float)mtm_srgb_decode(0.4);
    a->rgba[4] = (float)mtm_srgb_decode(0.9);
    assert_ok(mtm_picture_difference(a, b, 4.0, &difference, &error), error);
    assert_float_equal(mtm_srgb_encode(difference->rgba[2]), 0.4, 1e-5);
    assert_float_equal(difference->rgba[4], 1.0, 0.0); /* 0.4 × 4 is clipped */
    assert_float_equal(difference->rgba[0], 0.0, 0.0);
    assert_float_equal(difference->rgba[3], 1.0, 0.0);
    mtm_picture_destroy(a);
    mtm_picture_destroy(b);
    mtm_picture_destroy(difference);
}

static void pictures_of_different_size_are_refused(void **state) {
    (void)state;
    mtm_error error;
    mtm_comparison comparison;
    mtm_picture *difference = NULL;
    mtm_picture *a = grey_picture(2, 3, 0.5);
    mtm_picture *b = grey_picture(3, 2, 0.5);
    assert_fails(mtm_picture_compare(a, b, &comparison, &error), MTM_ARGUMENT, error, "2 x 3 and 3 x 2");
    assert_fails(mtm_picture_difference(a, b, 1.0, &difference, &error), MTM_ARGUMENT, error,
                 "2 x 3 and 3 x 2");
    assert_null(difference);
    mtm_picture_destroy(a);
    mtm_picture_destroy(b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_pictures_have_no_difference),
        cmocka_unit_test(one_channel_off_by_a_tenth_counts_as_its_share),
        cmocka_unit_test(a_constant_difference_has_its_own_psnr),
        cmocka_unit_test(values_outside_and_no_numbers_are_clipped_and_alpha_does_not_count),
        cmocka_unit_test(the_difference_picture_shows_the_gained_difference),
        cmocka_unit_test(pictures_of_different_size_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
