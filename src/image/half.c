/* SPDX-License-Identifier: BSD-3-Clause
 * The spectral image in halves. */
#include <stdlib.h>

#include "base/fail.h"
#include "base/half.h"
#include "base/memory.h"
#include "metamer/image.h"

mtm_status mtm_half_image_create(const mtm_image *image, mtm_half_image **half, mtm_error *error) {
    const size_t numbers = (size_t)image->width * (size_t)image->height * (size_t)image->lanes;
    mtm_half_image *created = calloc(1, sizeof *created);
    if (created == NULL) return mtm_fail_memory(error, "an image of halves", sizeof *created);
    *created = (mtm_half_image){
        .width = image->width, .height = image->height, .dimension = image->dimension, .lanes = image->lanes};
    created->pixels = mtm_allocate(numbers, sizeof *created->pixels);
    if (created->pixels == NULL) {
        mtm_half_image_destroy(created);
        return mtm_fail_memory(error, "an image of halves", numbers * sizeof *created->pixels);
    }
    for (size_t i = 0; i < numbers; i++) created->pixels[i] = mtm_half_of_float(image->pixels[i]);
    *half = created;
    return MTM_OK;
}

void mtm_half_image_destroy(mtm_half_image *half) {
    if (half == NULL) return;
    free(half->pixels);
    free(half);
}
