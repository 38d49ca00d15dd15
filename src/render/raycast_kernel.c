/* SPDX-License-Identifier: BSD-3-Clause
 * The raycaster over packets: 4 × (width / 4) neighboring rays at a time, one vector element each. What differs from ray
 * to ray along the way (positions, voxels, shading, transmittance) is done in vectors over the rays; the d coefficients
 * of a step are then added ray by ray, in vectors over the coefficients, so that many cost little more than three.
 * A ray's pixel does not depend on which rays share its packet, and on the instruction set only by rounding: positions,
 * voxels and rows of the table are the same, shading and sums may be fused.
 * Levoy, "Efficient ray tracing of volume data", ACM TOG 9(3), 1990; Wald et al., "Interactive rendering with coherent
 * ray tracing", Computer Graphics Forum 20(3), 2001 (packets); paper section 5, eqs. 5 and 6. */
#include "render/raycast_kernel.h"

#include <math.h>
#include <string.h>

#include "render/fetch.h"
#include "render/packet_coefficients.h"
#include "render/packet_rays.h"

/* Optical depth beyond which a step is taken as two halves. */
static const float deep = (float)MTM_DEEP_STEP;

/* What was read at a point of every ray. */
typedef struct packet_sample {
    packet_place place;
    mtm_vector_int row;                                            /* of the transfer function's table */
    mtm_vector_int extinction, extinction_on;                      /* sums up to the row, and with it */
    mtm_vector_int emission, emission_on, highlight, highlight_on; /* where they are not the same */
    mtm_vector gradient[3];
    bool has_sums, has_gradient; /* read where they are needed */
} packet_sample;

/* What stays the same for all packets of a picture. */
typedef struct packet_pass {
    const mtm_raycast *raycast;
    int lanes;
    void (*add_rays)(int lanes, const int32_t *table, mtm_vector_int low, mtm_vector_int high,
                     mtm_vector weight, uint32_t seen, float *sums);
    bool is_following, is_preintegrated, is_shaded, is_headlight;
    float step, half_step, termination;
    float last[3]; /* voxel coordinates */
    int last_cell[3];
    float row_scale, row_offset, last_row;
    float extinction_step, highlight_step, coefficient_step;
    float ambient, diffuse, specular, light[3];
    float gradient_factor, gradient_offset; /* strength = smoothstep(|gradient| · factor - offset) */
    int visible_begin, visible_end;         /* no other rows are visible */
    uint32_t shininess_whole;
    uint32_t shininess_digits; /* eight binary digits behind the point */
} packet_pass;

/* What a packet has gathered. */
typedef struct packet_sum {
    mtm_vector transmittance, highlight;
    float coefficients[WIDTH * (MTM_DIMENSION_MAX + 1)] __attribute__((aligned(64)));
} packet_sum;

MTM_INLINE packet_place locate(const packet_pass *pass, const ray_packet *packet, mtm_vector distance) {
    packet_place place;
    for (int axis = 0; axis < 3; axis++) {
        mtm_vector x = packet->entry[axis] + distance * packet->voxel_direction[axis];
        x = mtm_vector_min(mtm_vector_max(x, mtm_vector_all(0)), mtm_vector_all(pass->last[axis]));
        place.cell[axis] =
            mtm_vector_min_int(mtm_vector_truncate(x), mtm_vector_all_int(pass->last_cell[axis]));
        place.fraction[axis] = x - mtm_vector_of_int(place.cell[axis]);
    }
    return place;
}

/* The type is decided once per packet, outside of the loops over its rays. */
static void fetch_any_values(const mtm_raycast *raycast, const packet_place *place, mtm_vector *value) {
    switch (raycast->type) {
    case MTM_VOXEL_INT8: fetch_native_values(raycast, place, MTM_VOXEL_INT8, value); break;
    case MTM_VOXEL_UINT8: fetch_native_values(raycast, place, MTM_VOXEL_UINT8, value); break;
    case MTM_VOXEL_INT16: fetch_native_values(raycast, place, MTM_VOXEL_INT16, value); break;
    case MTM_VOXEL_UINT16: fetch_native_values(raycast, place, MTM_VOXEL_UINT16, value); break;
    case MTM_VOXEL_INT32: fetch_native_values(raycast, place, MTM_VOXEL_INT32, value); break;
    case MTM_VOXEL_UINT32: fetch_native_values(raycast, place, MTM_VOXEL_UINT32, value); break;
    case MTM_VOXEL_INT64: fetch_native_values(raycast, place, MTM_VOXEL_INT64, value); break;
    case MTM_VOXEL_UINT64: fetch_native_values(raycast, place, MTM_VOXEL_UINT64, value); break;
    case MTM_VOXEL_FLOAT32: fetch_native_values(raycast, place, MTM_VOXEL_FLOAT32, value); break;
    default: fetch_native_values(raycast, place, MTM_VOXEL_FLOAT64, value); break;
    }
}

