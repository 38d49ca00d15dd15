/* SPDX-License-Identifier: BSD-3-Clause
 * Color rendering indices: CIE 13.3-1995, Method of measuring and specifying colour rendering properties of light
 * sources, sections 5.6 to 5.10. */
#include <math.h>
#include <stdio.h>

#include "base/fail.h"
#include "color/chromaticity.h"
#include "spectrum/embedded.h"

enum { GENERAL_COLORS = 8 };

/* The two functions of a chromaticity that von Kries' adaptation scales (section 5.7). */
typedef struct cone_pair {
    double c, d;
} cone_pair;

/* What a light is to the observer. */
typedef struct viewing {
    const mtm_observer *observer;
    mtm_spectrum light; /* of luminance 100 */
    mtm_chromaticity white;
} viewing;

/* Coordinates in the CIE 1964 uniform space U*V*W*. */
typedef struct uvw {
    double u, v, w;
} uvw;

static mtm_status view(const mtm_spectrum *light, const mtm_observer *observer, viewing *seen,
                       mtm_error *error) {
    seen->observer = observer;
    const mtm_status status = mtm_light_normalize(light, observer, &seen->light, error);
    if (status != MTM_OK) return status;
    seen->light = mtm_spectrum_scale(&seen->light, 100);
    seen->white = mtm_chromaticity_of(mtm_xyz_of(&seen->light, observer));
    return MTM_OK;
}

static cone_pair cones_of(mtm_chromaticity at) {
    return (cone_pair){(4 - at.u - 10 * at.v) / at.v, (1.708 * at.v + 0.404 - 1.481 * at.u) / at.v};
}

/* The chromaticity under the reference that looks like `at` under a light of white `from`. */
static mtm_chromaticity adapt(mtm_chromaticity at, mtm_chromaticity from, mtm_chromaticity to) {
    const cone_pair source = cones_of(from);
    const cone_pair target = cones_of(to);
    cone_pair cones = cones_of(at);
    cones.c *= target.c / source.c;
    cones.d *= target.d / source.d;
    const double sum = 16.518 + 1.481 * cones.c - cones.d;
    return (mtm_chromaticity){(10.872 + 0.404 * cones.c - 4 * cones.d) / sum, 5.520 / sum};
}

/* A test color under a light whose white has become that of the reference. */
static uvw appearance_of(const mtm_spectrum *reflectance, const viewing *light,
                         mtm_chromaticity reference_white) {
    const mtm_spectrum stimulus = mtm_spectrum_multiply(&light->light, reflectance);
    const mtm_xyz xyz = mtm_xyz_of(&stimulus, light->observer);
    const mtm_chromaticity adapted = adapt(mtm_chromaticity_of(xyz), light->white, reference_white);
    const double w = 25 * cbrt(xyz.y) - 17;
    return (uvw){13 * w * (adapted.u - reference_white.u), 13 * w * (adapted.v - reference_white.v), w};
}

static double index_of(const mtm_spectrum *reflectance, const viewing *light, const viewing *reference) {
    const uvw a = appearance_of(reflectance, light, reference->white);
    const uvw b = appearance_of(reflectance, reference, reference->white);
    return 100 - 4.6 * hypot(hypot(a.u - b.u, a.v - b.v), a.w - b.w);
}

static mtm_status make_reference(double kelvin, const mtm_observer *observer, viewing *reference,
                                 mtm_error *error) {
    mtm_spectrum light;
    if (kelvin > 25000)
        return mtm_fail(
            error, MTM_NUMERIC,
            "the light's color temperature is %.0f K, and above 25000 K there is no daylight to compare "
            "its color rendering with",
            kelvin);
    const mtm_status status =
        kelvin < 5000 ? mtm_blackbody(kelvin, &light, error) : mtm_daylight(kelvin, &light, error);
    return status == MTM_OK ? view(&light, observer, reference, error) : status;
}

static mtm_status compare_colors(const viewing *light, const viewing *reference,
                                 mtm_color_rendering_result *result, mtm_error *error) {
    static const char name[] = "cie_test_color_samples";
    mtm_spectrum_table table;
    mtm_status status = mtm_embedded_table_read(name, &table, error);
    if (status != MTM_OK) return status;
    result->general = 0;
    for (int i = 0; i < MTM_TEST_COLORS && status == MTM_OK; i++) {
        char column[8];
        mtm_spectrum reflectance;
        (void)snprintf(column, sizeof column, "TCS%02d", i + 1);
        status = mtm_spectrum_table_column(&table, name, column, MTM_KIND_REFLECTANCE, &reflectance, error);
        if (status != MTM_OK) break;
        result->special[i] = index_of(&reflectance, light, reference);
        if (i < GENERAL_COLORS) result->general += result->special[i] / GENERAL_COLORS;
    }
    mtm_spectrum_table_free(&table);
    return status;
}

mtm_status mtm_color_rendering(const mtm_spectrum *light, mtm_color_rendering_result *result,
                               mtm_error *error) {
    mtm_color_rendering_result made;
    mtm_observer observer;
    viewing tested;
    viewing reference;
    mtm_status status = mtm_color_temperature(light, &made.temperature, error);
    if (status == MTM_OK) status = mtm_observer_get("cie1931", &observer, error);
    if (status == MTM_OK) status = view(light, &observer, &tested, error);
    if (status == MTM_OK) status = make_reference(made.temperature.kelvin, &observer, &reference, error);
    if (status == MTM_OK) status = compare_colors(&tested, &reference, &made, error);
    if (status == MTM_OK) *result = made;
    return status;
}
