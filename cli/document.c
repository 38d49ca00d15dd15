/* SPDX-License-Identifier: BSD-3-Clause
 * What the subcommands say as JSON. */
#include "document.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

json_t *make_text(const char *text) {
    json_t *value = json_string(text);
    char *plain = value == NULL ? strdup(text) : NULL;
    for (char *byte = plain; byte != NULL && *byte != '\0'; byte++)
        if ((unsigned char)*byte >= 0x80) *byte = '?';
    if (plain != NULL) value = json_string(plain);
    free(plain);
    return value;
}

json_t *make_numbers(int count, const double *values) {
    json_t *array = json_array();
    for (int i = 0; i < count; i++) {
        if (json_array_append_new(array, json_real(values[i])) == 0) continue;
        json_decref(array);
        return NULL;
    }
    return array;
}

void print_document(const json_t *document) {
    (void)json_dumpf(document, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(15));
    (void)printf("\n");
}
