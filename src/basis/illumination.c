/* SPDX-License-Identifier: BSD-3-Clause
 * The step from a reflectance under a light to linear sRGB, in full spectra (paper eq. 1). */
#include <string.h>

#include "base/linear.h"
#include "metamer/basis.h"

/* The observer by whose luminance lights are scaled. It is built in; only without memory is there none. */
static mtm_observer luminance_observer(const mtm_observer *fallback) {
    mtm_observer standard;
    return mtm_observer_get("cie1931", &standard, NULL) == MTM_OK ? standard : *fallback;
}

/* What makes y (green) of the perfect reflector 1 under equal-energy light of Y = 1. It depends on no light, so that
 * responses to a mix of lights stay the mix of the responses. */
static double exposure_of(const mtm_observer *observer, const mtm_observer *standard) {
    const mtm_spectrum equal_energy = mtm_spectrum_constant(1);
    return mtm_xyz_of(&equal_energy, standard).y / mtm_xyz_of(&equal_energy, observer).y;
}

/* `luminance` is what white adapts to, 0 for none. A channel that does not see the light has nothing to adapt. */
static void show_camera(mtm_xyz white, double exposure, double luminance, double rgb_from_response[3][3]) {
    const double responses[3] = {white.x, white.y, white.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double gain = luminance > 0 && responses[i] > 0 ? luminance / responses[i] : exposure;
            rgb_from_response[i][j] = i == j ? gain : 0;
        }
}

/* The same for XYZ: only the light's chromaticity becomes that of D65, its luminance stays. */
static void show_observer(mtm_xyz white, double exposure, double luminance, double rgb_from_xyz[3][3]) {
    const mtm_xyz d65 = mtm_white_d65();
    const mtm_xyz target = {d65.x * luminance, d65.y * luminance, d65.z * luminance};
    mtm_matrix3 step = {{{exposure, 0, 0}, {0, exposure, 0}, {0, 0, exposure}}};
    mtm_matrix3 to_rgb;
    if (luminance > 0 && white.y > 0) mtm_bradford(white, target, step.m);
    mtm_rgb_from_xyz_matrix(to_rgb.m);
    to_rgb = mtm_matrix3_multiply(to_rgb, step);
    memcpy(rgb_from_xyz, to_rgb.m, sizeof to_rgb.m);
}

mtm_illumination mtm_illumination_of(const mtm_spectrum *light, const mtm_observer *observer,
                                     bool is_adapted) {
    mtm_illumination illumination = {.light = *light, .observer = *observer};
    const mtm_observer standard = luminance_observer(observer);
    const mtm_xyz white = mtm_xyz_of(light, observer);
    const double exposure = exposure_of(observer, &standard);
    const double luminance = is_adapted ? mtm_xyz_of(light, &standard).y : 0;
    if (observer->is_camera)
        show_camera(white, exposure, luminance, illumination.rgb_from_xyz);
    else
        show_observer(white, exposure, luminance, illumination.rgb_from_xyz);
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
