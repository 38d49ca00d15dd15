/* SPDX-License-Identifier: BSD-3-Clause
 * From measured wavelengths to the grid. A table is taken as the piecewise-linear curve through its samples.
 * Where it is coarse the grid reads that curve; where it is fine, narrow emission lines would fall between the
 * grid's wavelengths, so a light's sample is the curve's mean over the 5 nm around it, which keeps their power. */
#include <assert.h>

#include "metamer/spectrum.h"

typedef struct curve {
    int count;
    const double *wavelength_nm;
    const double *value;
} curve;

/* The last sample at or below the wavelength, which lies within the table: 0 … count-2 (count ≥ 2). */
static int segment_at(const curve *c, double wavelength_nm) {
    int low = 0;
    int high = c->count - 1;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (c->wavelength_nm[middle] <= wavelength_nm)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The curve with its end values held. */
static double value_at(const curve *c, double wavelength_nm) {
    const int last = c->count - 1;
    if (wavelength_nm <= c->wavelength_nm[0]) return c->value[0];
    if (wavelength_nm >= c->wavelength_nm[last]) return c->value[last];
    const int i = segment_at(c, wavelength_nm);
    const double width = c->wavelength_nm[i + 1] - c->wavelength_nm[i];
    return c->value[i] + (wavelength_nm - c->wavelength_nm[i]) / width * (c->value[i + 1] - c->value[i]);
}

/* The curve's mean between two wavelengths: trapezoids from sample to sample, exact for a piecewise-linear curve. */
static double mean_between(const curve *c, double from_nm, double to_nm) {
    double integral = 0;
    double left_nm = from_nm;
    double left_value = value_at(c, from_nm);
    for (int i = from_nm < c->wavelength_nm[0] ? 0 : segment_at(c, from_nm); i < c->count; i++) {
        const double right_nm = c->wavelength_nm[i];
        if (right_nm <= from_nm) continue;
        if (right_nm >= to_nm) break;
        integral += 0.5 * (left_value + c->value[i]) * (right_nm - left_nm);
        left_nm = right_nm;
        left_value = c->value[i];
    }
    integral += 0.5 * (left_value + value_at(c, to_nm)) * (to_nm - left_nm);
    return integral / (to_nm - from_nm);
}

/* Finer than the grid: the median step is shorter than 5 nm. The median, so that a gap or a doubled stretch does
 * not decide; more than half of the steps being shorter is the same without sorting. A table whose decimals make
 * its steps 4.9999999 nm is a table of 5 nm. */
static bool is_finer_than_grid(const curve *c) {
    const double rounding_nm = 1e-6;
    int shorter = 0;
    for (int i = 0; i + 1 < c->count; i++)
        shorter += c->wavelength_nm[i + 1] - c->wavelength_nm[i] < MTM_WAVELENGTH_STEP_NM - rounding_nm;
    return 2 * shorter > c->count - 1;
}

static bool is_within(const curve *c, double wavelength_nm) {
    return wavelength_nm >= c->wavelength_nm[0] && wavelength_nm <= c->wavelength_nm[c->count - 1];
}

mtm_spectrum mtm_spectrum_resample(int count, const double *wavelength_nm, const double *value,
                                   mtm_spectrum_kind kind) {
    assert(count >= 1);
    const curve c = {count, wavelength_nm, value};
    const bool is_averaged = kind == MTM_KIND_LIGHT && is_finer_than_grid(&c);
    const double half_step_nm = 0.5 * MTM_WAVELENGTH_STEP_NM;
    mtm_spectrum spectrum;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        const double at_nm = MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * i;
        if (kind == MTM_KIND_OBSERVER && !is_within(&c, at_nm))
            spectrum.value[i] = 0;
        else if (is_averaged)
            spectrum.value[i] = mean_between(&c, at_nm - half_step_nm, at_nm + half_step_nm);
        else
            spectrum.value[i] = value_at(&c, at_nm);
    }
    return spectrum;
}
