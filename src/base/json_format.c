/* SPDX-License-Identifier: BSD-3-Clause
 * JSON text whose numbers are as short as they read back exactly (jansson prints 0.1 with 17 digits or loses bits). */
#include "base/json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"

typedef struct json_text {
    char *bytes; /* NULL after running out of memory */
    size_t length, capacity;
    bool is_indented;
} json_text;

static void append(json_text *text, const char *piece) {
    if (text->bytes == NULL) return;
    const size_t length = strlen(piece);
    if (text->length + length + 1 > text->capacity) {
        text->capacity = 2 * text->capacity + length + 1;
        char *larger = realloc(text->bytes, text->capacity);
        if (larger == NULL) free(text->bytes);
        text->bytes = larger;
        if (larger == NULL) return;
    }
    memcpy(text->bytes + text->length, piece, length + 1);
    text->length += length;
}

static void append_line(json_text *text, int depth, bool is_broken) {
    if (!is_broken) return;
    append(text, "\n");
    for (int i = 0; i < depth; i++) append(text, "  ");
}

static void append_scalar(json_text *text, const json_t *value) {
    char number[MTM_NUMBER_TEXT];
    if (json_is_real(value)) {
        append(text, mtm_number_format(json_real_value(value), number));
        return;
    }
    char *scalar = json_dumps(value, JSON_ENCODE_ANY);
    if (scalar == NULL) { /* out of memory: no text is better than one that says something else */
        free(text->bytes);
        text->bytes = NULL;
        return;
    }
    append(text, scalar);
    free(scalar);
}

static bool has_only_numbers(const json_t *array) {
    for (size_t i = 0; i < json_array_size(array); i++)
        if (!json_is_number(json_array_get(array, i))) return false;
    return true;
}

static void append_value(json_text *text, const json_t *value, int depth);

static void append_array(json_text *text, const json_t *array, int depth) {
    const bool is_broken = text->is_indented && !has_only_numbers(array);
    append(text, "[");
    for (size_t i = 0; i < json_array_size(array); i++) {
        if (i > 0) append(text, text->is_indented && !is_broken ? ", " : ",");
        append_line(text, depth + 1, is_broken);
        append_value(text, json_array_get(array, i), depth + 1);
    }
    append_line(text, depth, is_broken && json_array_size(array) > 0);
    append(text, "]");
}

static void append_object(json_text *text, const json_t *object, int depth) {
    const bool is_broken = text->is_indented && json_object_size(object) > 0;
    const char *key = NULL;
    json_t *member = NULL;
    bool is_first = true;
    append(text, "{");
    json_object_foreach((json_t *)object, key, member) {
        if (!is_first) append(text, ",");
        is_first = false;
        append_line(text, depth + 1, is_broken);
        json_t *name = json_string(key);
        append_scalar(text, name);
        json_decref(name);
        append(text, text->is_indented ? ": " : ":");
        append_value(text, member, depth + 1);
    }
    append_line(text, depth, is_broken);
    append(text, "}");
}

/* Depth is bounded by the documents this library makes itself, a handful of levels. */
static void append_value(json_text *text, const json_t *value, int depth) {
    if (json_is_array(value))
        append_array(text, value, depth);
    else if (json_is_object(value))
        append_object(text, value, depth);
    else
        append_scalar(text, value);
}

char *mtm_json_format(const json_t *value, bool is_indented) {
    json_text text = {.capacity = 4096, .is_indented = is_indented};
    text.bytes = malloc(text.capacity);
    if (text.bytes != NULL) text.bytes[0] = '\0';
    append_value(&text, value, 0);
    if (is_indented) append(&text, "\n");
    return text.bytes;
}
