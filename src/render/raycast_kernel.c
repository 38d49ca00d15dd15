/* SPDX-License-Identifier: BSD-3-Clause
 * The raycaster over packets: 4 × (width / 4) neighboring rays at a time, one vector element each. What differs from ray
 * to ray along the way (positions, voxels, shading, transmittance) is done in vectors over the rays; the d coefficients
 * of a step are then added ray by ray, in vectors over the coefficients, so that many cost little more than three.
 * A ray's pixel does not depend on which rays share its packet, nor on the instruction set.
 * Levoy, "Efficient ray tracing of volume data", ACM TOG 9(3), 1990; Wald et al., "Interactive rendering with coherent
 * ray tracing", Computer Graphics Forum 20(3), 2001 (packets); paper section 5, eqs. 5 and 6. */
#include "render/raycast_kernel.h"

#include <math.h>
#include <string.h>

#include "render/fetch.h"

enum {
    WIDTH = MTM_VECTOR_WIDTH,
    PACKET_ACROSS = 4,
    PACKET_DOWN = WIDTH / PACKET_ACROSS,
    PACKETS_ACROSS = MTM_TILE_PIXELS / PACKET_ACROSS,
    PACKETS_DOWN = MTM_TILE_PIXELS / PACKET_DOWN,
    PACKETS = PACKETS_ACROSS * PACKETS_DOWN,
    SLAB_STEPS = 4,      /* empty space is asked for this many steps at a time */
    SLABS_LISTED = 1024, /* for a whole tile at once; of longer rays the rest is asked for packet by packet */
    PREFETCH_STEPS = 3,
};

/* Bounds in doubles: low and high per axis. */
typedef struct bounds {
    double low[3], high[3];
} bounds;

/* What rays with some bounds reach between two distances, in blocks: the corners of a box, linear in both. */
typedef double four_doubles __attribute__((vector_size(32)));
typedef int32_t four_ints __attribute__((vector_size(16)));
typedef struct slab_box {
    four_doubles low, low_begin, low_end;
    four_doubles high, high_begin, high_end;
    four_ints last; /* block along each axis */
} slab_box;

/* Optical depth beyond which a step is taken as two halves. */
static const float deep = (float)MTM_DEEP_STEP;

/* Rays in voxel coordinates. Their steps are counted from where they enter the volume; first_step tells which of the
 * tile's steps, which are counted from the eye, that is, so that the packet moves on in step. */
typedef struct ray_packet {
    mtm_vector entry[3];           /* voxel coordinates */
    mtm_vector voxel_direction[3]; /* per world unit */
    mtm_vector direction[3];       /* world, unit length */
    mtm_vector begin, end; /* the clipped part, world units behind the entry; equal where a ray misses */
    mtm_vector shift;      /* of the samples, world units */
    mtm_vector first_step;
    int step_begin, step_end; /* of all rays */
    int32_t voxels_ahead;     /* about how far apart in memory samples PREFETCH_STEPS apart are */
    bounds origins, directions;
    slab_box box;
    bool is_hit;
} ray_packet;

/* Rays of a packet while they are set up. */
typedef struct ray_setup {
    double across[WIDTH], upward[WIDTH];
    double origin[3][WIDTH], direction[3][WIDTH], voxel_origin[3][WIDTH], voxel_direction[3][WIDTH];
    double inverse_direction[3][WIDTH]; /* in voxel coordinates */
    double entry[WIDTH], begin[WIDTH], end[WIDTH], jitter[WIDTH];
    double first_step[WIDTH], step_begin[WIDTH], step_end[WIDTH]; /* from the eye */
    double is_hit[WIDTH];                                         /* 1 or 0 */
} ray_setup;

/* The loops over rays read constants from local variables: stores to a ray's numbers could else change them, and
 * compilers would not make vectors of the loops. Nor would they after unrolling them. */
#define FOR_RAYS(i) _Pragma("GCC unroll 1") for (int i = 0; i < WIDTH; i++)

