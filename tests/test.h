/* SPDX-License-Identifier: BSD-3-Clause
 * What every test includes: cmocka with the headers it wants first, and the assertions for our own errors. */
#ifndef METAMER_TEST_H
#define METAMER_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "metamer/base.h"

/* The call succeeded; else its message is printed. */
#define assert_ok(call, error)                                                                               \
    do {                                                                                                     \
        if ((call) != MTM_OK) fail_msg("%s: %s", #call, (error).message);                                    \
    } while (0)

/* The call failed with this status and its message contains the text (a file, a field, a value). */
#define assert_fails(call, expected_status, error, text)                                                     \
    do {                                                                                                     \
        (error).message[0] = '\0';                                                                           \
        assert_int_equal((call), (expected_status));                                                         \
        if (strstr((error).message, (text)) == NULL)                                                         \
            fail_msg("%s: message '%s' does not contain '%s'", #call, (error).message, (text));              \
    } while (0)

#endif
