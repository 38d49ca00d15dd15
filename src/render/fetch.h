/* SPDX-License-Identifier: BSD-3-Clause
 * Reading what a packet of samples needs from the volume: from voxels packed with their gradients, or from the volume's
 * own voxels. Positions are split into a cell and a fraction first. */
#ifndef METAMER_RENDER_FETCH_H
#define METAMER_RENDER_FETCH_H

#include "base/vector.h"
#include "render/raycast.h"

/* Where the samples of a packet are. */
typedef struct packet_place {
    mtm_vector_int cell[3];
    mtm_vector fraction[3]; /* 0 … 1 */
} packet_place;

/* Interpolation weights in fixed point with 14 bits: products with 16-bit voxels fit 32 bits. */
enum { WEIGHT_ONE = 1 << 14 };

/* The weights of the 4 rows of a cell, (y, z) = (0,0), (1,0), (0,1), (1,1), each that of its far voxel (along x) above
 * that of its near one, 16 bits each. They add up to WEIGHT_ONE exactly: what is constant stays so. (The first row's may
 * round to -1.) */
MTM_INLINE void weigh_rows(const packet_place *place, mtm_vector_int weights[4]) {
    const mtm_vector y = place->fraction[1] * (float)WEIGHT_ONE;
    const mtm_vector z = place->fraction[2] * (float)WEIGHT_ONE;
    const mtm_vector_int both = mtm_vector_round(y * place->fraction[2]);
    mtm_vector_int rows[4];
    rows[3] = both;
    rows[1] = mtm_vector_round(y) - both;
    rows[2] = mtm_vector_round(z) - both;
    rows[0] = WEIGHT_ONE - rows[1] - rows[2] - both;
    for (int row = 0; row < 4; row++) {
        const mtm_vector_int far = mtm_vector_round(mtm_vector_of_int(rows[row]) * place->fraction[0]);
        weights[row] = (far << 16) | ((rows[row] - far) & 0xFFFF);
    }
}

/* How the pair of voxels that begins at `row` becomes pairs of 16-bit numbers, component by component. */
#define PAIR_OF_BYTES 0, -1, 4, -1, 1, -1, 5, -1, 2, -1, 6, -1, 3, -1, 7, -1
#define PAIR_OF_WORDS 0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15

#if MTM_VECTOR_WIDTH == 16
/* One sample: 4 rows in 4 lanes of 128 bits; the products' sums over the rows are still to be taken. */
MTM_INLINE __m512i multiply_rows(const char *const rows[4], size_t offset, int voxel_bytes,
                                 mtm_vector weights, int quad) {
    __m512i pairs;
    if (voxel_bytes == 4) {
        pairs = _mm512_castsi128_si512(_mm_loadl_epi64((const void *)(rows[0] + offset)));
        pairs = _mm512_mask_broadcastq_epi64(pairs, 0x0C, _mm_loadl_epi64((const void *)(rows[1] + offset)));
        pairs = _mm512_mask_broadcastq_epi64(pairs, 0x30, _mm_loadl_epi64((const void *)(rows[2] + offset)));
        pairs = _mm512_mask_broadcastq_epi64(pairs, 0xC0, _mm_loadl_epi64((const void *)(rows[3] + offset)));
        pairs = _mm512_shuffle_epi8(pairs, _mm512_broadcast_i32x4(_mm_setr_epi8(PAIR_OF_BYTES)));
    } else {
        pairs = _mm512_castsi128_si512(_mm_loadu_si128((const void *)(rows[0] + offset)));
        pairs = _mm512_mask_broadcast_i32x4(pairs, 0x00F0, _mm_loadu_si128((const void *)(rows[1] + offset)));
        pairs = _mm512_mask_broadcast_i32x4(pairs, 0x0F00, _mm_loadu_si128((const void *)(rows[2] + offset)));
        pairs = _mm512_mask_broadcast_i32x4(pairs, 0xF000, _mm_loadu_si128((const void *)(rows[3] + offset)));
        pairs = _mm512_shuffle_epi8(pairs, _mm512_broadcast_i32x4(_mm_setr_epi8(PAIR_OF_WORDS)));
    }
    const __m512i spread = _mm512_add_epi32(_mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3),
                                            _mm512_set1_epi32(4 * quad));
    return _mm512_madd_epi16(pairs, _mm512_castps_si512(_mm512_permutexvar_ps(spread, weights)));
}

