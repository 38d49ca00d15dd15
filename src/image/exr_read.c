/* SPDX-License-Identifier: BSD-3-Clause
 * Reads a spectral image from OpenEXR, with OpenEXR's C core: our own coefficients, or reflectances after
 * A. Fichet, R. Pacanowski, A. Wilkie, "An OpenEXR Layout for Spectral Images", Journal of Computer Graphics
 * Techniques 10(3), 2021. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/fail.h"
#include "base/half.h"
#include "base/memory.h"
#include "image/exr.h"
#include "image/exr_layout.h"
#include "metamer/spectrum.h"

enum {
    CHUNK_BYTES_MAX = 1 << 30,    /* of pixels in one compressed block; our own largest is a third of it */
    COMPRESSION_RATIO_MAX = 2000, /* deflate reaches 1032, PXR24 leaves out a quarter before it */
};

static const unsigned char exr_magic[4] = {0x76, 0x2f, 0x31, 0x01};

typedef struct exr_reader {
    FILE *stream;
    const char *path;
    uint64_t byte_count;
    exr_context_t context;
    mtm_exr_layout layout;
    int width, height;
    int first_row; /* of the data window */
    int rows_per_chunk;
    const char *basis, *palette, *scene; /* inside the context */
    mtm_image *image;
    float
        *rows; /* a chunk of reflectances as they are in the file, slot_count + 1 floats per pixel, or NULL */
} exr_reader;

bool mtm_file_is_exr(const char *path) {
    unsigned char start[sizeof exr_magic];
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) return false;
    const size_t count = fread(start, 1, sizeof start, stream);
    (void)fclose(stream);
    return count == sizeof start && memcmp(start, exr_magic, sizeof start) == 0;
}

static int64_t read_bytes(exr_const_context_t context, void *user, void *bytes, uint64_t count,
                          uint64_t offset, exr_stream_error_func_ptr_t report) {
    (void)context;
    (void)report;
    const exr_reader *reader = user;
    if (offset > reader->byte_count) return -1;
    if (ftello(reader->stream) != (off_t)offset && fseeko(reader->stream, (off_t)offset, SEEK_SET) != 0)
        return -1;
    return (int64_t)fread(bytes, 1, count, reader->stream);
}

static int64_t tell_size(exr_const_context_t context, void *user) {
    (void)context;
    return (int64_t)((const exr_reader *)user)->byte_count;
}

static mtm_status fail_read(const exr_reader *reader, exr_result_t result, const char *what,
                            mtm_error *error) {
    if (ferror(reader->stream))
        return mtm_fail(error, MTM_IO, "%s: cannot be read: %s", reader->path, strerror(errno));
    return mtm_exr_fail(error, result, reader->path, what);
}

static mtm_status open_context(exr_reader *reader, mtm_error *error) {
    unsigned char start[sizeof exr_magic];
    if (fseeko(reader->stream, 0, SEEK_END) != 0 || ftello(reader->stream) < 0)
        return mtm_fail(error, MTM_IO, "%s: cannot be read: %s", reader->path, strerror(errno));
    reader->byte_count = (uint64_t)ftello(reader->stream);
    rewind(reader->stream);
    const size_t count = fread(start, 1, sizeof start, reader->stream);
    if (count != sizeof start || memcmp(start, exr_magic, sizeof start) != 0)
        return mtm_fail(error, MTM_FORMAT, "%s: is no OpenEXR file", reader->path);
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = mtm_exr_stay_silent;
    setup.user_data = reader;
    setup.read_fn = read_bytes;
    setup.size_fn = tell_size;
    setup.flags = EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    const exr_result_t result = exr_start_read(&reader->context, reader->path, &setup);
    return result == EXR_ERR_SUCCESS ? MTM_OK : fail_read(reader, result, "damaged OpenEXR header", error);
}

static mtm_status check_storage(const exr_reader *reader, mtm_error *error) {
    int part_count = 0;
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
    if (exr_get_count(reader->context, &part_count) != EXR_ERR_SUCCESS || part_count != 1)
        return mtm_fail(error, MTM_FORMAT, "%s: has %d parts, expected 1", reader->path, part_count);
    if (exr_get_storage(reader->context, 0, &storage) != EXR_ERR_SUCCESS || storage != EXR_STORAGE_SCANLINE)
        return mtm_fail(error, MTM_FORMAT, "%s: is stored as %s, expected scan lines", reader->path,
                        storage == EXR_STORAGE_TILED ? "tiles" : "deep pixels");
    return MTM_OK;
}

