/* SPDX-License-Identifier: BSD-3-Clause
 * Linear sRGB to its 8-bit level, exactly the nearest to 255 · mtm_srgb_encode, without a power per channel. Inline,
 * because it is the inner loop of kernels. */
#ifndef METAMER_COLOR_SRGB_LEVELS_H
#define METAMER_COLOR_SRGB_LEVELS_H

#include <stdint.h>
#include <string.h>

enum {
    MTM_SRGB_OCTAVES = 13, /* from 2^-13, which is level 0, to 1 */
    MTM_SRGB_BUCKET_BITS =
        16, /* of the mantissa: 128 buckets an octave, narrow enough for one threshold each */
    MTM_SRGB_BUCKETS = MTM_SRGB_OCTAVES << (23 - MTM_SRGB_BUCKET_BITS),
    MTM_SRGB_LOWEST_BITS = (127 - MTM_SRGB_OCTAVES) << 23, /* 2^-13 as float */
};

/* [level]: the smallest number that has this level or a higher one; [256]: infinity. */
extern const double mtm_srgb_thresholds[257];

/* For floats: the bits above MTM_SRGB_BUCKET_BITS choose a bucket, and adding those below to its entry carries into
 * the level (above the same bit) from the threshold on. */
typedef struct mtm_srgb_levels {
    uint32_t buckets[MTM_SRGB_BUCKETS];
} mtm_srgb_levels;

/* Takes about two microseconds. */
void mtm_srgb_levels_prepare(mtm_srgb_levels *levels);

/* The level of a float: 0 for what is not a number, clipped outside 0..1. */
static inline uint32_t mtm_srgb_level(const mtm_srgb_levels *levels, float linear) {
    const float lowest = 0x1p-13F;
    const float highest = 0x1.fffffep-1F; /* before 1 */
    float clipped = linear > lowest ? linear : lowest;
    clipped = clipped < highest ? clipped : highest;
    uint32_t bits;
    memcpy(&bits, &clipped, sizeof bits);
    bits -= MTM_SRGB_LOWEST_BITS;
    const uint32_t below_mask = (1U << MTM_SRGB_BUCKET_BITS) - 1;
    return (levels->buckets[bits >> MTM_SRGB_BUCKET_BITS] + (bits & below_mask)) >> MTM_SRGB_BUCKET_BITS;
}

/* The level of a number between floats: that of the float before it, or one more. */
static inline uint32_t mtm_srgb_level_of_double(const mtm_srgb_levels *levels, double linear) {
    const double clipped = linear > 0 ? linear < 1 ? linear : 1 : 0;
    float before = (float)clipped;
    uint32_t bits;
    memcpy(&bits, &before, sizeof bits);
    bits -= (double)before > clipped;
    memcpy(&before, &bits, sizeof bits);
    const uint32_t level = mtm_srgb_level(levels, before);
    return level + (clipped >= mtm_srgb_thresholds[level + 1]);
}

#endif