static void fetch_any_gradients(const mtm_raycast *raycast, const packet_place *place,
                                mtm_vector gradient[3]) {
    switch (raycast->type) {
    case MTM_VOXEL_INT8: fetch_native_gradients(raycast, place, MTM_VOXEL_INT8, gradient); break;
    case MTM_VOXEL_UINT8: fetch_native_gradients(raycast, place, MTM_VOXEL_UINT8, gradient); break;
    case MTM_VOXEL_INT16: fetch_native_gradients(raycast, place, MTM_VOXEL_INT16, gradient); break;
    case MTM_VOXEL_UINT16: fetch_native_gradients(raycast, place, MTM_VOXEL_UINT16, gradient); break;
    case MTM_VOXEL_INT32: fetch_native_gradients(raycast, place, MTM_VOXEL_INT32, gradient); break;
    case MTM_VOXEL_UINT32: fetch_native_gradients(raycast, place, MTM_VOXEL_UINT32, gradient); break;
    case MTM_VOXEL_INT64: fetch_native_gradients(raycast, place, MTM_VOXEL_INT64, gradient); break;
    case MTM_VOXEL_UINT64: fetch_native_gradients(raycast, place, MTM_VOXEL_UINT64, gradient); break;
    case MTM_VOXEL_FLOAT32: fetch_native_gradients(raycast, place, MTM_VOXEL_FLOAT32, gradient); break;
    default: fetch_native_gradients(raycast, place, MTM_VOXEL_FLOAT64, gradient); break;
    }
}

MTM_INLINE void fetch_gradient(const mtm_raycast *raycast, packet_sample *sample) {
    if (sample->has_gradient) return;
    fetch_any_gradients(raycast, &sample->place, sample->gradient);
    sample->has_gradient = true;
}

MTM_INLINE void read_sample(int voxel_bytes, const packet_pass *pass, const ray_packet *packet,
                            mtm_vector distance, packet_sample *sample) {
    const mtm_raycast *raycast = pass->raycast;
    mtm_vector value;
    sample->place = locate(pass, packet, distance);
    sample->has_gradient = voxel_bytes > 0;
    if (voxel_bytes > 0)
        fetch_packed(raycast, &sample->place, voxel_bytes, packet->voxels_ahead, &value, sample->gradient);
    else
        fetch_any_values(raycast, &sample->place, &value);
    const mtm_vector row = value * pass->row_scale + pass->row_offset;
    sample->row = mtm_vector_round(
        mtm_vector_min(mtm_vector_max(row, mtm_vector_all(0)), mtm_vector_all(pass->last_row)));
    sample->has_sums = false;
}

MTM_INLINE void fetch_sums(const packet_pass *pass, packet_sample *sample) {
    if (sample->has_sums) return;
    const mtm_transfer_rows *rows = pass->raycast->rows;
    mtm_vector_gather_pairs(rows->extinction, sample->row, &sample->extinction, &sample->extinction_on);
    if (!pass->is_following) {
        mtm_vector_gather_pairs(rows->emission, sample->row, &sample->emission, &sample->emission_on);
        mtm_vector_gather_pairs(rows->highlight, sample->row, &sample->highlight, &sample->highlight_on);
    }
    sample->has_sums = true;
}

/* 1 - e^-x for x ≥ 0, to a few units in the last place of small results, too: 2^-y with y = n + f, |f| ≤ ½, where
 * 1 - e^-(f ln 2) is f ln 2 times a polynomial (fitted at Chebyshev nodes, 1e-8). */
