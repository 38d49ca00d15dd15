/* SPDX-License-Identifier: BSD-3-Clause
 * IEEE 754 binary16. Inline, because converting is part of kernels; every instruction set gives the same floats. */
#ifndef METAMER_BASE_HALF_H
#define METAMER_BASE_HALF_H

#include <stdint.h>
#include <string.h>

#ifdef __F16C__
#include <immintrin.h>
#endif

/* binary32 holds every half exactly. Shifted in place, a half's exponent is 112 too small, also that of the smallest
 * numbers, which have no leading 1; infinity and what is not a number keep all ones. */
static inline float mtm_float_of_half(uint16_t half) {
    const uint32_t shifted = (uint32_t)(half & 0x7fffU) << 13;
    float value;
    memcpy(&value, &shifted, sizeof value);
    value *= 0x1p112F;
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    bits |= (shifted >= 0x0f800000U ? 0x7f800000U : 0) | (uint32_t)(half & 0x8000U) << 16;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline void mtm_floats_of_halves(int count, const uint16_t *halves, float *floats) {
    int i = 0;
#ifdef __AVX512F__
    for (; i + 16 <= count; i += 16)
        _mm512_storeu_ps(floats + i, _mm512_cvtph_ps(_mm256_loadu_si256((const __m256i *)(halves + i))));
#elif defined(__F16C__)
    for (; i + 8 <= count; i += 8)
        _mm256_storeu_ps(floats + i, _mm256_cvtph_ps(_mm_loadu_si128((const __m128i *)(halves + i))));
#endif
    for (; i < count; i++) floats[i] = mtm_float_of_half(halves[i]);
}

/* The nearest half, the even one of two; from 65520 on infinity, also below the other end. */
uint16_t mtm_half_of_float(float value);

#endif
