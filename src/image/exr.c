/* SPDX-License-Identifier: BSD-3-Clause
 * What the OpenEXR writer and reader share. */
#include "image/exr.h"

#include "base/fail.h"

void mtm_exr_stay_silent(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context;
    (void)code;
    (void)message;
}

static mtm_status status_of(exr_result_t result) {
    switch (result) {
    case EXR_ERR_OUT_OF_MEMORY: return MTM_MEMORY;
    case EXR_ERR_FILE_ACCESS: return MTM_IO;
    default: return MTM_FORMAT; /* EXR_ERR_READ_IO too: a file that ends too early */
    }
}

mtm_status mtm_exr_fail(mtm_error *error, exr_result_t result, const char *path, const char *what) {
    return mtm_fail(error, status_of(result), "%s: %s: %s", path, what,
                    exr_get_default_error_message(result));
}
