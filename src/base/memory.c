/* SPDX-License-Identifier: BSD-3-Clause
 * Allocation with checked size arithmetic. */
#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "metamer/base.h"

enum { ALIGNMENT = 64 };

bool mtm_size_multiply(size_t a, size_t b, size_t *product) {
    if (b != 0 && a > SIZE_MAX / b) return false;
    *product = a * b;
    return true;
}

/* Rounded up to at least one cache line, also for zero bytes. */
static void *allocate(size_t count, size_t size, size_t *bytes) {
    void *memory = NULL;
    if (!mtm_size_multiply(count, size, bytes) || *bytes > SIZE_MAX - ALIGNMENT) return NULL;
    *bytes = (*bytes + ALIGNMENT) / ALIGNMENT * ALIGNMENT;
    return posix_memalign(&memory, ALIGNMENT, *bytes) == 0 ? memory : NULL;
}

void *mtm_allocate(size_t count, size_t size) {
    size_t bytes = 0;
    void *memory = allocate(count, size, &bytes);
    if (memory != NULL) memset(memory, 0, bytes);
    return memory;
}

void *mtm_allocate_unset(size_t count, size_t size) {
    size_t bytes = 0;
    return allocate(count, size, &bytes);
}

size_t mtm_machine_memory(void) {
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_bytes = sysconf(_SC_PAGESIZE);
    if (pages > 0 && page_bytes > 0) return (size_t)pages * (size_t)page_bytes;
#endif
    return (size_t)1 << 32;
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
