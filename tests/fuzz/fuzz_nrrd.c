/* SPDX-License-Identifier: BSD-3-Clause
 * Feeds any bytes to the NRRD reader. Build with clang -fsanitize=fuzzer, or with replay_main.c. */
#include <stdint.h>
#include <stdio.h>

#include "volume/nrrd.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size == 0) return 0; /* nothing to open */
    FILE *stream = fmemopen((void *)(uintptr_t)data, size, "rb");
    if (stream == NULL) return 0;
    mtm_volume *volume = NULL;
    mtm_error error = {""};
    const mtm_status status = mtm_nrrd_read(stream, "/nowhere/fuzz.nrrd", &volume, &error);
    (void)fclose(stream);
    if ((status == MTM_OK) != (volume != NULL) || (status == MTM_OK) != (error.message[0] == '\0'))
        __builtin_trap();
    mtm_volume_destroy(volume);
    return 0;
}
