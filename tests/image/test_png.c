/* SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <sys/stat.h>

#include <png.h>
#include <zlib.h>

#include "image/image_files.h"
#include "metamer/color.h"

static const char *const file_name = "test_png.png";

static mtm_picture *new_picture(int width, int height) {
    mtm_error error;
    mtm_picture *picture = NULL;
    assert_ok(mtm_picture_create(width, height, &picture, &error), error);
    return picture;
}

static void set_pixel(mtm_picture *picture, int index, float r, float g, float b, float a) {
    const float rgba[4] = {r, g, b, a};
    memcpy(picture->rgba + index * 4, rgba, sizeof rgba);
}

static void write_picture(const mtm_picture *picture, const char *scene) {
    mtm_error error;
    assert_ok(mtm_picture_write_png(picture, file_name, scene, &error), error);
}

static mtm_picture *read_picture(char **scene) {
    mtm_error error;
    mtm_picture *picture = NULL;
    assert_ok(mtm_picture_read_png(file_name, &picture, scene, &error), error);
    return picture;
}

/* The file as libpng's simple interface shows it: 8-bit RGBA rows. */
static unsigned char *read_levels(uint32_t *format) {
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, file_name));
    *format = image.format;
    image.format = PNG_FORMAT_RGBA;
    unsigned char *levels = malloc(PNG_IMAGE_SIZE(image));
    assert_non_null(levels);
    assert_true(png_image_finish_read(&image, NULL, levels, 0, NULL));
    return levels;
}

static void all_256_levels_come_back_exactly(void **state) {
    (void)state;
    uint32_t format = 0;
    mtm_picture *picture = new_picture(256, 3);
    for (int i = 0; i < 256 * 3; i++) {
        const float linear = (float)mtm_srgb_decode(i % 256 / 255.0);
        set_pixel(picture, i, i / 256 == 0 ? linear : 0.0F, i / 256 == 1 ? linear : 1.0F,
                  i / 256 == 2 ? linear : 0.5F, 1.0F);
    }
    write_picture(picture, NULL);
    unsigned char *levels = read_levels(&format);
    assert_int_equal(format & PNG_FORMAT_FLAG_ALPHA, 0);
    for (int i = 0; i < 256 * 3; i++) assert_int_equal(levels[i * 4 + i / 256], i % 256);
    mtm_picture *copy = read_picture(NULL);
    for (int i = 0; i < 256 * 3; i++) {
        const int channel = i / 256;
        assert_true(copy->rgba[i * 4 + channel] == picture->rgba[i * 4 + channel]);
        assert_true(copy->rgba[i * 4 + 3] == 1.0F);
    }
    free(levels);
    mtm_picture_destroy(picture);
    mtm_picture_destroy(copy);
}

static void levels_are_rounded_to_the_nearest_and_clipped(void **state) {
    (void)state;
    uint32_t format = 0;
    mtm_picture *picture = new_picture(4, 1);
    set_pixel(picture, 0, (float)mtm_srgb_decode(100.4 / 255), (float)mtm_srgb_decode(100.6 / 255), 0.0F,
              1.0F);
    set_pixel(picture, 1, -1.0F, 2.0F, NAN, 1.0F);
    set_pixel(picture, 2, INFINITY, -INFINITY, 1.0F, 1.5F);
    set_pixel(picture, 3, 0.0F, 0.0F, 0.0F, 1.0F);
    write_picture(picture, NULL);
    unsigned char *levels = read_levels(&format);
    const unsigned char expected[] = {100, 101, 0, 255, 0, 255, 0, 255, 255, 0, 255, 255, 0, 0, 0, 255};
    assert_int_equal(format & PNG_FORMAT_FLAG_ALPHA, 0);
    assert_memory_equal(levels, expected, sizeof expected);
    free(levels);
    mtm_picture_destroy(picture);
}

static void alpha_is_straight_and_covers_added_light(void **state) {
    (void)state;
    uint32_t format = 0;
    mtm_picture *picture = new_picture(5, 1);
    const float half = 128.0F / 255.0F;
    set_pixel(picture, 0, 0.0F, 0.0F, 0.0F, 0.0F);
    set_pixel(picture, 1, half, 0.0F, 0.0F, half); /* half covered with full red */
    set_pixel(picture, 2, half, 0.0F, 0.0F, 0.0F); /* the same light without cover */
    set_pixel(picture, 3, 2.0F, 0.0F, 0.0F, 0.0F);
    set_pixel(picture, 4, 0.25F, 0.25F, 0.25F, 1.0F);
    write_picture(picture, NULL);
    unsigned char *levels = read_levels(&format);
    const unsigned char expected[] = {0, 0,   0,   0, 255, 0,   0,   128, 255, 0,
                                      0, 128, 255, 0, 0,   255, 137, 137, 137, 255};
    assert_int_not_equal(format & PNG_FORMAT_FLAG_ALPHA, 0);
    assert_memory_equal(levels, expected, sizeof expected);
    mtm_picture *copy = read_picture(NULL);
    assert_float_equal(copy->rgba[8], half, 1e-6); /* over black it is the same picture */
    assert_float_equal(copy->rgba[11], half, 1e-6);
    free(levels);
    mtm_picture_destroy(picture);
    mtm_picture_destroy(copy);
}

