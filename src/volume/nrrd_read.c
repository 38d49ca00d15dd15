/* SPDX-License-Identifier: BSD-3-Clause
 * The voxels of a NRRD file: mapped where they lie in it as they are in memory, else read straight into the volume. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/mapping.h"
#include "base/memory.h"
#include "volume/gunzip.h"
#include "volume/nrrd.h"
#include "volume/open.h"
#include "volume/volume.h"
#include "volume/voxel_type.h"

/* One of the files that the voxels are in, standing at its first voxel (raw) or at its gzip data. */
typedef struct data_part {
    FILE *stream;
    char *path; /* NULL: the header's own file, which stays open */
    const char *name;
} data_part;

typedef struct nrrd_reader {
    FILE *stream; /* of the header */
    mtm_nrrd_header header;
    mtm_nrrd_files files;
    size_t part_bytes; /* of voxels, in each of the files */
} nrrd_reader;

static void close_part(data_part *part) {
    if (part->path != NULL && part->stream != NULL) (void)fclose(part->stream);
    free(part->path);
}

static mtm_status skip_lines(const nrrd_reader *reader, const data_part *part, mtm_error *error) {
    for (long long line = 0; line < reader->header.line_skip; line++) {
        int byte = getc(part->stream);
        while (byte != '\n' && byte != EOF) byte = getc(part->stream);
        if (byte == EOF)
            return mtm_fail(error, MTM_FORMAT, "%s: has %lld lines, field 'line skip' is %lld", part->name,
                            line, reader->header.line_skip);
    }
    return MTM_OK;
}

static mtm_status fail_seek(const data_part *part, mtm_error *error) {
    return mtm_fail(error, MTM_IO, "%s: cannot be read: %s", part->name, strerror(errno));
}

/* Goes to the first voxel of a raw file and makes sure that all of them are there. */
static mtm_status seek_raw(const nrrd_reader *reader, const data_part *part, long long begin, long long end,
                           mtm_error *error) {
    const long long needed = (long long)reader->part_bytes;
    const long long byte_skip = reader->header.byte_skip;
    long long available = end - begin;
    if (byte_skip > 0) available = available > byte_skip ? available - byte_skip : 0;
    if (available < needed)
        return mtm_fail(error, MTM_FORMAT, "%s: has %lld bytes of voxels, its header asks for %lld",
                        part->name, available, needed);
    const long long first = byte_skip < 0 ? end - needed : begin + byte_skip;
    return fseeko(part->stream, (off_t)first, SEEK_SET) == 0 ? MTM_OK : fail_seek(part, error);
}

/* Gzip data tell their length only by being decompressed, but not more than so much can be in them. */
static mtm_status check_gzip(const nrrd_reader *reader, const data_part *part, long long begin, long long end,
                             mtm_error *error) {
    const double most = (double)(end - begin) * MTM_GUNZIP_RATIO_LIMIT;
    const double needed = (double)reader->part_bytes + (double)reader->header.byte_skip;
    if (most < needed)
        return mtm_fail(error, MTM_FORMAT, "%s: has at most %.0f bytes of voxels, its header asks for %.0f",
                        part->name, most, needed);
    return fseeko(part->stream, (off_t)begin, SEEK_SET) == 0 ? MTM_OK : fail_seek(part, error);
}

/* Opens file `index`, in which case close_part must follow whatever the status is. */
static mtm_status open_part(const nrrd_reader *reader, int index, data_part *part, mtm_error *error) {
    *part = (data_part){.stream = reader->stream, .name = reader->header.path};
    mtm_status status = MTM_OK;
    if (reader->files.is_attached) {
        if (fseeko(part->stream, (off_t)reader->header.data_offset, SEEK_SET) != 0)
            return fail_seek(part, error);
    } else {
        part->stream = NULL;
        part->path = mtm_nrrd_file_path(&reader->files, index);
        if (part->path == NULL) return mtm_fail_memory(error, reader->header.path, BUFSIZ);
        part->name = part->path;
        mtm_error reason;
        status = mtm_open_regular(part->path, &part->stream, &reason);
        if (status != MTM_OK)
            return mtm_fail(error, status, "%s: field 'data file' names a file that cannot be used: %s",
                            reader->header.path, reason.message);
    }
    if (status == MTM_OK) status = skip_lines(reader, part, error);
    if (status != MTM_OK) return status;

    const long long begin = ftello(part->stream);
    if (begin < 0 || fseeko(part->stream, 0, SEEK_END) != 0) return fail_seek(part, error);
    const long long end = ftello(part->stream);
    return reader->header.is_gzip ? check_gzip(reader, part, begin, end, error)
                                  : seek_raw(reader, part, begin, end, error);
}

