/* SPDX-License-Identifier: BSD-3-Clause
 * The files that hold a NRRD file's voxels: attached, one, a LIST, or numbered ones ("slice.%03d 1 93 1"). */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/number.h"
#include "volume/nrrd.h"

enum { NUMBER_WIDTH_LIMIT = 64 };

/* The one conversion of a pattern: "%d", "%03d", "%4u" or "%i". */
typedef struct conversion {
    size_t begin, end; /* where it stands in the pattern */
    int width;
    bool has_zeros;
} conversion;

static bool find_conversion(const char *pattern, conversion *found) {
    const char *percent = strchr(pattern, '%');
    if (percent == NULL) return false;
    const char *text = percent + 1;
    *found = (conversion){.begin = (size_t)(percent - pattern), .has_zeros = *text == '0'};
    for (; isdigit((unsigned char)*text) && found->width <= NUMBER_WIDTH_LIMIT; text++)
        found->width = 10 * found->width + (*text - '0');
    if (found->width > NUMBER_WIDTH_LIMIT || *text == '\0' || strchr("diu", *text) == NULL) return false;
    found->end = (size_t)(text + 1 - pattern);
    return strchr(text, '%') == NULL;
}

static bool next_integer(const char **text, int *number) {
    char word[MTM_NRRD_NAME_TEXT];
    *text = mtm_nrrd_next_word(*text, word);
    return *text != NULL && mtm_integer_parse(word, number);
}

/* "pattern first last step", perhaps followed by the dimension of each file, which is 0 where it is not stated.
 * Anything else is the name of a single file, whatever its letters. */
static bool scan_numbered(const char *value, mtm_nrrd_files *files, int *last, int *dimension) {
    char word[MTM_NRRD_NAME_TEXT];
    conversion unused;
    const char *rest = mtm_nrrd_next_word(value, word);
    if (rest == NULL || !find_conversion(value, &unused)) return false;
    *dimension = 0;
    if (!next_integer(&rest, &files->first) || !next_integer(&rest, last) ||
        !next_integer(&rest, &files->step))
        return false;
    const char *end = mtm_nrrd_next_word(rest, word);
    return end == NULL || (next_integer(&rest, dimension) && mtm_nrrd_next_word(rest, word) == NULL);
}

static mtm_status count_numbered(const mtm_nrrd_header *header, mtm_nrrd_files *files, int last,
                                 mtm_error *error) {
    const long long distance = (long long)last - files->first;
    if (files->step == 0 || (distance > 0) != (files->step > 0 && distance != 0))
        return mtm_fail(error, MTM_FORMAT,
                        "%s: field 'data file' is '%.100s', whose step does not lead from the first number "
                        "to the last",
                        header->path, header->values[MTM_NRRD_DATA_FILE]);
    const long long count = distance / files->step + 1;
    if (count > 1 << 30)
        return mtm_fail(error, MTM_LIMIT, "%s: field 'data file' names %lld files", header->path, count);
    files->count = (int)count;
    return MTM_OK;
}

/* An array, so that file n is found without walking over the n names before it. */
static mtm_status index_list(const mtm_nrrd_header *header, mtm_nrrd_files *files, mtm_error *error) {
    files->count = header->file_list_count;
    if (files->count == 0)
        return mtm_fail(error, MTM_FORMAT, "%s: field 'data file' is LIST, but no file name follows",
                        header->path);
    files->names = mtm_allocate((size_t)files->count, sizeof *files->names);
    if (files->names == NULL)
        return mtm_fail_memory(error, header->path, (size_t)files->count * sizeof *files->names);
    const char *name = header->file_list;
    for (int i = 0; i < files->count; i++) {
        files->names[i] = name;
        name += strlen(name) + 1;
    }
    return MTM_OK;
}

/* Files of `dimension` axes each must be as many as the slower axes ask for; files of all axes are slabs along
 * the slowest. The files follow each other in memory in both cases. */
