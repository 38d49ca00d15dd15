/* SPDX-License-Identifier: BSD-3-Clause
 * Allocation with checked size arithmetic. */
#ifndef METAMER_BASE_MEMORY_H
#define METAMER_BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

/* product = a * b; false (product untouched) where that overflows. */
bool mtm_size_multiply(size_t a, size_t b, size_t *product);

/* Zeroed memory for `count` items of `size` bytes, aligned to 64 bytes; NULL when out of memory or on overflow.
 * Zero bytes give a valid pointer. Release with free(). */
void *mtm_allocate(size_t count, size_t size);

/* The same but holding anything: for what is large and written at once. */
void *mtm_allocate_unset(size_t count, size_t size);

/* Bytes of memory that this machine has; a guess of 4 GiB where it does not tell. */
size_t mtm_machine_memory(void);

/* A copy of the text for free(); NULL when out of memory. */
char *mtm_text_copy(const char *text);

#endif
