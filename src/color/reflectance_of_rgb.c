/* SPDX-License-Identifier: BSD-3-Clause
 * A reflectance for a color: the least-slope-squared one within 0 … 1 (S. A. Burns, Numerical Methods for Smoothest
 * Reflectance Reconstruction, Color Research and Application 45(1), 2020; C. van Trigt, Smoothest Reflectance
 * Functions, JOSA A 7, 1990). */
#include "base/fail.h"
#include "color/smoothest.h"
#include "metamer/color.h"

static bool is_unit(double value) {
    return value >= 0 && value <= 1;
}

/* One channel's weights per wavelength under the light, scaled so that they sum to 1: white is then exactly
 * (1, 1, 1) although the tabulated D65 and the four-digit matrix leave it 1e-4 beside. */
static mtm_spectrum channel_weights(const double row[3], const mtm_spectrum *light,
                                    const mtm_observer *observer) {
    mtm_spectrum weights;
    double sum = 0;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        weights.value[i] = light->value[i] * (row[0] * observer->x.value[i] + row[1] * observer->y.value[i] +
                                              row[2] * observer->z.value[i]);
        sum += weights.value[i];
    }
    return mtm_spectrum_scale(&weights, 1 / sum);
}

static mtm_status find_weights(mtm_spectrum weights[3], mtm_error *error) {
    mtm_observer observer;
    mtm_spectrum light;
    mtm_status status = mtm_observer_get("cie1931", &observer, error);
    if (status == MTM_OK) status = mtm_illuminant("D65", &light, error);
    if (status != MTM_OK) return status;
    double matrix[3][3];
    mtm_rgb_from_xyz_matrix(matrix);
    for (int k = 0; k < 3; k++) weights[k] = channel_weights(matrix[k], &light, &observer);
    return MTM_OK;
}

mtm_status mtm_reflectance_of_rgb(mtm_rgb rgb, mtm_spectrum *reflectance, mtm_error *error) {
    if (!is_unit(rgb.r) || !is_unit(rgb.g) || !is_unit(rgb.b))
        return mtm_fail(error, MTM_ARGUMENT, "linear color (%g, %g, %g), expected channels of 0 to 1", rgb.r,
                        rgb.g, rgb.b);
    mtm_spectrum weights[3];
    mtm_status status = find_weights(weights, error);
    if (status == MTM_OK)
        status = mtm_smoothest_curve(weights, (const double[]){rgb.r, rgb.g, rgb.b}, reflectance, error);
    if (status == MTM_NUMERIC)
        return mtm_fail(error, MTM_NUMERIC,
                        "no reflectance within 0 to 1 shows the linear color (%g, %g, %g) under D65", rgb.r,
                        rgb.g, rgb.b);
    return status;
}
