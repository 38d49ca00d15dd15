/* SPDX-License-Identifier: BSD-3-Clause
 * Arithmetic of spectra on the grid. */
#include "metamer/spectrum.h"

mtm_spectrum mtm_spectrum_constant(double value) {
    mtm_spectrum spectrum;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) spectrum.value[i] = value;
    return spectrum;
}

mtm_spectrum mtm_spectrum_multiply(const mtm_spectrum *a, const mtm_spectrum *b) {
    mtm_spectrum product;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) product.value[i] = a->value[i] * b->value[i];
    return product;
}

mtm_spectrum mtm_spectrum_scale(const mtm_spectrum *spectrum, double factor) {
    mtm_spectrum scaled;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) scaled.value[i] = spectrum->value[i] * factor;
    return scaled;
}
