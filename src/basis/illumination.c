/* SPDX-License-Identifier: BSD-3-Clause
 * The step from a reflectance under a light to linear sRGB, in full spectra (paper eq. 1). */
#include <assert.h>
#include <string.h>

#include "base/linear.h"
#include "metamer/basis.h"

/* Σȳ of the CIE 1931 observer, the luminance of equal-energy light before lights are scaled to Y = 1. */
static const double standard_sum = 21.371327790000002;

/* What makes y (green) of the perfect reflector 1 under equal-energy light of Y = 1. It depends on no light, so that
 * responses to a mix of lights stay the mix of the responses. */
static double exposure_of(const mtm_observer *observer) {
    const mtm_spectrum equal_energy = mtm_spectrum_constant(1);
    const double sum = mtm_xyz_of(&equal_energy, observer).y;
    assert(sum > 0);
    return standard_sum / sum;
}

/* A channel that does not see the light has nothing to adapt. */
static void show_camera(mtm_xyz white, double exposure, double adapted_y, double rgb_from_response[3][3]) {
    const double responses[3] = {white.x, white.y, white.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double gain = adapted_y > 0 && responses[i] > 0 ? adapted_y / responses[i] : exposure;
            rgb_from_response[i][j] = i == j ? gain : 0;
        }
}

/* The same for XYZ by Bradford's adaptation: white becomes D65. */
static void show_observer(mtm_xyz white, double exposure, double adapted_y, double rgb_from_xyz[3][3]) {
    const mtm_xyz d65 = mtm_white_d65();
    const mtm_xyz target = {d65.x * adapted_y, d65.y * adapted_y, d65.z * adapted_y};
    mtm_matrix3 step = {{{exposure, 0, 0}, {0, exposure, 0}, {0, 0, exposure}}};
    mtm_matrix3 to_rgb;
    if (adapted_y > 0 && white.y > 0) mtm_bradford(white, target, step.m);
    mtm_rgb_from_xyz_matrix(to_rgb.m);
    to_rgb = mtm_matrix3_multiply(to_rgb, step);
    memcpy(rgb_from_xyz, to_rgb.m, sizeof to_rgb.m);
}

mtm_illumination mtm_illumination_of(const mtm_spectrum *light, const mtm_observer *observer,
                                     double adapted_y) {
    mtm_illumination illumination = {.light = *light, .observer = *observer};
    const mtm_xyz white = mtm_xyz_of(light, observer);
    const double exposure = exposure_of(observer);
    if (observer->is_camera)
        show_camera(white, exposure, adapted_y, illumination.rgb_from_xyz);
    else
        show_observer(white, exposure, adapted_y, illumination.rgb_from_xyz);
    return illumination;
}

mtm_rgb mtm_illuminate(const mtm_illumination *illumination, const mtm_spectrum *reflectance) {
    const mtm_spectrum stimulus = mtm_spectrum_multiply(&illumination->light, reflectance);
    const mtm_xyz xyz = mtm_xyz_of(&stimulus, &illumination->observer);
    const double(*m)[3] = illumination->rgb_from_xyz;
    return (mtm_rgb){m[0][0] * xyz.x + m[0][1] * xyz.y + m[0][2] * xyz.z,
                     m[1][0] * xyz.x + m[1][1] * xyz.y + m[1][2] * xyz.z,
                     m[2][0] * xyz.x + m[2][1] * xyz.y + m[2][2] * xyz.z};
}
