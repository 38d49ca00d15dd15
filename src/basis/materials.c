/* SPDX-License-Identifier: BSD-3-Clause
 * Basis "materials": the columns are the scene's own reflectances and white. A pixel is linear in the materials
 * (achromatic opacity, local shading), so this is exact under every light, and reflectances can be replaced after
 * rendering. */
#include <string.h>

#include "basis/kind.h"

static int dimension(int material_count) {
    return material_count + 1;
}

static void encode(const mtm_basis *basis, int material, float *coefficients) {
    memset(coefficients, 0, (size_t)basis->dimension * sizeof *coefficients);
    coefficients[material] = 1;
}

static mtm_spectrum column(const mtm_basis *basis, int column) {
    return basis->reflectances[column];
}

const mtm_basis_kind mtm_basis_materials = {.name = "materials",
                                            .dimension = dimension,
                                            .encode = encode,
                                            .column = column,
                                            .matrix = mtm_basis_light_columns};
