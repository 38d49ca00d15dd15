/* SPDX-License-Identifier: BSD-3-Clause
 * Correlated color temperature: the nearest point of the Planckian locus in CIE 1960 (u, v) (CIE 015:2018, Colorimetry).
 * The search runs over the reciprocal temperature in mireds (10⁶ / T), in which the locus is nearly evenly spaced
 * (D. B. Judd, Sensibility to color-temperature change as a function of temperature, JOSA 23(1), 1933). */
#include <math.h>

#include "base/fail.h"
#include "color/chromaticity.h"

/* The locus is searched as far as black bodies are computed, so that a nearest point beyond the range is seen to lie
 * there and not at its end. */
static const double mired_first = 1;   /* 10⁶ K */
static const double mired_last = 2000; /* 500 K */
static const double kelvin_min = 1000;
static const double kelvin_max = 1e5;
static const double duv_max = 0.05;

static mtm_chromaticity locus_at(double mired, const mtm_observer *observer) {
    mtm_spectrum light;
    const double kelvin = fmin(fmax(1e6 / mired, 500), 1e6); /* rounding at the ends */
    if (mtm_blackbody(kelvin, &light, NULL) != MTM_OK) return (mtm_chromaticity){NAN, NAN};
    return mtm_chromaticity_of(mtm_xyz_of(&light, observer));
}

static double distance_at(double mired, mtm_chromaticity light, const mtm_observer *observer) {
    const mtm_chromaticity locus = locus_at(mired, observer);
    return hypot(light.u - locus.u, light.v - locus.v);
}

/* Points about 2 % apart, so that the distance has a single minimum between the neighbors of the nearest one. */
enum { POINTS = 385 };

static double mired_of_point(int index) {
    const int within = index < 0 ? 0 : index < POINTS ? index : POINTS - 1;
    return mired_first * pow(mired_last / mired_first, within / (POINTS - 1.0));
}

static int find_nearest_point(mtm_chromaticity light, const mtm_observer *observer) {
    int nearest = 0;
    double least = INFINITY;
    for (int i = 0; i < POINTS; i++) {
        const double distance = distance_at(mired_of_point(i), light, observer);
        if (!(distance < least)) continue;
        least = distance;
        nearest = i;
    }
    return nearest;
}

/* Golden-section search (J. Kiefer, Sequential minimax search for a maximum, Proc. AMS 4(3), 1953). */
static double refine(double low, double high, mtm_chromaticity light, const mtm_observer *observer) {
    enum { STEPS = 60 }; /* 0.618⁶⁰ = 3e-13 of the bracket */
    const double ratio = (sqrt(5) - 1) / 2;
    double left = high - ratio * (high - low);
    double right = low + ratio * (high - low);
    double left_distance = distance_at(left, light, observer);
    double right_distance = distance_at(right, light, observer);
    for (int i = 0; i < STEPS; i++) {
        if (left_distance < right_distance) {
            high = right;
            right = left;
            right_distance = left_distance;
            left = high - ratio * (high - low);
            left_distance = distance_at(left, light, observer);
        } else {
            low = left;
            left = right;
            left_distance = right_distance;
            right = low + ratio * (high - low);
            right_distance = distance_at(right, light, observer);
        }
    }
    return (low + high) / 2;
}

mtm_status mtm_color_temperature(const mtm_spectrum *light, mtm_color_temperature_result *result,
                                 mtm_error *error) {
    mtm_observer observer;
    mtm_spectrum normalized;
    mtm_status status = mtm_observer_get("cie1931", &observer, error);
    if (status == MTM_OK) status = mtm_light_normalize(light, &observer, &normalized, error);
    if (status != MTM_OK) return status;
    const mtm_chromaticity place = mtm_chromaticity_of(mtm_xyz_of(&normalized, &observer));
    const int nearest = find_nearest_point(place, &observer);
    const double mired = refine(mired_of_point(nearest - 1), mired_of_point(nearest + 1), place, &observer);
    const double distance = distance_at(mired, place, &observer);
    const double kelvin = 1e6 / mired;
    if (!(distance <= duv_max))
        return mtm_fail(
            error, MTM_NUMERIC,
            "the light's chromaticity (u, v) = (%.4f, %.4f) is %.4f from the Planckian locus; a color "
            "temperature has a meaning only within %g",
            place.u, place.v, distance, duv_max);
    if (!(kelvin >= kelvin_min && kelvin <= kelvin_max))
        return mtm_fail(error, MTM_NUMERIC, "the light's color temperature is %s %g K, expected %g to %g K",
                        kelvin < kelvin_min ? "below" : "above",
                        kelvin < kelvin_min ? kelvin_min : kelvin_max, kelvin_min, kelvin_max);
    *result =
        (mtm_color_temperature_result){kelvin, copysign(distance, place.v - locus_at(mired, &observer).v)};
    return MTM_OK;
}
