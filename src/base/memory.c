/* SPDX-License-Identifier: BSD-3-Clause
 * Allocation with checked size arithmetic. */
#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "metamer/base.h"

enum { ALIGNMENT = 64 };

bool mtm_size_multiply(size_t a, size_t b, size_t *product) {
    if (b != 0 && a > SIZE_MAX / b) return false;
    *product = a * b;
    return true;
}

void *mtm_allocate(size_t count, size_t size) {
    size_t bytes = 0;
    if (!mtm_size_multiply(count, size, &bytes) || bytes > SIZE_MAX - ALIGNMENT) return NULL;
    bytes = (bytes + ALIGNMENT) / ALIGNMENT * ALIGNMENT; /* at least one cache line, also for zero bytes */
    void *memory = NULL;
    if (posix_memalign(&memory, ALIGNMENT, bytes) != 0) return NULL;
    memset(memory, 0, bytes);
    return memory;
}

char *mtm_text_copy(const char *text) {
    const size_t bytes = strlen(text) + 1;
    char *copy = malloc(bytes);
    if (copy != NULL) memcpy(copy, text, bytes);
    return copy;
}

void mtm_text_free(char *text) {
    free(text);
}
