/* SPDX-License-Identifier: BSD-3-Clause
 * What the basic fields of a NRRD header say: type, sizes, encoding, byte order and what to skip. */
#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/number.h"
#include "volume/nrrd.h"

typedef struct type_spelling {
    const char *name;
    mtm_voxel_type type;
} type_spelling;

/* Every spelling of the format; "char" alone is none of them, because its sign is anybody's guess. */
static const type_spelling spellings[] = {
    {"signed char", MTM_VOXEL_INT8},
    {"int8", MTM_VOXEL_INT8},
    {"int8_t", MTM_VOXEL_INT8},
    {"uchar", MTM_VOXEL_UINT8},
    {"unsigned char", MTM_VOXEL_UINT8},
    {"uint8", MTM_VOXEL_UINT8},
    {"uint8_t", MTM_VOXEL_UINT8},
    {"short", MTM_VOXEL_INT16},
    {"short int", MTM_VOXEL_INT16},
    {"signed short", MTM_VOXEL_INT16},
    {"signed short int", MTM_VOXEL_INT16},
    {"int16", MTM_VOXEL_INT16},
    {"int16_t", MTM_VOXEL_INT16},
    {"ushort", MTM_VOXEL_UINT16},
    {"unsigned short", MTM_VOXEL_UINT16},
    {"unsigned short int", MTM_VOXEL_UINT16},
    {"uint16", MTM_VOXEL_UINT16},
    {"uint16_t", MTM_VOXEL_UINT16},
    {"int", MTM_VOXEL_INT32},
    {"signed int", MTM_VOXEL_INT32},
    {"int32", MTM_VOXEL_INT32},
    {"int32_t", MTM_VOXEL_INT32},
    {"uint", MTM_VOXEL_UINT32},
    {"unsigned int", MTM_VOXEL_UINT32},
    {"uint32", MTM_VOXEL_UINT32},
    {"uint32_t", MTM_VOXEL_UINT32},
    {"long long", MTM_VOXEL_INT64},
    {"long long int", MTM_VOXEL_INT64},
    {"signed long long", MTM_VOXEL_INT64},
    {"signed long long int", MTM_VOXEL_INT64},
    {"int64", MTM_VOXEL_INT64},
    {"int64_t", MTM_VOXEL_INT64},
    {"ulonglong", MTM_VOXEL_UINT64},
    {"unsigned long long", MTM_VOXEL_UINT64},
    {"unsigned long long int", MTM_VOXEL_UINT64},
    {"uint64", MTM_VOXEL_UINT64},
    {"uint64_t", MTM_VOXEL_UINT64},
    {"float", MTM_VOXEL_FLOAT32},
    {"double", MTM_VOXEL_FLOAT64},
};

const char *mtm_nrrd_next_word(const char *text, char word[MTM_NRRD_NAME_TEXT]) {
    while (isspace((unsigned char)*text)) text++;
    if (*text == '\0') return NULL;
    size_t length = 0;
    for (; *text != '\0' && !isspace((unsigned char)*text); text++)
        if (length < MTM_NRRD_NAME_TEXT - 1) word[length++] = *text;
    word[length] = '\0';
    return text;
}

static int count_words(const char *text) {
    int count = 0;
    char word[MTM_NRRD_NAME_TEXT];
    while ((text = mtm_nrrd_next_word(text, word)) != NULL) count++;
    return count;
}

static mtm_status fail_count(const mtm_nrrd_header *header, mtm_nrrd_field field, int count,
                             mtm_error *error) {
    const char *value = header->values[field];
    return mtm_fail(error, MTM_FORMAT, "%s: field '%s' has %d numbers (\"%.60s\"), dimension %d needs %d",
                    header->path, mtm_nrrd_field_name(field), count_words(value), value, header->dimension,
                    count);
}

mtm_status mtm_nrrd_numbers(const mtm_nrrd_header *header, mtm_nrrd_field field, int count, double *numbers,
                            bool *is_present, mtm_error *error) {
    const char *text = header->values[field];
    *is_present = text != NULL;
    if (text == NULL) return MTM_OK;
    if (count_words(text) != count) return fail_count(header, field, count, error);
    for (int i = 0; i < count; i++) {
        char word[MTM_NRRD_NAME_TEXT];
        text = mtm_nrrd_next_word(text, word);
        if (!mtm_number_parse(word, &numbers[i]))
            return mtm_fail(error, MTM_FORMAT, "%s: field '%s' has '%s' where a number is expected",
                            header->path, mtm_nrrd_field_name(field), word);
    }
    return MTM_OK;
}

static mtm_status require(const mtm_nrrd_header *header, mtm_nrrd_field field, mtm_error *error) {
    if (header->values[field] != NULL) return MTM_OK;
    return mtm_fail(error, MTM_FORMAT, "%s: field '%s' is missing", header->path, mtm_nrrd_field_name(field));
}

/* A whole number from `least` on; the field may be absent where *number has a default. */
static mtm_status read_count(const mtm_nrrd_header *header, mtm_nrrd_field field, long long least,
                             long long *number, mtm_error *error) {
    const char *text = header->values[field];
    if (text == NULL) return MTM_OK;
    char *end = NULL;
    errno = 0;
    const long long value = strtoll(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || value < least)
        return mtm_fail(error, MTM_FORMAT, "%s: field '%s' is '%.60s', expected a whole number from %lld on",
                        header->path, mtm_nrrd_field_name(field), text, least);
    *number = value;
    return MTM_OK;
}

