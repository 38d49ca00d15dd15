/* SPDX-License-Identifier: BSD-3-Clause
 * Writes a picture as PNG, clipped and encoded. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <png.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "color/srgb_levels.h"
#include "image/png.h"

enum { COMPRESSION_LEVEL = 6 }; /* stated so that the bytes do not depend on a default */

typedef struct png_writer {
    const mtm_picture *picture;
    const char *scene;
    FILE *stream;
    png_structp png;
    png_infop info;
    unsigned char *row;
    bool has_alpha;
    int reason;                         /* errno of the write that failed, else 0 */
    char message[MTM_PNG_REASON_BYTES]; /* libpng's */
} png_writer;

static void stop_at_error(png_structp png, png_const_charp message) {
    png_writer *writer = png_get_error_ptr(png);
    (void)snprintf(writer->message, sizeof writer->message, "%s", message);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static void write_bytes(png_structp png, png_bytep bytes, size_t count) {
    png_writer *writer = png_get_io_ptr(png);
    if (fwrite(bytes, 1, count, writer->stream) == count) return;
    writer->reason = errno;
    png_error(png, "write error");
}

static void flush_nothing(png_structp png) {
    (void)png;
}

static double clip(double value) {
    return value > 0.0 ? fmin(value, 1.0) : 0.0; /* what is not a number becomes 0 */
}

static bool has_transparency(const mtm_picture *picture) {
    const size_t pixels = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < pixels; i++)
        if (!(picture->rgba[i * 4 + 3] >= 1.0F)) return true;
    return false;
}

/* Straight color = premultiplied color / alpha, which must not exceed 1; so alpha is at least the largest
 * channel. Over black, color · alpha is then the premultiplied color again. */
static void encode_pixel(const mtm_srgb_levels *levels, const float *rgba, bool has_alpha,
                         unsigned char *bytes) {
    const double rgb[3] = {clip(rgba[0]), clip(rgba[1]), clip(rgba[2])};
    double alpha = 1.0;
    if (has_alpha) alpha = fmax(clip(rgba[3]), fmax(rgb[0], fmax(rgb[1], rgb[2])));
    for (int i = 0; i < 3; i++) {
        const double straight = alpha > 0.0 ? rgb[i] / alpha : 0.0;
        bytes[i] = (unsigned char)mtm_srgb_level_of_double(levels, straight);
    }
    if (has_alpha) bytes[3] = (unsigned char)lrint(alpha * 255.0);
}

static void write_scene(png_writer *writer) {
    char keyword[] = MTM_PNG_SCENE; /* libpng's structure wants texts that are not const, but changes none */
    char nothing[] = "";
    png_text text = {
        .compression = PNG_ITXT_COMPRESSION_zTXt,
        .key = keyword,
        .text = (char *)writer->scene,
        .itxt_length = strlen(writer->scene),
        .lang = nothing,
        .lang_key = nothing,
    };
    png_set_text(writer->png, writer->info, &text, 1);
}

/* Everything that libpng may jump out of. */
static void write_content(png_writer *writer) {
    const mtm_picture *picture = writer->picture;
    png_set_write_fn(writer->png, writer, write_bytes, flush_nothing);
    png_set_user_limits(writer->png, MTM_IMAGE_EDGE_MAX, MTM_IMAGE_EDGE_MAX);
    png_set_compression_level(writer->png, COMPRESSION_LEVEL);
    png_set_IHDR(writer->png, writer->info, (png_uint_32)picture->width, (png_uint_32)picture->height, 8,
                 writer->has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(writer->png, writer->info, PNG_sRGB_INTENT_RELATIVE);
    if (writer->scene != NULL) write_scene(writer);
    png_write_info(writer->png, writer->info);
    mtm_srgb_levels levels;
    mtm_srgb_levels_prepare(&levels);
    const float *rgba = picture->rgba;
    const size_t channels = writer->has_alpha ? 4 : 3;
    for (int y = 0; y < picture->height; y++) {
        for (size_t x = 0; x < (size_t)picture->width; x++, rgba += 4)
            encode_pixel(&levels, rgba, writer->has_alpha, writer->row + x * channels);
        png_write_row(writer->png, writer->row);
    }
    png_write_end(writer->png, writer->info);
}

/* False after a jump out of libpng. */
static bool run_writer(png_writer *writer) {
    if (setjmp(png_jmpbuf(writer->png)) != 0) return false;
    write_content(writer);
    return true;
}

static mtm_status fail_write(const png_writer *writer, const char *path, mtm_error *error) {
    if (writer->reason != 0)
        return mtm_fail(error, MTM_IO, "%s: cannot be written: %s", path, strerror(writer->reason));
    return mtm_fail(error, MTM_MEMORY, "%s: cannot be written as PNG: %s", path, writer->message);
}

static mtm_status write_file(png_writer *writer, const char *path, mtm_error *error) {
    mtm_output output;
    const mtm_status status = mtm_output_open(path, &output, error);
    if (status != MTM_OK) return status;
    writer->stream = output.stream;
    if (run_writer(writer)) return mtm_output_commit(&output, error);
    mtm_output_abandon(&output);
    return fail_write(writer, path, error);
}

mtm_status mtm_picture_write_png(const mtm_picture *picture, const char *path, const char *scene,
                                 mtm_error *error) {
    png_writer writer = {.picture = picture, .scene = scene, .has_alpha = has_transparency(picture)};
    const size_t row_bytes = (size_t)picture->width * 4;
    writer.row = mtm_allocate(row_bytes, 1);
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer, stop_at_error, ignore_warning);
    writer.info = writer.png == NULL ? NULL : png_create_info_struct(writer.png);
    const mtm_status status = writer.row == NULL || writer.info == NULL
                                  ? mtm_fail_memory(error, path, row_bytes)
                                  : write_file(&writer, path, error);
    png_destroy_write_struct(&writer.png, &writer.info);
    free(writer.row);
    return status;
}
