/* SPDX-License-Identifier: BSD-3-Clause
 * Strict reading of JSON documents with errors that name document, key and value, and writing them back so that
 * every number reads back as the same double. On top of jansson. */
#ifndef METAMER_BASE_JSON_H
#define METAMER_BASE_JSON_H

#include <jansson.h>

#include "metamer/base.h"

enum { MTM_JSON_TEXT_MAX = 64 << 20 }; /* bytes of a document */

/* Where in which document the reading is, and the first failure, which sticks: after it every call below does
 * nothing, so that a caller checks `status` once at the end. */
typedef struct mtm_json_reader {
    const char *document; /* file name, for messages */
    mtm_error *error;
    mtm_status status;
    size_t path_length;
    char path[512]; /* "transfer.points[2]" */
} mtm_json_reader;

/* The values a number may take, both ends included. */
typedef struct mtm_json_range {
    double min, max;
} mtm_json_range;

extern const mtm_json_range mtm_json_any;          /* every finite number */
extern const mtm_json_range mtm_json_not_negative; /* 0 and above */
extern const mtm_json_range mtm_json_unit;         /* 0 … 1 */
extern const mtm_json_range mtm_json_amount; /* 0 … 10⁶: an amount of light, far from what floats hold */

/* The text of a document; a file that holds a NUL is none (MTM_FORMAT). Release with free(). */
MTM_CHECK mtm_status mtm_json_read_text(const char *path, char **text, mtm_error *error);

/* Parses text; a key that stands twice is an error. Release with json_decref. MTM_FORMAT names document and line. */
MTM_CHECK mtm_status mtm_json_parse(const char *document, const char *text, size_t byte_count, json_t **value,
                                    mtm_error *error);

mtm_json_reader mtm_json_begin(const char *document, mtm_error *error);

/* Fails at `key` of the present place (NULL: the place itself) with a sentence that follows its name. */
__attribute__((format(printf, 3, 4))) void mtm_json_fail(mtm_json_reader *reader, const char *key,
                                                         const char *format, ...);

/* Fails because `name` is no `kind` ("material"); `nearest` is the known name most like it, "" where none is known. */
void mtm_json_fail_name(mtm_json_reader *reader, const char *key, const char *name, const char *kind,
                        const char *nearest);

/* Steps into a key or an element, and back out. */
size_t mtm_json_enter(mtm_json_reader *reader, const char *key);
size_t mtm_json_enter_index(mtm_json_reader *reader, size_t index);
void mtm_json_leave(mtm_json_reader *reader, size_t previous);

/* True where `value` is an object with no other than the `count` known keys. */
bool mtm_json_expect_object(mtm_json_reader *reader, const json_t *value, const char *const *keys,
                            size_t count);

/* Fails where the key "metamer" is there and not 1, the version of every document. */
void mtm_json_expect_version(mtm_json_reader *reader, const json_t *document);

/* Calls `read` on each element of the array at `key`, with the reader's place there, until one fails. A missing array has
 * no elements; one of more than `limit` is refused. */
void mtm_json_each(mtm_json_reader *reader, const json_t *object, const char *key, size_t limit,
                   void (*read)(mtm_json_reader *reader, const json_t *element, void *context),
                   void *context);

/* The value of a key that must be there; NULL after a failure. */
json_t *mtm_json_required(mtm_json_reader *reader, const json_t *object, const char *key);

/* Optional keys: true where the key is there and good, *result untouched otherwise. Text stays the document's. */
bool mtm_json_number(mtm_json_reader *reader, const json_t *object, const char *key, mtm_json_range range,
                     double *result);
bool mtm_json_numbers(mtm_json_reader *reader, const json_t *object, const char *key, size_t count,
                      mtm_json_range range, double *result);
/* The same for whole numbers. */
bool mtm_json_integers(mtm_json_reader *reader, const json_t *object, const char *key, size_t count, int min,
                       int max, int *result);
bool mtm_json_boolean(mtm_json_reader *reader, const json_t *object, const char *key, bool *result);
bool mtm_json_text(mtm_json_reader *reader, const json_t *object, const char *key, const char **result);
bool mtm_json_choice(mtm_json_reader *reader, const json_t *object, const char *key, const char *const *names,
                     size_t count, int *result);

/* Whether a document can hold the first `byte_count` bytes of the text: they are UTF-8. */
bool mtm_json_can_hold(const char *text, size_t byte_count);

/* As many first bytes of the text as a document can hold, at most `byte_max`; 0 where its beginning is not UTF-8. */
size_t mtm_json_prefix(const char *text, size_t byte_max);

/* A value for a message, at most about 60 characters: `"cubic"`, `[1,2]`. */
const char *mtm_json_preview(const json_t *value, char buffer[64]);

/* Text of a document, keys in the order they were set, numbers as short as they read back exactly; indented by two
 * spaces where `is_indented`, arrays of numbers always on one line. Release with free(); NULL when out of memory. */
char *mtm_json_format(const json_t *value, bool is_indented);

#endif
