/* SPDX-License-Identifier: BSD-3-Clause
 * Setting up a tile of ray packets: where they begin and end, which steps they share, and which slabs of steps may hold
 * anything at all. Included by the kernel only, so compiled per instruction set. */
#ifndef METAMER_RENDER_PACKET_RAYS_H
#define METAMER_RENDER_PACKET_RAYS_H

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "render/packet_coefficients.h" /* four_ints */
#include "render/raycast.h"

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
typedef struct slab_box {
    four_doubles low, low_begin, low_end;
    four_doubles high, high_begin, high_end;
    four_ints last; /* block along each axis */
} slab_box;

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
#define FOR_RAYS _Pragma("GCC unroll 1") for (int i = 0; i < WIDTH; i++)

/* Directions, in the picture as everywhere from mtm_view_ray. */
static void aim_rays(const mtm_raycast *raycast, const mtm_lattice *lattice, int column, int row,
                     ray_setup *restrict setup) {
    const mtm_view view = raycast->view;
    const double width = raycast->options.width;
    const double height = raycast->options.height;
    const double first_x = lattice->x + column * lattice->stride + 0.5;
    const double first_y = lattice->y + row * lattice->stride + 0.5;
    const double stride = lattice->stride;
    FOR_RAYS {
        const int across = i % PACKET_ACROSS;
        setup->across[i] = (2 * (first_x + across * stride) - width) / height * view.half_height;
        const int down = i / PACKET_ACROSS;
        setup->upward[i] = (1 - 2 * (first_y + down * stride) / height) * view.half_height;
    }
    const double origin_share = view.is_orthographic ? 1 : 0;
    const double direction_share = 1 - origin_share;
    for (int axis = 0; axis < 3; axis++) {
        const double right = view.right[axis];
        const double up = view.up[axis];
        const double forward = view.forward[axis];
        const double eye = view.eye[axis] - raycast->grid_origin[axis];
        FOR_RAYS {
            const double offset = setup->across[i] * right + setup->upward[i] * up;
            setup->origin[axis][i] = eye + origin_share * offset;
            setup->direction[axis][i] = forward + direction_share * offset;
        }
    }
    FOR_RAYS {
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
        FOR_RAYS {
            setup->voxel_origin[axis][i] =
                a * setup->origin[0][i] + b * setup->origin[1][i] + c * setup->origin[2][i];
            const double direction =
                a * setup->direction[0][i] + b * setup->direction[1][i] + c * setup->direction[2][i];
            setup->voxel_direction[axis][i] = direction;
            setup->inverse_direction[axis][i] = 1 / (fabs(direction) > 1e-200 ? direction : 1e-200);
        }
    }
}

/* Distances at which the rays enter and leave a box; the former is larger where they miss it. */
static void intersect(const ray_setup *setup, const double low[3], const double high[3],
                      double enter[restrict WIDTH], double leave[restrict WIDTH]) {
    FOR_RAYS {
        enter[i] = -HUGE_VAL;
        leave[i] = HUGE_VAL;
    }
    for (int axis = 0; axis < 3; axis++) {
        const double *origin = setup->voxel_origin[axis];
        const double *inverse = setup->inverse_direction[axis];
        const double from = low[axis];
        const double to = high[axis];
        FOR_RAYS {
            const double a = (from - origin[i]) * inverse[i];
            const double b = (to - origin[i]) * inverse[i];
            /* A ray along the box's faces is between them all the way or never. */
            const bool is_between = origin[i] >= from && origin[i] <= to;
            const bool is_along = inverse[i] > 1e199;
            const double near = is_along ? (is_between ? -HUGE_VAL : HUGE_VAL) : a < b ? a : b;
            const double far = is_along ? HUGE_VAL : a < b ? b : a;
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
    FOR_RAYS {
        setup->entry[i] = enter[i] > earliest ? enter[i] : earliest;
        setup->begin[i] = setup->begin[i] > setup->entry[i] ? setup->begin[i] : setup->entry[i];
        setup->end[i] = setup->end[i] < leave[i] ? setup->end[i] : leave[i];
    }
}

static void jitter_rays(const mtm_raycast *raycast, const mtm_lattice *lattice, int column, int row,
                        ray_setup *setup) {
    memset(setup->jitter, 0, sizeof setup->jitter);
    if (!raycast->options.jitter) return;
    FOR_RAYS {
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
    FOR_RAYS {
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
    FOR_RAYS floats[i] = (float)(is_hit[i] > 0 ? numbers[i] : 0);
    return mtm_vector_load(floats);
}

static void bound(const double is_hit[WIDTH], const double numbers[WIDTH], int axis, bounds *range) {
    double low[WIDTH];
    double high[WIDTH];
    FOR_RAYS {
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
        FOR_RAYS numbers[i] = origin[i] + setup->entry[i] * direction[i];
        packet->entry[axis] = to_floats(is_hit, numbers);
        packet->voxel_direction[axis] = to_floats(is_hit, direction);
        packet->direction[axis] = to_floats(is_hit, setup->direction[axis]);
        bound(is_hit, origin, axis, &packet->origins);
        bound(is_hit, direction, axis, &packet->directions);
        const double ahead = 0.5 * (packet->directions.low[axis] + packet->directions.high[axis]) * step;
        packet->voxels_ahead +=
            (int32_t)(raycast->stride[axis] & INT32_MAX) * (int32_t)lrint(ahead * PREFETCH_STEPS);
    }
    if (raycast->packed->voxel_bytes == 0 || (raycast->options.without & MTM_WITHOUT_PREFETCH) != 0)
        packet->voxels_ahead = 0;
    make_box(raycast, &packet->origins, &packet->directions, &packet->box);
    FOR_RAYS numbers[i] = setup->begin[i] - setup->entry[i];
    packet->begin = to_floats(is_hit, numbers);
    FOR_RAYS numbers[i] = setup->end[i] - setup->entry[i];
    packet->end = to_floats(is_hit, numbers);
    FOR_RAYS numbers[i] = setup->jitter[i] * step;
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

#endif