/* Directions, in the picture as everywhere from mtm_view_ray. */
static void aim_rays(const mtm_raycast *raycast, const mtm_lattice *lattice, int column, int row,
                     ray_setup *restrict setup) {
    const mtm_view view = raycast->view;
    const double width = raycast->options.width;
    const double height = raycast->options.height;
    const double first_x = lattice->x + column * lattice->stride + 0.5;
    const double first_y = lattice->y + row * lattice->stride + 0.5;
    const double stride = lattice->stride;
    FOR_RAYS(i) {
        setup->across[i] = (2 * (first_x + i % PACKET_ACROSS * stride) - width) / height * view.half_height;
        setup->upward[i] = (1 - 2 * (first_y + i / PACKET_ACROSS * stride) / height) * view.half_height;
    }
    const double origin_share = view.is_orthographic ? 1 : 0;
    const double direction_share = 1 - origin_share;
    for (int axis = 0; axis < 3; axis++) {
        const double right = view.right[axis];
        const double up = view.up[axis];
        const double forward = view.forward[axis];
        const double eye = view.eye[axis] - raycast->grid_origin[axis];
        FOR_RAYS(i) {
            const double offset = setup->across[i] * right + setup->upward[i] * up;
            setup->origin[axis][i] = eye + origin_share * offset;
            setup->direction[axis][i] = forward + direction_share * offset;
        }
    }
    FOR_RAYS(i) {
        const double x = setup->direction[0][i];
        const double y = setup->direction[1][i];
        const double z = setup->direction[2][i];
        const double inverse_length = 1 / sqrt(x * x + y * y + z * z);
        setup->direction[0][i] = x * inverse_length;
        setup->direction[1][i] = y * inverse_length;
        setup->direction[2][i] = z * inverse_length;
    }
    for (int axis = 0; axis < 3; axis++) {
        const double a = raycast->inverse_axes[axis][0];
        const double b = raycast->inverse_axes[axis][1];
        const double c = raycast->inverse_axes[axis][2];
        FOR_RAYS(i) {
            setup->voxel_origin[axis][i] =
                a * setup->origin[0][i] + b * setup->origin[1][i] + c * setup->origin[2][i];
            const double direction =
                a * setup->direction[0][i] + b * setup->direction[1][i] + c * setup->direction[2][i];
            setup->voxel_direction[axis][i] = direction;
            /* A ray along an axis meets the faces across the others never: huge distances, whose sign says on which
             * side of the face it is. */
            setup->inverse_direction[axis][i] = 1 / (fabs(direction) > 1e-200 ? direction : 1e-200);
        }
    }
}

/* Distances at which the rays enter and leave a box; the former is larger where they miss it. */
static void intersect(const ray_setup *setup, const double low[3], const double high[3],
                      double enter[restrict WIDTH], double leave[restrict WIDTH]) {
    FOR_RAYS(i) {
        enter[i] = -HUGE_VAL;
        leave[i] = HUGE_VAL;
    }
    for (int axis = 0; axis < 3; axis++) {
        const double *origin = setup->voxel_origin[axis];
        const double *inverse = setup->inverse_direction[axis];
        const double from = low[axis];
        const double to = high[axis];
        const double tiny = 1e-12 * (fabs(from) + fabs(to) + 1); /* voxels */
        FOR_RAYS(i) {
            /* Within a face, 0 times a huge number: a ray that runs along it is taken as just inside. */
            const double a = (from - origin[i] - tiny) * inverse[i];
            const double b = (to - origin[i] + tiny) * inverse[i];
            const double near = a < b ? a : b;
            const double far = a < b ? b : a;
            enter[i] = near > enter[i] ? near : enter[i];
            leave[i] = far < leave[i] ? far : leave[i];
        }
    }
}

/* Where the rays are in the volume and in the clip box. */
static void cut_rays(const mtm_raycast *raycast, ray_setup *restrict setup) {
    double enter[WIDTH];
    const double whole_low[3] = {0, 0, 0};
    const double whole_high[3] = {raycast->size[0] - 1, raycast->size[1] - 1, raycast->size[2] - 1};
    double leave[WIDTH];
    intersect(setup, whole_low, whole_high, enter, leave);
    if (raycast->is_clipped) {
        double begin[WIDTH];
        double end[WIDTH];
        intersect(setup, raycast->box_low, raycast->box_high, begin, end);
        memcpy(setup->begin, begin, sizeof begin);
        memcpy(setup->end, end, sizeof end);
    } else {
        memcpy(setup->begin, enter, sizeof enter);
        memcpy(setup->end, leave, sizeof leave);
    }
    /* A perspective ray begins in the eye; an orthographic one comes from infinitely far away. */
    const double earliest = raycast->view.is_orthographic ? -HUGE_VAL : 0;
    FOR_RAYS(i) {
        setup->entry[i] = enter[i] > earliest ? enter[i] : earliest;
        setup->begin[i] = setup->begin[i] > setup->entry[i] ? setup->begin[i] : setup->entry[i];
        setup->end[i] = setup->end[i] < leave[i] ? setup->end[i] : leave[i];
    }
}

