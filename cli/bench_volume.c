/* SPDX-License-Identifier: BSD-3-Clause
 * The volumes that speed is measured on. */
#include "bench_volume.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_BYTES = 4096 };

/* The first of the folders of METAMER_DATA that has the file. */
static bool find_in_data(const char *file, char path[PATH_BYTES]) {
    const char *folders = getenv("METAMER_DATA");
    while (folders != NULL && *folders != '\0') {
        const size_t length = strcspn(folders, ":");
        const int size = snprintf(path, PATH_BYTES, "%.*s/%s", (int)length, folders, file);
        if (length > 0 && size < PATH_BYTES && access(path, R_OK) == 0) return true;
        folders += length + (folders[length] == ':');
    }
    return false;
}

static bool find_in_examples(const char *file, char path[PATH_BYTES]) {
    glob_t found = {.gl_pathc = 0};
    (void)snprintf(path, PATH_BYTES, "examples/*/%s", file);
    const bool is_found = glob(path, 0, NULL, &found) == 0;
    if (is_found) (void)snprintf(path, PATH_BYTES, "%s", found.gl_pathv[0]);
    globfree(&found);
    return is_found;
}

/* The same voxels with spacing 1. */
static mtm_status take_unit_spacing(const mtm_volume *read, mtm_volume **volume, mtm_error *error) {
    const int *size = mtm_volume_grid(read)->size;
    const mtm_grid grid = mtm_grid_defaults(size[0], size[1], size[2]);
    return mtm_volume_create(&grid, mtm_volume_type(read), mtm_volume_voxels(read), mtm_volume_slope(read),
                             mtm_volume_intercept(read), volume, error);
}

mtm_status find_volume(const char *file, mtm_volume **volume, mtm_error *error) {
    char path[PATH_BYTES];
    mtm_volume *read = NULL;
    *volume = NULL;
    if (!find_in_data(file, path) && !find_in_examples(file, path)) {
        (void)fprintf(
            stderr,
            "metamer bench: note: %s is in no folder of METAMER_DATA and not in examples/*/, so its "
            "rows stay empty\n",
            file);
        return MTM_OK;
    }
    mtm_status status = mtm_volume_read(path, &read, error);
    if (status == MTM_OK && mtm_volume_type(read) != MTM_VOXEL_UINT8)
        (void)fprintf(stderr,
                      "metamer bench: note: the voxels of %s are %s, not uint8, so its rows stay empty\n",
                      file, mtm_voxel_type_name(mtm_volume_type(read)));
    else if (status == MTM_OK)
        status = take_unit_spacing(read, volume, error);
    mtm_volume_destroy(read);
    return status;
}

/* Eq. 5, 0 … 1. */
static double marschner_lobb(double x, double y, double z) {
    static const double pi = 3.14159265358979323846;
    static const double frequency = 6;
    static const double alpha = 0.25;
    const double ripple = cos(2 * pi * frequency * cos(0.5 * pi * sqrt(x * x + y * y)));
    return (1 - sin(0.5 * pi * z) + alpha * (1 + ripple)) / (2 * (1 + alpha));
}

mtm_status make_marschner_lobb(int edge, mtm_volume **volume, mtm_error *error) {
    const mtm_grid grid = mtm_grid_defaults(edge, edge, edge);
    unsigned char *voxels = malloc((size_t)edge * (size_t)edge * (size_t)edge);
    if (voxels == NULL) {
        (void)snprintf(error->message, sizeof error->message, "out of memory for %d^3 voxels", edge);
        return MTM_MEMORY;
    }
    const double scale = 2.0 / (edge - 1);
    unsigned char *voxel = voxels;
    for (int k = 0; k < edge; k++)
        for (int j = 0; j < edge; j++)
            for (int i = 0; i < edge; i++)
                *voxel++ =
                    (unsigned char)lround(255 * marschner_lobb(i * scale - 1, j * scale - 1, k * scale - 1));
    const mtm_status status = mtm_volume_create(&grid, MTM_VOXEL_UINT8, voxels, 1, 0, volume, error);
    free(voxels);
    return status;
}