static void assert_scene_comes_back(const char *scene) {
    mtm_error error;
    char *copy = NULL;
    mtm_picture *picture = new_picture(4, 4);
    write_picture(picture, scene);
    mtm_picture_destroy(picture);
    picture = read_picture(&copy);
    assert_string_equal(copy, scene);
    mtm_text_free(copy);
    mtm_picture_destroy(picture);
    assert_ok(mtm_scene_text_of_png(file_name, &copy, &error), error);
    assert_string_equal(copy, scene);
    mtm_text_free(copy);
}

static void the_embedded_scene_comes_back(void **state) {
    (void)state;
    enum { LENGTH = 200000 };
    char *scene = malloc(LENGTH + 1);
    uint64_t seed = 2;
    assert_non_null(scene);
    for (int i = 0; i < LENGTH; i++) scene[i] = (char)(' ' + next_random(&seed) % 90);
    scene[LENGTH] = '\0';
    assert_scene_comes_back(scene);
    assert_scene_comes_back("{\"name\": \"grün 緑 🙂\"}");
    assert_scene_comes_back("");
    free(scene);
}

/* Moves the scene's chunk, which follows the header (33 bytes) and sRGB (13), behind the pixels. */
static void move_scene_to_the_end(void) {
    size_t count = 0;
    char *bytes = read_whole(file_name, &count);
    const size_t begin = 33 + 13;
    assert_memory_equal(bytes + begin + 4, "iTXt", 4);
    const size_t chunk = 12 + png_get_uint_32((png_const_bytep)bytes + begin);
    const size_t end = count - 12; /* of the pixels: IEND follows */
    char *copy = malloc(count);
    assert_non_null(copy);
    memcpy(copy, bytes, begin);
    memcpy(copy + begin, bytes + begin + chunk, end - begin - chunk);
    memcpy(copy + end - chunk, bytes + begin, chunk);
    memcpy(copy + end, bytes + end, 12);
    write_whole(file_name, copy, count);
    free(copy);
    free(bytes);
}

static void a_scene_behind_the_pixels_is_found(void **state) {
    (void)state;
    mtm_error error;
    char *scene = NULL;
    mtm_picture *picture = new_picture(4, 4);
    write_picture(picture, "{\"metamer\": 1}");
    move_scene_to_the_end();
    assert_ok(mtm_scene_text_of_png(file_name, &scene, &error), error);
    assert_string_equal(scene, "{\"metamer\": 1}");
    mtm_text_free(scene);
    mtm_picture_destroy(picture);
}

static void without_a_scene_there_is_none(void **state) {
    (void)state;
    mtm_error error;
    char text[] = "not null";
    char *scene = text;
    mtm_picture *picture = new_picture(4, 4);
    write_picture(picture, NULL);
    assert_ok(mtm_scene_text_of_png(file_name, &scene, &error), error);
    assert_null(scene);
    mtm_picture_destroy(picture);
}

static void the_same_picture_gives_the_same_bytes(void **state) {
    (void)state;
    size_t counts[2] = {0};
    char *bytes[2] = {NULL};
    uint64_t seed = 4;
    mtm_picture *picture = new_picture(60, 50);
    for (int i = 0; i < 60 * 50 * 4; i++) picture->rgba[i] = (float)(next_random(&seed) % 1000) / 999.0F;
    for (int i = 0; i < 2; i++) {
        write_picture(picture, "{}");
        bytes[i] = read_whole(file_name, &counts[i]);
    }
    assert_int_equal(counts[0], counts[1]);
    assert_memory_equal(bytes[0], bytes[1], counts[0]);
    assert_memory_equal(bytes[0] + 37, "sRGB", 4); /* right behind the header */
    free(bytes[0]);
    free(bytes[1]);
    mtm_picture_destroy(picture);
}