static mtm_status read_part(const nrrd_reader *reader, const data_part *part, unsigned char *voxels,
                            mtm_error *error) {
    if (reader->header.is_gzip)
        return mtm_gunzip(part->stream, part->name, (unsigned long long)reader->header.byte_skip, voxels,
                          reader->part_bytes, error);
    if (fread(voxels, 1, reader->part_bytes, part->stream) == reader->part_bytes) return MTM_OK;
    return mtm_fail(error, MTM_IO, "%s: cannot be read to its end", part->name);
}

/* Opens every file, and reads it where there is a place for its voxels. */
static mtm_status visit_parts(const nrrd_reader *reader, unsigned char *voxels, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int index = 0; status == MTM_OK && index < reader->files.count; index++) {
        data_part part;
        status = open_part(reader, index, &part, error);
        if (status == MTM_OK && voxels != NULL)
            status = read_part(reader, &part, voxels + (size_t)index * reader->part_bytes, error);
        close_part(&part);
    }
    return status;
}

/* False where the voxels must be read: compressed, in several files, in the other byte order or at an odd place, or
 * the file cannot be mapped or opened again, of which reading then tells. */
static bool map_voxels(const nrrd_reader *reader, mtm_mapping *mapping) {
    const mtm_nrrd_header *header = &reader->header;
    const size_t voxel_bytes = mtm_voxel_type_bytes(header->type);
    const bool is_native = voxel_bytes == 1 || header->is_big_endian == mtm_is_big_endian();
    if (header->is_gzip || reader->files.count > 1 || !is_native) return false;

    data_part part;
    bool is_mapped = false;
    if (open_part(reader, 0, &part, NULL) == MTM_OK) {
        const long long offset = ftello(part.stream);
        is_mapped = offset >= 0 && (unsigned long long)offset % voxel_bytes == 0 &&
                    mtm_mapping_open(part.stream, offset, reader->part_bytes, mapping);
    }
    close_part(&part);
    return is_mapped;
}

static mtm_status read_into_memory(const nrrd_reader *reader, const mtm_grid *grid, mtm_volume **volume,
                                   mtm_error *error) {
    const mtm_nrrd_header *header = &reader->header;
    mtm_status status = mtm_volume_allocate(grid, header->type, header->path, volume, error);
    if (status == MTM_OK) status = visit_parts(reader, mtm_volume_storage(*volume), error);
    if (status == MTM_OK && header->is_big_endian != mtm_is_big_endian())
        mtm_voxels_swap_bytes_parallel(header->type, mtm_volume_storage(*volume),
                                       mtm_volume_voxel_count(*volume));
    return status;
}

/* Makes the volume only after all files were found long enough, so that a header cannot ask for memory that no
 * file will fill. */
static mtm_status read_voxels(nrrd_reader *reader, const mtm_grid *grid, mtm_volume **volume,
                              mtm_error *error) {
    const mtm_nrrd_header *header = &reader->header;
    size_t bytes = 0;
    mtm_status status = mtm_volume_bytes(grid->size, header->type, header->path, &bytes, error);
    if (status != MTM_OK) return status;
    reader->part_bytes = bytes / (size_t)reader->files.count;
    status = visit_parts(reader, NULL, error);
    if (status != MTM_OK) return status;
    mtm_mapping mapping;
    if (map_voxels(reader, &mapping))
        status = mtm_volume_adopt(grid, header->type, &mapping, header->path, volume, error);
    else
        status = read_into_memory(reader, grid, volume, error);
    if (status == MTM_OK) mtm_volume_finish(*volume, 1.0, 0.0);
    return status;
}

mtm_status mtm_nrrd_read(FILE *stream, const char *path, mtm_volume **volume, mtm_error *error) {
    nrrd_reader reader = {.stream = stream};
    mtm_grid grid = {0};
    mtm_volume *result = NULL;
    mtm_status status = mtm_nrrd_header_read(stream, path, &reader.header, error);
    if (status == MTM_OK) status = mtm_nrrd_header_interpret(&reader.header, error);
    if (status == MTM_OK) status = mtm_nrrd_grid(&reader.header, &grid, error);
    if (status == MTM_OK) status = mtm_nrrd_files_find(&reader.header, &reader.files, error);
    if (status == MTM_OK) status = read_voxels(&reader, &grid, &result, error);
    mtm_nrrd_files_free(&reader.files);
    mtm_nrrd_header_free(&reader.header);
    if (status == MTM_OK)
        *volume = result;
    else
        mtm_volume_destroy(result);
    return status;
}