MTM_INLINE mtm_vector absorbed(mtm_vector x) {
    const mtm_vector y = mtm_vector_min(x * 1.44269504f, mtm_vector_all(125));
    const mtm_vector_int n = mtm_vector_round(y);
    const mtm_vector f = (y - mtm_vector_of_int(n)) * 0.693147181f;
    const mtm_vector square = f * f;
    const mtm_vector low = mtm_vector_fused(f, mtm_vector_all(-0.5f), mtm_vector_all(1));
    const mtm_vector middle =
        mtm_vector_fused(f, mtm_vector_all(-0.0416663515f), mtm_vector_all(0.166665045f));
    const mtm_vector high =
        mtm_vector_fused(f, mtm_vector_all(-0.00139412236f), mtm_vector_all(0.00836922827f));
    const mtm_vector series = mtm_vector_fused(square, mtm_vector_fused(square, high, middle), low);
    const mtm_vector power = (mtm_vector)((127 - n) << 23);
    return mtm_vector_fused(power, f * series, 1.0f - power);
}

/* base^shininess for 0 ≤ base ≤ 1: squaring for the whole part, square roots for eight binary digits behind the
 * point. */
MTM_INLINE mtm_vector raise(const packet_pass *pass, mtm_vector base) {
    mtm_vector result = mtm_vector_all(1);
    mtm_vector square = base;
    for (uint32_t bits = pass->shininess_whole; bits > 0; bits >>= 1) {
        if ((bits & 1) != 0) result = result * square;
        square = square * square;
    }
    mtm_vector root = base;
    for (uint32_t bits = pass->shininess_digits; (bits & 0xFF) != 0; bits <<= 1) {
        root = mtm_vector_square_root(root);
        if ((bits & 0x80) != 0) result = result * root;
    }
    return result;
}

MTM_INLINE mtm_vector dot(const mtm_vector a[3], const mtm_vector b[3]) {
    return mtm_vector_fused(a[0], b[0], mtm_vector_fused(a[1], b[1], a[2] * b[2]));
}

/* Blinn–Phong as in the plain raycaster: factors of the material and of white. */
MTM_INLINE void shade(const packet_pass *pass, const ray_packet *packet, const mtm_vector normal[3],
                      mtm_vector *material, mtm_vector *white) {
    const mtm_vector zero = {0};
    const mtm_vector one = mtm_vector_all(1);
    const mtm_vector square = dot(normal, normal);
    const mtm_vector inverse = mtm_vector_reciprocal_root(mtm_vector_max(square, mtm_vector_all(1e-30f)));
    const mtm_vector length = square * inverse;
    mtm_vector strength = length * pass->gradient_factor - pass->gradient_offset;
    strength = mtm_vector_min(mtm_vector_max(strength, zero), one);
    strength = strength * strength * (3.0f - 2.0f * strength);

    const mtm_vector facing = dot(normal, packet->direction) * inverse;
    mtm_vector diffuse = mtm_vector_min(mtm_vector_abs(facing), one);
    mtm_vector highlight = diffuse; /* a headlight's half vector is the view direction */
    if (!pass->is_headlight) {
        mtm_vector lit = zero;
        mtm_vector shining = zero;
        mtm_vector toward_square = zero;
        for (int i = 0; i < 3; i++) {
            const mtm_vector toward = pass->light[i] - packet->direction[i];
            toward_square += toward * toward;
            lit += normal[i] * pass->light[i];
            shining += normal[i] * toward;
        }
        const mtm_vector sign = mtm_vector_select(mtm_vector_less(zero, facing), -inverse, inverse);
        const mtm_vector half = mtm_vector_square_root(mtm_vector_max(toward_square, mtm_vector_all(1e-30f)));
        diffuse = mtm_vector_min(mtm_vector_max(sign * lit, zero), one);
        highlight = mtm_vector_min(mtm_vector_max(sign * shining / half, zero), one);
    }
    *material = mtm_vector_fused(strength * pass->diffuse, diffuse, mtm_vector_all(pass->ambient));
    *white = strength * pass->specular * raise(pass, highlight);
    if (!pass->is_headlight) *white = mtm_vector_select(mtm_vector_less(zero, diffuse), *white, zero);
}

/* From the lower of two rows up to and with the higher one. */
MTM_INLINE mtm_vector_int subtract_sums(mtm_mask is_rising, mtm_vector_int back_on, mtm_vector_int front_on,
                                        mtm_vector_int front_at, mtm_vector_int back_at) {
    return mtm_vector_select_int(is_rising, back_on, front_on) -
           mtm_vector_select_int(is_rising, front_at, back_at);
}

