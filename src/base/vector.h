/* SPDX-License-Identifier: BSD-3-Clause
 * Vectors of the width that the instruction set of a kernel has, for the few places where plain loops measurably lose:
 * the vector extensions of gcc and clang, and intrinsics for what these cannot say. */
#ifndef METAMER_BASE_VECTOR_H
#define METAMER_BASE_VECTOR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define MTM_VECTOR_WIDTH 16
#elif defined(__AVX2__) && defined(__FMA__)
#define MTM_VECTOR_WIDTH 8
#else
#define MTM_VECTOR_WIDTH 4
#endif

#if MTM_VECTOR_WIDTH > 4
#include <immintrin.h>
#endif

typedef float mtm_vector __attribute__((vector_size(4 * MTM_VECTOR_WIDTH)));
typedef int32_t mtm_vector_int __attribute__((vector_size(4 * MTM_VECTOR_WIDTH)));

/* Called with constants from hot loops, and too long for the compiler to think so. */
#define MTM_INLINE static inline __attribute__((always_inline))

MTM_INLINE mtm_vector mtm_vector_load(const float *from) {
    mtm_vector vector;
    memcpy(&vector, from, sizeof vector);
    return vector;
}

MTM_INLINE void mtm_vector_store(mtm_vector vector, float *to) {
    memcpy(to, &vector, sizeof vector);
}

/* Quads of 4 floats one behind the other: those at from, from + stride, … */
MTM_INLINE mtm_vector mtm_vector_load_quads(const float *from, size_t stride) {
#if MTM_VECTOR_WIDTH == 4
    (void)stride;
    return mtm_vector_load(from);
#else
    const __m256 low =
        _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from)), _mm_loadu_ps(from + stride), 1);
#if MTM_VECTOR_WIDTH == 8
    return low;
#else
    const __m256 high = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from + 2 * stride)),
                                             _mm_loadu_ps(from + 3 * stride), 1);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
#endif
#endif
}

/* In every quad: two elements of x and then two of y, by constant indices 0 … 3. */
#define MTM_VECTOR_INDICES(quad, x0, x1, y0, y1)                                                             \
    (x0) + 4 * (quad), (x1) + 4 * (quad), (y0) + 4 * (quad) + MTM_VECTOR_WIDTH,                              \
        (y1) + 4 * (quad) + MTM_VECTOR_WIDTH
#if MTM_VECTOR_WIDTH == 4
#define MTM_VECTOR_SHUFFLE(x, y, x0, x1, y0, y1)                                                             \
    __builtin_shufflevector(x, y, MTM_VECTOR_INDICES(0, x0, x1, y0, y1))
#elif MTM_VECTOR_WIDTH == 8
#define MTM_VECTOR_SHUFFLE(x, y, x0, x1, y0, y1)                                                             \
    __builtin_shufflevector(x, y, MTM_VECTOR_INDICES(0, x0, x1, y0, y1),                                     \
                            MTM_VECTOR_INDICES(1, x0, x1, y0, y1))
#else
#define MTM_VECTOR_SHUFFLE(x, y, x0, x1, y0, y1)                                                             \
    __builtin_shufflevector(x, y, MTM_VECTOR_INDICES(0, x0, x1, y0, y1),                                     \
                            MTM_VECTOR_INDICES(1, x0, x1, y0, y1), MTM_VECTOR_INDICES(2, x0, x1, y0, y1),    \
                            MTM_VECTOR_INDICES(3, x0, x1, y0, y1))
#endif

/* Transposes the 4×4 matrix that the first, second, … quads of the four vectors are. */
MTM_INLINE void mtm_vector_transpose(mtm_vector v[4]) {
    const mtm_vector low01 = MTM_VECTOR_SHUFFLE(v[0], v[1], 0, 1, 0, 1);
    const mtm_vector high01 = MTM_VECTOR_SHUFFLE(v[0], v[1], 2, 3, 2, 3);
    const mtm_vector low23 = MTM_VECTOR_SHUFFLE(v[2], v[3], 0, 1, 0, 1);
    const mtm_vector high23 = MTM_VECTOR_SHUFFLE(v[2], v[3], 2, 3, 2, 3);
    v[0] = MTM_VECTOR_SHUFFLE(low01, low23, 0, 2, 0, 2);
    v[1] = MTM_VECTOR_SHUFFLE(low01, low23, 1, 3, 1, 3);
    v[2] = MTM_VECTOR_SHUFFLE(high01, high23, 0, 2, 0, 2);
    v[3] = MTM_VECTOR_SHUFFLE(high01, high23, 1, 3, 1, 3);
}