static mtm_status interpret_dimension(mtm_nrrd_header *header, mtm_error *error) {
    mtm_status status = require(header, MTM_NRRD_DIMENSION, error);
    if (status != MTM_OK) return status;
    long long dimension = 0;
    status = read_count(header, MTM_NRRD_DIMENSION, 1, &dimension, error);
    if (status != MTM_OK) return status;
    if (dimension < 3)
        return mtm_fail(error, MTM_FORMAT, "%s: field 'dimension' is %lld, volumes have 3 axes", header->path,
                        dimension);
    if (dimension > MTM_NRRD_AXES)
        return mtm_fail(error, MTM_FORMAT, "%s: field 'dimension' is %lld, the format ends at %d",
                        header->path, dimension, MTM_NRRD_AXES);
    header->dimension = (int)dimension;
    return MTM_OK;
}

static mtm_status interpret_sizes(mtm_nrrd_header *header, mtm_error *error) {
    const mtm_status status = require(header, MTM_NRRD_SIZES, error);
    if (status != MTM_OK) return status;
    const char *text = header->values[MTM_NRRD_SIZES];
    if (count_words(text) != header->dimension)
        return fail_count(header, MTM_NRRD_SIZES, header->dimension, error);
    for (int axis = 0; axis < header->dimension; axis++) {
        char word[MTM_NRRD_NAME_TEXT];
        text = mtm_nrrd_next_word(text, word);
        char *end = NULL;
        const long long size = strtoll(word, &end, 10); /* beyond its range: the largest, which is refused */
        if (end == word || *end != '\0' || size < 1)
            return mtm_fail(error, MTM_FORMAT, "%s: field 'sizes' has '%s', expected whole numbers from 1 on",
                            header->path, word);
        if (size > INT_MAX)
            return mtm_fail(error, MTM_LIMIT, "%s: field 'sizes' has %s, axes hold at most %d voxels",
                            header->path, word, INT_MAX);
        header->sizes[axis] = (int)size;
    }
    return MTM_OK;
}

static mtm_status interpret_type(mtm_nrrd_header *header, mtm_error *error) {
    const mtm_status status = require(header, MTM_NRRD_TYPE, error);
    if (status != MTM_OK) return status;
    const char *text = header->values[MTM_NRRD_TYPE];
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings; i++) {
        if (!mtm_nrrd_is_same_name(text, spellings[i].name)) continue;
        header->type = spellings[i].type;
        return MTM_OK;
    }
    return mtm_fail(error, MTM_FORMAT,
                    "%s: field 'type' is '%.60s', expected a scalar type such as 'uint8', 'short' or 'float'",
                    header->path, text);
}

static mtm_status interpret_encoding(mtm_nrrd_header *header, mtm_error *error) {
    const mtm_status status = require(header, MTM_NRRD_ENCODING, error);
    if (status != MTM_OK) return status;
    const char *text = header->values[MTM_NRRD_ENCODING];
    header->is_gzip = mtm_nrrd_is_same_name(text, "gzip") || mtm_nrrd_is_same_name(text, "gz");
    if (header->is_gzip || mtm_nrrd_is_same_name(text, "raw")) return MTM_OK;
    return mtm_fail(error, MTM_FORMAT, "%s: encoding '%.60s' is not supported; raw and gzip are",
                    header->path, text);
}

static mtm_status interpret_endian(mtm_nrrd_header *header, mtm_error *error) {
    const char *text = header->values[MTM_NRRD_ENDIAN];
    const size_t voxel_bytes = mtm_voxel_type_bytes(header->type);
    if (text == NULL) {
        if (voxel_bytes == 1) return MTM_OK;
        return mtm_fail(error, MTM_FORMAT, "%s: field 'endian' is missing, which voxels of %zu bytes need",
                        header->path, voxel_bytes);
    }
    header->is_big_endian = mtm_nrrd_is_same_name(text, "big");
    if (header->is_big_endian || mtm_nrrd_is_same_name(text, "little")) return MTM_OK;
    return mtm_fail(error, MTM_FORMAT, "%s: field 'endian' is '%.60s', expected 'little' or 'big'",
                    header->path, text);
}

static mtm_status interpret_skips(mtm_nrrd_header *header, mtm_error *error) {
    mtm_status status = read_count(header, MTM_NRRD_LINE_SKIP, 0, &header->line_skip, error);
    if (status != MTM_OK) return status;
    status = read_count(header, MTM_NRRD_BYTE_SKIP, -1, &header->byte_skip, error);
    if (status != MTM_OK) return status;
    if (header->byte_skip < 0 && header->is_gzip)
        return mtm_fail(error, MTM_FORMAT, "%s: field 'byte skip' is -1, which only encoding raw allows",
                        header->path);
    return MTM_OK;
}

mtm_status mtm_nrrd_header_interpret(mtm_nrrd_header *header, mtm_error *error) {
    mtm_status status = interpret_dimension(header, error);
    if (status == MTM_OK) status = interpret_sizes(header, error);
    if (status == MTM_OK) status = interpret_type(header, error);
    if (status == MTM_OK) status = interpret_encoding(header, error);
    if (status == MTM_OK) status = interpret_endian(header, error);
    if (status == MTM_OK) status = interpret_skips(header, error);
    return status;
}
