/* SPDX-License-Identifier: BSD-3-Clause
 * Strict reading of JSON documents with errors that name document, key and value. */
#include "base/json.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/nearest.h"
#include "base/number.h"

const mtm_json_range mtm_json_any = {-HUGE_VAL, HUGE_VAL};
const mtm_json_range mtm_json_not_negative = {0, HUGE_VAL};
const mtm_json_range mtm_json_unit = {0, 1};
const mtm_json_range mtm_json_amount = {0, 1e6};

mtm_status mtm_json_parse(const char *document, const char *text, size_t byte_count, json_t **value,
                          mtm_error *error) {
    static const char utf8_mark[] = "\xEF\xBB\xBF"; /* some editors begin a file with it */
    json_error_t reason;
    if (byte_count >= 3 && memcmp(text, utf8_mark, 3) == 0) {
        text += 3;
        byte_count -= 3;
    }
    *value = json_loadb(text, byte_count, JSON_REJECT_DUPLICATES, &reason);
    if (*value != NULL) return MTM_OK;
    return mtm_fail(error, MTM_FORMAT, "%s:%d: is no JSON document: %s", document, reason.line, reason.text);
}

mtm_status mtm_json_read_text(const char *path, char **text, mtm_error *error) {
    char *read = NULL;
    size_t byte_count = 0;
    const mtm_status status = mtm_file_read(path, MTM_JSON_TEXT_MAX, &read, &byte_count, error);
    if (status != MTM_OK) return status;
    if (strlen(read) != byte_count) {
        free(read);
        return mtm_fail(error, MTM_FORMAT, "%s: is no JSON document: holds a zero byte", path);
    }
    *text = read;
    return MTM_OK;
}

mtm_json_reader mtm_json_begin(const char *document, mtm_error *error) {
    return (mtm_json_reader){.document = document, .error = error};
}

void mtm_json_fail(mtm_json_reader *reader, const char *key, const char *format, ...) {
    if (reader->status != MTM_OK) return;
    char sentence[640];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    const char *dot = key != NULL && reader->path_length > 0 ? "." : "";
    const char *name = key != NULL ? key : "";
    const char *place = reader->path_length == 0 && key == NULL ? "the document" : reader->path;
    reader->status =
        mtm_fail(reader->error, MTM_FORMAT, "%s: %s%s%s %s", reader->document, place, dot, name, sentence);
}

void mtm_json_fail_name(mtm_json_reader *reader, const char *key, const char *name, const char *kind,
                        const char *nearest) {
    if (nearest[0] == '\0')
        mtm_json_fail(reader, key, "is \"%.64s\", but the palette has no %s", name, kind);
    else
        mtm_json_fail(reader, key, "is \"%.64s\", which is no %s of the palette; the nearest is \"%s\"", name,
                      kind, nearest);
}

static size_t extend_path(mtm_json_reader *reader, const char *separator, const char *step, const char *end) {
    const size_t previous = reader->path_length;
    const size_t room = sizeof reader->path - previous;
    const int added = snprintf(reader->path + previous, room, "%s%s%s", separator, step, end);
    reader->path_length += added < 0 ? 0 : (size_t)added < room ? (size_t)added : room - 1;
    return previous;
}

size_t mtm_json_enter(mtm_json_reader *reader, const char *key) {
    return extend_path(reader, reader->path_length > 0 ? "." : "", key, "");
}

size_t mtm_json_enter_index(mtm_json_reader *reader, size_t index) {
    char number[24];
    (void)snprintf(number, sizeof number, "%zu", index);
    return extend_path(reader, "[", number, "]");
}

void mtm_json_leave(mtm_json_reader *reader, size_t previous) {
    reader->path_length = previous;
    reader->path[previous] = '\0';
}

bool mtm_json_can_hold(const char *text, size_t byte_count) {
    json_t *held = json_stringn(text, byte_count);
    const bool can_hold = held != NULL;
    json_decref(held);
    return can_hold;
}

size_t mtm_json_prefix(const char *text, size_t byte_max) {
    size_t length = strnlen(text, byte_max);
    while (length > 0 && !mtm_json_can_hold(text, length)) length--;
    return length;
}