/* Rays that are still going on and have a part of the step. */
MTM_INLINE mtm_mask find_alive(const packet_pass *pass, mtm_vector length, const packet_sum *sum) {
    const mtm_mask is_dark = mtm_vector_less(sum->transmittance, mtm_vector_all(pass->termination));
    return mtm_mask_and(mtm_vector_less(mtm_vector_all(0), length), mtm_mask_not(is_dark));
}

/* Whether any of them meets a row between the first and the last visible one. */
MTM_INLINE bool may_be_seen(const packet_pass *pass, mtm_vector_int low, mtm_vector_int high,
                            mtm_vector length, const packet_sum *sum) {
    const mtm_mask is_below = mtm_vector_less_int(low, mtm_vector_all_int(pass->visible_end));
    const mtm_mask is_above = mtm_vector_less_int(mtm_vector_all_int(pass->visible_begin - 1), high);
    return mtm_mask_bits(mtm_mask_and(find_alive(pass, length, sum), mtm_mask_and(is_below, is_above))) != 0;
}

/* What lies between two samples of the packet, or around one that stands for it (is_point; front is then back); `length`
 * is what each ray has of it. */
MTM_INLINE void add_stretch(bool is_point, const packet_pass *pass, const ray_packet *packet,
                            packet_sample *front, packet_sample *back, mtm_vector length, packet_sum *sum) {
    const mtm_vector zero = {0};
    const mtm_mask is_rising = mtm_vector_less_int(front->row, back->row);
    const mtm_vector_int low = is_point ? back->row : mtm_vector_select_int(is_rising, front->row, back->row);
    const mtm_vector_int high =
        1 + (is_point ? back->row : mtm_vector_select_int(is_rising, back->row, front->row));
    const mtm_mask is_alive = find_alive(pass, length, sum);
    fetch_sums(pass, back);
    mtm_vector_int extinction = back->extinction_on - back->extinction;
    mtm_vector_int emission = extinction;
    mtm_vector_int shining = extinction;
    if (!is_point) {
        fetch_sums(pass, front);
        extinction = subtract_sums(is_rising, back->extinction_on, front->extinction_on, front->extinction,
                                   back->extinction);
        emission = extinction;
        shining = extinction;
    }
    if (!pass->is_following) {
        emission =
            subtract_sums(is_rising, back->emission_on, front->emission_on, front->emission, back->emission);
        shining = subtract_sums(is_rising, back->highlight_on, front->highlight_on, front->highlight,
                                back->highlight);
    }
    const mtm_mask is_seen =
        mtm_mask_and(is_alive, mtm_vector_less_int((mtm_vector_int){0}, extinction | emission));
    const uint32_t seen = mtm_mask_bits(is_seen);
    if (seen == 0) return;

    const mtm_vector share =
        is_point ? mtm_vector_all(1) : mtm_vector_reciprocal(mtm_vector_of_int(high - low));
    const mtm_vector depth = mtm_vector_max(
        mtm_vector_of_int(extinction) * share * length * pass->extinction_step, mtm_vector_all(1e-20f));
    const mtm_vector lost = absorbed(depth);
    mtm_vector weight = mtm_vector_select(
        is_seen, sum->transmittance * lost * mtm_vector_reciprocal(depth) * length * share, zero);
    const mtm_vector remaining = sum->transmittance - sum->transmittance * lost;
    sum->transmittance = mtm_vector_select(is_seen, remaining, sum->transmittance);

    mtm_vector material = mtm_vector_all(pass->ambient);
    if (pass->is_shaded) {
        mtm_vector normal[3];
        mtm_vector white;
        fetch_gradient(pass->raycast, back);
        if (!is_point) fetch_gradient(pass->raycast, front);
        for (int i = 0; i < 3; i++)
            normal[i] = back->gradient[i] + (is_point ? back->gradient[i] : front->gradient[i]);
        shade(pass, packet, normal, &material, &white);
        sum->highlight += weight * white * mtm_vector_of_int(shining) * pass->highlight_step;
    }
    weight = weight * material * pass->coefficient_step;
    pass->add_rays(pass->lanes, pass->raycast->rows->coefficients, low, high, weight, seen,
                   sum->coefficients);
}

