/* SPDX-License-Identifier: BSD-3-Clause
 * sRGB (IEC 61966-2-1:1999), CIELAB (CIE 015:2018) and Bradford's adaptation between whites (K. M. Lam, Metamerism
 * and Colour Constancy, PhD thesis, University of Bradford, 1985; the linear form of the ICC profiles). */
#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "base/linear.h"
#include "metamer/color.h"

static const mtm_matrix3 rgb_from_xyz = {{
    {3.2406, -1.5372, -0.4986},
    {-0.9689, 1.8758, 0.0415},
    {0.0557, -0.2040, 1.0570},
}};

static const mtm_matrix3 bradford_cones = {{
    {0.8951, 0.2664, -0.1614},
    {-0.7502, 1.7135, 0.0367},
    {0.0389, -0.0685, 1.0296},
}};

static double apply_row(const double row[3], double x, double y, double z) {
    return row[0] * x + row[1] * y + row[2] * z;
}

/* For the matrices of this file, which have an inverse. */
static mtm_matrix3 inverse_of(mtm_matrix3 matrix) {
    mtm_matrix3 inverse;
    const bool is_regular = mtm_matrix3_invert(matrix, &inverse);
    assert(is_regular);
    (void)is_regular;
    return inverse;
}

void mtm_rgb_from_xyz_matrix(double matrix[3][3]) {
    memcpy(matrix, rgb_from_xyz.m, sizeof rgb_from_xyz.m);
}

mtm_rgb mtm_rgb_from_xyz(mtm_xyz xyz) {
    return (mtm_rgb){apply_row(rgb_from_xyz.m[0], xyz.x, xyz.y, xyz.z),
                     apply_row(rgb_from_xyz.m[1], xyz.x, xyz.y, xyz.z),
                     apply_row(rgb_from_xyz.m[2], xyz.x, xyz.y, xyz.z)};
}

/* By the inverse computed here: the standard's own has four digits and would not lead back. */
mtm_xyz mtm_xyz_from_rgb(mtm_rgb rgb) {
    const mtm_matrix3 inverse = inverse_of(rgb_from_xyz);
    return (mtm_xyz){apply_row(inverse.m[0], rgb.r, rgb.g, rgb.b),
                     apply_row(inverse.m[1], rgb.r, rgb.g, rgb.b),
                     apply_row(inverse.m[2], rgb.r, rgb.g, rgb.b)};
}

