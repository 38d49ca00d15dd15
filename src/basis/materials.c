/* SPDX-License-Identifier: BSD-3-Clause
 * Basis "materials": the columns are the scene's own reflectances and white. A pixel is linear in the materials
 * (achromatic opacity, local shading), so this is exact under every light, and reflectances can be replaced after
 * rendering. */
#include <string.h>

#include "basis/kind.h"

static int dimension(int asked, int material_count) {
    return asked == 0 ? material_count + 1 : 0;
}

static mtm_status prepare(mtm_basis *basis, mtm_error *error) {
    (void)error;
    memcpy(basis->columns, basis->reflectances, (size_t)basis->dimension * sizeof *basis->columns);
    return MTM_OK;
}

const mtm_basis_kind mtm_basis_materials = {.name = "materials",
                                            .dimension = dimension,
                                            .prepare = prepare,
                                            .matrix = mtm_basis_light_columns,
                                            .has_spectra = true};