static void a_file_cut_off_or_changed_anywhere_is_an_error(void **state) {
    (void)state;
    mtm_error error;
    mtm_picture *copy = NULL;
    char *scene = NULL;
    uint64_t seed = 6;
    mtm_picture *picture = new_picture(7, 9);
    for (int i = 0; i < 7 * 9 * 4; i++) picture->rgba[i] = (float)(next_random(&seed) % 1000) / 999.0F;
    write_picture(picture, "{\"metamer\": 1}");
    size_t count = 0;
    char *bytes = read_whole(file_name, &count);
    for (size_t i = 0; i < count; i++) {
        write_whole("test_png_cut.png", bytes, i);
        assert_fails(mtm_picture_read_png("test_png_cut.png", &copy, NULL, &error), MTM_FORMAT, error,
                     "test_png_cut.png: ");
        bytes[i] = (char)(bytes[i] ^ 0x10);
        write_whole("test_png_cut.png", bytes, count);
        const mtm_status status = mtm_picture_read_png("test_png_cut.png", &copy, &scene, &error);
        assert_true(status == MTM_FORMAT || status == MTM_LIMIT);
        bytes[i] = (char)(bytes[i] ^ 0x10);
    }
    assert_null(copy);
    assert_null(scene);
    free(bytes);
    mtm_picture_destroy(picture);
}

/* Writes with libpng a file of this color type, one row of `width` pixels, with a palette where it needs one.
 * */
static void write_other(int color_type, int bit_depth, int interlace, png_uint_32 width, int height,
                        unsigned char *row) {
    FILE *stream = fopen(file_name, "wb");
    assert_non_null(stream);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    const png_color palette[2] = {{10, 20, 30}, {200, 100, 50}};
    const png_byte transparency[1] = {51};
    png_init_io(png, stream);
    png_set_IHDR(png, info, width, (png_uint_32)height, bit_depth, color_type, interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (color_type == PNG_COLOR_TYPE_PALETTE) {
        png_set_PLTE(png, info, palette, 2);
        png_set_tRNS(png, info, transparency, 1, NULL);
    }
    png_write_info(png, info);
    const int pass_count = png_set_interlace_handling(png);
    for (int pass = 0; pass < pass_count; pass++)
        for (int y = 0; y < height; y++) png_write_row(png, row);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(stream), 0);
}

static void assert_pixel(const mtm_picture *picture, int index, double r, double g, double b, double alpha) {
    const double encoded[3] = {r, g, b};
    for (int i = 0; i < 3; i++)
        assert_float_equal(picture->rgba[index * 4 + i], mtm_srgb_decode(encoded[i]) * alpha, 1e-6);
    assert_float_equal(picture->rgba[index * 4 + 3], alpha, 1e-6);
}

static void every_kind_of_png_is_read(void **state) {
    (void)state;
    unsigned char wide[] = {0x12, 0x34, 0x80, 0x00, 0xff, 0xff};
    write_other(PNG_COLOR_TYPE_RGB, 16, PNG_INTERLACE_NONE, 1, 1, wide);
    mtm_picture *picture = read_picture(NULL);
    assert_pixel(picture, 0, 0x1234 / 65535.0, 0x8000 / 65535.0, 1.0, 1.0);
    mtm_picture_destroy(picture);

    unsigned char indices[] = {0x40}; /* 1 bit: 0, 1, 0 */
    write_other(PNG_COLOR_TYPE_PALETTE, 1, PNG_INTERLACE_NONE, 3, 2, indices);
    picture = read_picture(NULL);
    assert_pixel(picture, 0, 10 / 255.0, 20 / 255.0, 30 / 255.0, 51 / 255.0);
    assert_pixel(picture, 4, 200 / 255.0, 100 / 255.0, 50 / 255.0, 1.0);
    mtm_picture_destroy(picture);

    unsigned char grey_alpha[] = {60, 255, 200, 102};
    write_other(PNG_COLOR_TYPE_GRAY_ALPHA, 8, PNG_INTERLACE_ADAM7, 2, 5, grey_alpha);
    picture = read_picture(NULL);
    assert_int_equal(picture->height, 5);
    for (int y = 0; y < 5; y++) {
        assert_pixel(picture, y * 2, 60 / 255.0, 60 / 255.0, 60 / 255.0, 1.0);
        assert_pixel(picture, y * 2 + 1, 200 / 255.0, 200 / 255.0, 200 / 255.0, 0.4);
    }
    mtm_picture_destroy(picture);
}

static void what_is_no_png_is_told(void **state) {
    (void)state;
    mtm_error error;
    mtm_picture *picture = NULL;
    char *scene = NULL;
    write_whole("test_png_text.png", "hello, this is text", 19);
    assert_false(mtm_file_is_png("test_png_text.png"));
    assert_fails(mtm_picture_read_png("test_png_text.png", &picture, NULL, &error), MTM_FORMAT, error,
                 "test_png_text.png: is no PNG file");
    assert_fails(mtm_scene_text_of_png("test_png_text.png", &scene, &error), MTM_FORMAT, error,
                 "is no PNG file");
    assert_fails(mtm_picture_read_png("no_such_file.png", &picture, NULL, &error), MTM_IO, error,
                 "no_such_file.png: cannot be opened");
    assert_fails(mtm_picture_read_png("/", &picture, NULL, &error), MTM_IO, error, "is a folder");
    picture = new_picture(2, 2);
    write_picture(picture, NULL);
    assert_true(mtm_file_is_png(file_name));
    assert_false(mtm_file_is_exr(file_name));
    mtm_picture_destroy(picture);
}