static mtm_status check_count(const mtm_nrrd_header *header, const mtm_nrrd_files *files, int dimension,
                              mtm_error *error) {
    if (dimension == 0) dimension = header->dimension - 1;
    if (dimension < 1 || dimension > header->dimension)
        return mtm_fail(error, MTM_FORMAT, "%s: field 'data file' states files of %d axes, expected 1 to %d",
                        header->path, dimension, header->dimension);
    const int slowest = header->sizes[header->dimension - 1];
    if (dimension == header->dimension && slowest % files->count == 0) return MTM_OK;
    double needed = dimension == header->dimension ? slowest : 1.0; /* exact up to any count of files */
    for (int axis = dimension; axis < header->dimension; axis++) needed *= header->sizes[axis];
    if (dimension < header->dimension && needed == files->count) return MTM_OK;
    return mtm_fail(error, MTM_FORMAT, "%s: field 'data file' names %d files, sizes \"%.60s\" need %s%.0f",
                    header->path, files->count, header->values[MTM_NRRD_SIZES],
                    dimension == header->dimension ? "a divisor of " : "", needed);
}

static mtm_status find_several(const mtm_nrrd_header *header, mtm_nrrd_files *files, int last, int dimension,
                               mtm_error *error) {
    mtm_status status = MTM_OK;
    if (files->is_numbered) {
        status = count_numbered(header, files, last, error);
    } else {
        status = index_list(header, files, error);
        const char *text = header->values[MTM_NRRD_DATA_FILE] + strlen("LIST");
        if (*text != '\0' && !mtm_integer_parse(text, &dimension)) dimension = -1;
    }
    return status == MTM_OK ? check_count(header, files, dimension, error) : status;
}

mtm_status mtm_nrrd_files_find(const mtm_nrrd_header *header, mtm_nrrd_files *files, mtm_error *error) {
    *files = (mtm_nrrd_files){.count = 1, .pattern = header->values[MTM_NRRD_DATA_FILE]};
    files->is_attached = files->pattern == NULL;
    if (files->is_attached) {
        if (header->has_empty_line) return MTM_OK;
        return mtm_fail(error, MTM_FORMAT, "%s: its header names no 'data file' and no empty line ends it",
                        header->path);
    }
    files->folder = mtm_path_folder(header->path);
    if (files->folder == NULL) return mtm_fail_memory(error, header->path, strlen(header->path));
    if (files->pattern[0] == '\0')
        return mtm_fail(error, MTM_FORMAT, "%s: field 'data file' is empty", header->path);
    int last = 0;
    int dimension = 0;
    files->is_numbered = header->file_list == NULL && scan_numbered(files->pattern, files, &last, &dimension);
    if (files->is_numbered || header->file_list != NULL)
        return find_several(header, files, last, dimension, error);
    return MTM_OK;
}

void mtm_nrrd_files_free(mtm_nrrd_files *files) {
    free(files->folder);
    free(files->names);
    *files = (mtm_nrrd_files){0};
}

/* Puts the number in by hand: the pattern comes from a file, which must never reach printf as a format. */
static char *numbered_name(const mtm_nrrd_files *files, int index) {
    conversion place;
    if (!find_conversion(files->pattern, &place)) return NULL;
    const size_t length = strcspn(files->pattern, " \t");
    const size_t bytes = length + NUMBER_WIDTH_LIMIT + 32;
    char *name = malloc(bytes);
    if (name == NULL) return NULL;
    const long long number = files->first + (long long)index * files->step;
    (void)snprintf(name, bytes, place.has_zeros ? "%.*s%0*lld%.*s" : "%.*s%*lld%.*s", (int)place.begin,
                   files->pattern, place.width, number, (int)(length - place.end),
                   files->pattern + place.end);
    return name;
}

char *mtm_nrrd_file_path(const mtm_nrrd_files *files, int index) {
    if (!files->is_numbered)
        return mtm_path_join(files->folder, files->names != NULL ? files->names[index] : files->pattern);
    char *name = numbered_name(files, index);
    char *path = name == NULL ? NULL : mtm_path_join(files->folder, name);
    free(name);
    return path;
}
