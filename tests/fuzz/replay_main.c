/* SPDX-License-Identifier: BSD-3-Clause
 * Runs a fuzz target once on each file named on the command line, with any compiler. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { INPUT_LIMIT = 1 << 24 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int replay(const char *path) {
    FILE *stream = fopen(path, "rb");
    uint8_t *data = malloc(INPUT_LIMIT);
    const size_t size = stream == NULL || data == NULL ? 0 : fread(data, 1, INPUT_LIMIT, stream);
    const int result = size == 0 ? 1 : LLVMFuzzerTestOneInput(data, size);
    if (size == 0) (void)fprintf(stderr, "%s: cannot be read\n", path);
    if (stream != NULL) (void)fclose(stream);
    free(data);
    return result;
}

int main(int argument_count, char **arguments) {
    int result = argument_count < 2;
    for (int i = 1; i < argument_count; i++) result |= replay(arguments[i]);
    return result;
}
