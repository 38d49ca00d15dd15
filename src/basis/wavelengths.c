/* SPDX-License-Identifier: BSD-3-Clause
 * Basis "wavelengths": every sample of the grid, the reference the others are measured against; or the 31 samples of
 * 400, 410 … 700 nm that renderers with plain wavelengths use (paper footnote 1), read as a piecewise-linear curve with
 * its ends held, so that the light is integrated and not sampled. */
#include "basis/kind.h"

enum { COARSE_SAMPLES = 31, COARSE_FIRST = 4 /* 400 nm */, COARSE_STEP = 2 /* 10 nm */ };

static int dimension(int asked, int material_count) {
    (void)material_count;
    if (asked == 0 || asked == MTM_SPECTRUM_SAMPLES) return MTM_SPECTRUM_SAMPLES;
    return asked == COARSE_SAMPLES ? COARSE_SAMPLES : 0;
}

/* Hat functions: a wavelength of the grid is a mix of the two coarse samples beside it. */
static void prepare_coarse(mtm_basis *basis) {
    for (int i = 0; i < COARSE_SAMPLES; i++) basis->encoder[i].value[COARSE_FIRST + COARSE_STEP * i] = 1;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        const double place = (double)(i - COARSE_FIRST) / COARSE_STEP;
        if (place <= 0) {
            basis->columns[0].value[i] = 1;
        } else if (place >= COARSE_SAMPLES - 1) {
            basis->columns[COARSE_SAMPLES - 1].value[i] = 1;
        } else {
            const int left = (int)place;
            basis->columns[left].value[i] = 1 - (place - left);
            basis->columns[left + 1].value[i] = place - left;
        }
    }
}

static mtm_status prepare(mtm_basis *basis, mtm_error *error) {
    (void)error;
    if (basis->dimension == COARSE_SAMPLES) {
        prepare_coarse(basis);
        return MTM_OK;
    }
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        basis->encoder[i].value[i] = basis->columns[i].value[i] = 1;
    return MTM_OK;
}

const mtm_basis_kind mtm_basis_wavelengths = {.name = "wavelengths",
                                              .dimensions = "31 or 81",
                                              .plain_dimension = MTM_SPECTRUM_SAMPLES,
                                              .dimension = dimension,
                                              .prepare = prepare,
                                              .matrix = mtm_basis_light_columns,
                                              .has_encoder = true,
                                              .has_spectra = true,
                                              .has_products = true};
