/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "image/exr_layout.h"
#include "image/image_files.h"

static const char *const file_name = "test_exr_foreign.exr";

static float value_of(int channel, int x, int y) {
    return (float)channel + (float)x / 16.0F + (float)y / 256.0F;
}

/* A file of 3 × 2 float pixels with these channels, to be changed further. */
static foreign_exr with_channels(int count, const char *const *names) {
    return (foreign_exr){
        .channel_count = count, .names = names, .pixel_type = 2, .width = 3, .height = 2, .value = value_of};
}

static void assert_refused(const foreign_exr *file, mtm_status status, const char *text) {
    mtm_error error;
    mtm_image *image = NULL;
    write_foreign_exr(file_name, file);
    assert_fails(mtm_image_read(file_name, &image, &error), status, error, text);
    assert_fails(mtm_image_read(file_name, &image, &error), status, error, file_name);
    assert_null(image);
}

static void wavelengths_are_read_in_every_form(void **state) {
    (void)state;
    const struct {
        const char *name;
        mtm_exr_meaning meaning;
        double nm;
    } cases[] = {
        {"T.400,0nm", MTM_EXR_REFLECTIVE, 400.0},
        {"T.400nm", MTM_EXR_REFLECTIVE, 400.0},
        {"T.4,0e2nm", MTM_EXR_REFLECTIVE, 400.0},
        {"T.4E+2nm", MTM_EXR_REFLECTIVE, 400.0},
        {"T.0,4um", MTM_EXR_REFLECTIVE, 400.0},
        {"T.4,0e-7m", MTM_EXR_REFLECTIVE, 400.0},
        {"T.0,0004mm", MTM_EXR_REFLECTIVE, 400.0},
        {"T.500THz", MTM_EXR_REFLECTIVE, 599.584916},
        {"T.5e14Hz", MTM_EXR_REFLECTIVE, 599.584916},
        {"T.0,0005EHz", MTM_EXR_REFLECTIVE, 599.584916},
        {"S0.400,0nm", MTM_EXR_EMISSIVE, 400.0},
        {"S3.400,0nm", MTM_EXR_EMISSIVE, 400.0},
        {"T.400nm.500nm", MTM_EXR_FLUORESCENT, 400.0},
        {"T.400.0nm", MTM_EXR_OTHER, 0.0},
        {"T.nm", MTM_EXR_OTHER, 0.0},
        {"T.400", MTM_EXR_OTHER, 0.0},
        {"T.4,0,0nm", MTM_EXR_OTHER, 0.0},
        {"T.400xm", MTM_EXR_OTHER, 0.0},
        {"T.0nm", MTM_EXR_OTHER, 0.0},
        {"T.0Hz", MTM_EXR_OTHER, 0.0},
        {"S4.400nm", MTM_EXR_OTHER, 0.0},
        {"T.400nmx", MTM_EXR_OTHER, 0.0},
        {"T.1e999nm", MTM_EXR_OTHER, 0.0},
        {"R", MTM_EXR_OTHER, 0.0},
        {"", MTM_EXR_OTHER, 0.0},
        {"T", MTM_EXR_OTHER, 0.0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double nm = 0.0;
        const mtm_exr_meaning meaning = mtm_exr_channel_meaning(cases[i].name, &nm);
        if (meaning != cases[i].meaning) fail_msg("%s: meaning %d", cases[i].name, (int)meaning);
        if (meaning != MTM_EXR_OTHER) assert_float_equal(nm, cases[i].nm, 1e-6);
    }
}

static void reflectances_are_sorted_and_brought_to_the_grid(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = NULL;
    /* as texts 1000 comes before 400 */
    const char *const names[] = {"A", "R", "T.1000,0nm", "T.400,0nm", "T.600,0nm"};
    foreign_exr file = with_channels(5, names);
    file.min_x = -7;
    file.min_y = 100;
    file.attribute = "spectralLayoutVersion";
    file.content = "1.0";
    write_foreign_exr(file_name, &file);
    assert_ok(mtm_image_read(file_name, &image, &error), error);
    assert_string_equal(image->basis, "wavelengths");
    assert_null(image->palette);
    assert_null(image->scene);
    assert_int_equal(image->width, 3);
    assert_int_equal(image->height, 2);
    assert_int_equal(image->dimension, 81);
    for (int p = 0; p < 6; p++) {
        const float *pixel = image->pixels + p * 84;
        const int x = p % 3;
        const int y = p / 3;
        assert_float_equal(pixel[0], value_of(3, x, y), 1e-6);         /* 380: held */
        assert_float_equal(pixel[4], value_of(3, x, y), 1e-6);         /* 400 */
        assert_float_equal(pixel[24], value_of(3, x, y) + 0.5F, 1e-6); /* 500 */
        assert_float_equal(pixel[44], value_of(4, x, y), 1e-6);        /* 600 */
        assert_float_equal(pixel[64], value_of(4, x, y) - 0.5F, 1e-6); /* 700 */
        assert_float_equal(pixel[81], value_of(0, x, y), 1e-6);        /* alpha */
        assert_true(pixel[82] == 0.0F && pixel[83] == 0.0F);
    }
    mtm_image_destroy(image);
}

static void without_alpha_everything_is_opaque(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = NULL;
    const char *const names[] = {"T.550,0nm"};
    const foreign_exr file = with_channels(1, names);
    write_foreign_exr(file_name, &file);
    assert_ok(mtm_image_read(file_name, &image, &error), error);
    for (int p = 0; p < 6; p++) assert_true(image->pixels[p * 84 + 81] == 1.0F);
    assert_float_equal(image->pixels[84], value_of(0, 1, 0), 1e-6);
    mtm_image_destroy(image);
}

/* For each count of channels OpenEXR has other functions, some of which do not expect that one is left out. */
static void half_reflectances_are_read_beside_any_number_of_other_channels(void **state) {
    (void)state;
    mtm_error error;
    const char *const names[] = {"A", "T.400nm", "X", "Y", "Z"};
    for (int first = 0; first <= 1; first++) {
        for (int count = 2 - first; count <= 5 - first; count++) {
            mtm_image *image = NULL;
            foreign_exr file = with_channels(count, names + first);
            file.pixel_type = 1;
            write_foreign_exr(file_name, &file);
            assert_ok(mtm_image_read(file_name, &image, &error), error);
            for (int p = 0; p < 6; p++) {
                assert_float_equal(image->pixels[p * 84 + 40], value_of(1 - first, p % 3, p / 3), 0.0);
                const float alpha = first == 0 ? value_of(0, p % 3, p / 3) : 1.0F;
                assert_float_equal(image->pixels[p * 84 + 81], alpha, 0.0);
            }
            mtm_image_destroy(image);
        }
    }
}

static void files_without_reflectances_say_what_they_hold(void **state) {
    (void)state;
    const char *const radiance[] = {"B", "G", "R", "S0.400,0nm", "S0.500,0nm"};
    foreign_exr file = with_channels(5, radiance);
    assert_refused(&file, MTM_FORMAT, "already lit");
    file = with_channels(3, radiance);
    assert_refused(&file, MTM_FORMAT, "has no coefficients");
    const char *const fluorescence[] = {"T.400nm", "T.400nm.500nm"};
    file = with_channels(2, fluorescence);
    assert_refused(&file, MTM_FORMAT, "fluorescence");
    const char *const twice[] = {"T.4,0e2nm", "T.400nm"};
    file = with_channels(2, twice);
    assert_refused(&file, MTM_FORMAT, "'T.4,0e2nm' and 'T.400nm' have the same wavelength");
}

static void unknown_layouts_are_refused(void **state) {
    (void)state;
    const char *const reflectance[] = {"T.400nm"};
    foreign_exr file = with_channels(1, reflectance);
    file.attribute = "spectralLayoutVersion";
    file.content = "9.0";
    assert_refused(&file, MTM_FORMAT, "spectralLayoutVersion is '9.0', expected '1.0'");
    file = with_channels(1, reflectance);
    file.pixel_type = 0;
    assert_refused(&file, MTM_FORMAT, "channel 'T.400nm' has pixel type 0, expected half or float");
    file = with_channels(1, reflectance);
    file.version_flags = 0x200;
    assert_refused(&file, MTM_FORMAT, "is stored as tiles, expected scan lines");
}

static void broken_files_of_our_own_are_refused(void **state) {
    (void)state;
    const char *const gap[] = {"A", "C.00", "C.02"};
    foreign_exr file = with_channels(3, gap);
    assert_refused(&file, MTM_FORMAT, "channel 'C.02' does not fit 2 coefficient channels");
    const char *const names[] = {"A", "C.00"};
    file = with_channels(2, names);
    assert_refused(&file, MTM_FORMAT, "attribute metamer.version is missing");
    file.attribute = "metamer.version";
    file.content = "1";
    assert_refused(&file, MTM_FORMAT, "attribute metamer.basis is missing");
    file.content = "7";
    assert_refused(&file, MTM_FORMAT, "metamer.version is '7', expected '1'");
}

static void absurd_sizes_are_refused_before_memory_is_taken(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = NULL;
    const char *const names[] = {"T.400nm"};
    foreign_exr file = with_channels(1, names);
    const int edges[][2] = {{32768, 32768}, {32769, 1}, {1, 32769}, {1 << 29, 1 << 29}};
    const mtm_status statuses[] = {MTM_FORMAT, MTM_LIMIT, MTM_LIMIT, MTM_LIMIT};
    for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
        file.width = edges[i][0];
        file.height = edges[i][1];
        FILE *stream = fopen(file_name, "wb");
        assert_non_null(stream);
        put_header(stream, &file);
        for (int k = 0; k < 1000; k++) put_integer(stream, 500, 8);
        assert_int_equal(fclose(stream), 0);
        assert_fails(mtm_image_read(file_name, &image, &error), statuses[i], error, file_name);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wavelengths_are_read_in_every_form),
        cmocka_unit_test(reflectances_are_sorted_and_brought_to_the_grid),
        cmocka_unit_test(without_alpha_everything_is_opaque),
        cmocka_unit_test(half_reflectances_are_read_beside_any_number_of_other_channels),
        cmocka_unit_test(files_without_reflectances_say_what_they_hold),
        cmocka_unit_test(unknown_layouts_are_refused),
        cmocka_unit_test(broken_files_of_our_own_are_refused),
        cmocka_unit_test(absurd_sizes_are_refused_before_memory_is_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
