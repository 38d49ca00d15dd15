/* SPDX-License-Identifier: BSD-3-Clause
 * Failing with one sentence. */
#include "fail.h"

#include <stdarg.h>
#include <stdio.h>

mtm_status fail(mtm_error *error, mtm_status status, const char *format, ...) {
    if (error == NULL) return status;
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    return status;
}

mtm_status fail_memory(mtm_error *error, const char *what) {
    return fail(error, MTM_MEMORY, "%s: out of memory", what);
}