/* Whether no element has any of the mask's bits. */
MTM_INLINE bool mtm_vector_lack_all(mtm_vector_int x, int32_t mask) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_test_epi32_mask((__m512i)x, _mm512_set1_epi32(mask)) == 0;
#elif MTM_VECTOR_WIDTH == 8
    return _mm256_testz_si256((__m256i)x, _mm256_set1_epi32(mask)) != 0;
#else
    uint64_t halves[2];
    memcpy(halves, &x, sizeof halves);
    return ((halves[0] | halves[1]) & ((uint64_t)mask << 32 | (uint32_t)mask)) == 0;
#endif
}

/* ---- What packets of rays need, at every width. Everything but mtm_vector_fused is IEEE or integer arithmetic, so the
 * same bits. ---- */

/* Bit i belongs to element i. */
#if MTM_VECTOR_WIDTH == 16
typedef __mmask16 mtm_mask;
#else
typedef mtm_vector_int mtm_mask; /* an element is 0 or -1 */
#endif

MTM_INLINE mtm_vector mtm_vector_all(float value) {
    return value - (mtm_vector){0};
}
MTM_INLINE mtm_vector_int mtm_vector_all_int(int32_t value) {
    return value - (mtm_vector_int){0};
}
MTM_INLINE mtm_vector mtm_vector_of_int(mtm_vector_int x) {
    return __builtin_convertvector(x, mtm_vector);
}
MTM_INLINE mtm_vector_int mtm_vector_truncate(mtm_vector x) {
    return __builtin_convertvector(x, mtm_vector_int);
}
/* x · y + z, rounded once where there is such an instruction: not for what must be the same bits with every instruction
 * set. */
MTM_INLINE mtm_vector mtm_vector_fused(mtm_vector x, mtm_vector y, mtm_vector z) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_fmadd_ps(x, y, z);
#elif MTM_VECTOR_WIDTH == 8
    return _mm256_fmadd_ps(x, y, z);
#else
    return x * y + z;
#endif
}

/* To the nearest integer, the even one of two; |x| < 2^22. */
MTM_INLINE mtm_vector_int mtm_vector_round(mtm_vector x) {
#if MTM_VECTOR_WIDTH == 16
    return (mtm_vector_int)_mm512_cvtps_epi32(x);
#elif MTM_VECTOR_WIDTH == 8
    return (mtm_vector_int)_mm256_cvtps_epi32(x);
#else
    const mtm_vector magic = mtm_vector_all(12582912.0f); /* 1.5 · 2^23: the sum's last bit is worth 1 */
    return (mtm_vector_int)(x + magic) - (mtm_vector_int)magic;
#endif
}

/* x < y, x ≤ y */
MTM_INLINE mtm_mask mtm_vector_less(mtm_vector x, mtm_vector y) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_cmp_ps_mask(x, y, _CMP_LT_OQ);
#else
    return x < y;
#endif
}
MTM_INLINE mtm_mask mtm_vector_less_int(mtm_vector_int x, mtm_vector_int y) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_cmplt_epi32_mask((__m512i)x, (__m512i)y);
#else
    return x < y;
#endif
}

/* x where the mask is set, else y. */
MTM_INLINE mtm_vector mtm_vector_select(mtm_mask mask, mtm_vector x, mtm_vector y) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_mask_blend_ps(mask, y, x);
#elif MTM_VECTOR_WIDTH == 8
    return _mm256_blendv_ps(y, x, (__m256)mask);
#else
    return (mtm_vector)((mask & (mtm_vector_int)x) | (~mask & (mtm_vector_int)y));
#endif
}
MTM_INLINE mtm_vector_int mtm_vector_select_int(mtm_mask mask, mtm_vector_int x, mtm_vector_int y) {
    return (mtm_vector_int)mtm_vector_select(mask, (mtm_vector)x, (mtm_vector)y);
}

