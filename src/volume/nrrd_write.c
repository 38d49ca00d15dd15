/* SPDX-License-Identifier: BSD-3-Clause
 * Writing NRRD, with attached or detached header, raw or gzip, so that reading gives the same bits back. */
#include <assert.h>
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/number.h"
#include "metamer/volume.h"
#include "volume/voxel_type.h"

enum {
    CHUNK_BYTES = 1 << 18,
    GZIP_ONLY = 16 + MAX_WBITS, /* zlib's plain gzip header holds no time and no name */
    MEMORY_LEVEL = 8,
};

mtm_volume_write_options mtm_volume_write_defaults(void) {
    /* Gzip, because most volumes halve and every reader takes it; little-endian as nearly all machines are. */
    return (mtm_volume_write_options){.is_gzip = true, .is_big_endian = false};
}

/* Turns voxels into the bytes of the file, a chunk after the other. */
typedef struct voxel_writer {
    FILE *stream;
    const char *path;
    bool is_gzip, is_swapped;
    mtm_voxel_type type;
    z_stream zlib;
    unsigned char *chunk, *output;
} voxel_writer;

static void deflate_chunk(voxel_writer *writer, const unsigned char *bytes, size_t count, int flush) {
    writer->zlib.next_in = (unsigned char *)bytes; /* zlib does not write to it */
    writer->zlib.avail_in = (unsigned int)count;
    do {
        writer->zlib.next_out = writer->output;
        writer->zlib.avail_out = CHUNK_BYTES;
        (void)deflate(&writer->zlib, flush); /* cannot fail: the state is good and there is room */
        (void)fwrite(writer->output, 1, CHUNK_BYTES - writer->zlib.avail_out, writer->stream);
    } while (writer->zlib.avail_out == 0);
}

static void write_chunk(voxel_writer *writer, const unsigned char *bytes, size_t count) {
    if (writer->is_swapped) {
        memcpy(writer->chunk, bytes, count);
        mtm_voxels_swap_bytes(writer->type, writer->chunk, count / mtm_voxel_type_bytes(writer->type));
        bytes = writer->chunk;
    }
    if (writer->is_gzip)
        deflate_chunk(writer, bytes, count, Z_NO_FLUSH);
    else
        (void)fwrite(bytes, 1, count, writer->stream);
}

/* A failed write is left in the stream's error flag for mtm_output_commit; there is just no use in going on. */
static void write_chunks(voxel_writer *writer, const mtm_volume *volume) {
    const unsigned char *bytes = mtm_volume_voxels(volume);
    const size_t byte_count = mtm_volume_voxel_count(volume) * mtm_voxel_type_bytes(writer->type);
    for (size_t begin = 0; begin < byte_count && !ferror(writer->stream); begin += CHUNK_BYTES) {
        const size_t left = byte_count - begin;
        write_chunk(writer, bytes + begin, left < CHUNK_BYTES ? left : CHUNK_BYTES);
    }
    if (writer->is_gzip) deflate_chunk(writer, NULL, 0, Z_FINISH);
}

static mtm_status write_voxels(FILE *stream, const char *path, const mtm_volume *volume,
                               const mtm_volume_write_options *options, mtm_error *error) {
    voxel_writer writer = {.stream = stream, .path = path, .type = mtm_volume_type(volume)};
    writer.is_swapped = options->is_big_endian != mtm_is_big_endian();
    writer.chunk = malloc(2 * (size_t)CHUNK_BYTES);
    if (writer.chunk == NULL) return mtm_fail_memory(error, path, 2 * (size_t)CHUNK_BYTES);
    writer.output = writer.chunk + CHUNK_BYTES;
    mtm_status status = MTM_OK;
    if (options->is_gzip) {
        writer.is_gzip = deflateInit2(&writer.zlib, Z_DEFAULT_COMPRESSION, Z_DEFLATED, GZIP_ONLY,
                                      MEMORY_LEVEL, Z_DEFAULT_STRATEGY) == Z_OK;
        if (!writer.is_gzip) status = mtm_fail_memory(error, path, CHUNK_BYTES);
    }
    if (status == MTM_OK) write_chunks(&writer, volume);
    if (writer.is_gzip) (void)deflateEnd(&writer.zlib);
    free(writer.chunk);
    return status;
}