const char *mtm_json_preview(const json_t *value, char buffer[64]) {
    char *text = json_dumps(value, JSON_COMPACT | JSON_ENCODE_ANY | JSON_REAL_PRECISION(10));
    (void)snprintf(buffer, 64, "%.57s%s", text == NULL ? "?" : text,
                   text != NULL && strlen(text) > 57 ? "…" : "");
    free(text);
    return buffer;
}

static bool is_known_key(const char *key, const char *const *keys, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (strcmp(key, keys[i]) == 0) return true;
    return false;
}

bool mtm_json_expect_object(mtm_json_reader *reader, const json_t *value, const char *const *keys,
                            size_t count) {
    if (reader->status != MTM_OK) return false;
    if (!json_is_object(value)) {
        char preview[64];
        mtm_json_fail(reader, NULL, "is %s, must be an object", mtm_json_preview(value, preview));
        return false;
    }
    const char *key = NULL;
    json_t *member = NULL;
    json_object_foreach((json_t *)value, key, member) {
        if (is_known_key(key, keys, count)) continue;
        const char *nearest = mtm_nearest_name(key, keys, count);
        mtm_json_fail(reader, key, "is not a known key; the nearest is \"%s\"", nearest);
        return false;
    }
    return true;
}

json_t *mtm_json_required(mtm_json_reader *reader, const json_t *object, const char *key) {
    if (reader->status != MTM_OK) return NULL;
    json_t *value = json_object_get(object, key);
    if (value == NULL) mtm_json_fail(reader, key, "is missing");
    return value;
}

static json_t *optional(const mtm_json_reader *reader, const json_t *object, const char *key) {
    return reader->status == MTM_OK ? json_object_get(object, key) : NULL;
}

/* "is "5", must be …": the tail of the sentence for a value of the wrong type. */
static void fail_type(mtm_json_reader *reader, const char *key, const json_t *value, const char *expected) {
    char preview[64];
    mtm_json_fail(reader, key, "is %s, must be %s", mtm_json_preview(value, preview), expected);
}

static bool is_in_range(double number, mtm_json_range range) {
    return isfinite(number) && number >= range.min && number <= range.max;
}

/* A range's end for people: 200 and not 2e+02. */
static const char *format_end(double end, char text[MTM_NUMBER_TEXT]) {
    if (fabs(end) >= 1e6 || end != floor(end)) return mtm_number_format(end, text);
    (void)snprintf(text, MTM_NUMBER_TEXT, "%.0f", end);
    return text;
}

static void fail_range(mtm_json_reader *reader, const char *key, const json_t *value, mtm_json_range range) {
    char low[MTM_NUMBER_TEXT];
    char high[MTM_NUMBER_TEXT];
    char expected[2 * MTM_NUMBER_TEXT + 32];
    if (isinf(range.min) && isinf(range.max))
        (void)snprintf(expected, sizeof expected, "a number");
    else if (isinf(range.max))
        (void)snprintf(expected, sizeof expected, "a number, %s or more", format_end(range.min, low));
    else
        (void)snprintf(expected, sizeof expected, "a number from %s to %s", format_end(range.min, low),
                       format_end(range.max, high));
    fail_type(reader, key, value, expected);
}

bool mtm_json_number(mtm_json_reader *reader, const json_t *object, const char *key, mtm_json_range range,
                     double *result) {
    const json_t *value = optional(reader, object, key);
    if (value == NULL) return false;
    if (!json_is_number(value) || !is_in_range(json_number_value(value), range)) {
        fail_range(reader, key, value, range);
        return false;
    }
    *result = json_number_value(value);
    return true;
}

