/* SPDX-License-Identifier: BSD-3-Clause
 * The step from a reflectance under a light to linear sRGB, in full spectra (paper eq. 1). */
#include <string.h>

#include "base/linear.h"
#include "metamer/basis.h"

mtm_illumination mtm_illumination_of(const mtm_spectrum *light, const mtm_observer *observer,
                                     bool is_adapted) {
    mtm_illumination illumination = {.light = *light, .observer = *observer};
    mtm_rgb_from_xyz_matrix(illumination.rgb_from_xyz);
    const mtm_xyz white = mtm_xyz_of(light, observer);
    if (!is_adapted || !(white.y > 0)) return illumination;

    /* The adaptation keeps the light's intensity: only its chromaticity becomes that of D65. */
    const mtm_xyz d65 = mtm_white_d65();
    const mtm_xyz target = {d65.x * white.y, d65.y * white.y, d65.z * white.y};
    mtm_matrix3 adaptation;
    mtm_matrix3 to_rgb;
    mtm_bradford(white, target, adaptation.m);
    memcpy(to_rgb.m, illumination.rgb_from_xyz, sizeof to_rgb.m);
    to_rgb = mtm_matrix3_multiply(to_rgb, adaptation);
    memcpy(illumination.rgb_from_xyz, to_rgb.m, sizeof to_rgb.m);
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
