/* SPDX-License-Identifier: BSD-3-Clause
 * Rounding to IEEE 754 binary16. */
#include "base/half.h"

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* Below 2^-14 halves are multiples of 2^-24, the last place of 0.5, so that adding 0.5 rounds. Above, the 13 bits that
 * are dropped round up from their half on, to even when they are just that; a carry moves on into the exponent. */
static uint32_t round_magnitude(float magnitude) {
    const uint32_t bits = bits_of(magnitude);
    if (bits > 0x7f800000U) return 0x7e00U; /* not a number */
    if (magnitude >= 65520) return 0x7c00U;
    if (magnitude < 0x1p-14F) return bits_of(magnitude + 0.5F) - bits_of(0.5F);
    const uint32_t is_odd = bits >> 13 & 1;
    return ((bits + 0xfffU + is_odd) >> 13) - (112U << 10);
}

uint16_t mtm_half_of_float(float value) {
    const uint32_t bits = bits_of(value);
    const uint32_t magnitude_bits = bits & 0x7fffffffU;
    float magnitude;
    memcpy(&magnitude, &magnitude_bits, sizeof magnitude);
    return (uint16_t)((bits >> 16 & 0x8000U) | round_magnitude(magnitude));
}