MTM_INLINE packet_sample blend_samples(mtm_mask mask, const packet_sample *x, const packet_sample *y) {
    packet_sample blend = *y;
    blend.row = mtm_vector_select_int(mask, x->row, y->row);
    for (int i = 0; i < 3; i++) blend.gradient[i] = mtm_vector_select(mask, x->gradient[i], y->gradient[i]);
    blend.has_sums = false;
    return blend;
}

/* A step in which much is absorbed, as two halves: what lies in front then hides what lies behind, and each half is lit
 * with its own gradient. For the rays with is_deep; for the others it stays one. */
static __attribute__((noinline)) void add_halves(const packet_pass *pass, const ray_packet *packet,
                                                 mtm_mask is_deep, packet_sample *front, packet_sample *back,
                                                 mtm_vector length, packet_sum *sum) {
    packet_sample middle = *back;
    if (pass->is_shaded) {
        fetch_gradient(pass->raycast, front);
        fetch_gradient(pass->raycast, back);
        for (int i = 0; i < 3; i++) middle.gradient[i] = 0.5f * (front->gradient[i] + back->gradient[i]);
    }
    middle.has_sums = false;
    middle.has_gradient = true;
    /* Every row belongs to one half, whose length is its share of the rows: together they absorb what the step does. */
    const mtm_mask is_rising = mtm_vector_less_int(front->row, back->row);
    const mtm_vector_int lower = (front->row + back->row) >> 1;
    const mtm_vector_int one = mtm_vector_all_int(1);
    const mtm_vector_int last = mtm_vector_select_int(is_rising, lower, lower + one); /* of the first half */
    const mtm_vector_int first =
        mtm_vector_select_int(is_rising, lower + one, lower); /* of the second half */
    const mtm_vector_int count = mtm_vector_select_int(is_rising, last - front->row, front->row - last) + one;
    const mtm_vector_int all =
        mtm_vector_select_int(is_rising, back->row - front->row, front->row - back->row) + one;
    const mtm_vector part = length * mtm_vector_of_int(count) / mtm_vector_of_int(all);
    middle.row = last;
    packet_sample end = blend_samples(is_deep, &middle, back);
    add_stretch(false, pass, packet, front, &end, mtm_vector_select(is_deep, part, length), sum);
    middle.row = first;
    middle.has_sums = false;
    add_stretch(false, pass, packet, &middle, back,
                mtm_vector_select(is_deep, length - part, mtm_vector_all(0)), sum);
}

/* A step between two samples. */
MTM_INLINE void add_step(const packet_pass *pass, const ray_packet *packet, packet_sample *front,
                         packet_sample *back, mtm_vector length, packet_sum *sum) {
    const mtm_mask is_rising = mtm_vector_less_int(front->row, back->row);
    const mtm_vector_int low = mtm_vector_select_int(is_rising, front->row, back->row);
    const mtm_vector_int high = mtm_vector_select_int(is_rising, back->row, front->row);
    if (!may_be_seen(pass, low, high, length, sum)) return;
    fetch_sums(pass, front);
    fetch_sums(pass, back);
    const mtm_vector_int extinction = subtract_sums(is_rising, back->extinction_on, front->extinction_on,
                                                    front->extinction, back->extinction);
    const mtm_vector depth = mtm_vector_of_int(extinction) * length * pass->extinction_step;
    const mtm_vector limit = mtm_vector_of_int(high - low + 1) * deep;
    const mtm_mask is_deep = mtm_mask_and(mtm_vector_less(limit, depth), mtm_vector_less_int(low, high));
    if (mtm_mask_bits(is_deep) != 0)
        add_halves(pass, packet, is_deep, front, back, length, sum);
    else
        add_stretch(false, pass, packet, front, back, length, sum);
}

/* Distance from the entry of the beginning of each ray's part of a step of the tile. */
MTM_INLINE mtm_vector distance_of(const packet_pass *pass, const ray_packet *packet, int step) {
    return ((float)step - packet->first_step) * pass->step;
}

MTM_INLINE mtm_vector clip(const ray_packet *packet, mtm_vector distance) {
    return mtm_vector_min(mtm_vector_max(distance, packet->begin), packet->end);
}

