/* SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/image_files.h"
#include "metamer/spectrum.h"

static const char *const file_name = "test_exr.exr";

/* Random bits: all exponents, signs and denormals. Patterns that are no numbers become one such. */
static mtm_image *random_image(int width, int height, int dimension) {
    mtm_error error;
    mtm_image *image = NULL;
    uint64_t seed = (uint64_t)width * 1000 + (uint64_t)dimension;
    assert_ok(mtm_image_create(width, height, dimension, "materials", "{\"materials\": []}",
                               "{\"metamer\": 1}", &image, &error),
              error);
    for (int p = 0; p < width * height; p++) {
        for (int i = 0; i <= dimension; i++) {
            const uint32_t bits = next_random(&seed);
            float value = 0.0F;
            memcpy(&value, &bits, sizeof value);
            image->pixels[p * image->lanes + i] = isnan(value) ? NAN : value;
        }
    }
    return image;
}

static mtm_image *read_back(void) {
    mtm_error error;
    mtm_image *image = NULL;
    assert_ok(mtm_image_read(file_name, &image, &error), error);
    return image;
}

static void write_image(const mtm_image *image) {
    mtm_error error;
    const mtm_image_write_options options = mtm_image_write_defaults();
    assert_ok(mtm_image_write(image, file_name, &options, &error), error);
}

static void assert_same_image(const mtm_image *a, const mtm_image *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->dimension, b->dimension);
    assert_int_equal(a->lanes, b->lanes);
    assert_memory_equal(a->pixels, b->pixels, (size_t)(a->width * a->height * a->lanes) * sizeof(float));
    assert_string_equal(a->basis, b->basis);
    assert_string_equal(a->palette, b->palette);
    assert_string_equal(a->scene, b->scene);
}

static void coefficients_come_back_bit_for_bit(void **state) {
    (void)state;
    const int dimensions[] = {1, 3, 7, 8, 15, 81, 83};
    const int sizes[][2] = {{1, 1}, {3, 5}, {16, 16}, {257, 129}};
    for (size_t i = 0; i < sizeof dimensions / sizeof *dimensions; i++) {
        for (size_t j = 0; j < sizeof sizes / sizeof *sizes; j++) {
            mtm_image *image = random_image(sizes[j][0], sizes[j][1], dimensions[i]);
            write_image(image);
            mtm_image *copy = read_back();
            assert_same_image(image, copy);
            mtm_image_destroy(image);
            mtm_image_destroy(copy);
        }
    }
}

static void half_coefficients_come_back_to_eleven_bits(void **state) {
    (void)state;
    mtm_error error;
    mtm_image_write_options options = mtm_image_write_defaults();
    options.is_half = true;
    mtm_image *image = random_image(33, 21, 7);
    uint64_t seed = 1;
    for (int i = 0; i < 33 * 21 * 8; i++)
        image->pixels[i] = (float)(next_random(&seed) % 2001) / 1000.0F - 1.0F;
    image->pixels[0] = 0.5F; /* exact in half */
    image->pixels[1] = 1.0F / 3.0F;
    assert_ok(mtm_image_write(image, file_name, &options, &error), error);
    mtm_image *copy = read_back();
    for (int i = 0; i < 33 * 21 * 8; i++)
        assert_float_equal(copy->pixels[i], image->pixels[i], fabsf(image->pixels[i]) / 2048.0F + 1e-7F);
    assert_true(copy->pixels[0] == 0.5F);
    assert_true(copy->pixels[1] == 0x1.554p-2F); /* 1/3 in eleven bits */
    mtm_image_destroy(image);
    mtm_image_destroy(copy);
}

