/* SPDX-License-Identifier: BSD-3-Clause
 * CIEDE2000 (G. Sharma, W. Wu, E. N. Dalal, The CIEDE2000 Color-Difference Formula: Implementation Notes,
 * Supplementary Test Data, and Mathematical Observations, Color Research and Application 30(1), 2005; the equation
 * numbers are theirs). */
#include <math.h>

#include "metamer/color.h"

static double radians(double degrees) {
    return degrees * (3.14159265358979323846 / 180);
}

static double seventh_power(double x) {
    const double cube = x * x * x;
    return cube * cube * x;
}

/* √(C⁷ / (C⁷ + 25⁷)), of equations 4 and 19. */
static double chroma_saturation(double chroma) {
    const double power = seventh_power(chroma);
    return sqrt(power / (power + seventh_power(25)));
}

/* Equation 7: the hue angle in 0 … 360 degrees, 0 for gray. */
static double hue_degrees(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double degrees = atan2(b, a) * (180 / 3.14159265358979323846);
    return degrees < 0 ? degrees + 360 : degrees;
}

/* Hues that differ by exactly 180 degrees must count as such although atan2 is rounded (pair 14 of the paper's
 * data would be 4.7461 instead of 4.8045). */
static bool is_beyond_half_turn(double difference_degrees) {
    return fabs(difference_degrees) > 180 + 1e-9;
}

/* Equation 10: the hue difference the short way round. */
static double hue_difference(double h1, double h2) {
    const double difference = h2 - h1;
    if (!is_beyond_half_turn(difference)) return difference;
    return difference > 0 ? difference - 360 : difference + 360;
}

/* Equation 14: the mean hue on the short way round. */
static double hue_mean(double h1, double h2) {
    if (!is_beyond_half_turn(h1 - h2)) return (h1 + h2) / 2;
    return h1 + h2 < 360 ? (h1 + h2 + 360) / 2 : (h1 + h2 - 360) / 2;
}

/* Equation 15. */
static double hue_weight(double mean) {
    return 1 - 0.17 * cos(radians(mean - 30)) + 0.24 * cos(radians(2 * mean)) +
           0.32 * cos(radians(3 * mean + 6)) - 0.20 * cos(radians(4 * mean - 63));
}

double mtm_ciede2000(mtm_lab a, mtm_lab b) {
    /* Equations 2 to 7: a* is stretched near gray, then chroma and hue. */
    const double mean_plain_chroma = (hypot(a.a, a.b) + hypot(b.a, b.b)) / 2;
    const double stretch = 1 + 0.5 * (1 - chroma_saturation(mean_plain_chroma));
    const double chroma1 = hypot(stretch * a.a, a.b);
    const double chroma2 = hypot(stretch * b.a, b.b);
    const double h1 = hue_degrees(stretch * a.a, a.b);
    const double h2 = hue_degrees(stretch * b.a, b.b);
    /* Equations 8 to 11: the differences. Gray has no hue, but then the hue distance is 0 whatever the angle, and
     * with it every term that the mean hue enters; the special cases of equations 10 and 14 need no code. */
    const double lightness_difference = b.l - a.l;
    const double chroma_difference = chroma2 - chroma1;
    const double hue_distance = 2 * sqrt(chroma1 * chroma2) * sin(radians(hue_difference(h1, h2)) / 2);
    /* Equations 12 to 21: their weights at the means. */
    const double from_middle = (a.l + b.l) / 2 - 50;
    const double chroma = (chroma1 + chroma2) / 2;
    const double hue = hue_mean(h1, h2);
    const double lightness_scale =
        1 + 0.015 * from_middle * from_middle / sqrt(20 + from_middle * from_middle);
    const double chroma_scale = 1 + 0.045 * chroma;
    const double hue_scale = 1 + 0.015 * chroma * hue_weight(hue);
    const double from_blue = (hue - 275) / 25;
    const double rotation = -2 * chroma_saturation(chroma) * sin(radians(60 * exp(-from_blue * from_blue)));
    /* Equation 22. */
    const double l = lightness_difference / lightness_scale;
    const double c = chroma_difference / chroma_scale;
    const double h = hue_distance / hue_scale;
    return sqrt(fmax(0, l * l + c * c + h * h + rotation * c * h));
}
