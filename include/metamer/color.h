/* SPDX-License-Identifier: BSD-3-Clause
 * Observers, and color in XYZ, linear and encoded sRGB, CIELAB and CIEDE2000. */
#ifndef METAMER_COLOR_H
#define METAMER_COLOR_H

#include "metamer/spectrum.h"

#ifdef __cplusplus
extern "C" {
#endif

/* CIE tristimulus values. The scale is the caller's: the library's own pictures have Y = 1 on the perfect
 * reflector under a light of weight 1. */
typedef struct mtm_xyz {
    double x, y, z;
} mtm_xyz;

/* Red, green, blue with sRGB's primaries and white; linear unless a function says encoded. */
typedef struct mtm_rgb {
    double r, g, b;
} mtm_rgb;

/* CIE 1976 L*a*b*. */
typedef struct mtm_lab {
    double l, a, b;
} mtm_lab;

/* Three sensitivity curves on the grid: x̄, ȳ, z̄ of an observer, or red, green, blue of a camera. */
typedef struct mtm_observer {
    char name[64];
    mtm_spectrum x, y, z;
    bool is_camera; /* its responses are linear red, green, blue and no XYZ */
} mtm_observer;

/* The observer of that name, from tables of the CIE: "cie1931" (2°) and "cie1964" (10°), the standard observers of
 * CIE 018; "cie2015" (2°) and "cie2015_10deg", from the cone fundamentals of CIE 170-2:2015. MTM_ARGUMENT for an
 * unknown name lists the known ones; MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_observer_get(const char *name, mtm_observer *observer, mtm_error *error);

/* Reads an observer from a CSV table as mtm_spectrum_table_read does, with exactly three columns in any order, letter
 * case ignored: x_bar, y_bar, z_bar (or x, y, z) are an observer's, R, G, B (or red, green, blue) a camera's. Its
 * name is the file's without ".csv", "observer" where that is not UTF-8; of a long one as much as fits is kept.
 * Errors (each names the file): those of mtm_spectrum_table_read; MTM_FORMAT for other columns, and for curves that
 * cannot work: one whose sum over the grid is not positive, ȳ or green with a sum outside 1e-30 … 1e30, or values
 * above a million times that sum. */
MTM_API MTM_CHECK mtm_status mtm_observer_read(const char *path, mtm_observer *observer, mtm_error *error);

/* Plain sums over the grid, no normalisation: x = Σ stimulus·x̄ and so on; a camera's are red, green and blue. */
MTM_API mtm_xyz mtm_xyz_of(const mtm_spectrum *stimulus, const mtm_observer *observer);

/* The light scaled so that its y is 1 on the perfect reflector. MTM_NUMERIC where its luminance is not positive
 * and finite. */
MTM_API MTM_CHECK mtm_status mtm_light_normalize(const mtm_spectrum *light, const mtm_observer *observer,
                                                 mtm_spectrum *normalized, mtm_error *error);

/* The four-digit matrix of IEC 61966-2-1 from XYZ (Y = 1 for white) to linear sRGB, row by row, and its inverse. */
MTM_API void mtm_rgb_from_xyz_matrix(double matrix[3][3]);
MTM_API mtm_rgb mtm_rgb_from_xyz(mtm_xyz xyz);
MTM_API mtm_xyz mtm_xyz_from_rgb(mtm_rgb rgb);

/* One channel between linear and encoded sRGB (IEC 61966-2-1), 0..1 to 0..1; values outside are clipped. */
MTM_API double mtm_srgb_encode(double linear);
MTM_API double mtm_srgb_decode(double encoded);

/* Linear sRGB of "#rrggbb". MTM_ARGUMENT names the text and the form expected. */
MTM_API MTM_CHECK mtm_status mtm_rgb_parse(const char *hex, mtm_rgb *linear, mtm_error *error);

/* "#rrggbb" of linear sRGB, clipped. */
MTM_API void mtm_rgb_format(mtm_rgb linear, char hex[8]);

/* XYZ of sRGB's white D65 (x = 0.3127, y = 0.3290, Y = 1), the white that pictures are judged against. */
MTM_API mtm_xyz mtm_white_d65(void);

/* CIELAB relative to a white with y > 0, exact 6/29 constants (CIE 015). Where the white's x or z is 0, the color's
 * ratio to it counts as that of y, so that white is (100, 0, 0). */
MTM_API mtm_lab mtm_lab_from_xyz(mtm_xyz xyz, mtm_xyz white);

/* Its inverse, for a white whose x, y and z are all above 0; colors that no light has may come out negative. */
MTM_API mtm_xyz mtm_xyz_from_lab(mtm_lab lab, mtm_xyz white);

/* A linear color as a display shows it: each channel within 0..1. And its CIELAB against D65. */
MTM_API mtm_rgb mtm_rgb_clip(mtm_rgb linear);
MTM_API mtm_lab mtm_lab_shown(mtm_rgb linear);

/* CIEDE2000 with kL = kC = kH = 1 (Sharma, Wu, Dalal, Color Res. Appl. 30, 2005). */
MTM_API double mtm_ciede2000(mtm_lab a, mtm_lab b);

/* The 3×3 matrix, row by row, that adapts XYZ from one white to another (Bradford, linear). Both whites have y > 0. Where
 * the first has a cone response below a hundredth of its y, as narrow blue light near 470 nm has, X, Y and Z themselves
 * are scaled instead, but for one that is 0. */
MTM_API void mtm_bradford(mtm_xyz from_white, mtm_xyz to_white, double matrix[3][3]);

/* The smoothest reflectance (least sum of squared steps between neighbours) with 0 ≤ ρ ≤ 1 that shows the linear
 * sRGB color `rgb` (each 0..1) under D65 to the CIE 1931 observer (Burns, Color Res. Appl. 45, 2020). White gives
 * all ones and black all zeros; the color of the result is within 1e-6 of `rgb` scaled, channel by channel, to the
 * white of the tabulated D65 (which is within 2e-4 of (1, 1, 1)). MTM_ARGUMENT outside 0..1; MTM_NUMERIC where no
 * bounded reflectance has that color (none of the cube is known); MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_reflectance_of_rgb(mtm_rgb rgb, mtm_spectrum *reflectance, mtm_error *error);

/* The point of the Planckian locus nearest to a light's chromaticity. */
typedef struct mtm_color_temperature_result {
    double kelvin; /* correlated color temperature, 1000 … 100000 */
    double duv;    /* distance from the locus in CIE 1960 (u, v), positive above it */
} mtm_color_temperature_result;

/* The correlated color temperature of a light (CIE 015:2018) for the CIE 1931 observer, with mtm_blackbody's c2 and
 * sums over the grid. MTM_NUMERIC with the reason where there is none: no luminance, a chromaticity farther than 0.05
 * from the locus, where the CIE gives the quantity no meaning, or a nearest black body below 1000 K or above
 * 100000 K, where the locus hardly moves any more. */
MTM_API MTM_CHECK mtm_status mtm_color_temperature(const mtm_spectrum *light,
                                                   mtm_color_temperature_result *result, mtm_error *error);

enum { MTM_TEST_COLORS = 14 };

/* How alike colors look under a light and under its reference; 100 is the same, and much worse than 0 is possible. */
typedef struct mtm_color_rendering_result {
    mtm_color_temperature_result temperature;
    double special[MTM_TEST_COLORS]; /* R1 … R14 */
    double general;                  /* Ra, the mean of R1 … R8 */
} mtm_color_rendering_result;

/* The color rendering indices of CIE 13.3-1995: test colors TCS01 … TCS14, a von Kries adaptation, differences in
 * U*V*W*. The reference has the light's correlated color temperature: a black body below 5000 K, daylight from there
 * on. The standard asks for a light within 5.4e-3 of its reference in (u, v); others are computed as well. MTM_NUMERIC
 * where the light has no color temperature, or one above 25000 K, for which the CIE defines no daylight; MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_color_rendering(const mtm_spectrum *light,
                                                 mtm_color_rendering_result *result, mtm_error *error);

/* Eyes whose color vision is normal, or in which one kind of cone is weak or missing: that for long wavelengths (protan),
 * middle ones (deutan, the most common) or short ones (tritan, rare). */
typedef enum mtm_vision {
    MTM_VISION_NORMAL,
    MTM_VISION_PROTAN,
    MTM_VISION_DEUTAN,
    MTM_VISION_TRITAN,
    MTM_VISION_COUNT,
} mtm_vision;

/* "normal", "protan", "deutan", "tritan". */
MTM_API const char *mtm_vision_name(mtm_vision vision);

/* The 3×3 matrix, row by row, from a linear sRGB color to one that looks the same to normal eyes as the first does to
 * these: `severity` is 0 (normal) … 1 (the cones are missing), linear between tenths (Machado, Oliveira, Fernandes, IEEE TVCG
 * 15(6), 2009). Grays stay as they are, to 3e-6. */
MTM_API void mtm_vision_matrix(mtm_vision vision, double severity, double matrix[3][3]);

/* The matrix times a color; not clipped, and saturated colors do leave 0..1. */
MTM_API mtm_rgb mtm_vision_see(mtm_vision vision, double severity, mtm_rgb linear);

#ifdef __cplusplus
}
#endif
#endif