static mtm_status find_size(exr_reader *reader, mtm_error *error) {
    exr_attr_box2i_t window;
    int32_t rows = 0;
    exr_result_t result = exr_get_data_window(reader->context, 0, &window);
    if (result == EXR_ERR_SUCCESS) result = exr_get_scanlines_per_chunk(reader->context, 0, &rows);
    if (result != EXR_ERR_SUCCESS) return fail_read(reader, result, "damaged OpenEXR header", error);
    const int64_t width = (int64_t)window.max.x - window.min.x + 1;
    const int64_t height = (int64_t)window.max.y - window.min.y + 1;
    if (width < 1 || height < 1 || width > MTM_IMAGE_EDGE_MAX || height > MTM_IMAGE_EDGE_MAX || rows < 1)
        return mtm_fail(error, MTM_LIMIT, "%s: data window of %lld x %lld pixels, expected 1 to %d each",
                        reader->path, (long long)width, (long long)height, MTM_IMAGE_EDGE_MAX);
    reader->width = (int)width;
    reader->height = (int)height;
    reader->first_row = window.min.y;
    reader->rows_per_chunk = rows;
    return MTM_OK;
}

/* Size of the pixels without compression. */
static uint64_t count_pixel_bytes(const exr_reader *reader, const exr_attr_chlist_t *channels) {
    uint64_t bytes = 0;
    for (int i = 0; i < channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *channel = &channels->entries[i];
        const uint64_t pixels = (uint64_t)reader->width * (uint64_t)reader->height;
        bytes += pixels * (channel->pixel_type == EXR_PIXEL_HALF ? 2U : 4U);
    }
    return bytes;
}

static bool is_chunk_plausible(const exr_chunk_info_t *chunk) {
    const bool is_plain = chunk->compression == EXR_COMPRESSION_NONE;
    return is_plain ? chunk->packed_size == chunk->unpacked_size
                    : chunk->unpacked_size / COMPRESSION_RATIO_MAX <= chunk->packed_size;
}

/* A header of a few bytes can claim terabytes. Before anything is allocated for the pixels, the whole file
 * and each of its chunks must be large enough for what they claim to hold. */
static mtm_status check_plausible(const exr_reader *reader, const exr_attr_chlist_t *channels,
                                  mtm_error *error) {
    uint64_t chunk_bytes = 0;
    exr_result_t result = exr_get_chunk_unpacked_size(reader->context, 0, &chunk_bytes);
    if (result == EXR_ERR_SUCCESS && chunk_bytes > CHUNK_BYTES_MAX)
        return mtm_fail(error, MTM_LIMIT, "%s: blocks of %llu bytes, at most %d are supported", reader->path,
                        (unsigned long long)chunk_bytes, CHUNK_BYTES_MAX);
    const uint64_t claimed = count_pixel_bytes(reader, channels);
    if (claimed / COMPRESSION_RATIO_MAX > reader->byte_count)
        return mtm_fail(error, MTM_FORMAT,
                        "%s: %llu bytes cannot hold the %llu bytes of pixels that its header "
                        "claims",
                        reader->path, (unsigned long long)reader->byte_count, (unsigned long long)claimed);
    for (int row = 0; row < reader->height && result == EXR_ERR_SUCCESS; row += reader->rows_per_chunk) {
        exr_chunk_info_t chunk = {0};
        result = exr_read_scanline_chunk_info(reader->context, 0, reader->first_row + row, &chunk);
        if (result == EXR_ERR_SUCCESS && !is_chunk_plausible(&chunk)) result = EXR_ERR_CORRUPT_CHUNK;
    }
    return result == EXR_ERR_SUCCESS ? MTM_OK : fail_read(reader, result, "damaged or cut off", error);
}

/* The text of an attribute; it stays with the context. NULL where `is_required` is false and there is none.
 * */
static mtm_status get_text(const exr_reader *reader, const char *name, bool is_required, const char **text,
                           mtm_error *error) {
    int32_t length = 0;
    const exr_result_t result = exr_attr_get_string(reader->context, 0, name, &length, text);
    if (result == EXR_ERR_SUCCESS && *text != NULL) return MTM_OK;
    *text = NULL;
    if (result == EXR_ERR_NO_ATTR_BY_NAME && !is_required) return MTM_OK;
    return mtm_fail(error, MTM_FORMAT, "%s: attribute %s is %s, expected text", reader->path, name,
                    result == EXR_ERR_NO_ATTR_BY_NAME ? "missing" : "no text");
}

