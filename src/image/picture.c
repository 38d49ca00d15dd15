/* SPDX-License-Identifier: BSD-3-Clause
 * The picture: linear sRGB and alpha after light. */
#include <assert.h>
#include <stdlib.h>

#include "base/fail.h"
#include "base/memory.h"
#include "metamer/image.h"

mtm_status mtm_picture_create(int width, int height, mtm_picture **picture, mtm_error *error) {
    assert(width >= 1 && width <= MTM_IMAGE_EDGE_MAX && height >= 1 && height <= MTM_IMAGE_EDGE_MAX);
    const size_t floats = (size_t)width * (size_t)height * 4;
    mtm_picture *created = calloc(1, sizeof *created);
    if (created == NULL) return mtm_fail_memory(error, "a picture", sizeof *created);
    *created = (mtm_picture){.width = width, .height = height};
    created->rgba = mtm_allocate(floats, sizeof *created->rgba);
    if (created->rgba == NULL) {
        mtm_picture_destroy(created);
        return mtm_fail_memory(error, "a picture", floats * sizeof *created->rgba);
    }
    *picture = created;
    return MTM_OK;
}

void mtm_picture_destroy(mtm_picture *picture) {
    if (picture == NULL) return;
    free(picture->rgba);
    free(picture);
}
