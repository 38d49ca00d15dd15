/* SPDX-License-Identifier: BSD-3-Clause
 * Basis "wavelengths": every sample of the grid, the reference the others are measured against. */
#include "basis/kind.h"

static int dimension(int asked, int material_count) {
    (void)material_count;
    return asked == 0 || asked == MTM_SPECTRUM_SAMPLES ? MTM_SPECTRUM_SAMPLES : 0;
}

static mtm_status prepare(mtm_basis *basis, mtm_error *error) {
    (void)error;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        basis->encoder[i].value[i] = basis->columns[i].value[i] = 1;
    return MTM_OK;
}

const mtm_basis_kind mtm_basis_wavelengths = {.name = "wavelengths",
                                              .dimensions = "81",
                                              .plain_dimension = MTM_SPECTRUM_SAMPLES,
                                              .dimension = dimension,
                                              .prepare = prepare,
                                              .matrix = mtm_basis_light_columns,
                                              .has_encoder = true,
                                              .has_spectra = true,
                                              .has_products = true};
