/* SPDX-License-Identifier: BSD-3-Clause
 * Scalar volumes on a regular, possibly sheared grid, in their own voxel type; reading and writing them. */
#ifndef METAMER_VOLUME_H
#define METAMER_VOLUME_H

#include "metamer/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mtm_voxel_type {
    MTM_VOXEL_INT8,
    MTM_VOXEL_UINT8,
    MTM_VOXEL_INT16,
    MTM_VOXEL_UINT16,
    MTM_VOXEL_INT32,
    MTM_VOXEL_UINT32,
    MTM_VOXEL_INT64,
    MTM_VOXEL_UINT64,
    MTM_VOXEL_FLOAT32,
    MTM_VOXEL_FLOAT64,
    MTM_VOXEL_TYPE_COUNT,
} mtm_voxel_type;

/* Where voxels are. World units are the file's own (mm in medical files, then in LPS). */
typedef struct mtm_grid {
    int size[3]; /* voxels along each axis, ≥ 1, x fastest in memory */
    /* axes[a]: world vector from a voxel to its neighbour along axis a, linearly independent */
    double axes[3][3];
    double origin[3]; /* world position of the center of voxel (0, 0, 0) */
    bool is_oriented; /* the axes are anatomical (LPS), not just "as stored" */
    char unit[16];    /* "mm", or "" where the file does not say */
} mtm_grid;

typedef struct mtm_volume mtm_volume;

/* A grid with spacing 1, origin 0 and no orientation. */
MTM_API mtm_grid mtm_grid_defaults(int size_x, int size_y, int size_z);

/* Length of axis `axis` in world units, and the smallest of the three. */
MTM_API double mtm_grid_spacing(const mtm_grid *grid, int axis);
MTM_API double mtm_grid_smallest_spacing(const mtm_grid *grid);

/* World position of a point in voxel coordinates, and back. */
MTM_API void mtm_grid_to_world(const mtm_grid *grid, const double voxel[3], double world[3]);
MTM_API void mtm_grid_to_voxel(const mtm_grid *grid, const double world[3], double voxel[3]);

/* The rows of the matrix that mtm_grid_to_voxel applies to (world - origin). */
MTM_API void mtm_grid_inverse_axes(const mtm_grid *grid, double inverse[3][3]);

MTM_API size_t mtm_voxel_type_bytes(mtm_voxel_type type);
MTM_API const char *mtm_voxel_type_name(mtm_voxel_type type); /* "uint8" … "float64" */

/* Makes a volume of a copy of size[0]·size[1]·size[2] voxels (NULL: zeros) in native byte order. The physical
 * value of a stored voxel v is slope·v + intercept, slope ≠ 0. MTM_ARGUMENT for a grid that is not usable,
 * MTM_LIMIT beyond 2^40 bytes, MTM_MEMORY. Release with mtm_volume_destroy (NULL allowed). */
MTM_API MTM_CHECK mtm_status mtm_volume_create(const mtm_grid *grid, mtm_voxel_type type, const void *voxels,
                                               double slope, double intercept, mtm_volume **volume,
                                               mtm_error *error);
MTM_API void mtm_volume_destroy(mtm_volume *volume);

MTM_API const mtm_grid *mtm_volume_grid(const mtm_volume *volume);
MTM_API mtm_voxel_type mtm_volume_type(const mtm_volume *volume);
MTM_API size_t mtm_volume_voxel_count(const mtm_volume *volume);
MTM_API const void *mtm_volume_voxels(const mtm_volume *volume);
MTM_API double mtm_volume_slope(const mtm_volume *volume);
MTM_API double mtm_volume_intercept(const mtm_volume *volume);

/* Physical value of one voxel; the index lies in the grid. */
MTM_API double mtm_volume_value(const mtm_volume *volume, int i, int j, int k);

/* Smallest and largest physical value of the finite voxels; 0 and 0 where there are none. Renderers read voxels
 * that are not numbers as the smallest value. */
MTM_API void mtm_volume_range(const mtm_volume *volume, double *smallest, double *largest);

/* Counts voxels in `bin_count` equal bins over the range above (the largest value falls in the last bin; voxels
 * that are not finite are left out). */
MTM_API void mtm_volume_histogram(const mtm_volume *volume, int bin_count, uint64_t *counts);

/* SHA-256 of the stored voxels, little-endian, x fastest, as 64 lower-case hexadecimal digits and a 0. The same
 * for a file however it was compressed. Empty text where memory for the computation is missing. */
MTM_API void mtm_volume_sha256(const mtm_volume *volume, char hex[65]);

/* Reads any volume format this library knows, recognised by content, not by name: NRRD (attached or detached,
 * raw or gzip, NRRD0001 … NRRD0005). Errors name file and field: MTM_IO, MTM_FORMAT, MTM_LIMIT, MTM_MEMORY.
 * Raw voxels in one file, in the machine's byte order and at a multiple of their size, are mapped, not read: they
 * take page cache instead of memory. That file must not be changed until mtm_volume_destroy (renaming, removing or
 * replacing it is no change); after it became shorter, reading voxels raises SIGBUS, as POSIX has it for mmap. */
MTM_API MTM_CHECK mtm_status mtm_volume_read(const char *path, mtm_volume **volume, mtm_error *error);

typedef struct mtm_volume_write_options {
    bool is_gzip;       /* default true; false writes raw voxels */
    bool is_big_endian; /* default false */
} mtm_volume_write_options;

MTM_API mtm_volume_write_options mtm_volume_write_defaults(void);

/* Writes NRRD: attached for a path that ends in .nrrd, a header beside a data file (path's name with .raw or
 * .raw.gz) for one that ends in .nhdr. MTM_ARGUMENT for another ending and for a volume whose slope and intercept
 * are not 1 and 0, which NRRD cannot state; MTM_IO. Nothing is left behind on failure. */
MTM_API MTM_CHECK mtm_status mtm_volume_write(const mtm_volume *volume, const char *path,
                                              const mtm_volume_write_options *options, mtm_error *error);

#ifdef __cplusplus
}
#endif
#endif
