/* SPDX-License-Identifier: BSD-3-Clause
 * A folder of its own for each test program, which is the current one while the tests run. */
#ifndef METAMER_TEST_SCRATCH_H
#define METAMER_TEST_SCRATCH_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "metamer/volume.h"
#include "test.h"

static inline void scratch_clear(void) {
    DIR *folder = opendir(".");
    assert_non_null(folder);
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder))
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) (void)remove(entry->d_name);
    (void)closedir(folder);
}

static inline int scratch_setup(void **state) {
    char *folder = malloc(32);
    if (folder == NULL) return 1;
    strcpy(folder, "scratch-XXXXXX");
    *state = folder;
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static inline int scratch_teardown(void **state) {
    scratch_clear();
    const int result = chdir("..") != 0 || rmdir(*state) != 0;
    free(*state);
    return result;
}

static inline int scratch_count(void) {
    int count = -2; /* . and .. */
    DIR *folder = opendir(".");
    assert_non_null(folder);
    while (readdir(folder) != NULL) count++;
    (void)closedir(folder);
    return count;
}

static inline void scratch_write(const char *name, const char *text, const void *bytes, size_t byte_count) {
    FILE *stream = fopen(name, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(text, 1, strlen(text), stream), strlen(text));
    if (byte_count > 0) assert_int_equal(fwrite(bytes, 1, byte_count, stream), byte_count);
    assert_int_equal(fclose(stream), 0);
}

/* A small volume of any type whose bytes differ from voxel to voxel, on an oblique grid. */
static inline mtm_volume *scratch_volume(mtm_voxel_type type, const mtm_grid *grid) {
    const size_t count = (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
    const size_t bytes = count * mtm_voxel_type_bytes(type);
    unsigned char *voxels = malloc(bytes);
    assert_non_null(voxels);
    for (size_t n = 0; n < bytes; n++) voxels[n] = (unsigned char)(n * 37 + n / 7);
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_ok(mtm_volume_create(grid, type, voxels, 1.0, 0.0, &volume, &error), error);
    free(voxels);
    return volume;
}

static inline void assert_same_voxels(const mtm_volume *a, const mtm_volume *b) {
    assert_int_equal(mtm_volume_type(a), mtm_volume_type(b));
    assert_int_equal(mtm_volume_voxel_count(a), mtm_volume_voxel_count(b));
    assert_memory_equal(mtm_volume_voxels(a), mtm_volume_voxels(b),
                        mtm_volume_voxel_count(a) * mtm_voxel_type_bytes(mtm_volume_type(a)));
}

#endif
