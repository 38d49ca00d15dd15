/* SPDX-License-Identifier: BSD-3-Clause
 * The color error of the fit: CIELAB (CIE 015:2018) with the weights of CIE94 (CIE 116-1995) at the true color, where
 * chroma and hue are straight directions, so that the error is a quadratic form in differences of L*, a*, b*. */
#include "lab_error.h"

#include <math.h>

/* x = m·8ᵏ with m in [1/8, 1), a parabola within 2 % of its root, then two steps of Halley, each of which cubes the
 * error. The second is written as a small correction, so that its rounding hardly shows. */
double cube_root(double x) {
    int exponent = 0;
    double m = frexp(x, &exponent);
    const int remainder = ((exponent % 3) + 3) % 3;
    if (remainder > 0) m = ldexp(m, remainder - 3);
    const int k = (remainder > 0 ? exponent - remainder + 3 : exponent) / 3;
    double y = 0.381 + m * (1.072 - 0.469 * m);
    for (int step = 0; step < 2; step++) {
        const double cube = y * y * y;
        y -= y * (cube - m) / (2 * cube + m);
    }
    return ldexp(y, k);
}

static const double knee = 6.0 / 29; /* CIELAB's f is a line below knee³ and a cube root above */

/* f and its derivative; the line continues below 0. */
static double lab_f(double t, double *slope) {
    if (t <= knee * knee * knee) {
        *slope = 1 / (3 * knee * knee);
        return t * *slope + 4.0 / 29;
    }
    const double f = cube_root(t);
    *slope = 1 / (3 * f * f);
    return f;
}

lab_target lab_target_of(const double xyz[3], const double white[3], double gain) {
    lab_target target;
    double slope;
    for (int i = 0; i < 3; i++) {
        target.scale[i] = gain / white[i];
        target.f[i] = lab_f(xyz[i] * target.scale[i], &slope);
    }
    const double a = 500 * (target.f[0] - target.f[1]);
    const double b = 200 * (target.f[1] - target.f[2]);
    const double chroma = sqrt(a * a + b * b);
    const double cosine = chroma > 1e-6 ? a / chroma : 1;
    const double sine = chroma > 1e-6 ? b / chroma : 0;
    const double chroma_weight = 1 / (1 + 0.045 * chroma);
    const double hue_weight = 1 / (1 + 0.015 * chroma);
    const double lab_from_f[3][3] = {{0, 116, 0}, {500, -500, 0}, {0, 200, -200}};
    const double lch_from_lab[3][3] = {{1, 0, 0},
                                       {0, cosine * chroma_weight, sine * chroma_weight},
                                       {0, -sine * hue_weight, cosine * hue_weight}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            target.weights[i][j] = lch_from_lab[i][0] * lab_from_f[0][j] +
                                   lch_from_lab[i][1] * lab_from_f[1][j] +
                                   lch_from_lab[i][2] * lab_from_f[2][j];
    return target;
}

double lab_error(const lab_target *target, const double xyz[3], double gradient[3]) {
    double difference[3], slope[3], error[3];
    for (int i = 0; i < 3; i++) difference[i] = lab_f(xyz[i] * target->scale[i], &slope[i]) - target->f[i];
    for (int i = 0; i < 3; i++)
        error[i] = target->weights[i][0] * difference[0] + target->weights[i][1] * difference[1] +
                   target->weights[i][2] * difference[2];
    const double floor = 0.1;
    const double length =
        sqrt(error[0] * error[0] + error[1] * error[1] + error[2] * error[2] + floor * floor);
    for (int i = 0; i < 3; i++)
        gradient[i] = (error[0] * target->weights[0][i] + error[1] * target->weights[1][i] +
                       error[2] * target->weights[2][i]) /
                      length * slope[i] * target->scale[i];
    return length - floor;
}
