/* SPDX-License-Identifier: BSD-3-Clause
 * A layout derived from a volume of 8- or 16-bit voxels: every voxel with its gradient beside it, so that one load
 * fetches what a shaded sample needs. Four times the memory of the volume. */
#ifndef METAMER_VOLUME_PACKED_H
#define METAMER_VOLUME_PACKED_H

#include "metamer/volume.h"

/* A voxel is its value and the three world components of its gradient: 4 × uint8_t, or 4 × int16_t. Value is
 * stored - value_base. A component is gradient · gradient_scale + gradient_bias, rounded and kept in range, where the
 * gradient is that of stored values per world unit, by central differences (one-sided at the faces). */
typedef struct mtm_packed {
    int voxel_bytes; /* 4 or 8; 0: none */
    void *voxels;    /* x fastest, as in the volume */
    double value_base;
    double gradient_scale;
    int gradient_bias;
} mtm_packed;

/* Whether volumes of this type and size can be packed at all, and in how many bytes. */
bool mtm_packed_is_possible(const mtm_volume *volume);
size_t mtm_packed_bytes(const mtm_volume *volume);

/* Release with mtm_packed_free. Precondition: it is possible. MTM_MEMORY, MTM_CANCELLED. */
MTM_CHECK mtm_status mtm_packed_create(const mtm_volume *volume, int thread_count,
                                       const mtm_progress *progress, mtm_packed *packed, mtm_error *error);
void mtm_packed_free(mtm_packed *packed);

#endif
