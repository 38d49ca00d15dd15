/* SPDX-License-Identifier: BSD-3-Clause
 * The spectral image: pixels before light, and the texts that let the file stand alone. */
#include "metamer/image.h"

#include <assert.h>
#include <stdlib.h>

#include "base/fail.h"
#include "base/memory.h"

/* A text that may be missing; false only when out of memory. */
static bool copy_text(const char *text, char **copy) {
    if (text == NULL) return true;
    *copy = mtm_text_copy(text);
    return *copy != NULL;
}

mtm_status mtm_image_create(int width, int height, int dimension, const char *basis, const char *palette,
                            const char *scene, mtm_image **image, mtm_error *error) {
    assert(width >= 1 && width <= MTM_IMAGE_EDGE_MAX && height >= 1 && height <= MTM_IMAGE_EDGE_MAX);
    assert(dimension >= 1 && dimension <= MTM_DIMENSION_MAX && basis != NULL);
    const int lanes = mtm_lanes(dimension);
    const size_t floats = (size_t)width * (size_t)height * (size_t)lanes; /* at most 2^30 × 84 */
    mtm_image *created = calloc(1, sizeof *created);
    if (created == NULL) return mtm_fail_memory(error, "an image", sizeof *created);
    *created = (mtm_image){.width = width, .height = height, .dimension = dimension, .lanes = lanes};
    created->pixels = mtm_allocate(floats, sizeof *created->pixels);
    if (created->pixels == NULL || !copy_text(basis, &created->basis) ||
        !copy_text(palette, &created->palette) || !copy_text(scene, &created->scene)) {
        mtm_image_destroy(created);
        return mtm_fail_memory(error, "an image", floats * sizeof *created->pixels);
    }
    *image = created;
    return MTM_OK;
}

void mtm_image_destroy(mtm_image *image) {
    if (image == NULL) return;
    free(image->pixels);
    free(image->basis);
    free(image->palette);
    free(image->scene);
    free(image);
}
