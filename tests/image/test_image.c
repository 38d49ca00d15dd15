/* SPDX-License-Identifier: BSD-3-Clause */
#include "metamer/image.h"

#include "test.h"

static void lanes_hold_the_coefficients_and_alpha(void **state) {
    (void)state;
    const int expected[][2] = {{1, 4},   {3, 4},   {4, 8},   {7, 8},  {8, 16},
                               {15, 16}, {16, 20}, {81, 84}, {83, 84}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_int_equal(mtm_lanes(expected[i][0]), expected[i][1]);
}

static void a_new_image_is_black_and_owns_its_texts(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = NULL;
    char basis[] = "materials";
    assert_ok(mtm_image_create(3, 2, 4, basis, NULL, "{}", &image, &error), error);
    basis[0] = 'x';
    assert_string_equal(image->basis, "materials");
    assert_null(image->palette);
    assert_string_equal(image->scene, "{}");
    assert_int_equal(image->lanes, 8);
    for (int i = 0; i < 3 * 2 * 8; i++) assert_true(image->pixels[i] == 0.0F);
    mtm_image_destroy(image);
    mtm_image_destroy(NULL);
}

static void an_image_of_halves_has_the_rounded_numbers(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = NULL;
    mtm_half_image *half = NULL;
    assert_ok(mtm_image_create(3, 2, 4, "materials", NULL, NULL, &image, &error), error);
    image->pixels[0] = 1;
    image->pixels[9] = -0.1F;
    image->pixels[47] = 1e6F;
    assert_ok(mtm_half_image_create(image, &half, &error), error);
    assert_true(half->width == 3 && half->height == 2 && half->dimension == 4 && half->lanes == 8);
    for (int i = 0; i < 3 * 2 * 8; i++)
        assert_int_equal(half->pixels[i], i == 0 ? 0x3c00 : i == 9 ? 0xae66 : i == 47 ? 0x7c00 : 0);
    mtm_half_image_destroy(half);
    mtm_half_image_destroy(NULL);
    mtm_image_destroy(image);
}

static void a_new_picture_is_transparent(void **state) {
    (void)state;
    mtm_error error;
    mtm_picture *picture = NULL;
    assert_ok(mtm_picture_create(2, 3, &picture, &error), error);
    for (int i = 0; i < 2 * 3 * 4; i++) assert_true(picture->rgba[i] == 0.0F);
    mtm_picture_destroy(picture);
    mtm_picture_destroy(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lanes_hold_the_coefficients_and_alpha),
        cmocka_unit_test(a_new_image_is_black_and_owns_its_texts),
        cmocka_unit_test(an_image_of_halves_has_the_rounded_numbers),
        cmocka_unit_test(a_new_picture_is_transparent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