static void special_halves_come_back(void **state) {
    (void)state;
    mtm_error error;
    mtm_image_write_options options = mtm_image_write_defaults();
    options.is_half = true;
    mtm_image *image = NULL;
    const float values[] = {0.0F, -0.0F, INFINITY, -INFINITY, 65504.0F, -0x1p-24F, 0x1p-14F, 0x3ffp-24F};
    assert_ok(mtm_image_create(1, 1, 7, "factors", NULL, NULL, &image, &error), error);
    memcpy(image->pixels, values, sizeof values);
    assert_ok(mtm_image_write(image, file_name, &options, &error), error);
    mtm_image *copy = read_back();
    assert_memory_equal(copy->pixels, values, sizeof values);
    mtm_image_destroy(image);
    mtm_image_destroy(copy);
}

static void long_and_foreign_texts_come_back(void **state) {
    (void)state;
    mtm_error error;
    enum { LENGTH = 300000 };
    mtm_image *image = NULL;
    char *scene = malloc(LENGTH + 1);
    assert_non_null(scene);
    for (int i = 0; i < LENGTH; i++) scene[i] = (char)(' ' + i % 90);
    scene[LENGTH] = '\0';
    assert_ok(mtm_image_create(2, 2, 3, "factors", "{\"name\": \"grün 緑 🙂\"}", scene, &image, &error),
              error);
    write_image(image);
    mtm_image *copy = read_back();
    assert_same_image(image, copy);
    mtm_image_destroy(image);
    mtm_image_destroy(copy);
    free(scene);
}

static void missing_texts_stay_missing(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = NULL;
    assert_ok(mtm_image_create(2, 2, 81, "wavelengths", NULL, NULL, &image, &error), error);
    write_image(image);
    mtm_image *copy = read_back();
    assert_null(copy->palette);
    assert_null(copy->scene);
    mtm_image_destroy(image);
    mtm_image_destroy(copy);
}

/* An image with everything that can be added to it. */
static mtm_image *write_full(float *reconstruction) {
    mtm_error error;
    mtm_picture *preview = NULL;
    mtm_image *image = random_image(19, 40, 3);
    assert_ok(mtm_picture_create(19, 40, &preview, &error), error);
    uint64_t seed = 5;
    for (int i = 0; i < 19 * 40 * 4; i++) preview->rgba[i] = (float)(next_random(&seed) % 1000) / 1000.0F;
    for (int i = 0; i < 19 * 40 * 4; i++) image->pixels[i] = (float)(next_random(&seed) % 1000) / 1000.0F;
    for (int i = 0; i < 81 * 3; i++) reconstruction[i] = (float)(next_random(&seed) % 1000) / 1000.0F;
    mtm_image_write_options options = mtm_image_write_defaults();
    options.preview = preview;
    options.reconstruction = reconstruction;
    assert_ok(mtm_image_write(image, file_name, &options, &error), error);
    mtm_picture_destroy(preview);
    return image;
}

static void a_preview_and_spectra_do_not_disturb_the_coefficients(void **state) {
    (void)state;
    float reconstruction[81 * 3];
    mtm_image *image = write_full(reconstruction);
    mtm_image *copy = read_back();
    assert_same_image(image, copy);
    mtm_image_destroy(image);
    mtm_image_destroy(copy);
}

/* Renames the channels C.00 … in the file's bytes so that only its spectra are recognised. */
static void hide_coefficients(void) {
    size_t count = 0;
    char *bytes = read_whole(file_name, &count);
    for (size_t i = 0; i + 5 < count && i < 2000; i++)
        if (memcmp(bytes + i, "C.0", 3) == 0) bytes[i + 1] = '_';
    write_whole(file_name, bytes, count);
    free(bytes);
}

static void spectra_are_the_reconstruction_times_the_coefficients(void **state) {
    (void)state;
    float reconstruction[81 * 3];
    mtm_image *image = write_full(reconstruction);
    hide_coefficients();
    mtm_image *spectra = read_back();
    assert_string_equal(spectra->basis, "wavelengths");
    assert_int_equal(spectra->dimension, 81);
    for (int p = 0; p < 19 * 40; p++) {
        const float *c = image->pixels + p * 4;
        for (int i = 0; i < 81; i++) {
            const float *weight = reconstruction + i * 3;
            const float expected = weight[0] * c[0] + weight[1] * c[1] + weight[2] * c[2];
            assert_float_equal(spectra->pixels[p * 84 + i], expected, 1e-6);
        }
        assert_true(spectra->pixels[p * 84 + 81] == c[3]);
    }
    mtm_image_destroy(image);
    mtm_image_destroy(spectra);
}

