/* SPDX-License-Identifier: BSD-3-Clause
 * Fuzz target: the bytes are an OpenEXR file. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "image/exr.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    FILE *stream = fmemopen((void *)data, size, "rb");
    if (stream == NULL) return 0; /* no bytes */
    mtm_error error;
    mtm_image *image = NULL;
    if (mtm_image_read_stream(stream, "fuzz.exr", &image, &error) == MTM_OK) mtm_image_destroy(image);
    (void)fclose(stream);
    return 0;
}