MTM_INLINE mtm_mask mtm_mask_and(mtm_mask x, mtm_mask y) {
    return (mtm_mask)(x & y);
}
MTM_INLINE mtm_mask mtm_mask_not(mtm_mask x) {
    return (mtm_mask)~x;
}
MTM_INLINE uint32_t mtm_mask_bits(mtm_mask mask) {
#if MTM_VECTOR_WIDTH == 16
    return mask;
#elif MTM_VECTOR_WIDTH == 8
    return (uint32_t)_mm256_movemask_ps((__m256)mask);
#else
    uint32_t bits = 0;
    for (int i = 0; i < MTM_VECTOR_WIDTH; i++) bits |= (uint32_t)(mask[i] & 1) << i;
    return bits;
#endif
}

/* y where either is not a number, like the processors' own. */
MTM_INLINE mtm_vector mtm_vector_min(mtm_vector x, mtm_vector y) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_min_ps(x, y);
#elif MTM_VECTOR_WIDTH == 8
    return _mm256_min_ps(x, y);
#else
    return mtm_vector_select(x < y, x, y);
#endif
}
MTM_INLINE mtm_vector mtm_vector_max(mtm_vector x, mtm_vector y) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_max_ps(x, y);
#elif MTM_VECTOR_WIDTH == 8
    return _mm256_max_ps(x, y);
#else
    return mtm_vector_select(x > y, x, y);
#endif
}
MTM_INLINE mtm_vector_int mtm_vector_min_int(mtm_vector_int x, mtm_vector_int y) {
#if MTM_VECTOR_WIDTH == 16
    return (mtm_vector_int)_mm512_min_epi32((__m512i)x, (__m512i)y);
#elif MTM_VECTOR_WIDTH == 8
    return (mtm_vector_int)_mm256_min_epi32((__m256i)x, (__m256i)y);
#else
    return mtm_vector_select_int(x < y, x, y);
#endif
}

MTM_INLINE mtm_vector mtm_vector_abs(mtm_vector x) {
    return (mtm_vector)((mtm_vector_int)x & 0x7FFFFFFF);
}

MTM_INLINE mtm_vector mtm_vector_square_root(mtm_vector x) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_sqrt_ps(x);
#elif MTM_VECTOR_WIDTH == 8
    return _mm256_sqrt_ps(x);
#else
    for (int i = 0; i < MTM_VECTOR_WIDTH; i++) x[i] = sqrtf(x[i]);
    return x;
#endif
}

/* 1 / x and 1 / √x for x > 0, to two units in the last place or better, which may differ from one instruction set to
 * another: an estimate and one step of Newton's. */
MTM_INLINE mtm_vector mtm_vector_reciprocal(mtm_vector x) {
#if MTM_VECTOR_WIDTH == 16
    const mtm_vector estimate = _mm512_rcp14_ps(x);
    return estimate * _mm512_fnmadd_ps(x, estimate, _mm512_set1_ps(2));
#elif MTM_VECTOR_WIDTH == 8
    const mtm_vector estimate = _mm256_rcp_ps(x);
    return estimate * _mm256_fnmadd_ps(x, estimate, _mm256_set1_ps(2));
#else
    return 1.0f / x;
#endif
}
MTM_INLINE mtm_vector mtm_vector_reciprocal_root(mtm_vector x) {
#if MTM_VECTOR_WIDTH == 16
    const mtm_vector estimate = _mm512_rsqrt14_ps(x);
    return estimate * _mm512_fnmadd_ps(x * 0.5f, estimate * estimate, _mm512_set1_ps(1.5f));
#elif MTM_VECTOR_WIDTH == 8
    const mtm_vector estimate = _mm256_rsqrt_ps(x);
    return estimate * _mm256_fnmadd_ps(x * 0.5f, estimate * estimate, _mm256_set1_ps(1.5f));
#else
    return 1.0f / mtm_vector_square_root(x);
#endif
}

/* Elements as an array in memory: compilers else take them out of the vector one by one, which takes longer. */
MTM_INLINE void mtm_vector_spill(mtm_vector_int x, int32_t to[MTM_VECTOR_WIDTH]) {
    memcpy(to, &x, sizeof x);
    __asm__("" : "+m"(*(int32_t(*)[MTM_VECTOR_WIDTH])to));
}