static void the_same_image_gives_the_same_bytes(void **state) {
    (void)state;
    size_t counts[2] = {0};
    char *bytes[2] = {NULL};
    mtm_image *image = random_image(50, 60, 7);
    for (int i = 0; i < 2; i++) {
        write_image(image);
        bytes[i] = read_whole(file_name, &counts[i]);
    }
    assert_int_equal(counts[0], counts[1]);
    assert_memory_equal(bytes[0], bytes[1], counts[0]);
    free(bytes[0]);
    free(bytes[1]);
    mtm_image_destroy(image);
}

static void a_file_cut_off_anywhere_is_an_error(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = random_image(20, 70, 3);
    write_image(image);
    size_t count = 0;
    char *bytes = read_whole(file_name, &count);
    for (size_t length = 0; length < count; length += length < 1000 ? 1 : 97) {
        mtm_image *copy = NULL;
        write_whole("test_exr_cut.exr", bytes, length);
        assert_fails(mtm_image_read("test_exr_cut.exr", &copy, &error), MTM_FORMAT, error,
                     "test_exr_cut.exr: ");
        assert_null(copy);
    }
    free(bytes);
    mtm_image_destroy(image);
}

static void a_damaged_file_never_crashes(void **state) {
    (void)state;
    mtm_error error;
    uint64_t seed = 3;
    mtm_image *image = random_image(9, 20, 3);
    write_image(image);
    size_t count = 0;
    char *bytes = read_whole(file_name, &count);
    for (int i = 0; i < 2000; i++) {
        mtm_image *copy = NULL;
        const size_t place = next_random(&seed) % (i % 2 == 0 ? count : 700);
        const char old = bytes[place];
        bytes[place] = (char)(next_random(&seed) & 0xff);
        write_whole("test_exr_cut.exr", bytes, count);
        if (mtm_image_read("test_exr_cut.exr", &copy, &error) == MTM_OK) mtm_image_destroy(copy);
        bytes[place] = old;
    }
    free(bytes);
    mtm_image_destroy(image);
}

static void what_cannot_be_opened_is_an_io_error(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = NULL;
    assert_fails(mtm_image_read("no_such_file.exr", &image, &error), MTM_IO, error, "no_such_file.exr: ");
    assert_fails(mtm_image_read("/", &image, &error), MTM_IO, error, "is a folder");
    image = random_image(2, 2, 3);
    const mtm_image_write_options options = mtm_image_write_defaults();
    assert_fails(mtm_image_write(image, "no_such_folder/a.exr", &options, &error), MTM_IO, error,
                 "no_such_folder/a.exr: ");
    assert_fails(mtm_image_write(image, "/", &options, &error), MTM_IO, error, "/: ");
    mtm_image_destroy(image);
}

static void a_full_disk_is_an_io_error_and_the_device_stays(void **state) {
    (void)state;
    mtm_error error;
    struct stat device;
    if (stat("/dev/full", &device) != 0) skip();
    mtm_image *image = random_image(200, 200, 3);
    const mtm_image_write_options options = mtm_image_write_defaults();
    assert_fails(mtm_image_write(image, "/dev/full", &options, &error), MTM_IO, error,
                 "/dev/full: cannot be written: No space left on device");
    assert_int_equal(stat("/dev/full", &device), 0);
    assert_true(S_ISCHR(device.st_mode));
    mtm_image_destroy(image);
}

