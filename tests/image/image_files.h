/* SPDX-License-Identifier: BSD-3-Clause
 * Files for the tests of images: random images, whole files as bytes, and OpenEXR files of other programs,
 * written byte by byte after the format's description so that our reader is not only tested against our own
 * writer. */
#ifndef METAMER_TESTS_IMAGE_FILES_H
#define METAMER_TESTS_IMAGE_FILES_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "metamer/image.h"
#include "test.h"

/* A linear congruential generator (Knuth's MMIX constants), its high half. */
static inline uint32_t next_random(uint64_t *seed) {
    *seed = *seed * 6364136223846793005U + 1442695040888963407U;
    return (uint32_t)(*seed >> 32);
}

/* A file's bytes, for free(). */
static inline char *read_whole(const char *path, size_t *count) {
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    assert_int_equal(fseek(stream, 0, SEEK_END), 0);
    *count = (size_t)ftell(stream);
    rewind(stream);
    char *bytes = malloc(*count + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *count, stream), *count);
    (void)fclose(stream);
    return bytes;
}

static inline void write_whole(const char *path, const char *bytes, size_t count) {
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, count, stream), count);
    assert_int_equal(fclose(stream), 0);
}

/* An OpenEXR file of another program: uncompressed scan lines of float channels. */
typedef struct foreign_exr {
    int channel_count;
    const char *const *names; /* sorted as texts, as the format wants it */
    int pixel_type;           /* 0 integer (written as float), 1 half, 2 float */
    int min_x, min_y, width, height;
    uint32_t version_flags;          /* 0x200 for tiles */
    const char *attribute, *content; /* a string attribute more; NULL: none */
    float (*value)(int channel, int x, int y);
} foreign_exr;

static inline void put_bytes(FILE *stream, const void *bytes, size_t count) {
    assert_int_equal(fwrite(bytes, 1, count, stream), count);
}

static inline void put_integer(FILE *stream, uint64_t value, int byte_count) {
    for (int i = 0; i < byte_count; i++) (void)fputc((int)(value >> (8 * i) & 0xff), stream);
}

static inline void put_attribute(FILE *stream, const char *name, const char *type, size_t size) {
    put_bytes(stream, name, strlen(name) + 1);
    put_bytes(stream, type, strlen(type) + 1);
    put_integer(stream, size, 4);
}

static inline void put_window(FILE *stream, const char *name, const foreign_exr *file) {
    put_attribute(stream, name, "box2i", 16);
    put_integer(stream, (uint32_t)file->min_x, 4);
    put_integer(stream, (uint32_t)file->min_y, 4);
    put_integer(stream, (uint32_t)(file->min_x + file->width - 1), 4);
    put_integer(stream, (uint32_t)(file->min_y + file->height - 1), 4);
}

static inline void put_channels(FILE *stream, const foreign_exr *file) {
    size_t size = 1;
    for (int i = 0; i < file->channel_count; i++) size += strlen(file->names[i]) + 1 + 16;
    put_attribute(stream, "channels", "chlist", size);
    for (int i = 0; i < file->channel_count; i++) {
        put_bytes(stream, file->names[i], strlen(file->names[i]) + 1);
        put_integer(stream, (uint64_t)file->pixel_type, 4);
        put_integer(stream, 0, 4); /* linear flag and padding */
        put_integer(stream, 1, 4);
        put_integer(stream, 1, 4);
    }
    put_integer(stream, 0, 1);
}

static inline void put_header(FILE *stream, const foreign_exr *file) {
    const float one = 1.0F;
    put_integer(stream, 20000630, 4);
    put_integer(stream, 2 | file->version_flags, 4);
    put_channels(stream, file);
    put_attribute(stream, "compression", "compression", 1);
    put_integer(stream, 0, 1);
    put_window(stream, "dataWindow", file);
    put_window(stream, "displayWindow", file);
    put_attribute(stream, "lineOrder", "lineOrder", 1);
    put_integer(stream, 0, 1);
    put_attribute(stream, "pixelAspectRatio", "float", 4);
    put_bytes(stream, &one, 4);
    put_attribute(stream, "screenWindowCenter", "v2f", 8);
    put_integer(stream, 0, 8);
    put_attribute(stream, "screenWindowWidth", "float", 4);
    put_bytes(stream, &one, 4);
    if (file->version_flags == 0x200) {
        put_attribute(stream, "tiles", "tiledesc", 9);
        put_integer(stream, 32, 4);
        put_integer(stream, 32, 4);
        put_integer(stream, 0, 1);
    }
    if (file->attribute != NULL) {
        put_attribute(stream, file->attribute, "string", strlen(file->content));
        put_bytes(stream, file->content, strlen(file->content));
    }
    put_integer(stream, 0, 1);
}

/* A positive value that 16 bits hold: 1.fraction · 2^exponent, or 0. */
static inline void put_half(FILE *stream, float value) {
    int exponent = 0;
    const float fraction = frexpf(value, &exponent); /* 0.5 … 1 */
    const int bits = (exponent + 14) * 1024 + (int)(fraction * 2048.0F) - 1024;
    put_integer(stream, value > 0.0F ? (uint64_t)bits : 0U, 2);
}

static inline void write_foreign_exr(const char *path, const foreign_exr *file) {
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    put_header(stream, file);
    const size_t sample_bytes = file->pixel_type == 1 ? 2 : 4;
    const size_t row_bytes = (size_t)file->channel_count * (size_t)file->width * sample_bytes;
    const size_t first = (size_t)ftell(stream) + (size_t)file->height * 8;
    for (size_t y = 0; y < (size_t)file->height; y++) put_integer(stream, first + y * (8 + row_bytes), 8);
    for (int y = 0; y < file->height; y++) {
        put_integer(stream, (uint32_t)(file->min_y + y), 4);
        put_integer(stream, row_bytes, 4);
        for (int channel = 0; channel < file->channel_count; channel++) {
            for (int x = 0; x < file->width; x++) {
                const float value = file->value(channel, x, y);
                if (file->pixel_type == 1)
                    put_half(stream, value);
                else
                    put_bytes(stream, &value, 4);
            }
        }
    }
    assert_int_equal(fclose(stream), 0);
}

#endif