static mtm_status get_own_texts(exr_reader *reader, mtm_error *error) {
    const char *version = NULL;
    mtm_status status = get_text(reader, MTM_EXR_VERSION, true, &version, error);
    if (status == MTM_OK && strcmp(version, MTM_EXR_VERSION_TEXT) != 0)
        return mtm_fail(error, MTM_FORMAT,
                        "%s: attribute %s is '%s', expected '%s', the only one known to this "
                        "version of metamer",
                        reader->path, MTM_EXR_VERSION, version, MTM_EXR_VERSION_TEXT);
    if (status == MTM_OK) status = get_text(reader, MTM_EXR_BASIS, true, &reader->basis, error);
    if (status == MTM_OK) status = get_text(reader, MTM_EXR_PALETTE, false, &reader->palette, error);
    if (status == MTM_OK) status = get_text(reader, MTM_EXR_SCENE, false, &reader->scene, error);
    if (status == MTM_OK && !reader->layout.has_alpha)
        status = mtm_fail(error, MTM_FORMAT, "%s: channel A (alpha) is missing beside the coefficients",
                          reader->path);
    return status;
}

static mtm_status get_foreign_texts(exr_reader *reader, mtm_error *error) {
    const char *version = NULL;
    const mtm_status status = get_text(reader, MTM_EXR_SPECTRAL_LAYOUT, false, &version, error);
    if (status == MTM_OK && version != NULL && strcmp(version, "1.0") != 0)
        return mtm_fail(error, MTM_FORMAT, "%s: attribute %s is '%s', expected '1.0'", reader->path,
                        MTM_EXR_SPECTRAL_LAYOUT, version);
    reader->basis = "wavelengths";
    return status;
}

static mtm_status read_header(exr_reader *reader, mtm_error *error) {
    const exr_attr_chlist_t *channels = NULL;
    mtm_status status = open_context(reader, error);
    if (status == MTM_OK) status = check_storage(reader, error);
    if (status == MTM_OK) status = find_size(reader, error);
    if (status != MTM_OK) return status;
    const exr_result_t result = exr_get_channels(reader->context, 0, &channels);
    if (result != EXR_ERR_SUCCESS) return fail_read(reader, result, "damaged OpenEXR header", error);
    status = mtm_exr_layout_find(channels, reader->path, &reader->layout, error);
    if (status != MTM_OK) return status;
    status = reader->layout.wavelength_nm == NULL ? get_own_texts(reader, error)
                                                  : get_foreign_texts(reader, error);
    return status == MTM_OK ? check_plausible(reader, channels, error) : status;
}

static mtm_status create_image(exr_reader *reader, mtm_error *error) {
    const mtm_exr_layout *layout = &reader->layout;
    const bool is_foreign = layout->wavelength_nm != NULL;
    const int dimension = is_foreign ? MTM_SPECTRUM_SAMPLES : layout->slot_count;
    if (is_foreign) {
        const size_t pixels = (size_t)reader->width * (size_t)reader->rows_per_chunk;
        const size_t pixel_bytes = ((size_t)layout->slot_count + 1) * sizeof(float);
        reader->rows = mtm_allocate(pixels, pixel_bytes);
        if (reader->rows == NULL) return mtm_fail_memory(error, reader->path, pixels * pixel_bytes);
    }
    return mtm_image_create(reader->width, reader->height, dimension, reader->basis, reader->palette,
                            reader->scene, &reader->image, error);
}

static uint32_t integer_of(const uint8_t *bytes, int byte_count) {
    uint32_t value = 0;
    for (int i = 0; i < byte_count; i++) value |= (uint32_t)bytes[i] << (8 * i);
    return value;
}