static void files_are_known_by_their_first_bytes(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = random_image(2, 2, 3);
    write_image(image);
    assert_true(mtm_file_is_exr(file_name));
    assert_false(mtm_file_is_png(file_name));
    assert_false(mtm_file_is_exr("no_such_file.exr"));
    write_whole("test_exr_text.exr", "hello, this is text", 19);
    assert_false(mtm_file_is_exr("test_exr_text.exr"));
    mtm_image *copy = NULL;
    assert_fails(mtm_image_read("test_exr_text.exr", &copy, &error), MTM_FORMAT, error,
                 "test_exr_text.exr: is no OpenEXR file");
    mtm_image_destroy(image);
}

/* The output of a command, for free(); NULL where the command cannot be run. */
static char *output_of(const char *command) {
    FILE *stream = popen(command, "r");
    enum { BYTES = 1 << 20 };
    char *text = calloc(BYTES, 1);
    if (stream == NULL || text == NULL) return NULL;
    (void)fread(text, 1, BYTES - 1, stream);
    if (pclose(stream) == 0) return text;
    free(text);
    return NULL;
}

static void openexr_tools_read_our_files(void **state) {
    (void)state;
    float reconstruction[81 * 3];
    mtm_image_destroy(write_full(reconstruction));
    char *text = output_of("exrheader test_exr.exr 2>&1");
    if (text == NULL) {
        print_message("exrheader (Debian package openexr) is missing, its test is left out\n");
        skip();
    }
    const char *const expected[] = {
        "metamer.version (type string): \"1\"",
        "metamer.basis (type string): \"materials\"",
        "metamer.scene (type string): \"{\"metamer\": 1}\"",
        "spectralLayoutVersion (type string): \"1.0\"",
        "A, 32-bit floating-point, sampling 1 1",
        "C.00, 32-bit floating-point, sampling 1 1",
        "C.02, 32-bit floating-point, sampling 1 1",
        "R, 32-bit floating-point, sampling 1 1",
        "T.380,000000nm, 32-bit floating-point, sampling 1 1",
        "T.780,000000nm, 32-bit floating-point, sampling 1 1",
        "compression (type compression): zip",
        "dataWindow (type box2i): (0 0) - (18 39)",
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (strstr(text, expected[i]) == NULL)
            fail_msg("exrheader does not say '%s':\n%s", expected[i], text);
    free(text);
    text = output_of("exrinfo -v test_exr.exr 2>&1");
    assert_non_null(text);
    free(text);
}

static void the_layout_of_another_version_is_refused(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *copy = NULL;
    mtm_image *image = random_image(2, 2, 3);
    write_image(image);
    size_t count = 0;
    char *bytes = read_whole(file_name, &count);
    for (size_t i = 0; i + 30 < count; i++) {
        if (memcmp(bytes + i, "metamer.version", 16) != 0) continue;
        bytes[i + 16 + 7 + 4] = '2'; /* after the name, "string" and the length */
    }
    write_whole(file_name, bytes, count);
    assert_fails(mtm_image_read(file_name, &copy, &error), MTM_FORMAT, error,
                 "metamer.version is '2', expected '1'");
    free(bytes);
    mtm_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coefficients_come_back_bit_for_bit),
        cmocka_unit_test(half_coefficients_come_back_to_eleven_bits),
        cmocka_unit_test(special_halves_come_back),
        cmocka_unit_test(long_and_foreign_texts_come_back),
        cmocka_unit_test(missing_texts_stay_missing),
        cmocka_unit_test(a_preview_and_spectra_do_not_disturb_the_coefficients),
        cmocka_unit_test(spectra_are_the_reconstruction_times_the_coefficients),
        cmocka_unit_test(the_same_image_gives_the_same_bytes),
        cmocka_unit_test(a_file_cut_off_anywhere_is_an_error),
        cmocka_unit_test(a_damaged_file_never_crashes),
        cmocka_unit_test(what_cannot_be_opened_is_an_io_error),
        cmocka_unit_test(a_full_disk_is_an_io_error_and_the_device_stays),
        cmocka_unit_test(files_are_known_by_their_first_bytes),
        cmocka_unit_test(openexr_tools_read_our_files),
        cmocka_unit_test(the_layout_of_another_version_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