static void jitter_rays(const mtm_raycast *raycast, const mtm_lattice *lattice, int column, int row,
                        ray_setup *setup) {
    memset(setup->jitter, 0, sizeof setup->jitter);
    if (!raycast->options.jitter) return;
    FOR_RAYS(i) {
        const uint32_t x = (uint32_t)(lattice->x + (column + i % PACKET_ACROSS) * lattice->stride);
        const uint32_t y = (uint32_t)(lattice->y + (row + i / PACKET_ACROSS) * lattice->stride);
        setup->jitter[i] = mtm_pixel_random(x, y) - 0.5;
    }
}

static double smaller(double a, double b) {
    return a < b ? a : b;
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

static const bounds no_bounds = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};

/* The smallest of `low` and the largest of `high`, in a tree of constant sizes, which compilers turn into vectors. */
#define HALVE_RANGE(n)                                                                                       \
    for (int i = 0; i < (n); i++) {                                                                          \
        low[i] = smaller(low[i], low[i + (n)]);                                                              \
        high[i] = larger(high[i], high[i + (n)]);                                                            \
    }

static inline void find_range(double low[WIDTH], double high[WIDTH]) {
#if MTM_VECTOR_WIDTH > 8
    HALVE_RANGE(8)
#endif
#if MTM_VECTOR_WIDTH > 4
    HALVE_RANGE(4)
#endif
    HALVE_RANGE(2)
    HALVE_RANGE(1)
}

static void widen(bounds *all, const bounds *one) {
    for (int axis = 0; axis < 3; axis++) {
        all->low[axis] = smaller(all->low[axis], one->low[axis]);
        all->high[axis] = larger(all->high[axis], one->high[axis]);
    }
}

/* Which rays meet the volume, and their first and last step from the eye. */
static void count_steps(const mtm_raycast *raycast, ray_setup *restrict setup) {
    const double inverse_step = 1 / raycast->step;
    const double spare = raycast->options.jitter ? 1 : 0; /* a jittered ray begins and ends half a step off */
    FOR_RAYS(i) {
        const double entry = setup->entry[i];
        const bool is_hit =
            setup->begin[i] < setup->end[i] && entry * inverse_step < 1e15 && setup->end[i] < 1e300;
        setup->is_hit[i] = is_hit ? 1 : 0;
        const double step = floor(entry * inverse_step);
        setup->first_step[i] = is_hit ? step : 0;
        setup->step_begin[i] =
            is_hit ? step + floor((setup->begin[i] - entry) * inverse_step) - spare : HUGE_VAL;
        setup->step_end[i] = is_hit ? step + ceil((setup->end[i] - entry) * inverse_step) + spare : -HUGE_VAL;
    }
}

/* Distances are not negative, so a slow or backward direction makes the low corner at the one or the other end. */
static void make_box(const mtm_raycast *raycast, const bounds *origins, const bounds *directions,
                     slab_box *box) {
    const double margin = 1e-3; /* of a voxel, more than floats are off */
    const double blocks = 1.0 / (1 << raycast->occupancy->cells_log2);
    *box = (slab_box){.last = {0}};
    for (int axis = 0; axis < 3; axis++) {
        const double slowest = directions->low[axis] * blocks;
        const double fastest = directions->high[axis] * blocks;
        box->low[axis] = (origins->low[axis] - margin) * blocks;
        box->low_begin[axis] = larger(slowest, 0);
        box->low_end[axis] = smaller(slowest, 0);
        box->high[axis] = (origins->high[axis] + margin) * blocks;
        box->high_begin[axis] = smaller(fastest, 0);
        box->high_end[axis] = larger(fastest, 0);
        box->last[axis] = raycast->occupancy->size[axis] - 1;
    }
}

