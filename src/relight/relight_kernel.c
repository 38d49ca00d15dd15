/* SPDX-License-Identifier: BSD-3-Clause
 * The inner loop of postillumination: only pixels that hold anything cost a product (the paper's "fill"). */
#include "relight/relight_kernel.h"

static bool is_empty(const float *pixel, int lanes) {
    for (int i = 0; i < lanes; i++)
        if (pixel[i] != 0) return false;
    return true;
}

static float product(const float *row, const float *pixel, int lanes) {
    float sum = 0;
    for (int i = 0; i < lanes; i++) sum += row[i] * pixel[i];
    return sum;
}

void mtm_relight_pixels(const mtm_relight_pass *pass, const float *pixels, size_t count, float *rgba) {
    const int lanes = pass->lanes;
    for (size_t n = 0; n < count; n++, pixels += lanes, rgba += 4) {
        const float alpha = pixels[pass->dimension];
        const float uncovered = pass->is_opaque ? 1 - alpha : 0;
        const bool is_lit = !is_empty(pixels, lanes);
        for (int channel = 0; channel < 3; channel++)
            rgba[channel] = (is_lit ? product(pass->matrix[channel], pixels, lanes) : 0) +
                            uncovered * pass->background[channel];
        rgba[3] = pass->is_opaque ? 1 : alpha;
    }
}