/* Steps that the samples in their middles stand for. */
MTM_INLINE void walk_points(int voxel_bytes, const packet_pass *pass, const ray_packet *packet, int first,
                            int end, packet_sum *sum) {
    for (int step = first; step < end; step++) {
        packet_sample sample;
        const mtm_vector begin = distance_of(pass, packet, step);
        const mtm_vector length = clip(packet, begin + pass->step) - clip(packet, begin);
        read_sample(voxel_bytes, pass, packet, begin + pass->half_step + packet->shift, &sample);
        if (may_be_seen(pass, sample.row, sample.row, length, sum))
            add_stretch(true, pass, packet, &sample, &sample, length, sum);
    }
}

/* Steps from sample to sample. `front` is the sample at the beginning of the next step where has_front says so. */
MTM_INLINE void walk_stretches(int voxel_bytes, const packet_pass *pass, const ray_packet *packet, int first,
                               int end, packet_sample *front, bool has_front, packet_sum *sum) {
    mtm_vector from = clip(packet, distance_of(pass, packet, first) + packet->shift);
    if (!has_front) read_sample(voxel_bytes, pass, packet, from, front);
    for (int step = first; step < end; step++) {
        packet_sample back;
        const mtm_vector to = clip(packet, distance_of(pass, packet, step + 1) + packet->shift);
        read_sample(voxel_bytes, pass, packet, to, &back);
        add_step(pass, packet, front, &back, to - from, sum);
        *front = back;
        from = to;
    }
}

MTM_INLINE void walk_packet(int voxel_bytes, const packet_pass *pass, const ray_tile *tile,
                            const ray_packet *packet, packet_sum *sum) {
    const mtm_raycast *raycast = pass->raycast;
    packet_sample front;
    bool has_front = false;
    for (int first = packet->step_begin; first < packet->step_end;) {
        const int slab = first / SLAB_STEPS;
        const int slab_end = (slab + 1) * SLAB_STEPS;
        const int end = slab_end < packet->step_end ? slab_end : packet->step_end;
        const int begin = first;
        first = end;
        if ((slab < SLABS_LISTED && tile->is_occupied[slab] == 0) ||
            !may_see(raycast, &packet->box, tile->first_step + (double)slab * SLAB_STEPS)) {
            has_front = false;
            continue;
        }
        const mtm_mask is_alive = mtm_mask_and(
            mtm_vector_less(packet->begin, packet->end),
            mtm_mask_not(mtm_vector_less(sum->transmittance, mtm_vector_all(pass->termination))));
        if (mtm_mask_bits(is_alive) == 0) return;
        if (pass->is_preintegrated)
            walk_stretches(voxel_bytes, pass, packet, begin, end, &front, has_front, sum);
        else
            walk_points(voxel_bytes, pass, packet, begin, end, sum);
        has_front = true;
    }
}

/* coefficients + highlight · white, four lanes at a time; alpha then takes its place. */
static void store_pixel(const float *coefficients, const float *white, float highlight, int lanes,
                        float *pixel) {
    for (int k = 0; k < lanes; k += 4) {
        four_floats sum;
        four_floats shine;
        memcpy(&sum, coefficients + k, sizeof sum);
        memcpy(&shine, white + k, sizeof shine);
        sum += highlight * shine;
        memcpy(pixel + k, &sum, sizeof sum);
    }
}

static void store_packet(const mtm_raycast *raycast, const mtm_lattice *lattice, int column, int row,
                         const packet_sum *sum, mtm_image *image) {
    const int lanes = image->lanes;
    const float *white = raycast->transfer->white;
    float highlight[WIDTH];
    float transmittance[WIDTH];
    mtm_vector_spill_floats(sum->highlight, highlight);
    mtm_vector_spill_floats(sum->transmittance, transmittance);
    for (int i = 0; i < WIDTH; i++) {
        const int x = lattice->x + (column + i % PACKET_ACROSS) * lattice->stride;
        const int y = lattice->y + (row + i / PACKET_ACROSS) * lattice->stride;
        if (x >= image->width || y >= image->height) continue;
        float *pixel = image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)lanes;
        store_pixel(sum->coefficients + i * lanes, white, highlight[i], lanes, pixel);
        pixel[image->dimension] = 1 - transmittance[i];
    }
}