/* numbers of the rays that meet the volume, 0 elsewhere */
static mtm_vector to_floats(const double is_hit[WIDTH], const double numbers[WIDTH]) {
    float floats[WIDTH];
    FOR_RAYS(i) floats[i] = (float)(is_hit[i] > 0 ? numbers[i] : 0);
    return mtm_vector_load(floats);
}

static void bound(const double is_hit[WIDTH], const double numbers[WIDTH], int axis, bounds *range) {
    double low[WIDTH];
    double high[WIDTH];
    FOR_RAYS(i) {
        low[i] = is_hit[i] > 0 ? numbers[i] : HUGE_VAL;
        high[i] = is_hit[i] > 0 ? numbers[i] : -HUGE_VAL;
    }
    find_range(low, high);
    range->low[axis] = low[0];
    range->high[axis] = high[0];
}

/* Brings rays to floats, relative to their entry: there they keep their precision however far away the eye is. */
static void store_rays(const mtm_raycast *raycast, const ray_setup *setup, ray_packet *packet) {
    const double *is_hit = setup->is_hit;
    const double step = raycast->step;
    double numbers[WIDTH];
    packet->voxels_ahead = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double *origin = setup->voxel_origin[axis];
        const double *direction = setup->voxel_direction[axis];
        FOR_RAYS(i) numbers[i] = origin[i] + setup->entry[i] * direction[i];
        packet->entry[axis] = to_floats(is_hit, numbers);
        packet->voxel_direction[axis] = to_floats(is_hit, direction);
        packet->direction[axis] = to_floats(is_hit, setup->direction[axis]);
        bound(is_hit, origin, axis, &packet->origins);
        bound(is_hit, direction, axis, &packet->directions);
        const double ahead = 0.5 * (packet->directions.low[axis] + packet->directions.high[axis]) * step;
        packet->voxels_ahead +=
            (int32_t)(raycast->stride[axis] & INT32_MAX) * (int32_t)lrint(ahead * PREFETCH_STEPS);
    }
    make_box(raycast, &packet->origins, &packet->directions, &packet->box);
    FOR_RAYS(i) numbers[i] = setup->begin[i] - setup->entry[i];
    packet->begin = to_floats(is_hit, numbers);
    FOR_RAYS(i) numbers[i] = setup->end[i] - setup->entry[i];
    packet->end = to_floats(is_hit, numbers);
    FOR_RAYS(i) numbers[i] = setup->jitter[i] * step;
    packet->shift = to_floats(is_hit, numbers);
}

/* A tile of packets and which slabs of steps, from first_step on, may hold anything. */
typedef struct ray_tile {
    ray_packet packets[PACKETS];
    double first_step; /* from the eye, a multiple of SLAB_STEPS */
    unsigned char is_occupied[SLABS_LISTED];
} ray_tile;

/* Blocks of a corner, kept in the volume. */
MTM_INLINE four_ints block_of(four_doubles corner, four_ints last) {
    const four_ints block = __builtin_convertvector(corner, four_ints);
    const four_ints low = block & (block > 0);
    const four_ints is_inside = low < last;
    return (low & is_inside) | (last & ~is_inside);
}

/* Whether any block that the rays touch in a slab's steps is visible. A step reaches from its number to the next one
 * but one, because the entry lies somewhere between two steps; jitter adds half a step on either side. */
static bool may_see(const mtm_raycast *raycast, const slab_box *box, double first_step) {
    if ((raycast->options.without & MTM_WITHOUT_SKIPPING) != 0) return true;
    const double slack = raycast->options.jitter ? 0.5 : 0;
    const double begin = larger((first_step - slack) * raycast->step, 0);
    const double end = (first_step + SLAB_STEPS + 1 + slack) * raycast->step;
    const four_ints from = block_of(box->low + begin * box->low_begin + end * box->low_end, box->last);
    const four_ints to = block_of(box->high + begin * box->high_begin + end * box->high_end, box->last);
    int32_t first[4];
    int32_t last[4];
    memcpy(first, &from, sizeof first);
    memcpy(last, &to, sizeof last);
    return mtm_occupancy_any_of(raycast->occupancy, first, last);
}