/* Four samples: quad q of the result is the sum over the rows of products[q]. */
MTM_INLINE __m512i sum_rows(const __m512i products[4]) {
    const __m512i low = _mm512_add_epi32(_mm512_shuffle_i32x4(products[0], products[1], 0x88),
                                         _mm512_shuffle_i32x4(products[0], products[1], 0xDD));
    const __m512i high = _mm512_add_epi32(_mm512_shuffle_i32x4(products[2], products[3], 0x88),
                                          _mm512_shuffle_i32x4(products[2], products[3], 0xDD));
    return _mm512_add_epi32(_mm512_shuffle_i32x4(low, high, 0x88), _mm512_shuffle_i32x4(low, high, 0xDD));
}
#elif MTM_VECTOR_WIDTH == 8
MTM_INLINE __m256i load_two_rows(const char *low, const char *high, int voxel_bytes) {
    if (voxel_bytes == 4) {
        const __m256i bytes =
            _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadl_epi64((const void *)low)),
                                    _mm_loadl_epi64((const void *)high), 1);
        return _mm256_shuffle_epi8(bytes, _mm256_broadcastsi128_si256(_mm_setr_epi8(PAIR_OF_BYTES)));
    }
    const __m256i words = _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128((const void *)low)),
                                                  _mm_loadu_si128((const void *)high), 1);
    return _mm256_shuffle_epi8(words, _mm256_broadcastsi128_si256(_mm_setr_epi8(PAIR_OF_WORDS)));
}

MTM_INLINE __m256i multiply_rows(const char *const rows[4], size_t offset, int voxel_bytes,
                                 mtm_vector weights, int quad) {
    const __m256i quads = _mm256_set1_epi32(4 * quad);
    const __m256i first = _mm256_add_epi32(_mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1), quads);
    const __m256i second = _mm256_add_epi32(_mm256_setr_epi32(2, 2, 2, 2, 3, 3, 3, 3), quads);
    const __m256i low = load_two_rows(rows[0] + offset, rows[1] + offset, voxel_bytes);
    const __m256i high = load_two_rows(rows[2] + offset, rows[3] + offset, voxel_bytes);
    return _mm256_add_epi32(
        _mm256_madd_epi16(low, _mm256_castps_si256(_mm256_permutevar8x32_ps(weights, first))),
        _mm256_madd_epi16(high, _mm256_castps_si256(_mm256_permutevar8x32_ps(weights, second))));
}

MTM_INLINE __m256i sum_rows(const __m256i products[2]) {
    return _mm256_add_epi32(_mm256_permute2x128_si256(products[0], products[1], 0x20),
                            _mm256_permute2x128_si256(products[0], products[1], 0x31));
}
#endif

#if MTM_VECTOR_WIDTH > 4
/* sums[c]: component c of all samples. Sample 4 q + k is quad q of the k-th vector until they are transposed. */
MTM_INLINE void interpolate_rows(const char *const rows[4], const int32_t *voxels, int voxel_bytes,
                                 const mtm_vector_int weights[4], mtm_vector_int sums[4]) {
    enum { QUADS = MTM_VECTOR_WIDTH / 4 };
    mtm_vector by_sample[4];
    for (int row = 0; row < 4; row++) by_sample[row] = (mtm_vector)weights[row];
    mtm_vector_transpose(by_sample);
    mtm_vector found[4];
#pragma GCC unroll 4
    for (int k = 0; k < 4; k++) {
#if MTM_VECTOR_WIDTH == 16
        __m512i products[QUADS];
#else
        __m256i products[QUADS];
#endif
#pragma GCC unroll 4
        for (int quad = 0; quad < QUADS; quad++)
            products[quad] = multiply_rows(rows, (size_t)voxels[4 * quad + k] * (size_t)voxel_bytes,
                                           voxel_bytes, by_sample[k], quad);
        found[k] = (mtm_vector)sum_rows(products);
    }
    mtm_vector_transpose(found);
    for (int c = 0; c < 4; c++) sums[c] = (mtm_vector_int)found[c];
}
#else
MTM_INLINE void interpolate_rows(const char *const rows[4], const int32_t *voxels, int voxel_bytes,
                                 const mtm_vector_int weights[4], mtm_vector_int sums[4]) {
    for (int c = 0; c < 4; c++) sums[c] = (mtm_vector_int){0};
    for (int i = 0; i < MTM_VECTOR_WIDTH; i++) {
        for (int row = 0; row < 4; row++) {
            const char *pair = rows[row] + (size_t)voxels[i] * (size_t)voxel_bytes;
            const int32_t far_weight = weights[row][i] >> 16;
            const int32_t near_weight = (int16_t)(weights[row][i] & 0xFFFF);
            for (int c = 0; c < 4; c++) {
                if (voxel_bytes == 4) {
                    const uint8_t *bytes = (const uint8_t *)pair;
                    sums[c][i] += near_weight * bytes[c] + far_weight * bytes[4 + c];
                } else {
                    int16_t words[8];
                    memcpy(words, pair, sizeof words);
                    sums[c][i] += near_weight * words[c] + far_weight * words[4 + c];
                }
            }
        }
    }
}
#endif