static const char *nrrd_type_name(mtm_voxel_type type) {
    if (type == MTM_VOXEL_FLOAT32) return "float";
    if (type == MTM_VOXEL_FLOAT64) return "double";
    return mtm_voxel_type_name(type);
}

static void write_vector(FILE *stream, const double vector[3]) {
    char text[3][MTM_NUMBER_TEXT];
    (void)fprintf(stream, " (%s,%s,%s)", mtm_number_format(vector[0], text[0]),
                  mtm_number_format(vector[1], text[1]), mtm_number_format(vector[2], text[2]));
}

static void write_unit(FILE *stream, const char *unit) {
    (void)fputs("space units:", stream);
    for (int axis = 0; axis < 3; axis++) {
        (void)fputs(" \"", stream);
        for (const char *letter = unit; *letter != '\0'; letter++) {
            if (*letter == '"' || *letter == '\\') (void)fputc('\\', stream);
            (void)fputc(*letter, stream);
        }
        (void)fputc('"', stream);
    }
    (void)fputc('\n', stream);
}

/* Whether spacings alone give back the same bits; -0 beside the diagonal does not. */
static bool is_spaced_only(const mtm_grid *grid) {
    mtm_grid plain = mtm_grid_defaults(grid->size[0], grid->size[1], grid->size[2]);
    bool is_positive = true;
    for (int axis = 0; axis < 3; axis++) {
        plain.axes[axis][axis] = grid->axes[axis][axis];
        is_positive = is_positive && grid->axes[axis][axis] > 0.0;
    }
    return is_positive && !grid->is_oriented && grid->unit[0] == '\0' &&
           memcmp(plain.axes, grid->axes, sizeof plain.axes) == 0 &&
           memcmp(plain.origin, grid->origin, sizeof plain.origin) == 0;
}

static void write_grid(FILE *stream, const mtm_grid *grid) {
    if (is_spaced_only(grid)) {
        (void)fputs("spacings:", stream);
        for (int axis = 0; axis < 3; axis++) {
            char text[MTM_NUMBER_TEXT];
            (void)fprintf(stream, " %s", mtm_number_format(grid->axes[axis][axis], text));
        }
        (void)fputc('\n', stream);
        return;
    }
    (void)fputs(grid->is_oriented ? "space: left-posterior-superior\n" : "space dimension: 3\n", stream);
    (void)fputs("space directions:", stream);
    for (int axis = 0; axis < 3; axis++) write_vector(stream, grid->axes[axis]);
    (void)fputs("\nkinds: domain domain domain\nspace origin:", stream);
    write_vector(stream, grid->origin);
    (void)fputc('\n', stream);
    if (grid->unit[0] != '\0') write_unit(stream, grid->unit);
}

/* `data_file` NULL: the voxels follow. NRRD0004 is the first version with space and orientation. */
static void write_header(FILE *stream, const mtm_volume *volume, const mtm_volume_write_options *options,
                         const char *data_file) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    (void)fprintf(stream, "NRRD0004\ntype: %s\ndimension: 3\nsizes: %d %d %d\nencoding: %s\nendian: %s\n",
                  nrrd_type_name(mtm_volume_type(volume)), grid->size[0], grid->size[1], grid->size[2],
                  options->is_gzip ? "gzip" : "raw", options->is_big_endian ? "big" : "little");
    write_grid(stream, grid);
    if (data_file != NULL) (void)fprintf(stream, "data file: %s\n", data_file);
    (void)fputc('\n', stream);
}

