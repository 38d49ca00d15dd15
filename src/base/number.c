/* SPDX-License-Identifier: BSD-3-Clause
 * Numbers as text, the same in every locale: the C library's conversions, run in a thread-local "C" locale. */
#define _POSIX_C_SOURCE 200809L
#include "base/number.h"

#include <ctype.h>
#include <limits.h>
#include <locale.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

/* Switches this thread to the "C" locale; the two handles are what leave_c_locale needs. */
typedef struct locale_switch {
    locale_t plain;
    locale_t previous;
} locale_switch;

static locale_switch enter_c_locale(void) {
    locale_switch change = {.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0)};
    if (change.plain != (locale_t)0) change.previous = uselocale(change.plain);
    return change;
}

static void leave_c_locale(locale_switch change) {
    if (change.plain == (locale_t)0) return;
    (void)uselocale(change.previous);
    freelocale(change.plain);
}

static bool is_blank_to_end(const char *text) {
    while (isspace((unsigned char)*text)) text++;
    return *text == '\0';
}

const char *mtm_number_scan(const char *text, double *value) {
    const locale_switch change = enter_c_locale();
    char *end = NULL;
    const double number = strtod(text, &end);
    leave_c_locale(change);
    if (end == text) return NULL;
    *value = number;
    return end;
}

bool mtm_number_parse(const char *text, double *value) {
    double number = 0;
    const char *end = mtm_number_scan(text, &number);
    if (end == NULL || !is_blank_to_end(end)) return false;
    *value = number;
    return true;
}

bool mtm_integer_parse(const char *text, int *value) {
    char *end = NULL;
    const long number = strtol(text, &end, 10);
    if (end == text || !is_blank_to_end(end) || number < INT_MIN || number > INT_MAX) return false;
    *value = (int)number;
    return true;
}

const char *mtm_number_format(double value, char buffer[MTM_NUMBER_TEXT]) {
    const locale_switch change = enter_c_locale();
    for (int digits = 1; digits <= 17; digits++) {
        (void)snprintf(buffer, MTM_NUMBER_TEXT, "%.*g", digits, value);
        if (strtod(buffer, NULL) == value) break;
    }
    leave_c_locale(change);
    return buffer;
}