static float float_of_bits(uint32_t bits) {
    float value = 0.0F;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void unpack_channel(const uint8_t *bytes, int sample_bytes, int width, float *to,
                           int floats_per_pixel) {
    for (int x = 0; x < width; x++, bytes += sample_bytes, to += floats_per_pixel)
        *to = sample_bytes == 2 ? mtm_float_of_half((uint16_t)integer_of(bytes, 2))
                                : float_of_bits(integer_of(bytes, 4));
}

/* Takes the wanted channels out of a chunk's rows, where each channel's samples stand together. OpenEXR's own
 * functions for this are not used: for some numbers of channels they write through the null pointer of a
 * channel that was not asked for (3.1.5, unpack.c). Coefficients go straight to their place in the image,
 * reflectances to the rows they are resampled from. */
static exr_result_t unpack_rows(exr_decode_pipeline_t *pipeline) {
    const exr_reader *reader = pipeline->decoding_user_data;
    const mtm_image *image = reader->image;
    const size_t row = (size_t)(pipeline->chunk.start_y - reader->first_row);
    float *pixels = reader->rows;
    int floats = reader->layout.slot_count + 1;
    if (pixels == NULL) {
        floats = image->lanes;
        pixels = image->pixels + row * (size_t)image->width * (size_t)image->lanes;
    }
    const uint8_t *bytes = pipeline->unpacked_buffer;
    for (int y = 0; y < pipeline->chunk.height; y++, pixels += (size_t)image->width * (size_t)floats) {
        for (int i = 0; i < reader->layout.channel_count; i++) {
            const int sample_bytes = pipeline->channels[i].bytes_per_element;
            const int slot = reader->layout.slot[i];
            if (slot >= 0) unpack_channel(bytes, sample_bytes, image->width, pixels + slot, floats);
            bytes += (size_t)image->width * (size_t)sample_bytes;
        }
    }
    return EXR_ERR_SUCCESS;
}

static void resample_rows(const exr_reader *reader, double *values, int row, int row_count) {
    const mtm_image *image = reader->image;
    const mtm_exr_layout *layout = &reader->layout;
    const float *from = reader->rows;
    float *to = image->pixels + (size_t)row * (size_t)image->width * (size_t)image->lanes;
    for (size_t p = 0; p < (size_t)image->width * (size_t)row_count; p++) {
        for (int i = 0; i < layout->slot_count; i++) values[i] = from[i];
        const mtm_spectrum spectrum =
            mtm_spectrum_resample(layout->slot_count, layout->wavelength_nm, values, MTM_KIND_REFLECTANCE);
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) to[i] = (float)spectrum.value[i];
        to[MTM_SPECTRUM_SAMPLES] = layout->has_alpha ? from[layout->slot_count] : 1.0F;
        from += layout->slot_count + 1;
        to += image->lanes;
    }
}

/* The pipeline is set up for the first chunk and reused, with its buffers, for the others. */
static exr_result_t decode_chunk(exr_reader *reader, exr_decode_pipeline_t *pipeline, double *values,
                                 int row) {
    exr_chunk_info_t chunk;
    exr_result_t result = exr_read_scanline_chunk_info(reader->context, 0, reader->first_row + row, &chunk);
    if (result != EXR_ERR_SUCCESS) return result;
    result = row == 0 ? exr_decoding_initialize(reader->context, 0, &chunk, pipeline)
                      : exr_decoding_update(reader->context, 0, &chunk, pipeline);
    if (result != EXR_ERR_SUCCESS) return result;
    if (row == 0) result = exr_decoding_choose_default_routines(reader->context, 0, pipeline);
    pipeline->unpack_and_convert_fn = unpack_rows;
    pipeline->decoding_user_data = reader;
    if (result == EXR_ERR_SUCCESS) result = exr_decoding_run(reader->context, 0, pipeline);
    if (result == EXR_ERR_SUCCESS && reader->rows != NULL) resample_rows(reader, values, row, chunk.height);
    return result;
}

static mtm_status read_pixels(exr_reader *reader, mtm_error *error) {
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    double *values = mtm_allocate((size_t)reader->layout.slot_count, sizeof *values);
    exr_result_t result = values == NULL ? EXR_ERR_OUT_OF_MEMORY : EXR_ERR_SUCCESS;
    int row = 0;
    for (; row < reader->height && result == EXR_ERR_SUCCESS; row += reader->rows_per_chunk)
        result = decode_chunk(reader, &pipeline, values, row);
    if (pipeline.context != NULL) (void)exr_decoding_destroy(reader->context, &pipeline);
    free(values);
    if (result == EXR_ERR_SUCCESS) return MTM_OK;
    char what[64];
    (void)snprintf(what, sizeof what, "damaged pixels from row %d", row - reader->rows_per_chunk);
    return fail_read(reader, result, what, error);
}

mtm_status mtm_image_read_stream(FILE *stream, const char *path, mtm_image **image, mtm_error *error) {
    exr_reader reader = {.stream = stream, .path = path};
    mtm_status status = read_header(&reader, error);
    if (status == MTM_OK) status = create_image(&reader, error);
    if (status == MTM_OK) status = read_pixels(&reader, error);
    if (status == MTM_OK)
        *image = reader.image;
    else
        mtm_image_destroy(reader.image);
    if (reader.context != NULL) (void)exr_finish(&reader.context);
    mtm_exr_layout_free(&reader.layout);
    free(reader.rows);
    return status;
}

mtm_status mtm_image_read(const char *path, mtm_image **image, mtm_error *error) {
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) return mtm_fail(error, MTM_IO, "%s: cannot be opened: %s", path, strerror(errno));
    struct stat state;
    const bool is_folder = fstat(fileno(stream), &state) == 0 && S_ISDIR(state.st_mode);
    const mtm_status status = is_folder
                                  ? mtm_fail(error, MTM_IO, "%s: is a folder, expected an OpenEXR file", path)
                                  : mtm_image_read_stream(stream, path, image, error);
    (void)fclose(stream);
    return status;
}
