/* SPDX-License-Identifier: BSD-3-Clause
 * Reads a PNG of any kind as a picture, and the scene embedded in it. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <png.h>

#include "base/fail.h"
#include "base/memory.h"
#include "image/png.h"
#include "metamer/color.h"

enum {
    SIGNATURE_BYTES = 8,
    TEXT_BYTES_MAX = 64 << 20,    /* of a text chunk, decompressed */
    CHUNK_COUNT_MAX = 32,         /* of ancillary chunks kept */
    COMPRESSION_RATIO_MAX = 1032, /* deflate's best */
    LEVELS = 65536,
};

typedef struct png_reader {
    FILE *stream;
    const char *path;
    off_t byte_count; /* of the file; -1 for a pipe, which cannot tell */
    mtm_error *error;
    png_structp png;
    png_infop info;
    mtm_picture *picture; /* what is read so far */
    png_bytep *rows;      /* each in the second half of its row of floats */
    float *linear;        /* linear value of each 16-bit level */
    mtm_status status;    /* MTM_OK while a failure is libpng's, which `message` then tells */
    char message[MTM_PNG_REASON_BYTES];
    char text_warning
        [MTM_PNG_REASON_BYTES]; /* the last one about a text chunk, which libpng then leaves out */
} png_reader;

bool mtm_file_is_png(const char *path) {
    unsigned char start[SIGNATURE_BYTES];
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) return false;
    const size_t count = fread(start, 1, sizeof start, stream);
    (void)fclose(stream);
    return count == sizeof start && png_sig_cmp(start, 0, sizeof start) == 0;
}

static void stop_at_error(png_structp png, png_const_charp message) {
    png_reader *reader = png_get_error_ptr(png);
    (void)snprintf(reader->message, sizeof reader->message, "%s", message);
    png_longjmp(png, 1);
}

/* libpng leaves out what it warns about. A chunk beyond the limit it would still read, so that ends here. */
static void keep_text_warning(png_structp png, png_const_charp message) {
    png_reader *reader = png_get_error_ptr(png);
    if (strstr(message, "too large") != NULL) png_error(png, message);
    if (strncmp(message, "iTXt", 4) == 0)
        (void)snprintf(reader->text_warning, sizeof reader->text_warning, "%s", message);
}

static void read_bytes(png_structp png, png_bytep bytes, size_t count) {
    png_reader *reader = png_get_io_ptr(png);
    if (fread(bytes, 1, count, reader->stream) == count) return;
    if (ferror(reader->stream))
        reader->status =
            mtm_fail(reader->error, MTM_IO, "%s: cannot be read: %s", reader->path, strerror(errno));
    png_error(png, "the file ends too early");
}

/* Leaves through libpng, with a failure of our own. */
static void stop_with(png_reader *reader, mtm_status status) {
    reader->status = status;
    png_error(reader->png, "stopped");
}

static void check_signature(png_reader *reader) {
    unsigned char start[SIGNATURE_BYTES];
    const size_t count = fread(start, 1, sizeof start, reader->stream);
    if (count != sizeof start || png_sig_cmp(start, 0, sizeof start) != 0)
        stop_with(reader, mtm_fail(reader->error, MTM_FORMAT, "%s: is no PNG file", reader->path));
    png_set_sig_bytes(reader->png, SIGNATURE_BYTES);
}

