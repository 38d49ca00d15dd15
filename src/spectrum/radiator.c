/* SPDX-License-Identifier: BSD-3-Clause
 * Lights computed from a temperature: Planck's black body and the CIE's daylight.
 * CIE 015:2018, Colorimetry: illuminants D, and Planck's law with the c2 of the ITS-90. */
#include <math.h>

#include "base/fail.h"
#include "spectrum/embedded.h"

static double grid_wavelength_nm(int index) {
    return MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * (double)index;
}

/* Planck's M ∝ λ⁻⁵ / (exp(c2 / λT) − 1), divided by its value at 560 nm. The quotient
 * needs no radiometric constant and stays within range at every temperature accepted. */
mtm_status mtm_blackbody(double kelvin, mtm_spectrum *light, mtm_error *error) {
    if (!(kelvin >= 500 && kelvin <= 1e6))
        return mtm_fail(error, MTM_ARGUMENT, "blackbody temperature %g K, expected 500 to 1000000 K", kelvin);
    const double c2_nm_kelvin = 1.4388e-2 * 1e9;
    const double reference_nm = 560;
    const double reference = expm1(c2_nm_kelvin / (reference_nm * kelvin));
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        const double wavelength_nm = grid_wavelength_nm(i);
        light->value[i] =
            pow(reference_nm / wavelength_nm, 5) * reference / expm1(c2_nm_kelvin / (wavelength_nm * kelvin));
    }
    return MTM_OK;
}

/* Chromaticity x of daylight (CIE 015), two cubics in 1/T that meet at 7000 K. */
static double daylight_x(double kelvin) {
    const double t = 1e3 / kelvin;
    return kelvin <= 7000 ? ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
                          : ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
}

mtm_status mtm_daylight(double kelvin, mtm_spectrum *light, mtm_error *error) {
    if (!(kelvin >= 4000 && kelvin <= 25000))
        return mtm_fail(error, MTM_ARGUMENT, "daylight temperature %g K, expected 4000 to 25000 K", kelvin);
    const char *const columns[3] = {"S0", "S1", "S2"};
    mtm_spectrum components[3];
    for (int i = 0; i < 3; i++) {
        const mtm_status status =
            mtm_embedded_column("cie_daylight_components", columns[i], MTM_KIND_LIGHT, &components[i], error);
        if (status != MTM_OK) return status;
    }
    const double x = daylight_x(kelvin);
    const double y = (-3.000 * x + 2.870) * x - 0.275; /* the daylight locus */
    const double divisor = 0.0241 + 0.2562 * x - 0.7341 * y;
    const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / divisor;
    const double m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / divisor;
    const double scale = 1.0 / 100; /* at 560 nm S0 is 100, S1 and S2 are 0 */
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        light->value[i] =
            scale * (components[0].value[i] + m1 * components[1].value[i] + m2 * components[2].value[i]);
    return MTM_OK;
}