MTM_INLINE void mtm_vector_spill_floats(mtm_vector x, float to[MTM_VECTOR_WIDTH]) {
    memcpy(to, &x, sizeof x);
    __asm__("" : "+m"(*(float(*)[MTM_VECTOR_WIDTH])to));
}

#if MTM_VECTOR_WIDTH > 4
MTM_INLINE __m128 mtm_load_two_pairs(const int32_t *first, const int32_t *second) {
    return _mm_castsi128_ps(
        _mm_unpacklo_epi64(_mm_loadl_epi64((const void *)first), _mm_loadl_epi64((const void *)second)));
}
#endif

/* table[index] and table[index + 1]. Loads of pairs take half the time of the processors' own gathers. */
MTM_INLINE void mtm_vector_gather_pairs(const int32_t *table, mtm_vector_int index, mtm_vector_int *at,
                                        mtm_vector_int *behind) {
    int32_t i[MTM_VECTOR_WIDTH];
    mtm_vector_spill(index, i);
#if MTM_VECTOR_WIDTH == 4
    for (int n = 0; n < MTM_VECTOR_WIDTH; n++) {
        (*at)[n] = table[i[n]];
        (*behind)[n] = table[i[n] + 1];
    }
#else
    /* Quads of two pairs: samples 0 1, 4 5, … and 2 3, 6 7, … */
    mtm_vector pairs[2];
    for (int half = 0; half < 2; half++) {
        const int32_t *at_half = i + 2 * half;
        const __m256 low = _mm256_insertf128_ps(
            _mm256_castps128_ps256(mtm_load_two_pairs(table + at_half[0], table + at_half[1])),
            mtm_load_two_pairs(table + at_half[4], table + at_half[5]), 1);
#if MTM_VECTOR_WIDTH == 8
        pairs[half] = low;
#else
        const __m256 high = _mm256_insertf128_ps(
            _mm256_castps128_ps256(mtm_load_two_pairs(table + at_half[8], table + at_half[9])),
            mtm_load_two_pairs(table + at_half[12], table + at_half[13]), 1);
        pairs[half] = _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
#endif
    }
    *at = (mtm_vector_int)MTM_VECTOR_SHUFFLE(pairs[0], pairs[1], 0, 2, 0, 2);
    *behind = (mtm_vector_int)MTM_VECTOR_SHUFFLE(pairs[0], pairs[1], 1, 3, 1, 3);
#endif
}

#if MTM_VECTOR_WIDTH > 4

/* `low` where x is not a number. */
MTM_INLINE mtm_vector mtm_vector_clamp(mtm_vector x, float low, float high) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_min_ps(_mm512_max_ps(x, _mm512_set1_ps(low)), _mm512_set1_ps(high));
#else
    return _mm256_min_ps(_mm256_max_ps(x, _mm256_set1_ps(low)), _mm256_set1_ps(high));
#endif
}

/* table[index % 16] */
MTM_INLINE mtm_vector mtm_vector_lookup(const float table[16], mtm_vector_int index) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_permutexvar_ps((__m512i)index, _mm512_loadu_ps(table));
#else
    const __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), (__m256i)index);
    const __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), (__m256i)index);
    return _mm256_blendv_ps(low, high, (__m256)(index << 28));
#endif
}

/* below where x <= bound, else above */
MTM_INLINE mtm_vector mtm_vector_choose(mtm_vector x, float bound, mtm_vector below, mtm_vector above) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_mask_blend_ps(_mm512_cmp_ps_mask(x, _mm512_set1_ps(bound), _CMP_LE_OQ), above, below);
#else
    return _mm256_blendv_ps(above, below, _mm256_cmp_ps(x, _mm256_set1_ps(bound), _CMP_LE_OQ));
#endif
}

/* Bit i: whether element i has none of the mask's bits. */
MTM_INLINE uint32_t mtm_vector_lacks(mtm_vector_int x, int32_t mask) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_testn_epi32_mask((__m512i)x, _mm512_set1_epi32(mask));
#else
    const __m256i masked = _mm256_and_si256((__m256i)x, _mm256_set1_epi32(mask));
    return (uint32_t)_mm256_movemask_ps((__m256)_mm256_cmpeq_epi32(masked, _mm256_setzero_si256()));
#endif
}
#endif

#endif