static void what_cannot_be_written_is_an_io_error(void **state) {
    (void)state;
    mtm_error error;
    struct stat device;
    uint64_t seed = 8;
    mtm_picture *picture =
        new_picture(200, 200); /* of noise, so that the file outgrows the stream's buffer */
    for (int i = 0; i < 200 * 200 * 4; i++) picture->rgba[i] = (float)(next_random(&seed) % 1000) / 999.0F;
    assert_fails(mtm_picture_write_png(picture, "no_such_folder/a.png", NULL, &error), MTM_IO, error,
                 "no_such_folder/a.png: ");
    assert_fails(mtm_picture_write_png(picture, "/", NULL, &error), MTM_IO, error, "/: ");
    if (stat("/dev/full", &device) == 0) {
        assert_fails(mtm_picture_write_png(picture, "/dev/full", NULL, &error), MTM_IO, error,
                     "/dev/full: cannot be written: No space left on device");
        assert_int_equal(stat("/dev/full", &device), 0);
        assert_true(S_ISCHR(device.st_mode));
    }
    mtm_picture_destroy(picture);
}

/* A header and one small pixel chunk, with right check sums. */
static void write_claim(png_uint_32 width, png_uint_32 height) {
    const unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    unsigned char header[17] = "IHDR";
    png_save_uint_32(header + 4, width);
    png_save_uint_32(header + 8, height);
    header[12] = 8;
    header[13] = 6;
    const unsigned char pixels[] = "IDAT";
    unsigned char number[4];
    FILE *stream = fopen(file_name, "wb");
    assert_non_null(stream);
    put_bytes(stream, signature, sizeof signature);
    png_save_uint_32(number, 13);
    put_bytes(stream, number, 4);
    put_bytes(stream, header, 17);
    png_save_uint_32(number, (png_uint_32)crc32(0, header, 17));
    put_bytes(stream, number, 4);
    png_save_uint_32(number, 0);
    put_bytes(stream, number, 4);
    put_bytes(stream, pixels, 4);
    png_save_uint_32(number, (png_uint_32)crc32(0, pixels, 4));
    put_bytes(stream, number, 4);
    assert_int_equal(fclose(stream), 0);
}

static void absurd_sizes_are_refused_before_memory_is_taken(void **state) {
    (void)state;
    mtm_error error;
    mtm_picture *picture = NULL;
    write_claim(32769, 1);
    assert_fails(mtm_picture_read_png(file_name, &picture, NULL, &error), MTM_LIMIT, error,
                 "32769 x 1 pixels");
    write_claim(0x7fffffff, 0x7fffffff);
    assert_fails(mtm_picture_read_png(file_name, &picture, NULL, &error), MTM_LIMIT, error, "at most 32768");
    write_claim(32768, 32768);
    assert_fails(mtm_picture_read_png(file_name, &picture, NULL, &error), MTM_FORMAT, error, "cannot hold");
    assert_null(picture);
}

static void a_text_that_would_swell_beyond_the_limit_is_refused(void **state) {
    (void)state;
    mtm_error error;
    char *scene = NULL;
    enum { LENGTH = 65 << 20 };
    char *text = malloc(LENGTH + 1);
    assert_non_null(text);
    memset(text, 'x', LENGTH);
    text[LENGTH] = '\0';
    mtm_picture *picture = new_picture(2, 2);
    write_picture(picture, text);
    assert_fails(mtm_scene_text_of_png(file_name, &scene, &error), MTM_FORMAT, error, "test_png.png: ");
    assert_null(scene);
    free(text);
    mtm_picture_destroy(picture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_256_levels_come_back_exactly),
        cmocka_unit_test(levels_are_rounded_to_the_nearest_and_clipped),
        cmocka_unit_test(alpha_is_straight_and_covers_added_light),
        cmocka_unit_test(the_embedded_scene_comes_back),
        cmocka_unit_test(a_scene_behind_the_pixels_is_found),
        cmocka_unit_test(without_a_scene_there_is_none),
        cmocka_unit_test(the_same_picture_gives_the_same_bytes),
        cmocka_unit_test(a_file_cut_off_or_changed_anywhere_is_an_error),
        cmocka_unit_test(every_kind_of_png_is_read),
        cmocka_unit_test(what_is_no_png_is_told),
        cmocka_unit_test(what_cannot_be_written_is_an_io_error),
        cmocka_unit_test(absurd_sizes_are_refused_before_memory_is_taken),
        cmocka_unit_test(a_text_that_would_swell_beyond_the_limit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
