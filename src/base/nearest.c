/* SPDX-License-Identifier: BSD-3-Clause
 * "Did you mean …?": V. I. Levenshtein's edit distance (Soviet Physics Doklady 10, 1966), one row at a time. */
#include "base/nearest.h"

#include <assert.h>
#include <ctype.h>
#include <limits.h>
#include <string.h>
#include <strings.h>

enum { LENGTH_LIMIT = 63 };

static int min_of(int a, int b) {
    return a < b ? a : b;
}

static int clipped_length(const char *text) {
    const size_t length = strlen(text);
    return length < LENGTH_LIMIT ? (int)length : LENGTH_LIMIT;
}

int mtm_edit_distance(const char *a, const char *b) {
    const int a_length = clipped_length(a);
    const int b_length = clipped_length(b);
    int row[LENGTH_LIMIT + 1];
    for (int j = 0; j <= b_length; j++) row[j] = j;
    for (int i = 1; i <= a_length; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= b_length; j++) {
            const int is_different = tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]);
            const int replaced = diagonal + is_different;
            diagonal = row[j];
            row[j] = min_of(replaced, min_of(row[j], row[j - 1]) + 1);
        }
    }
    return row[b_length];
}

/* A name that was cut short is nearer to the whole than its missing letters say. */
static int name_distance(const char *name, const char *known) {
    const size_t length = strlen(name);
    return length >= 3 && strncasecmp(name, known, length) == 0 ? 1 : mtm_edit_distance(name, known);
}

const char *mtm_nearest_name(const char *name, const char *const *names, size_t count) {
    assert(count >= 1);
    const char *nearest = names[0];
    int nearest_distance = INT_MAX;
    for (size_t i = 0; i < count; i++) {
        const int distance = name_distance(name, names[i]);
        if (distance >= nearest_distance) continue;
        nearest = names[i];
        nearest_distance = distance;
    }
    return nearest;
}
