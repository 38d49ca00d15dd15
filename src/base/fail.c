/* SPDX-License-Identifier: BSD-3-Clause
 * The one way to report a failure: fill the error, return the status. */
#include "base/fail.h"

#include <stdarg.h>
#include <stdio.h>

mtm_status mtm_fail(mtm_error *error, mtm_status status, const char *format, ...) {
    if (error != NULL) {
        va_list arguments;
        va_start(arguments, format);
        (void)vsnprintf(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
    }
    return status;
}

mtm_status mtm_fail_memory(mtm_error *error, const char *what, size_t bytes) {
    return mtm_fail(error, MTM_MEMORY, "out of memory: %s needs %zu bytes", what, bytes);
}
