/* SPDX-License-Identifier: BSD-3-Clause
 * Writes a spectral image as OpenEXR, with OpenEXR's C core.
 * The T channels follow A. Fichet, R. Pacanowski, A. Wilkie, "An OpenEXR Layout for Spectral Images", Journal
 * of Computer Graphics Techniques 10(3), 2021. */
#include <assert.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "image/exr.h"
#include "metamer/spectrum.h"

enum {
    ROWS_PER_CHUNK = 16, /* of ZIP compression */
    ZIP_LEVEL = 4,       /* OpenEXR's own default of today, stated so that the bytes do not depend on it */
    CHANNEL_NAME_BYTES = 32,
};

typedef struct exr_writer {
    const mtm_image *image;
    const mtm_image_write_options *options;
    exr_context_t context;
    mtm_output output;
    uint64_t position; /* of the stream */
    int reason;        /* errno of the write that failed, else 0 */
    float *spectra;    /* a chunk of reconstructed spectra, MTM_SPECTRUM_SAMPLES per pixel, or NULL */
} exr_writer;

mtm_image_write_options mtm_image_write_defaults(void) {
    return (mtm_image_write_options){.is_half = false};
}

static int64_t write_bytes(exr_const_context_t context, void *user, const void *bytes, uint64_t count,
                           uint64_t offset, exr_stream_error_func_ptr_t report) {
    (void)context;
    (void)report;
    exr_writer *writer = user;
    FILE *stream = writer->output.stream;
    const bool is_placed = offset == writer->position || fseeko(stream, (off_t)offset, SEEK_SET) == 0;
    if (!is_placed || fwrite(bytes, 1, count, stream) != count) {
        writer->reason = errno;
        return -1;
    }
    writer->position = offset + count;
    return (int64_t)count;
}

static exr_result_t open_context(exr_writer *writer) {
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = mtm_exr_stay_silent;
    setup.user_data = writer;
    setup.write_fn = write_bytes;
    setup.zip_level = ZIP_LEVEL;
    exr_result_t result = exr_start_write(&writer->context, "image", EXR_WRITE_FILE_DIRECTLY, &setup);
    int part = 0;
    if (result == EXR_ERR_SUCCESS)
        result = exr_add_part(writer->context, "image", EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result = exr_initialize_required_attr_simple(writer->context, 0, writer->image->width,
                                                     writer->image->height, EXR_COMPRESSION_ZIP);
    return result;
}

static exr_result_t set_text(exr_writer *writer, const char *name, const char *text) {
    return text == NULL ? EXR_ERR_SUCCESS : exr_attr_set_string(writer->context, 0, name, text);
}

static exr_result_t declare_texts(exr_writer *writer) {
    const mtm_image *image = writer->image;
    exr_result_t result = set_text(writer, MTM_EXR_VERSION, MTM_EXR_VERSION_TEXT);
    if (result == EXR_ERR_SUCCESS) result = set_text(writer, MTM_EXR_BASIS, image->basis);
    if (result == EXR_ERR_SUCCESS) result = set_text(writer, MTM_EXR_PALETTE, image->palette);
    if (result == EXR_ERR_SUCCESS) result = set_text(writer, MTM_EXR_SCENE, image->scene);
    if (result == EXR_ERR_SUCCESS && writer->options->reconstruction != NULL)
        result = set_text(writer, MTM_EXR_SPECTRAL_LAYOUT, "1.0");
    return result;
}

static exr_result_t add_channel(exr_writer *writer, const char *name, exr_pixel_type_t type) {
    return exr_add_channel(writer->context, 0, name, type, EXR_PERCEPTUALLY_LINEAR, 1, 1);
}

static int wavelength_of(int sample) {
    return MTM_WAVELENGTH_FIRST_NM + sample * MTM_WAVELENGTH_STEP_NM;
}

static exr_result_t declare_channels(exr_writer *writer) {
    const exr_pixel_type_t type = writer->options->is_half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
    char name[CHANNEL_NAME_BYTES];
    exr_result_t result = add_channel(writer, "A", type);
    for (int i = 0; i < writer->image->dimension && result == EXR_ERR_SUCCESS; i++) {
        (void)snprintf(name, sizeof name, "C.%02d", i);
        result = add_channel(writer, name, type);
    }
    for (int i = 0; i < 3 && writer->options->preview != NULL && result == EXR_ERR_SUCCESS; i++) {
        const char *const names[] = {"R", "G", "B"};
        result = add_channel(writer, names[i], EXR_PIXEL_FLOAT);
    }
    const bool has_spectra = writer->options->reconstruction != NULL;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES && has_spectra && result == EXR_ERR_SUCCESS; i++) {
        (void)snprintf(name, sizeof name, "T.%d,000000nm", wavelength_of(i));
        result = add_channel(writer, name, EXR_PIXEL_FLOAT);
    }
    return result;
}

/* T = reconstruction · coefficients for the pixels of one chunk. */
static void reconstruct_rows(exr_writer *writer, int row, int row_count) {
    const mtm_image *image = writer->image;
    const size_t pixel_count = (size_t)image->width * (size_t)row_count;
    const float *pixel = image->pixels + (size_t)row * (size_t)image->width * (size_t)image->lanes;
    float *spectrum = writer->spectra;
    for (size_t p = 0; p < pixel_count; p++) {
        const float *weight = writer->options->reconstruction;
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++, weight += image->dimension) {
            double sum = 0.0;
            for (int k = 0; k < image->dimension; k++) sum += (double)weight[k] * (double)pixel[k];
            spectrum[i] = (float)sum;
        }
        pixel += image->lanes;
        spectrum += MTM_SPECTRUM_SAMPLES;
    }
}

