/* SPDX-License-Identifier: BSD-3-Clause
 * Failing with one sentence, as the library does. */
#ifndef METAMER_ACCURACY_FAIL_H
#define METAMER_ACCURACY_FAIL_H

#include "metamer/base.h"

/* Fills `error` (NULL is allowed) with the sentence and returns `status`. */
__attribute__((format(printf, 3, 4))) mtm_status fail(mtm_error *error, mtm_status status, const char *format,
                                                      ...);

mtm_status fail_memory(mtm_error *error, const char *what);

#endif
