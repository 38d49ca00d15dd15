/* SPDX-License-Identifier: BSD-3-Clause
 * Runs tests under a locale that writes 0,5 for one half. */
#ifndef METAMER_TEST_COMMA_LOCALE_H
#define METAMER_TEST_COMMA_LOCALE_H

#include "test.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

/* Takes an installed locale, else the one that the build made of tests/comma.locale. Prints why where it returns false. */
static inline bool enter_comma_locale(void) {
    static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "comma"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(names[i], "comma") == 0) (void)setenv("LOCPATH", METAMER_TEST_LOCALES, 1);
        if (setlocale(LC_ALL, names[i]) == NULL && setlocale(LC_NUMERIC, names[i]) == NULL) continue;
        if (strcmp(localeconv()->decimal_point, ",") == 0) return true;
        (void)setlocale(LC_ALL, "C");
    }
    print_message("skipped: no locale with decimal commas is installed, and localedef made none\n");
    return false;
}

static inline void leave_comma_locale(void) {
    (void)setlocale(LC_ALL, "C");
}

/* The group once more under such a locale; the result is to be added to the first run's. */
#define run_group_in_comma_locale(tests)                                                                     \
    (enter_comma_locale() ? cmocka_run_group_tests_name("tests with decimal commas", (tests), NULL, NULL) : 0)

#endif