/* A packet's steps, in numbers of the tile. */
static void number_steps(const double first_steps[WIDTH], const double range[2], double tile_step,
                         ray_packet *packet) {
    float first[WIDTH];
    for (int i = 0; i < WIDTH; i++) first[i] = (float)(first_steps[i] - tile_step);
    packet->first_step = mtm_vector_load(first);
    packet->step_begin = (int)(range[0] - tile_step);
    packet->step_end = (int)(range[1] - tile_step);
}

/* Sets up the rays of a tile; false where none meets the volume. */
static bool aim_tile(const mtm_raycast *raycast, const mtm_lattice *lattice, int across, int down,
                     ray_tile *tile) {
    double first_steps[PACKETS][WIDTH];
    double ranges[PACKETS][2];
    double first = HUGE_VAL;
    double last = -HUGE_VAL;
    bounds origins = no_bounds;
    bounds directions = no_bounds;
    for (int p = 0; p < PACKETS; p++) {
        ray_packet *packet = &tile->packets[p];
        const int column = across * MTM_TILE_PIXELS + p % PACKETS_ACROSS * PACKET_ACROSS;
        const int row = down * MTM_TILE_PIXELS + p / PACKETS_ACROSS * PACKET_DOWN;
        ray_setup setup;
        aim_rays(raycast, lattice, column, row, &setup);
        cut_rays(raycast, &setup);
        jitter_rays(raycast, lattice, column, row, &setup);
        count_steps(raycast, &setup);
        double low[WIDTH];
        double high[WIDTH];
        memcpy(low, setup.step_begin, sizeof low);
        memcpy(high, setup.step_end, sizeof high);
        memcpy(first_steps[p], setup.first_step, sizeof first_steps[p]);
        find_range(low, high);
        packet->is_hit = low[0] < high[0];
        if (!packet->is_hit) continue;
        ranges[p][0] = low[0];
        ranges[p][1] = high[0];
        first = smaller(first, low[0]);
        last = larger(last, high[0]);
        store_rays(raycast, &setup, packet);
        widen(&origins, &packet->origins);
        widen(&directions, &packet->directions);
    }
    if (!(first < last)) return false;
    tile->first_step = floor(first / SLAB_STEPS) * SLAB_STEPS;
    for (int p = 0; p < PACKETS; p++)
        if (tile->packets[p].is_hit)
            number_steps(first_steps[p], ranges[p], tile->first_step, &tile->packets[p]);
    slab_box box;
    make_box(raycast, &origins, &directions, &box);
    const double slabs = ceil((last - tile->first_step) / SLAB_STEPS);
    for (int slab = 0; slab < slabs && slab < SLABS_LISTED; slab++)
        tile->is_occupied[slab] = may_see(raycast, &box, tile->first_step + slab * SLAB_STEPS);
    return true;
}

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

/* Vectors over the coefficients of one ray. */
typedef float four_floats __attribute__((vector_size(16)));
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
    float weights[WIDTH];
    int32_t lows[WIDTH];
    int32_t highs[WIDTH];
    mtm_vector_spill_floats(weight, weights);
    mtm_vector_spill(low * lanes, lows);
    mtm_vector_spill(high * lanes, highs);
    if (__builtin_popcount(seen) > WIDTH / 2 && lanes <= 16) {
#pragma GCC unroll 16
        for (int i = 0; i < WIDTH; i++)
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
    int32_t lows[WIDTH];
    int32_t highs[WIDTH];
    mtm_vector_spill(low * 8, lows);
    mtm_vector_spill(high * 8, highs);
    __m512i spread = _mm512_setr_epi32(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1);
#pragma GCC unroll 8
    for (int i = 0; i < WIDTH; i += 2) {
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
    if (__builtin_popcount(seen) > WIDTH / 2) {
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
    middle.row = (front->row + back->row) >> 1;
    middle.has_sums = false;
    middle.has_gradient = true;
    const mtm_vector half = 0.5f * length;
    for (int part = 0; part < 2; part++) {
        packet_sample from = part == 0 ? *front : middle;
        packet_sample to = part == 0 ? blend_samples(is_deep, &middle, back) : *back;
        const mtm_vector rest = part == 0 ? length : mtm_vector_all(0);
        add_stretch(false, pass, packet, &from, &to, mtm_vector_select(is_deep, half, rest), sum);
    }
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