/* Interleaved floats that a channel's values are taken from. */
static void point_channel(exr_coding_channel_info_t *channel, const float *first, int floats_per_pixel,
                          int width) {
    channel->user_data_type = EXR_PIXEL_FLOAT;
    channel->user_bytes_per_element = sizeof(float);
    channel->user_pixel_stride = floats_per_pixel * (int)sizeof(float);
    channel->user_line_stride = width * channel->user_pixel_stride;
    channel->encode_from_ptr = (const uint8_t *)first;
}

/* The channels are the ones declared above, which OpenEXR has sorted by name. */
static void point_channels(const exr_writer *writer, exr_encode_pipeline_t *pipeline, int row) {
    const mtm_image *image = writer->image;
    const size_t first_pixel = (size_t)row * (size_t)image->width;
    const float *pixel = image->pixels + first_pixel * (size_t)image->lanes;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        const char *name = channel->channel_name;
        if (name[0] == 'A') {
            point_channel(channel, pixel + image->dimension, image->lanes, image->width);
        } else if (name[0] == 'C') {
            point_channel(channel, pixel + strtol(name + 2, NULL, 10), image->lanes, image->width);
        } else if (name[0] == 'T') {
            const long sample =
                (strtol(name + 2, NULL, 10) - MTM_WAVELENGTH_FIRST_NM) / MTM_WAVELENGTH_STEP_NM;
            point_channel(channel, writer->spectra + sample, MTM_SPECTRUM_SAMPLES, image->width);
        } else {
            const ptrdiff_t color = strchr("RGB", name[0]) - "RGB";
            point_channel(channel, writer->options->preview->rgba + first_pixel * 4 + color, 4, image->width);
        }
    }
}

/* The pipeline is set up for the first chunk and reused, with its buffers, for the others. */
static exr_result_t write_chunk(exr_writer *writer, exr_encode_pipeline_t *pipeline, int row) {
    exr_chunk_info_t chunk;
    exr_result_t result = exr_write_scanline_chunk_info(writer->context, 0, row, &chunk);
    if (result != EXR_ERR_SUCCESS) return result;
    result = row == 0 ? exr_encoding_initialize(writer->context, 0, &chunk, pipeline)
                      : exr_encoding_update(writer->context, 0, &chunk, pipeline);
    if (result != EXR_ERR_SUCCESS) return result;
    if (writer->spectra != NULL) reconstruct_rows(writer, row, chunk.height);
    point_channels(writer, pipeline, row);
    if (row == 0) result = exr_encoding_choose_default_routines(writer->context, 0, pipeline);
    if (result == EXR_ERR_SUCCESS) result = exr_encoding_run(writer->context, 0, pipeline);
    return result;
}

static exr_result_t write_content(exr_writer *writer) {
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t result = open_context(writer);
    if (result == EXR_ERR_SUCCESS) result = declare_texts(writer);
    if (result == EXR_ERR_SUCCESS) result = declare_channels(writer);
    if (result == EXR_ERR_SUCCESS) result = exr_write_header(writer->context);
    for (int row = 0; row < writer->image->height && result == EXR_ERR_SUCCESS; row += ROWS_PER_CHUNK)
        result = write_chunk(writer, &pipeline, row);
    if (pipeline.context != NULL) (void)exr_encoding_destroy(writer->context, &pipeline);
    if (writer->context != NULL) {
        const exr_result_t finished = exr_finish(&writer->context);
        if (result == EXR_ERR_SUCCESS) result = finished;
    }
    return result;
}

static mtm_status fail_write(const exr_writer *writer, exr_result_t result, const char *path,
                             mtm_error *error) {
    if (writer->reason != 0)
        return mtm_fail(error, MTM_IO, "%s: cannot be written: %s", path, strerror(writer->reason));
    return mtm_fail(error, result == EXR_ERR_OUT_OF_MEMORY ? MTM_MEMORY : MTM_IO, "%s: cannot be written: %s",
                    path, exr_get_default_error_message(result));
}

mtm_status mtm_image_write(const mtm_image *image, const char *path, const mtm_image_write_options *options,
                           mtm_error *error) {
    const mtm_picture *preview = options->preview;
    assert(preview == NULL || (preview->width == image->width && preview->height == image->height));
    (void)preview;
    exr_writer writer = {.image = image, .options = options};
    if (options->reconstruction != NULL) {
        const size_t pixels = (size_t)image->width * ROWS_PER_CHUNK;
        writer.spectra = mtm_allocate(pixels, MTM_SPECTRUM_SAMPLES * sizeof(float));
        if (writer.spectra == NULL) return mtm_fail_memory(error, path, pixels * MTM_SPECTRUM_SAMPLES * 4);
    }
    mtm_status status = mtm_output_open(path, &writer.output, error);
    if (status == MTM_OK) {
        const exr_result_t result = write_content(&writer);
        if (result == EXR_ERR_SUCCESS) {
            status = mtm_output_commit(&writer.output, error);
        } else {
            status = fail_write(&writer, result, path, error);
            mtm_output_abandon(&writer.output);
        }
    }
    free(writer.spectra);
    return status;
}