/* The number of each sample's first voxel; packed volumes have less than 2^31. */
MTM_INLINE mtm_vector_int voxel_numbers(const mtm_raycast *raycast, const mtm_vector_int cell[3]) {
    return cell[0] + cell[1] * (int32_t)raycast->stride[1] + cell[2] * (int32_t)raycast->stride[2];
}

/* Asks for the corner rays' voxels, `ahead` of where they are. */
MTM_INLINE void prefetch(const char *const rows[4], const int32_t *voxels, int voxel_bytes, int32_t ahead) {
    const int corners[4] = {0, 3, MTM_VECTOR_WIDTH - 4, MTM_VECTOR_WIDTH - 1};
    for (int i = 0; i < (MTM_VECTOR_WIDTH > 4 ? 4 : 2); i++)
        for (int row = 0; row < 4; row++)
            __builtin_prefetch(rows[row] + (ptrdiff_t)(voxels[corners[i]] + ahead) * voxel_bytes);
}

/* Stored values, and gradients in world axes in some unit, packed->gradient_scale. Voxels are prefetched where `ahead`
 * is not 0. */
MTM_INLINE void fetch_packed(const mtm_raycast *raycast, const packet_place *place, int voxel_bytes,
                             int32_t ahead, mtm_vector *value, mtm_vector gradient[3]) {
    const mtm_packed *packed = raycast->packed;
    const size_t stride_y = raycast->stride[1] * (size_t)voxel_bytes;
    const size_t stride_z = raycast->stride[2] * (size_t)voxel_bytes;
    const char *first = packed->voxels;
    const char *const rows[4] = {first, first + stride_y, first + stride_z, first + stride_y + stride_z};
    int32_t voxels[MTM_VECTOR_WIDTH];
    mtm_vector_spill(voxel_numbers(raycast, place->cell), voxels);
    if (ahead != 0) prefetch(rows, voxels, voxel_bytes, ahead);
    mtm_vector_int weights[4];
    mtm_vector_int sums[4];
    weigh_rows(place, weights);
    interpolate_rows(rows, voxels, voxel_bytes, weights, sums);
    *value = mtm_vector_of_int(sums[0]) * (1.0f / WEIGHT_ONE) + (float)packed->value_base;
    for (int i = 0; i < 3; i++)
        gradient[i] = mtm_vector_of_int(sums[i + 1] - packed->gradient_bias * WEIGHT_ONE);
}

/* ---- The volume's own voxels. ---- */

/* Of types wider than 16 bits: the share of the way from the smallest voxel to the largest; what is no number is the
 * smallest. */
MTM_INLINE float share_of_range(const mtm_raycast *raycast, double stored) {
    return isfinite(stored) ? (float)((stored - raycast->lowest_stored) * raycast->inverse_range) : 0.0f;
}

/* A voxel as it is stored, or as a share of the range. */
MTM_INLINE float native_value(const mtm_raycast *raycast, mtm_voxel_type type, size_t offset) {
    const void *voxels = raycast->voxels;
    switch (type) {
    case MTM_VOXEL_INT8: return ((const int8_t *)voxels)[offset];
    case MTM_VOXEL_UINT8: return ((const uint8_t *)voxels)[offset];
    case MTM_VOXEL_INT16: return ((const int16_t *)voxels)[offset];
    case MTM_VOXEL_UINT16: return ((const uint16_t *)voxels)[offset];
    case MTM_VOXEL_INT32: return share_of_range(raycast, ((const int32_t *)voxels)[offset]);
    case MTM_VOXEL_UINT32: return share_of_range(raycast, ((const uint32_t *)voxels)[offset]);
    case MTM_VOXEL_INT64: return share_of_range(raycast, (double)((const int64_t *)voxels)[offset]);
    case MTM_VOXEL_UINT64: return share_of_range(raycast, (double)((const uint64_t *)voxels)[offset]);
    case MTM_VOXEL_FLOAT32: return share_of_range(raycast, (double)((const float *)voxels)[offset]);
    default: return share_of_range(raycast, ((const double *)voxels)[offset]);
    }
}

/* Offsets of a sample's cell, and of the voxels before and behind it along each axis. */
typedef struct native_cell {
    size_t first;
    size_t step[3];             /* from the cell's near voxels to its far ones */
    size_t before[3], after[3]; /* from `first` back, and on */
    float near_factor[3], far_factor[3];
} native_cell;

