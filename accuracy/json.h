/* SPDX-License-Identifier: BSD-3-Clause
 * The measured numbers as JSON, for tests and other programs. */
#ifndef METAMER_ACCURACY_JSON_H
#define METAMER_ACCURACY_JSON_H

#include "measure.h"

/* Writes all errors, no times: the same numbers for every run, number of threads and compiler. Errors: those of output.h. */
MTM_CHECK mtm_status json_write(const measurements *made, const char *path, mtm_error *error);

#endif
