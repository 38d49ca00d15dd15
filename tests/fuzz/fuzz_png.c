/* SPDX-License-Identifier: BSD-3-Clause
 * Fuzz target: the bytes are a PNG file. */
#define _POSIX_C_SOURCE 200809L
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "image/png.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    FILE *stream = fmemopen((void *)data, size, "rb");
    if (stream == NULL) return 0; /* no bytes */
    mtm_error error;
    mtm_picture *picture = NULL;
    char *scene = NULL;
    if (mtm_png_read_stream(stream, "fuzz.png", &picture, &scene, &error) == MTM_OK) {
        mtm_picture_destroy(picture);
        mtm_text_free(scene);
    }
    (void)fclose(stream);
    return 0;
}
