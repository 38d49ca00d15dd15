/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination (paper section 5) to bytes, in blocks of pixels: a block's sums lie channel by channel, so that the
 * loops over a block are vector instructions of any width. Blocks that hold nothing cost no product. */
#include "relight/bytes_kernel.h"

#include "base/half.h"

enum { BLOCK = 16, BLOCK_NUMBERS_MAX = BLOCK * (MTM_DIMENSION_MAX + 1) }; /* pixels, their numbers */

typedef struct pixel_block {
    float rgb[3][BLOCK];
    float alpha[BLOCK];
} pixel_block;

static inline bool are_floats_zero(const float *numbers, int count) {
    int found = 0;
    for (int i = 0; i < count; i++) found |= numbers[i] != 0;
    return found == 0;
}

static inline bool are_halves_zero(const uint16_t *numbers, int count) {
    uint16_t found = 0;
    for (int i = 0; i < count; i++) found |= numbers[i];
    return (found & 0x7fffU) == 0;
}

/* The sums in the order of mtm_relight_pixels. */
static inline void multiply(const mtm_relight_pass *pass, const float *pixels, int lanes,
                            pixel_block *block) {
    for (int n = 0; n < BLOCK; n++) {
        const float *pixel = pixels + n * lanes;
        float sum[3];
        for (int channel = 0; channel < 3; channel++) sum[channel] = pass->matrix[channel][0] * pixel[0];
        for (int i = 1; i < lanes; i++)
            for (int channel = 0; channel < 3; channel++) sum[channel] += pass->matrix[channel][i] * pixel[i];
        for (int channel = 0; channel < 3; channel++) block->rgb[channel][n] = sum[channel];
        block->alpha[n] = pixel[pass->dimension];
    }
}

static inline void put_pixel(uint32_t r, uint32_t g, uint32_t b, uint32_t a, unsigned char *rgba) {
    const unsigned char bytes[4] = {(unsigned char)r, (unsigned char)g, (unsigned char)b, (unsigned char)a};
    memcpy(rgba, bytes, sizeof bytes);
}

static inline void encode_over_background(const mtm_bytes_pass *pass, const pixel_block *block,
                                          unsigned char *rgba) {
    uint32_t levels[3][BLOCK];
    for (int channel = 0; channel < 3; channel++) {
        const float background = pass->relight.background[channel];
        for (int n = 0; n < BLOCK; n++) {
            const float color = block->rgb[channel][n] + (1 - block->alpha[n]) * background;
            levels[channel][n] = mtm_srgb_level(&pass->levels, color);
        }
    }
    for (int n = 0; n < BLOCK; n++)
        put_pixel(levels[0][n], levels[1][n], levels[2][n], 255, rgba + (ptrdiff_t)4 * n);
}

static inline float clip(float value) {
    const float positive = value > 0 ? value : 0; /* what is not a number becomes 0 */
    return positive < 1 ? positive : 1;
}

/* As the PNG writer: alpha is at least the largest channel, so that straight color does not exceed 1. */
static inline void encode_straight(const mtm_bytes_pass *pass, const pixel_block *block,
                                   unsigned char *rgba) {
    for (int n = 0; n < BLOCK; n++) {
        float rgb[3];
        float alpha = clip(block->alpha[n]);
        for (int channel = 0; channel < 3; channel++) {
            rgb[channel] = clip(block->rgb[channel][n]);
            alpha = rgb[channel] > alpha ? rgb[channel] : alpha;
        }
        uint32_t level[3];
        for (int channel = 0; channel < 3; channel++) {
            const double straight = alpha > 0 ? (double)rgb[channel] / alpha : 0;
            level[channel] = mtm_srgb_level_of_double(&pass->levels, straight);
        }
        put_pixel(level[0], level[1], level[2], (uint32_t)((double)alpha * 255 + 0.5),
                  rgba + (ptrdiff_t)4 * n);
    }
}

static inline void light_block(const mtm_bytes_pass *pass, const float *pixels, int lanes,
                               unsigned char *rgba) {
    pixel_block block;
    multiply(&pass->relight, pixels, lanes, &block);
    if (pass->relight.is_opaque)
        encode_over_background(pass, &block, rgba);
    else
        encode_straight(pass, &block, rgba);
}

static inline void relight_block(const mtm_bytes_pass *pass, const void *pixels, bool is_half, int lanes,
                                 unsigned char *rgba) {
    const int count = BLOCK * lanes;
    if (is_half ? are_halves_zero(pixels, count) : are_floats_zero(pixels, count)) {
        for (int n = 0; n < BLOCK; n++) memcpy(rgba + (ptrdiff_t)4 * n, pass->empty, 4);
    } else if (is_half) {
        float floats[BLOCK_NUMBERS_MAX];
        mtm_floats_of_halves(count, pixels, floats);
        light_block(pass, floats, lanes, rgba);
    } else {
        light_block(pass, pixels, lanes, rgba);
    }
}

/* The pixels behind the last whole block are copied into one. */
static inline void relight_blocks(const mtm_bytes_pass *pass, const void *pixels, bool is_half, int lanes,
                                  size_t count, unsigned char *rgba) {
    const unsigned char *from = pixels;
    const size_t pixel_bytes = (size_t)lanes * (is_half ? sizeof(uint16_t) : sizeof(float));
    const size_t whole = count - count % BLOCK;
    for (size_t n = 0; n < whole; n += BLOCK)
        relight_block(pass, from + n * pixel_bytes, is_half, lanes, rgba + 4 * n);
    if (whole == count) return;
    float rest[BLOCK_NUMBERS_MAX] = {0};
    unsigned char rest_rgba[BLOCK * 4];
    memcpy(rest, from + whole * pixel_bytes, (count - whole) * pixel_bytes);
    relight_block(pass, rest, is_half, lanes, rest_rgba);
    memcpy(rgba + 4 * whole, rest_rgba, 4 * (count - whole));
}

/* With the number of lanes known the compiler unrolls what runs over them. */
static inline void relight_pixels(const mtm_bytes_pass *pass, const void *pixels, bool is_half, size_t count,
                                  unsigned char *rgba) {
    switch (pass->relight.lanes) {
    case 4: relight_blocks(pass, pixels, is_half, 4, count, rgba); break;
    case 8: relight_blocks(pass, pixels, is_half, 8, count, rgba); break;
    case 16: relight_blocks(pass, pixels, is_half, 16, count, rgba); break;
    default: relight_blocks(pass, pixels, is_half, pass->relight.lanes, count, rgba);
    }
}

static void relight_floats(const mtm_bytes_pass *pass, const void *pixels, size_t count,
                           unsigned char *rgba) {
    relight_pixels(pass, pixels, false, count, rgba);
}

static void relight_halves(const mtm_bytes_pass *pass, const void *pixels, size_t count,
                           unsigned char *rgba) {
    relight_pixels(pass, pixels, true, count, rgba);
}

const mtm_bytes_kernel MTM_OF_ISA(mtm_bytes_kernel) = {relight_floats, relight_halves};
