/* SPDX-License-Identifier: BSD-3-Clause
 * The one way to report a failure: fill the error, return the status. */
#ifndef METAMER_BASE_FAIL_H
#define METAMER_BASE_FAIL_H

#include "metamer/base.h"

/* Formats the message (printf form) into `error`, which may be NULL, and returns `status`. */
__attribute__((format(printf, 3, 4))) mtm_status mtm_fail(mtm_error *error, mtm_status status,
                                                          const char *format, ...);

/* The usual message for an allocation of `bytes` bytes for `what` that failed. */
mtm_status mtm_fail_memory(mtm_error *error, const char *what, size_t bytes);

#endif