static void set_shading(packet_pass *pass, const mtm_raycast *raycast) {
    const mtm_shading *shading = &raycast->options.shading;
    const double whole = floor(shading->shininess);
    const double threshold = shading->gradient_threshold > 0 ? shading->gradient_threshold : 1e-20;
    pass->is_shaded = raycast->needs_gradient;
    pass->is_headlight = shading->is_headlight;
    pass->ambient = (float)shading->ambient;
    pass->diffuse = (float)shading->diffuse;
    pass->specular = (float)shading->specular;
    for (int i = 0; i < 3; i++) pass->light[i] = (float)raycast->light[i];
    /* A packet adds the gradients at both ends of a step. */
    pass->gradient_factor = (float)(0.5 * (double)raycast->fetched_gradient_scale / threshold);
    pass->gradient_offset = shading->gradient_threshold > 0 ? 1 : 0;
    pass->shininess_whole = whole < 1e6 ? (uint32_t)whole : 1000000;
    pass->shininess_digits = (uint32_t)((shading->shininess - whole) * 256);
}

static packet_pass make_pass(const mtm_raycast *raycast) {
    const mtm_transfer_rows *rows = raycast->rows;
    const bool is_sum = raycast->options.blend == MTM_BLEND_SUM; /* nothing absorbs, so nothing shines */
    const int lanes = rows->lanes;
    packet_pass pass = {.raycast = raycast,
                        .lanes = lanes,
                        .add_rays = lanes == 4    ? add_rays_4
                                    : lanes == 8  ? add_rays_8
                                    : lanes == 16 ? add_rays_16
                                                  : add_rays_any,
                        .is_following = rows->is_following && !is_sum,
                        .is_preintegrated = raycast->options.is_preintegrated,
                        .step = (float)raycast->step,
                        .half_step = (float)(0.5 * raycast->step),
                        .termination = (float)raycast->options.termination,
                        .row_scale = raycast->row_scale,
                        .row_offset = raycast->row_offset,
                        .last_row = (float)(rows->count - 1),
                        .visible_begin = rows->visible_begin,
                        .visible_end = rows->visible_end,
                        .extinction_step = is_sum ? 0 : rows->extinction_step,
                        .highlight_step = is_sum ? 0 : rows->highlight_step,
                        .coefficient_step = rows->coefficient_step};
    for (int axis = 0; axis < 3; axis++) {
        pass.last[axis] = (float)(raycast->size[axis] - 1);
        pass.last_cell[axis] = raycast->size[axis] > 1 ? raycast->size[axis] - 2 : 0;
    }
    set_shading(&pass, raycast);
    return pass;
}

/* The compiler sees the layout as a constant: bytes of a packed voxel, 0 for native ones. */
MTM_INLINE void render_packets(int voxel_bytes, const mtm_raycast *raycast, const mtm_lattice *lattice,
                               int across, int down, mtm_image *image) {
    const size_t sums_bytes = (size_t)(WIDTH * image->lanes) * sizeof(float);
    ray_tile tile;
    packet_sum sum;
    const bool is_hit = aim_tile(raycast, lattice, across, down, &tile);
    const packet_pass pass = make_pass(raycast);
    for (int p = 0; p < PACKETS; p++) {
        const int column = across * MTM_TILE_PIXELS + p % PACKETS_ACROSS * PACKET_ACROSS;
        const int row = down * MTM_TILE_PIXELS + p / PACKETS_ACROSS * PACKET_DOWN;
        sum.transmittance = mtm_vector_all(1);
        sum.highlight = mtm_vector_all(0);
        memset(sum.coefficients, 0, sums_bytes);
        if (is_hit && tile.packets[p].is_hit) walk_packet(voxel_bytes, &pass, &tile, &tile.packets[p], &sum);
        store_packet(raycast, lattice, column, row, &sum, image);
    }
}

static void render_tile(const mtm_raycast *raycast, const mtm_lattice *lattice, int across, int down,
                        mtm_image *image) {
    switch (raycast->packed->voxel_bytes) {
    case 4: render_packets(4, raycast, lattice, across, down, image); break;
    case 8: render_packets(8, raycast, lattice, across, down, image); break;
    default: render_packets(0, raycast, lattice, across, down, image); break;
    }
}

const mtm_raycast_kernel MTM_OF_ISA(mtm_raycast_kernel) = {render_tile};
