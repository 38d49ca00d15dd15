/* SPDX-License-Identifier: BSD-3-Clause
 * How readers build a volume in place, without a second copy of its voxels. MTM_MAPPING_PADDING bytes behind the last
 * voxel can be read, whatever they are. */
#ifndef METAMER_VOLUME_VOLUME_H
#define METAMER_VOLUME_VOLUME_H

#include "base/mapping.h"
#include "metamer/volume.h"

/* Bytes of the voxels of such a grid. MTM_LIMIT beyond 2^40 bytes; `what` (a file's name) begins the message. */
MTM_CHECK mtm_status mtm_volume_bytes(const int size[3], mtm_voxel_type type, const char *what, size_t *bytes,
                                      mtm_error *error);

/* A volume whose voxels hold anything yet; fill mtm_volume_storage and call mtm_volume_finish, or destroy it.
 * `what` as above. MTM_ARGUMENT for a grid that is not usable, MTM_LIMIT, MTM_MEMORY. */
MTM_CHECK mtm_status mtm_volume_allocate(const mtm_grid *grid, mtm_voxel_type type, const char *what,
                                         mtm_volume **volume, mtm_error *error);
void *mtm_volume_storage(mtm_volume *volume);

/* A volume whose voxels are those of a mapping, complete, aligned and in native byte order, which it then owns; the
 * mapping is closed where this fails, as above. Call mtm_volume_finish, or destroy it. */
MTM_CHECK mtm_status mtm_volume_adopt(const mtm_grid *grid, mtm_voxel_type type, mtm_mapping *mapping,
                                      const char *what, mtm_volume **volume, mtm_error *error);
bool mtm_volume_is_mapped(const mtm_volume *volume);

/* Sets slope (not 0) and intercept and computes the range, after which the voxels do not change any more. */
void mtm_volume_finish(mtm_volume *volume, double slope, double intercept);

#endif
