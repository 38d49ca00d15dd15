/* SPDX-License-Identifier: BSD-3-Clause
 * The color error that the fit makes small, with its gradient, from + − × ÷ and the square root only, which IEEE 754
 * rounds alike everywhere. */
#ifndef METAMER_ACCURACY_LAB_ERROR_H
#define METAMER_ACCURACY_LAB_ERROR_H

/* The cube root of x > 0 to about a unit in the last place. */
double cube_root(double x);

/* A color to be met: what takes XYZ to the error. */
typedef struct lab_target {
    double scale[3]; /* gain / white */
    double f[3];     /* CIELAB's f of the scaled true color */
    /* From differences of f to differences of lightness, chroma and hue as CIE94 weighs them. */
    double weights[3][3];
} lab_target;

/* The target for a true color under a white (all of `white` > 0), the color times `gain`. */
lab_target lab_target_of(const double xyz[3], const double white[3], double gain);

/* √(ΔE² + 0.01) − 0.1, nearly the color difference and smooth at 0, where ΔE is that of CIE94 with the weights of the
 * true color, and its gradient with respect to `xyz`. */
double lab_error(const lab_target *target, const double xyz[3], double gradient[3]);

#endif
