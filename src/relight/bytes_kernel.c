/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination (paper section 5) to bytes, in blocks of pixels: their quads of lanes are transposed into vectors of
 * one coefficient of many pixels, and from there on the channels lie apart. Blocks that hold nothing cost no product. */
#include "relight/bytes_kernel.h"

#include "base/half.h"
#include "base/vector.h"

enum {
    BLOCK = 64, /* pixels, several vectors: their chains of operations overlap */
    BLOCK_NUMBERS_MAX = BLOCK * (MTM_DIMENSION_MAX + 1),
};

typedef struct pixel_block {
    float rgb[3][BLOCK];
    float alpha[BLOCK];
} pixel_block;

/* Whether all of the numbers are 0 but for the bits that `mask` leaves out, their signs. Where there is something, it
 * is mostly found at once. */
MTM_INLINE bool are_zero(const unsigned char *numbers, size_t bytes, int32_t mask) {
    for (size_t i = 0; i < bytes; i += sizeof(mtm_vector_int)) {
        mtm_vector_int bits;
        memcpy(&bits, numbers + i, sizeof bits);
        if (!mtm_vector_lack_all(bits, mask)) return false;
    }
    return true;
}

/* A vector of pixels from the n-th on; the sums in the order of mtm_relight_pixels. */
MTM_INLINE void multiply(const mtm_relight_pass *pass, const float *pixels, int lanes, int n,
                         pixel_block *block) {
    mtm_vector sum[3] = {{0}, {0}, {0}};
    pixels += n * lanes;
    for (int quad = 0; quad < lanes; quad += 4) {
        mtm_vector columns[4];
        for (int i = 0; i < 4; i++)
            columns[i] = mtm_vector_load_quads(pixels + i * lanes + quad, 4 * (size_t)lanes);
        mtm_vector_transpose(columns);
        for (int i = 0; i < 4; i++)
            for (int channel = 0; channel < 3; channel++)
                sum[channel] += pass->matrix[channel][quad + i] * columns[i];
        for (int i = 0; i < 4; i++)
            if (quad + i == pass->dimension) mtm_vector_store(columns[i], block->alpha + n);
    }
    for (int channel = 0; channel < 3; channel++) mtm_vector_store(sum[channel], block->rgb[channel] + n);
}

MTM_INLINE void add_background(const mtm_relight_pass *pass, pixel_block *block) {
    for (int channel = 0; channel < 3; channel++)
        for (int n = 0; n < BLOCK; n++)
            block->rgb[channel][n] += (1 - block->alpha[n]) * pass->background[channel];
}

#if MTM_VECTOR_WIDTH > 4
/* At e mod 16: 255 · 1.055 · 2^13 · 2^((e − 127) · 5/12), for floats with the exponent e = 118 … 126. */
static const float factors[16] = {
    0,           0,           0,           0,           0,          0,           163802.339F, 218649.891F,
    291862.588F, 389589.815F, 520040.012F, 694170.133F, 926605.96F, 1236870.56F, 1651024.12F, 0};

/* The level of a color (IEC 61966-2-1) in 13-bit fixed point, half a level added for rounding and 4 units more. Above
 * the linear part of the curve m^(5/12) of the mantissa m is a minimax polynomial (relative error 1.2e-6) and the
 * exponent a factor. Altogether the error is less than 4 units (2.8 over all floats). */
MTM_INLINE mtm_vector_int approximate_level(mtm_vector color) {
    const float unit = 1 << 13;
    const mtm_vector x = mtm_vector_clamp(color, 0, 0x1.fffffep-1F);
    const mtm_vector_int bits = (mtm_vector_int)x;
    const mtm_vector m = (mtm_vector)((bits & 0x7fffff) | 0x3f800000);
    mtm_vector power = mtm_vector_fused(m, mtm_vector_all(0.00543537317F), mtm_vector_all(-0.0514170155F));
    power = mtm_vector_fused(power, m, mtm_vector_all(0.208567783F));
    power = mtm_vector_fused(power, m, mtm_vector_all(-0.491730154F));
    power = mtm_vector_fused(power, m, mtm_vector_all(0.952814877F));
    power = mtm_vector_fused(power, m, mtm_vector_all(0.376330316F));
    const mtm_vector above = mtm_vector_fused(mtm_vector_lookup(factors, bits >> 23), power,
                                              mtm_vector_all((0.5F - 0.055F * 255) * unit + 4));
    const mtm_vector below =
        mtm_vector_fused(x, mtm_vector_all(12.92F * 255 * unit), mtm_vector_all(0.5F * unit + 4));
    return __builtin_convertvector(mtm_vector_choose(x, 0.0031308F, below, above), mtm_vector_int);
}

/* Colors with full alpha; bit n of the result: the n-th pixel is within 4 units of a threshold and remains to be done.
 * That is one color in a thousand of all between 0 and 1. */