bool mtm_json_numbers(mtm_json_reader *reader, const json_t *object, const char *key, size_t count,
                      mtm_json_range range, double *result) {
    const json_t *value = optional(reader, object, key);
    if (value == NULL) return false;
    if (!json_is_array(value) || json_array_size(value) != count) {
        char expected[64];
        (void)snprintf(expected, sizeof expected, "an array of %zu numbers", count);
        if (json_is_array(value) && json_array_size(value) > 8)
            mtm_json_fail(reader, key, "has %zu elements, must be %s", json_array_size(value), expected);
        else
            fail_type(reader, key, value, expected);
        return false;
    }
    const size_t place = mtm_json_enter(reader, key);
    for (size_t i = 0; i < count && reader->status == MTM_OK; i++) {
        const json_t *element = json_array_get(value, i);
        const size_t array = mtm_json_enter_index(reader, i);
        if (!json_is_number(element) || !is_in_range(json_number_value(element), range))
            fail_range(reader, NULL, element, range);
        else
            result[i] = json_number_value(element);
        mtm_json_leave(reader, array);
    }
    mtm_json_leave(reader, place);
    return reader->status == MTM_OK;
}

bool mtm_json_integers(mtm_json_reader *reader, const json_t *object, const char *key, size_t count, int min,
                       int max, int *result) {
    enum { COUNT_MAX = 8 };
    double numbers[COUNT_MAX];
    assert(count <= COUNT_MAX);
    if (!mtm_json_numbers(reader, object, key, count, (mtm_json_range){min, max}, numbers)) return false;
    const size_t place = mtm_json_enter(reader, key);
    for (size_t i = 0; i < count; i++) {
        const size_t array = mtm_json_enter_index(reader, i);
        if (numbers[i] != floor(numbers[i]))
            fail_type(reader, NULL, json_array_get(json_object_get(object, key), i), "a whole number");
        else
            result[i] = (int)numbers[i];
        mtm_json_leave(reader, array);
    }
    mtm_json_leave(reader, place);
    return reader->status == MTM_OK;
}

bool mtm_json_boolean(mtm_json_reader *reader, const json_t *object, const char *key, bool *result) {
    const json_t *value = optional(reader, object, key);
    if (value == NULL) return false;
    if (!json_is_boolean(value)) {
        fail_type(reader, key, value, "true or false");
        return false;
    }
    *result = json_is_true(value);
    return true;
}

bool mtm_json_text(mtm_json_reader *reader, const json_t *object, const char *key, const char **result) {
    const json_t *value = optional(reader, object, key);
    if (value == NULL) return false;
    if (!json_is_string(value) || json_string_length(value) == 0) {
        fail_type(reader, key, value, "text in quotes, not empty");
        return false;
    }
    *result = json_string_value(value);
    return true;
}

bool mtm_json_choice(mtm_json_reader *reader, const json_t *object, const char *key, const char *const *names,
                     size_t count, int *result) {
    const json_t *value = optional(reader, object, key);
    if (value == NULL) return false;
    const char *text = json_string_value(value);
    for (size_t i = 0; text != NULL && i < count; i++) {
        if (strcmp(text, names[i]) != 0) continue;
        *result = (int)i;
        return true;
    }
    char expected[256] = "one of";
    for (size_t i = 0; i < count; i++) {
        const size_t length = strlen(expected);
        (void)snprintf(expected + length, sizeof expected - length, "%s \"%s\"", i > 0 ? "," : "", names[i]);
    }
    fail_type(reader, key, value, expected);
    return false;
}

void mtm_json_expect_version(mtm_json_reader *reader, const json_t *document) {
    double version = 1;
    if (mtm_json_number(reader, document, "metamer", mtm_json_any, &version) && version != 1)
        mtm_json_fail(reader, "metamer", "is version %g, this program reads version 1", version);
}

void mtm_json_each(mtm_json_reader *reader, const json_t *object, const char *key, size_t limit,
                   void (*read)(mtm_json_reader *reader, const json_t *element, void *context),
                   void *context) {
    const json_t *list = optional(reader, object, key);
    if (list == NULL) return;
    if (!json_is_array(list)) {
        fail_type(reader, key, list, "an array");
        return;
    }
    if (json_array_size(list) > limit) {
        mtm_json_fail(reader, key, "has %zu elements, at most %zu are allowed", json_array_size(list), limit);
        return;
    }
    const size_t place = mtm_json_enter(reader, key);
    for (size_t i = 0; i < json_array_size(list) && reader->status == MTM_OK; i++) {
        const size_t element = mtm_json_enter_index(reader, i);
        read(reader, json_array_get(list, i), context);
        mtm_json_leave(reader, element);
    }
    mtm_json_leave(reader, place);
}