static mtm_status write_attached(const mtm_volume *volume, const char *path,
                                 const mtm_volume_write_options *options, mtm_error *error) {
    mtm_output output;
    mtm_status status = mtm_output_open(path, &output, error);
    if (status != MTM_OK) return status;
    write_header(output.stream, volume, options, NULL);
    status = write_voxels(output.stream, path, volume, options, error);
    if (status == MTM_OK) return mtm_output_commit(&output, error);
    mtm_output_abandon(&output);
    return status;
}

/* Puts both files in place. The header is flushed first, so that a full disk is met before anything is replaced;
 * should the header fail all the same, the data are removed again. */
static mtm_status commit_pair(mtm_output *data, mtm_output *header, mtm_error *error) {
    char *data_target = data->temporary == NULL ? NULL : mtm_text_copy(data->target);
    mtm_status status = MTM_OK;
    if (fflush(header->stream) == 0) {
        status = mtm_output_commit(data, error);
    } else {
        mtm_output_abandon(data);
        free(data_target);
        data_target = NULL;
    }
    if (status == MTM_OK) {
        status = mtm_output_commit(header, error);
        if (status != MTM_OK && data_target != NULL) (void)unlink(data_target);
    } else {
        mtm_output_abandon(header);
    }
    free(data_target);
    return status;
}

static mtm_status write_pair(const mtm_volume *volume, const char *path, const char *data_path,
                             const mtm_volume_write_options *options, mtm_error *error) {
    mtm_output data;
    mtm_output header;
    mtm_status status = mtm_output_open(data_path, &data, error);
    if (status != MTM_OK) return status;
    status = write_voxels(data.stream, data_path, volume, options, error);
    if (status == MTM_OK) status = mtm_output_open(path, &header, error);
    if (status != MTM_OK) {
        mtm_output_abandon(&data);
        return status;
    }
    write_header(header.stream, volume, options, mtm_path_name(data_path));
    return commit_pair(&data, &header, error);
}

/* A name that a header line can hold and give back. */
static bool is_line(const char *name) {
    for (const char *letter = name; *letter != '\0'; letter++)
        if (iscntrl((unsigned char)*letter)) return false;
    return !isspace((unsigned char)name[0]);
}

static mtm_status write_detached(const mtm_volume *volume, const char *path,
                                 const mtm_volume_write_options *options, mtm_error *error) {
    if (!is_line(mtm_path_name(path)))
        return mtm_fail(error, MTM_ARGUMENT,
                        "%s: begins with a blank or has control characters, which a header cannot name",
                        path);
    const size_t stem = strlen(path) - strlen(".nhdr");
    const size_t bytes = stem + sizeof ".raw.gz";
    char *data_path = malloc(bytes);
    if (data_path == NULL) return mtm_fail_memory(error, path, bytes);
    (void)snprintf(data_path, bytes, "%.*s%s", (int)stem, path, options->is_gzip ? ".raw.gz" : ".raw");
    const mtm_status status = write_pair(volume, path, data_path, options, error);
    free(data_path);
    return status;
}

mtm_status mtm_volume_write(const mtm_volume *volume, const char *path,
                            const mtm_volume_write_options *options, mtm_error *error) {
    assert(volume != NULL && path != NULL && options != NULL);
    const double slope = mtm_volume_slope(volume);
    const double intercept = mtm_volume_intercept(volume);
    if (slope != 1.0 || intercept != 0.0)
        return mtm_fail(error, MTM_ARGUMENT,
                        "%s: the volume has slope %g and intercept %g, NRRD can state only 1 and 0", path,
                        slope, intercept);
    for (const char *letter = mtm_volume_grid(volume)->unit; *letter != '\0'; letter++)
        if (iscntrl((unsigned char)*letter))
            return mtm_fail(error, MTM_ARGUMENT, "%s: the volume's unit has control characters", path);
    if (mtm_path_has_extension(path, ".nrrd")) return write_attached(volume, path, options, error);
    if (mtm_path_has_extension(path, ".nhdr")) return write_detached(volume, path, options, error);
    return mtm_fail(error, MTM_ARGUMENT, "%s: volumes are written to names that end in .nrrd or .nhdr", path);
}