MTM_INLINE uint64_t encode_certain(float color[3][BLOCK], unsigned char *rgba) {
    uint64_t doubtful = 0;
    for (int n = 0; n < BLOCK; n += MTM_VECTOR_WIDTH) {
        mtm_vector_int packed = (mtm_vector_int){0} | -0x1000000;
        for (int channel = 0; channel < 3; channel++) {
            const mtm_vector_int level = approximate_level(mtm_vector_load(color[channel] + n));
            doubtful |= (uint64_t)mtm_vector_lacks(level, 0x1ff8) << n;
            packed |= level >> 13 << 8 * channel;
        }
        memcpy(rgba + (ptrdiff_t)4 * n, &packed, sizeof packed);
    }
    return doubtful;
}
#else
/* Nothing is certain. */
MTM_INLINE uint64_t encode_certain(float color[3][BLOCK], unsigned char *rgba) {
    (void)color;
    memset(rgba, 255, (size_t)4 * BLOCK);
    return UINT64_MAX;
}
#endif

MTM_INLINE void encode_opaque(const mtm_srgb_levels *levels, pixel_block *block, unsigned char *rgba) {
    uint64_t doubtful = encode_certain(block->rgb, rgba);
    for (; doubtful != 0; doubtful &= doubtful - 1) {
        const int n = __builtin_ctzll(doubtful);
        for (int channel = 0; channel < 3; channel++)
            rgba[4 * n + channel] = (unsigned char)mtm_srgb_level(levels, block->rgb[channel][n]);
    }
}

MTM_INLINE float clip(float value) {
    const float positive = value > 0 ? value : 0; /* what is not a number becomes 0 */
    return positive < 1 ? positive : 1;
}

/* As the PNG writer: alpha is at least the largest channel, so that straight color does not exceed 1. */
MTM_INLINE void clip_block(pixel_block *block) {
    for (int n = 0; n < BLOCK; n++) {
        float alpha = clip(block->alpha[n]);
        for (int channel = 0; channel < 3; channel++) {
            const float color = clip(block->rgb[channel][n]);
            block->rgb[channel][n] = color;
            alpha = color > alpha ? color : alpha;
        }
        block->alpha[n] = alpha;
    }
}

/* The quotient that counts is of doubles; that of floats is so near that what is certain of it is certain. */
MTM_INLINE void encode_straight(const mtm_srgb_levels *levels, pixel_block *block, unsigned char *rgba) {
    float straight[3][BLOCK];
    int32_t alpha[BLOCK];
    clip_block(block);
    for (int channel = 0; channel < 3; channel++)
        for (int n = 0; n < BLOCK; n++)
            straight[channel][n] = block->rgb[channel][n] / block->alpha[n]; /* 0/0: black */
    uint64_t doubtful = encode_certain(straight, rgba);
    for (; doubtful != 0; doubtful &= doubtful - 1) {
        const int n = __builtin_ctzll(doubtful);
        for (int channel = 0; channel < 3; channel++) {
            const double quotient = (double)block->rgb[channel][n] / block->alpha[n];
            rgba[4 * n + channel] = (unsigned char)mtm_srgb_level_of_double(levels, quotient);
        }
    }
    for (int n = 0; n < BLOCK; n++) alpha[n] = (int32_t)((double)block->alpha[n] * 255 + 0.5);
    for (int n = 0; n < BLOCK; n++) rgba[4 * n + 3] = (unsigned char)alpha[n];
}

MTM_INLINE void light_block(const mtm_bytes_pass *pass, const float *pixels, int lanes, unsigned char *rgba) {
    pixel_block block;
    for (int n = 0; n < BLOCK; n += MTM_VECTOR_WIDTH) multiply(&pass->relight, pixels, lanes, n, &block);
    if (pass->relight.is_opaque) {
        add_background(&pass->relight, &block);
        encode_opaque(&pass->levels, &block, rgba);
    } else {
        encode_straight(&pass->levels, &block, rgba);
    }
}

MTM_INLINE void relight_block(const mtm_bytes_pass *pass, const void *pixels, bool is_half, int lanes,
                              unsigned char *rgba) {
    const int count = BLOCK * lanes;
    const bool is_empty = is_half ? are_zero(pixels, (size_t)count * 2, 0x7fff7fff)
                                  : are_zero(pixels, (size_t)count * 4, 0x7fffffff);
    if (is_empty) {
        for (int n = 0; n < BLOCK; n++) memcpy(rgba + (ptrdiff_t)4 * n, &pass->empty, 4);
    } else if (is_half) {
        float floats[BLOCK_NUMBERS_MAX];
        mtm_floats_of_halves(count, pixels, floats);
        light_block(pass, floats, lanes, rgba);
    } else {
        light_block(pass, pixels, lanes, rgba);
    }
}

/* The pixels behind the last whole block are copied into one. */
MTM_INLINE void relight_blocks(const mtm_bytes_pass *pass, const void *pixels, bool is_half, int lanes,
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
MTM_INLINE void relight_pixels(const mtm_bytes_pass *pass, const void *pixels, bool is_half, size_t count,
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
