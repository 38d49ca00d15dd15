/* SPDX-License-Identifier: BSD-3-Clause
 * Adding the coefficients of one step to every ray of a packet: in vectors over the coefficients, ray by ray, so that
 * many coefficients cost little more than three. Included by the kernel only, so compiled per instruction set. */
#ifndef METAMER_RENDER_PACKET_COEFFICIENTS_H
#define METAMER_RENDER_PACKET_COEFFICIENTS_H

#include <string.h>

#include "base/vector.h"

/* Vectors over the coefficients of one ray. */
typedef float four_floats __attribute__((vector_size(16)));
typedef int32_t four_ints __attribute__((vector_size(16)));
typedef float eight_floats __attribute__((vector_size(32)));
typedef int32_t eight_ints __attribute__((vector_size(32)));

#if MTM_VECTOR_WIDTH > 4
#define FUSED_FOUR(x, y, z)  _mm_fmadd_ps(x, y, z)
#define FUSED_EIGHT(x, y, z) _mm256_fmadd_ps(x, y, z)
#else
#define FUSED_FOUR(x, y, z)  ((x) * (y) + (z))
#define FUSED_EIGHT(x, y, z) ((x) * (y) + (z))
#endif

/* sum += weight · (to - from) */
#define ADD_DIFFERENCE(floats, ints, fused, from, to, weight, sum)                                           \
    do {                                                                                                     \
        ints below;                                                                                          \
        ints above;                                                                                          \
        floats all;                                                                                          \
        memcpy(&below, from, sizeof below);                                                                  \
        memcpy(&above, to, sizeof above);                                                                    \
        memcpy(&all, sum, sizeof all);                                                                       \
        all = fused(__builtin_convertvector(above - below, floats), (weight) - (floats){0}, all);            \
        memcpy(sum, &all, sizeof all);                                                                       \
    } while (0)

/* The weighted sums of the coefficients of rows low … high - 1, onto ray i's own; lanes is a multiple of four. */
MTM_INLINE void add_ray(int lanes, const int32_t *low, const int32_t *high, float weight, float *sum) {
    if (lanes % 8 == 4) ADD_DIFFERENCE(four_floats, four_ints, FUSED_FOUR, low, high, weight, sum);
    for (int k = lanes % 8; k < lanes; k += 8)
        ADD_DIFFERENCE(eight_floats, eight_ints, FUSED_EIGHT, low + k, high + k, weight, sum + k);
}

/* For the rays whose bits are set in `seen`; the others' weights are 0. Most packets see with most of their rays: then
 * all of them in a row take less time than finding those that do. */
MTM_INLINE void add_rays(int lanes, const int32_t *table, mtm_vector_int low, mtm_vector_int high,
                         mtm_vector weight, uint32_t seen, float *sums) {
    float weights[MTM_VECTOR_WIDTH];
    int32_t lows[MTM_VECTOR_WIDTH];
    int32_t highs[MTM_VECTOR_WIDTH];
    mtm_vector_spill_floats(weight, weights);
    mtm_vector_spill(low * lanes, lows);
    mtm_vector_spill(high * lanes, highs);
    if (__builtin_popcount(seen) > MTM_VECTOR_WIDTH / 2 && lanes <= 16) {
#pragma GCC unroll 16
        for (int i = 0; i < MTM_VECTOR_WIDTH; i++)
            add_ray(lanes, table + lows[i], table + highs[i], weights[i], sums + i * lanes);
        return;
    }
    for (; seen != 0; seen &= seen - 1) {
        const int i = __builtin_ctz(seen);
        add_ray(lanes, table + lows[i], table + highs[i], weights[i], sums + i * lanes);
    }
}

#if MTM_VECTOR_WIDTH == 16
MTM_INLINE __m512i load_two_rows(const int32_t *first, const int32_t *second) {
    const __m512i low = _mm512_castsi256_si512(_mm256_loadu_si256((const void *)first));
    return _mm512_inserti64x4(low, _mm256_loadu_si256((const void *)second), 1);
}

/* All rays, two of 8 lanes in a vector. */
MTM_INLINE void add_pairs_of_8(const int32_t *table, mtm_vector_int low, mtm_vector_int high,
                               mtm_vector weight, float *sums) {
    int32_t lows[MTM_VECTOR_WIDTH];
    int32_t highs[MTM_VECTOR_WIDTH];
    mtm_vector_spill(low * 8, lows);
    mtm_vector_spill(high * 8, highs);
    __m512i spread = _mm512_setr_epi32(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1);
#pragma GCC unroll 8
    for (int i = 0; i < MTM_VECTOR_WIDTH; i += 2) {
        const __m512i below = load_two_rows(table + lows[i], table + lows[i + 1]);
        const __m512i above = load_two_rows(table + highs[i], table + highs[i + 1]);
        const __m512 weights = _mm512_permutexvar_ps(spread, weight);
        const __m512 mean = _mm512_cvtepi32_ps(_mm512_sub_epi32(above, below));
        _mm512_storeu_ps(sums + 8 * i, _mm512_fmadd_ps(mean, weights, _mm512_loadu_ps(sums + 8 * i)));
        spread = _mm512_add_epi32(spread, _mm512_set1_epi32(2));
    }
}
#endif

/* One for each number of lanes that the compiler is to see as a constant. */
static void add_rays_4(int lanes, const int32_t *table, mtm_vector_int low, mtm_vector_int high,
                       mtm_vector weight, uint32_t seen, float *sums) {
    (void)lanes;
    add_rays(4, table, low, high, weight, seen, sums);
}
static void add_rays_8(int lanes, const int32_t *table, mtm_vector_int low, mtm_vector_int high,
                       mtm_vector weight, uint32_t seen, float *sums) {
    (void)lanes;
#if MTM_VECTOR_WIDTH == 16
    if (__builtin_popcount(seen) > MTM_VECTOR_WIDTH / 2) {
        add_pairs_of_8(table, low, high, weight, sums);
        return;
    }
#endif
    add_rays(8, table, low, high, weight, seen, sums);
}
static void add_rays_16(int lanes, const int32_t *table, mtm_vector_int low, mtm_vector_int high,
                        mtm_vector weight, uint32_t seen, float *sums) {
    (void)lanes;
    add_rays(16, table, low, high, weight, seen, sums);
}
static void add_rays_any(int lanes, const int32_t *table, mtm_vector_int low, mtm_vector_int high,
                         mtm_vector weight, uint32_t seen, float *sums) {
    add_rays(lanes, table, low, high, weight, seen, sums);
}

#endif
