/* SPDX-License-Identifier: BSD-3-Clause
 * Reading gzip data out of the middle of a file (RFC 1952), through zlib. */
#include "volume/gunzip.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/fail.h"

enum {
    INPUT_BYTES = 1 << 18,
    SCRATCH_BYTES = 1 << 14,
    OUTPUT_STEP_BYTES = 1 << 30, /* zlib counts in unsigned int */
    GZIP_ONLY = 16 + MAX_WBITS,
};

typedef struct gunzip {
    FILE *stream;
    const char *path;
    z_stream zlib;
    unsigned char *input;
    bool is_at_end; /* of the last member, or of the file */
    bool is_cut;    /* the file ends inside a member */
} gunzip;

static mtm_status fail_zlib(const gunzip *reader, int result, mtm_error *error) {
    if (result == Z_MEM_ERROR) return mtm_fail_memory(error, reader->path, SCRATCH_BYTES);
    const char *reason = reader->zlib.msg != NULL ? reader->zlib.msg : "a dictionary is missing";
    return mtm_fail(error, MTM_FORMAT, "%s: its gzip data are damaged: %s", reader->path, reason);
}

/* Keeps what is left of the input and adds more of the file. */
static mtm_status refill(gunzip *reader, mtm_error *error) {
    const unsigned int left = reader->zlib.avail_in;
    if (left > 0) memmove(reader->input, reader->zlib.next_in, left);
    reader->zlib.next_in = reader->input;
    reader->zlib.avail_in =
        left + (unsigned int)fread(reader->input + left, 1, INPUT_BYTES - left, reader->stream);
    if (ferror(reader->stream)) return mtm_fail(error, MTM_IO, "%s: cannot be read", reader->path);
    return MTM_OK;
}

/* After a member another one may follow; anything else is not ours. */
static mtm_status begin_next_member(gunzip *reader, mtm_error *error) {
    if (reader->zlib.avail_in < 2) {
        const mtm_status status = refill(reader, error);
        if (status != MTM_OK) return status;
    }
    const unsigned char *next = reader->zlib.next_in;
    reader->is_at_end = reader->zlib.avail_in < 2 || next[0] != 0x1f || next[1] != 0x8b;
    if (!reader->is_at_end) (void)inflateReset(&reader->zlib);
    return MTM_OK;
}

/* Decompresses up to `byte_count` bytes; *got is less only at the end of the data. */
static mtm_status pull(gunzip *reader, unsigned char *bytes, size_t byte_count, size_t *got,
                       mtm_error *error) {
    *got = 0;
    mtm_status status = MTM_OK;
    while (status == MTM_OK && *got < byte_count && !reader->is_at_end) {
        if (reader->zlib.avail_in == 0) status = refill(reader, error);
        if (status != MTM_OK) break;
        const size_t left = byte_count - *got;
        const unsigned int step = left < OUTPUT_STEP_BYTES ? (unsigned int)left : OUTPUT_STEP_BYTES;
        reader->zlib.next_out = bytes + *got;
        reader->zlib.avail_out = step;
        const int result = inflate(&reader->zlib, Z_NO_FLUSH);
        *got += step - reader->zlib.avail_out;
        if (result == Z_STREAM_END)
            status = begin_next_member(reader, error);
        else if (result == Z_BUF_ERROR) /* no input is left */
            reader->is_at_end = reader->is_cut = true;
        else if (result != Z_OK)
            status = fail_zlib(reader, result, error);
    }
    return status;
}

static mtm_status skip(gunzip *reader, unsigned long long skip_bytes, mtm_error *error) {
    mtm_status status = MTM_OK;
    while (status == MTM_OK && skip_bytes > 0 && !reader->is_at_end) {
        unsigned char scratch[SCRATCH_BYTES];
        size_t got = 0;
        const size_t step = skip_bytes < SCRATCH_BYTES ? (size_t)skip_bytes : SCRATCH_BYTES;
        status = pull(reader, scratch, step, &got, error);
        skip_bytes -= got;
    }
    return status;
}

/* Reads one byte more, which makes zlib compare the checksum where the data end with the bytes asked for. */
static mtm_status check_end(gunzip *reader, mtm_error *error) {
    unsigned char byte = 0;
    size_t got = 0;
    const mtm_status status = pull(reader, &byte, 1, &got, error);
    if (status != MTM_OK || !reader->is_cut) return status;
    return mtm_fail(error, MTM_FORMAT, "%s: its gzip data end before their checksum", reader->path);
}

mtm_status mtm_gunzip(FILE *stream, const char *path, unsigned long long skip_bytes, void *bytes,
                      size_t byte_count, mtm_error *error) {
    gunzip reader = {.stream = stream, .path = path};
    if (inflateInit2(&reader.zlib, GZIP_ONLY) != Z_OK) return mtm_fail_memory(error, path, SCRATCH_BYTES);
    reader.input = malloc(INPUT_BYTES);
    size_t got = 0;
    mtm_status status = reader.input == NULL ? mtm_fail_memory(error, path, INPUT_BYTES) : MTM_OK;
    if (status == MTM_OK) status = skip(&reader, skip_bytes, error);
    if (status == MTM_OK) status = pull(&reader, bytes, byte_count, &got, error);
    if (status == MTM_OK && got < byte_count)
        status = mtm_fail(error, MTM_FORMAT, "%s: has %zu bytes of voxels, its header asks for %zu", path,
                          got, byte_count);
    if (status == MTM_OK) status = check_end(&reader, error);
    free(reader.input);
    (void)inflateEnd(&reader.zlib);
    return status;
}
