/* SPDX-License-Identifier: BSD-3-Clause
 * Basis "wavelengths": every sample of the grid, the reference the others are measured against. */
#include "basis/kind.h"

static int dimension(int material_count) {
    (void)material_count;
    return MTM_SPECTRUM_SAMPLES;
}

static void encode(const mtm_basis *basis, int material, float *coefficients) {
    const mtm_spectrum *reflectance = &basis->reflectances[material];
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) coefficients[i] = (float)reflectance->value[i];
}

static mtm_status matrix(const mtm_basis *basis, const mtm_illumination *illumination, double *matrix,
                         mtm_error *error) {
    (void)error;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        mtm_spectrum line = mtm_spectrum_constant(0);
        line.value[i] = 1;
        mtm_basis_set_column(matrix, basis->dimension, i, mtm_illuminate(illumination, &line));
    }
    return MTM_OK;
}

const mtm_basis_kind mtm_basis_wavelengths = {
    .name = "wavelengths", .dimension = dimension, .encode = encode, .matrix = matrix};
