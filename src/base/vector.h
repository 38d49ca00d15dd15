/* SPDX-License-Identifier: BSD-3-Clause
 * Vectors of the width that the instruction set of a kernel has, for the few places where plain loops measurably lose:
 * the vector extensions of gcc and clang, and intrinsics for what these cannot say. */
#ifndef METAMER_BASE_VECTOR_H
#define METAMER_BASE_VECTOR_H

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

#if MTM_VECTOR_WIDTH > 4

/* `low` where x is not a number. */
MTM_INLINE mtm_vector mtm_vector_clamp(mtm_vector x, float low, float high) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_min_ps(_mm512_max_ps(x, _mm512_set1_ps(low)), _mm512_set1_ps(high));
#else
    return _mm256_min_ps(_mm256_max_ps(x, _mm256_set1_ps(low)), _mm256_set1_ps(high));
#endif
}

/* x · y + z, rounded once: not for what must be the same bits with every instruction set. */
MTM_INLINE mtm_vector mtm_vector_fused(mtm_vector x, mtm_vector y, mtm_vector z) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_fmadd_ps(x, y, z);
#else
    return _mm256_fmadd_ps(x, y, z);
#endif
}

MTM_INLINE mtm_vector mtm_vector_set(float value) {
#if MTM_VECTOR_WIDTH == 16
    return _mm512_set1_ps(value);
#else
    return _mm256_set1_ps(value);
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