/* The limits of sizes are checked in our own words below; libpng's stand open. */
static void prepare(png_reader *reader) {
    png_set_read_fn(reader->png, reader, read_bytes);
    png_set_user_limits(reader->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_chunk_malloc_max(reader->png, TEXT_BYTES_MAX);
    png_set_chunk_cache_max(reader->png, CHUNK_COUNT_MAX);
    png_set_crc_action(reader->png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    check_signature(reader);
}

/* A file of a few bytes can claim gigabytes: it must be large enough for what it claims to hold. */
static void check_size(png_reader *reader, png_uint_32 width, png_uint_32 height) {
    if (width > MTM_IMAGE_EDGE_MAX || height > MTM_IMAGE_EDGE_MAX)
        stop_with(reader,
                  mtm_fail(reader->error, MTM_LIMIT, "%s: %u x %u pixels, at most %d each are supported",
                           reader->path, (unsigned)width, (unsigned)height, MTM_IMAGE_EDGE_MAX));
    const uint64_t claimed = (uint64_t)png_get_rowbytes(reader->png, reader->info) * height;
    if (reader->byte_count >= 0 && claimed / COMPRESSION_RATIO_MAX > (uint64_t)reader->byte_count)
        stop_with(reader,
                  mtm_fail(reader->error, MTM_FORMAT,
                           "%s: %lld bytes cannot hold the %llu bytes of pixels that its header claims",
                           reader->path, (long long)reader->byte_count, (unsigned long long)claimed));
}

/* 16-bit RGBA whatever the file has; 8-bit levels times 257 are the same fractions. */
static void expand(png_reader *reader) {
    png_set_expand_16(reader->png);
    png_set_gray_to_rgb(reader->png);
    png_set_add_alpha(reader->png, LEVELS - 1, PNG_FILLER_AFTER);
    (void)png_set_interlace_handling(reader->png);
    png_read_update_info(reader->png, reader->info);
}

static void allocate(png_reader *reader, png_uint_32 width, png_uint_32 height) {
    mtm_status status = mtm_picture_create((int)width, (int)height, &reader->picture, reader->error);
    if (status != MTM_OK) stop_with(reader, status);
    reader->rows = mtm_allocate(height, sizeof *reader->rows);
    reader->linear = mtm_allocate(LEVELS, sizeof *reader->linear);
    if (reader->rows == NULL || reader->linear == NULL)
        stop_with(reader, mtm_fail_memory(reader->error, reader->path, height * sizeof *reader->rows));
    for (size_t y = 0; y < height; y++)
        reader->rows[y] = (png_bytep)(reader->picture->rgba + y * width * 4) + (size_t)width * 8;
    for (int i = 0; i < LEVELS; i++) reader->linear[i] = (float)mtm_srgb_decode(i / (double)(LEVELS - 1));
}

static unsigned level_of(const unsigned char *bytes) {
    return (unsigned)bytes[0] << 8 | bytes[1];
}

/* In place, from left to right: pixel x is written to bytes 16 x … 16 x + 15 of its row of 16 · width bytes
 * and the next one is read from 8 · width + 8 (x + 1), which is not before them. */
static void convert_rows(png_reader *reader) {
    const mtm_picture *picture = reader->picture;
    for (int y = 0; y < picture->height; y++) {
        float *rgba = picture->rgba + (size_t)y * (size_t)picture->width * 4;
        const unsigned char *bytes = reader->rows[y];
        for (int x = 0; x < picture->width; x++, bytes += 8, rgba += 4) {
            const float alpha = (float)level_of(bytes + 6) / (float)(LEVELS - 1);
            const float rgb[3] = {reader->linear[level_of(bytes)], reader->linear[level_of(bytes + 2)],
                                  reader->linear[level_of(bytes + 4)]};
            for (int i = 0; i < 3; i++) rgba[i] = rgb[i] * alpha;
            rgba[3] = alpha;
        }
    }
}

/* Everything that libpng may jump out of. */
static void read_picture(png_reader *reader) {
    prepare(reader);
    png_read_info(reader->png, reader->info);
    const png_uint_32 width = png_get_image_width(reader->png, reader->info);
    const png_uint_32 height = png_get_image_height(reader->png, reader->info);
    check_size(reader, width, height);
    expand(reader);
    allocate(reader, width, height);
    png_read_image(reader->png, reader->rows);
    png_read_end(reader->png, reader->info);
}

/* The chunks before the pixels, where our writer puts the scene. */
static void read_texts(png_reader *reader) {
    prepare(reader);
    png_read_info(reader->png, reader->info);
}

/* False after a jump out of libpng. */
static bool run_reader(png_reader *reader, void (*read)(png_reader *)) {
    if (setjmp(png_jmpbuf(reader->png)) != 0) return false;
    read(reader);
    return true;
}

static mtm_status fail_read(const png_reader *reader) {
    if (reader->status != MTM_OK) return reader->status;
    const bool is_memory =
        strstr(reader->message, "emory") != NULL; /* "Out of memory", "insufficient memory" */
    return mtm_fail(reader->error, is_memory ? MTM_MEMORY : MTM_FORMAT, "%s: damaged PNG: %s", reader->path,
                    reader->message);
}

/* The first text of our keyword. One that libpng left out, because it is too long or damaged, is an error. */
static mtm_status copy_scene(const png_reader *reader, char **scene) {
    png_textp texts = NULL;
    int count = 0;
    *scene = NULL;
    (void)png_get_text(reader->png, reader->info, &texts, &count);
    for (int i = 0; i < count; i++) {
        if (strcmp(texts[i].key, MTM_PNG_SCENE) != 0) continue;
        *scene = mtm_text_copy(texts[i].text);
        return *scene != NULL ? MTM_OK : mtm_fail_memory(reader->error, reader->path, strlen(texts[i].text));
    }
    if (reader->text_warning[0] == '\0') return MTM_OK;
    return mtm_fail(reader->error, MTM_FORMAT, "%s: a text in it cannot be read: %s", reader->path,
                    reader->text_warning);
}

static mtm_status read_content(png_reader *reader, mtm_picture **picture, char **scene) {
    if (!run_reader(reader, picture != NULL ? read_picture : read_texts)) return fail_read(reader);
    const mtm_status status = scene == NULL ? MTM_OK : copy_scene(reader, scene);
    if (status != MTM_OK || picture == NULL) return status;
    convert_rows(reader);
    *picture = reader->picture;
    reader->picture = NULL;
    return MTM_OK;
}

mtm_status mtm_png_read_stream(FILE *stream, const char *path, mtm_picture **picture, char **scene,
                               mtm_error *error) {
    png_reader reader = {.stream = stream, .path = path, .byte_count = -1, .error = error};
    if (fseeko(stream, 0, SEEK_END) == 0) {
        reader.byte_count = ftello(stream);
        rewind(stream);
    }
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, stop_at_error, keep_text_warning);
    reader.info = reader.png == NULL ? NULL : png_create_info_struct(reader.png);
    const mtm_status status = reader.info == NULL ? mtm_fail(error, MTM_MEMORY, "out of memory: %s", path)
                                                  : read_content(&reader, picture, scene);
    png_destroy_read_struct(&reader.png, &reader.info, NULL);
    mtm_picture_destroy(reader.picture);
    free(reader.rows);
    free(reader.linear);
    return status;
}

static mtm_status read_file(const char *path, mtm_picture **picture, char **scene, mtm_error *error) {
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) return mtm_fail(error, MTM_IO, "%s: cannot be opened: %s", path, strerror(errno));
    struct stat state;
    const bool is_folder = fstat(fileno(stream), &state) == 0 && S_ISDIR(state.st_mode);
    const mtm_status status = is_folder
                                  ? mtm_fail(error, MTM_IO, "%s: is a folder, expected a PNG file", path)
                                  : mtm_png_read_stream(stream, path, picture, scene, error);
    (void)fclose(stream);
    return status;
}

mtm_status mtm_picture_read_png(const char *path, mtm_picture **picture, char **scene, mtm_error *error) {
    return read_file(path, picture, scene, error);
}

/* Programs that rewrite a PNG may move its texts behind the pixels; only then are those decoded too. */
mtm_status mtm_scene_text_of_png(const char *path, char **scene, mtm_error *error) {
    mtm_status status = read_file(path, NULL, scene, error);
    if (status != MTM_OK || *scene != NULL) return status;
    mtm_picture *picture = NULL;
    status = read_file(path, &picture, scene, error);
    mtm_picture_destroy(picture);
    return status;
}