double mtm_srgb_encode(double linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

double mtm_srgb_decode(double encoded) {
    if (!(encoded > 0)) return 0;
    if (encoded >= 1) return 1;
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

static int hex_digit(char digit) {
    const char *digits = "0123456789abcdef";
    const char *found = digit == '\0' ? NULL : strchr(digits, tolower((unsigned char)digit));
    return found == NULL ? -1 : (int)(found - digits);
}

mtm_status mtm_rgb_parse(const char *hex, mtm_rgb *linear, mtm_error *error) {
    int digits[6];
    bool is_color = hex[0] == '#' && strlen(hex) == 7;
    for (int i = 0; i < 6 && is_color; i++) {
        digits[i] = hex_digit(hex[1 + i]);
        is_color = digits[i] >= 0;
    }
    if (!is_color) return mtm_fail(error, MTM_ARGUMENT, "color '%.64s', expected the form #rrggbb", hex);
    linear->r = mtm_srgb_decode((16 * digits[0] + digits[1]) / 255.0);
    linear->g = mtm_srgb_decode((16 * digits[2] + digits[3]) / 255.0);
    linear->b = mtm_srgb_decode((16 * digits[4] + digits[5]) / 255.0);
    return MTM_OK;
}

void mtm_rgb_format(mtm_rgb linear, char hex[8]) {
    static const char digits[] = "0123456789abcdef";
    const double channels[3] = {linear.r, linear.g, linear.b};
    hex[0] = '#';
    for (int c = 0; c < 3; c++) {
        const int level = (int)lround(255 * mtm_srgb_encode(channels[c]));
        hex[1 + 2 * c] = digits[level / 16];
        hex[2 + 2 * c] = digits[level % 16];
    }
    hex[7] = '\0';
}

mtm_xyz mtm_white_d65(void) {
    const double x = 0.3127;
    const double y = 0.3290;
    return (mtm_xyz){x / y, 1, (1 - x - y) / y};
}

/* CIE 015's f: a cube root above (6/29)³, below it the tangent that begins there. */
static double lab_curve(double ratio) {
    const double delta = 6.0 / 29;
    if (ratio > delta * delta * delta) return cbrt(ratio);
    return ratio / (3 * delta * delta) + 4.0 / 29;
}

/* A light that lacks red or blue has a white with x or z of 0, and so has all that it shows; white's share is taken to
 * be that of y, so that white is neutral. */
static double ratio_to_white(double value, double white, double luminance_ratio) {
    return white == 0 ? luminance_ratio : value / white;
}

mtm_lab mtm_lab_from_xyz(mtm_xyz xyz, mtm_xyz white) {
    assert(white.y > 0);
    const double luminance_ratio = xyz.y / white.y;
    const double x = lab_curve(ratio_to_white(xyz.x, white.x, luminance_ratio));
    const double y = lab_curve(luminance_ratio);
    const double z = lab_curve(ratio_to_white(xyz.z, white.z, luminance_ratio));
    return (mtm_lab){116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/* Inverse of lab_curve. */
static double lab_curve_inverse(double value) {
    const double delta = 6.0 / 29;
    return value > delta ? value * value * value : 3 * delta * delta * (value - 4.0 / 29);
}

mtm_xyz mtm_xyz_from_lab(mtm_lab lab, mtm_xyz white) {
    assert(white.x > 0 && white.y > 0 && white.z > 0);
    const double y = (lab.l + 16) / 116;
    return (mtm_xyz){white.x * lab_curve_inverse(y + lab.a / 500), white.y * lab_curve_inverse(y),
                     white.z * lab_curve_inverse(y - lab.b / 200)};
}

static double clip(double value) {
    return value > 0 ? fmin(value, 1) : 0;
}

mtm_rgb mtm_rgb_clip(mtm_rgb linear) {
    return (mtm_rgb){clip(linear.r), clip(linear.g), clip(linear.b)};
}

mtm_lab mtm_lab_shown(mtm_rgb linear) {
    return mtm_lab_from_xyz(mtm_xyz_from_rgb(mtm_rgb_clip(linear)), mtm_white_d65());
}

/* The responses of Bradford's cones, or x, y, z themselves, to a white. */
static void respond(const double cones[3][3], mtm_xyz white, double responses[3]) {
    for (int i = 0; i < 3; i++) responses[i] = apply_row(cones[i], white.x, white.y, white.z);
}

/* Bradford's sharpened cones are negative for some colors. Near there a response, divided by, would turn a light's small
 * difference into a large one of the picture; x, y and z cannot do that, they are sums of what is not negative. */
static mtm_matrix3 choose_cones(mtm_xyz white) {
    static const mtm_matrix3 xyz = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    static const double least_share = 0.01; /* of y; HP1, nearly monochromatic yellow, has 0.1 */
    double responses[3];
    respond(bradford_cones.m, white, responses);
    for (int i = 0; i < 3; i++)
        if (!(responses[i] >= least_share * white.y)) return xyz;
    return bradford_cones;
}

void mtm_bradford(mtm_xyz from_white, mtm_xyz to_white, double matrix[3][3]) {
    assert(from_white.y > 0 && to_white.y > 0);
    const mtm_matrix3 cones = choose_cones(from_white);
    mtm_matrix3 scaled = cones;
    double from[3];
    double to[3];
    respond(cones.m, from_white, from);
    respond(cones.m, to_white, to);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3 && from[i] != 0; j++) scaled.m[i][j] *= to[i] / from[i];
    const mtm_matrix3 product = mtm_matrix3_multiply(inverse_of(cones), scaled);
    memcpy(matrix, product.m, sizeof product.m);
}
