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

static mtm_spectrum column(const mtm_basis *basis, int column) {
    (void)basis;
    mtm_spectrum line = mtm_spectrum_constant(0);
    line.value[column] = 1;
    return line;
}

const mtm_basis_kind mtm_basis_wavelengths = {.name = "wavelengths",
                                              .dimension = dimension,
                                              .encode = encode,
                                              .column = column,
                                              .matrix = mtm_basis_light_columns};