MTM_INLINE native_cell find_native_cell(const mtm_raycast *raycast, const packet_place *place, int i) {
    native_cell found = {.first = 0};
    for (int axis = 0; axis < 3; axis++) {
        const int cell = place->cell[axis][i];
        const size_t stride = raycast->stride[axis];
        const bool has_before = cell > 0;
        const bool has_after = cell + 2 < raycast->size[axis];
        found.first += (size_t)cell * stride;
        found.step[axis] = stride;
        found.before[axis] = has_before ? stride : 0;
        found.after[axis] = has_after ? 2 * stride : stride;
        found.near_factor[axis] = has_before ? 0.5f : 1.0f;
        found.far_factor[axis] = has_after ? 0.5f : 1.0f;
    }
    return found;
}

MTM_INLINE float mix(float a, float b, float share) {
    return a + share * (b - a);
}

MTM_INLINE float interpolate_corners(const float c[8], float x, float y, float z) {
    const float low = mix(mix(c[0], c[1], x), mix(c[2], c[3], x), y);
    const float high = mix(mix(c[4], c[5], x), mix(c[6], c[7], x), y);
    return mix(low, high, z);
}

MTM_INLINE void fetch_native_values(const mtm_raycast *raycast, const packet_place *place,
                                    mtm_voxel_type type, mtm_vector *value) {
    float corners[8][MTM_VECTOR_WIDTH];
    for (int i = 0; i < MTM_VECTOR_WIDTH; i++) {
        const native_cell cell = find_native_cell(raycast, place, i);
        for (int corner = 0; corner < 8; corner++) {
            const size_t x = corner & 1 ? cell.step[0] : 0;
            const size_t y = corner & 2 ? cell.step[1] : 0;
            const size_t z = corner & 4 ? cell.step[2] : 0;
            corners[corner][i] = native_value(raycast, type, cell.first + x + y + z);
        }
    }
    mtm_vector c[8];
    for (int corner = 0; corner < 8; corner++) c[corner] = mtm_vector_load(corners[corner]);
    const mtm_vector x = place->fraction[0];
    const mtm_vector y = place->fraction[1];
    for (int edge = 0; edge < 4; edge++) c[edge] = c[2 * edge] + x * (c[2 * edge + 1] - c[2 * edge]);
    for (int face = 0; face < 2; face++) c[face] = c[2 * face] + y * (c[2 * face + 1] - c[2 * face]);
    *value = c[0] + place->fraction[2] * (c[1] - c[0]);
}

/* Central differences at the corners, one-sided at the faces, interpolated; then turned into world axes. */
MTM_INLINE void fetch_native_gradients(const mtm_raycast *raycast, const packet_place *place,
                                       mtm_voxel_type type, mtm_vector gradient[3]) {
    float along[3][MTM_VECTOR_WIDTH];
    for (int i = 0; i < MTM_VECTOR_WIDTH; i++) {
        const native_cell cell = find_native_cell(raycast, place, i);
        for (int axis = 0; axis < 3; axis++) {
            const int u = axis == 0 ? 1 : 0;
            const int v = axis == 2 ? 1 : 2;
            float at_near[4];
            float at_far[4];
            for (int edge = 0; edge < 4; edge++) {
                const size_t base =
                    cell.first + (edge & 1 ? cell.step[u] : 0) + (edge & 2 ? cell.step[v] : 0);
                const float before = native_value(raycast, type, base - cell.before[axis]);
                const float near = native_value(raycast, type, base);
                const float far = native_value(raycast, type, base + cell.step[axis]);
                const float after = native_value(raycast, type, base + cell.after[axis]);
                at_near[edge] = cell.near_factor[axis] * (far - before);
                at_far[edge] = cell.far_factor[axis] * (after - near);
            }
            const float fu = place->fraction[u][i];
            const float fv = place->fraction[v][i];
            const float near = mix(mix(at_near[0], at_near[1], fu), mix(at_near[2], at_near[3], fu), fv);
            const float far = mix(mix(at_far[0], at_far[1], fu), mix(at_far[2], at_far[3], fu), fv);
            along[axis][i] = mix(near, far, place->fraction[axis][i]);
        }
    }
    for (int i = 0; i < 3; i++) {
        gradient[i] = (mtm_vector){0};
        for (int axis = 0; axis < 3; axis++)
            gradient[i] += mtm_vector_load(along[axis]) * (float)raycast->inverse_axes[axis][i];
    }
}

#endif
