/* SPDX-License-Identifier: BSD-3-Clause
 * Whole-file reading with a limit, writing that never leaves half a file, and paths. */
#define _XOPEN_SOURCE 700
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/fail.h"
#include "base/memory.h"

enum { READ_CHUNK_BYTES = 1 << 16 };

mtm_status mtm_text_write(const char *path, const char *text, mtm_error *error) {
    return mtm_file_write(path, text, strlen(text), error);
}

bool mtm_file_exists(const char *path) {
    struct stat state;
    return stat(path, &state) == 0 && !S_ISDIR(state.st_mode);
}

/* Reads to the end in growing chunks, because a pipe does not tell its length. */
static mtm_status read_stream(FILE *stream, const char *path, size_t limit_bytes, char **bytes,
                              size_t *byte_count, mtm_error *error) {
    size_t capacity = READ_CHUNK_BYTES;
    size_t count = 0;
    char *buffer = malloc(capacity + 1);
    while (buffer != NULL) {
        count += fread(buffer + count, 1, capacity - count, stream);
        if (count > limit_bytes) {
            free(buffer);
            return mtm_fail(error, MTM_LIMIT, "%s: more than %zu bytes, too large for a file of its kind",
                            path, limit_bytes);
        }
        if (count < capacity) break;
        capacity *= 2;
        char *larger = realloc(buffer, capacity + 1);
        if (larger == NULL) free(buffer);
        buffer = larger;
    }
    if (buffer == NULL) return mtm_fail_memory(error, path, capacity);
    if (ferror(stream)) {
        free(buffer);
        return mtm_fail(error, MTM_IO, "%s: cannot be read: %s", path, strerror(errno));
    }
    buffer[count] = '\0';
    *bytes = buffer;
    *byte_count = count;
    return MTM_OK;
}

mtm_status mtm_file_read(const char *path, size_t limit_bytes, char **bytes, size_t *byte_count,
                         mtm_error *error) {
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) return mtm_fail(error, MTM_IO, "%s: cannot be opened: %s", path, strerror(errno));
    const mtm_status status = read_stream(stream, path, limit_bytes, bytes, byte_count, error);
    (void)fclose(stream);
    return status;
}

static mtm_status fail_output(mtm_output *output, const char *path, mtm_error *error) {
    const mtm_status status = mtm_fail(error, MTM_IO, "%s: cannot be written: %s", path, strerror(errno));
    mtm_output_abandon(output);
    return status;
}

static bool is_written_directly(const char *target) {
    struct stat state;
    return stat(target, &state) == 0 && !S_ISREG(state.st_mode);
}

/* A new file beside the target. Its name holds the process and a number, so that programs writing the same
 * target at the same time do not meet; open() applies the user's permissions. */
static FILE *open_temporary(mtm_output *output) {
    const size_t bytes = strlen(output->target) + 64;
    output->temporary = malloc(bytes);
    if (output->temporary == NULL) return NULL;
    int descriptor = -1;
    for (int attempt = 0; attempt < 100 && descriptor < 0; attempt++) {
        (void)snprintf(output->temporary, bytes, "%s.%ld-%d.part", output->target, (long)getpid(), attempt);
        descriptor = open(output->temporary, O_RDWR | O_CREAT | O_EXCL, 0666);
        if (descriptor < 0 && errno != EEXIST) break;
    }
    FILE *stream = descriptor < 0 ? NULL : fdopen(descriptor, "w+b");
    if (stream == NULL) {
        const int reason = errno;
        if (descriptor >= 0) (void)close(descriptor);
        free(output->temporary);
        output->temporary = NULL;
        errno = reason;
    }
    return stream;
}

mtm_status mtm_output_open(const char *path, mtm_output *output, mtm_error *error) {
    *output = (mtm_output){.target = realpath(path, NULL)};
    if (output->target == NULL) output->target = mtm_text_copy(path);
    if (output->target == NULL) return mtm_fail_memory(error, path, strlen(path));
    /* Renaming would replace a file that its owner has locked. */
    if (mtm_file_exists(output->target) && access(output->target, W_OK) != 0)
        return fail_output(output, path, error);
    output->stream =
        is_written_directly(output->target) ? fopen(output->target, "wb") : open_temporary(output);
    return output->stream == NULL ? fail_output(output, path, error) : MTM_OK;
}

mtm_status mtm_output_commit(mtm_output *output, mtm_error *error) {
    const bool had_error = ferror(output->stream) != 0;
    const bool is_flushed = fflush(output->stream) == 0;
    if (had_error || !is_flushed) return fail_output(output, output->target, error);
    FILE *stream = output->stream;
    output->stream = NULL;
    if (fclose(stream) != 0) return fail_output(output, output->target, error);
    if (output->temporary != NULL && rename(output->temporary, output->target) != 0)
        return fail_output(output, output->target, error);
    free(output->temporary);
    free(output->target);
    *output = (mtm_output){0};
    return MTM_OK;
}

void mtm_output_abandon(mtm_output *output) {
    if (output->stream != NULL) (void)fclose(output->stream);
    if (output->temporary != NULL) (void)unlink(output->temporary);
    free(output->temporary);
    free(output->target);
    *output = (mtm_output){0};
}

mtm_status mtm_file_write(const char *path, const void *bytes, size_t byte_count, mtm_error *error) {
    mtm_output output;
    const mtm_status status = mtm_output_open(path, &output, error);
    if (status != MTM_OK) return status;
    (void)fwrite(bytes, 1, byte_count, output.stream);
    return mtm_output_commit(&output, error);
}

char *mtm_path_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    if (slash == NULL) return mtm_text_copy(".");
    char *folder = mtm_text_copy(path);
    if (folder != NULL) folder[slash == path ? 1 : slash - path] = '\0';
    return folder;
}

char *mtm_path_join(const char *folder, const char *file) {
    if (file[0] == '/') return mtm_text_copy(file);
    const size_t bytes = strlen(folder) + strlen(file) + 2;
    char *path = malloc(bytes);
    if (path != NULL) (void)snprintf(path, bytes, "%s/%s", folder, file);
    return path;
}

const char *mtm_path_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash == NULL ? path : slash + 1;
}

bool mtm_path_has_extension(const char *path, const char *extension) {
    const size_t length = strlen(path);
    const size_t extension_length = strlen(extension);
    return length > extension_length && strcasecmp(path + length - extension_length, extension) == 0;
}
