/* SPDX-License-Identifier: BSD-3-Clause
 * Mapping a part of a file. POSIX.1-2008, mmap; MAP_ANONYMOUS is an extension that every system has. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "base/mapping.h"

#include <assert.h>
#include <stdint.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static bool is_in_file(int file, long long offset, size_t byte_count) {
    struct stat state;
    if (fstat(file, &state) != 0 || !S_ISREG(state.st_mode) || state.st_size < offset) return false;
    return (uintmax_t)(state.st_size - offset) >= byte_count;
}

/* The padding may need a page more than the file has, and touching one behind a file's end is SIGBUS. So empty pages
 * are laid out first, one more than needed, and those of the file are put over them. */
bool mtm_mapping_open(FILE *stream, long long offset, size_t byte_count, mtm_mapping *mapping) {
    assert(offset >= 0 && byte_count > 0);
    *mapping = (mtm_mapping){0};
    const int file = fileno(stream);
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    if (file < 0 || byte_count > SIZE_MAX - 3 * page || !is_in_file(file, offset, byte_count)) return false;

    const size_t before = (size_t)offset % page;
    const size_t file_bytes = (before + byte_count + page - 1) / page * page;
    void *pages = mmap(NULL, file_bytes + page, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) return false;
    const off_t first = (off_t)offset - (off_t)before;
    if (mmap(pages, file_bytes, PROT_READ, MAP_PRIVATE | MAP_FIXED, file, first) == MAP_FAILED) {
        (void)munmap(pages, file_bytes + page);
        return false;
    }
    *mapping = (mtm_mapping){(const char *)pages + before, pages, file_bytes + page};
    return true;
}

void mtm_mapping_close(mtm_mapping *mapping) {
    if (mapping->bytes != NULL) (void)munmap(mapping->pages, mapping->page_bytes);
    *mapping = (mtm_mapping){0};
}
