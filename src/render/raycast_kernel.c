/* SPDX-License-Identifier: BSD-3-Clause
 * The raycaster's inner loop: one ray at a time, double precision where errors add up along the ray.
 * Levoy, "Display of surfaces from volume data", CG&A 8(3), 1988; Max, "Optical models for direct volume rendering",
 * TVCG 1(2), 1995; paper section 5, eqs. 5 and 6. */
#include "render/raycast_kernel.h"

#include <math.h>
#include <string.h>

#include "volume/blocks.h"

#define ALWAYS_INLINE static inline __attribute__((always_inline))

/* A ray through the volume, in world distances from its origin. */
typedef struct ray_span {
    double origin[3], direction[3];             /* world */
    double voxel_origin[3], voxel_direction[3]; /* the same in voxel coordinates */
    double entry;                               /* where samples are counted from */
    double begin, end;                          /* the clipped part */
    double jitter;                              /* -½ … ½ */
} ray_span;

/* Where a sample is: a cell and the position inside it. */
typedef struct sample_place {
    int cell[3];
    float fraction[3];
} sample_place;

/* What a ray gathers. Double, because at small steps thousands of small terms add up. */
typedef struct gathered {
    double coefficients[MTM_DIMENSION_MAX + 1];
    double highlight; /* weight of the white reflector */
    double transmittance;
} gathered;

ALWAYS_INLINE float lerp(float a, float b, float fraction) {
    return a + fraction * (b - a);
}

/* A random number in 0 … 1 that depends on the pixel only (an integer hash, so the same on every machine). */
static double pixel_random(uint32_t x, uint32_t y) {
    uint32_t h = x * 0x9E3779B1u ^ (y + 0x7F4A7C15u) * 0x85EBCA77u;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return (double)(h ^ h >> 15) / 4294967296.0;
}

/* Distances at which a ray enters and leaves a box in voxel coordinates; false where it misses it. */
static bool intersect(const ray_span *ray, const double low[3], const double high[3], double *enter,
                      double *leave) {
    double first = -HUGE_VAL;
    double last = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double origin = ray->voxel_origin[axis];
        const double direction = ray->voxel_direction[axis];
        if (direction == 0) {
            if (origin < low[axis] || origin > high[axis]) return false;
            continue;
        }
        const double a = (low[axis] - origin) / direction;
        const double b = (high[axis] - origin) / direction;
        first = fmax(first, fmin(a, b));
        last = fmin(last, fmax(a, b));
    }
    *enter = first;
    *leave = last;
    return first < last && isfinite(first) && isfinite(last);
}

static bool aim(const mtm_raycast *raycast, int x, int y, ray_span *ray) {
    const mtm_render_options *options = &raycast->options;
    mtm_view_ray(&raycast->view, options->width, options->height, x + 0.5, y + 0.5, ray->origin,
                 ray->direction);
    double whole_high[3];
    for (int axis = 0; axis < 3; axis++) {
        const double *row = raycast->inverse_axes[axis];
        const double from[3] = {ray->origin[0] - raycast->grid_origin[0],
                                ray->origin[1] - raycast->grid_origin[1],
                                ray->origin[2] - raycast->grid_origin[2]};
        ray->voxel_origin[axis] = row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
        ray->voxel_direction[axis] =
            row[0] * ray->direction[0] + row[1] * ray->direction[1] + row[2] * ray->direction[2];
        whole_high[axis] = raycast->size[axis] - 1;
    }
    double leave = 0;
    if (!intersect(ray, (const double[3]){0, 0, 0}, whole_high, &ray->entry, &leave)) return false;
    if (!intersect(ray, raycast->box_low, raycast->box_high, &ray->begin, &ray->end)) return false;
    /* A perspective ray begins in the eye; an orthographic one comes from infinitely far away. */
    if (!raycast->view.is_orthographic) {
        ray->entry = fmax(ray->entry, 0);
        ray->begin = fmax(ray->begin, 0);
    }
    ray->end = fmin(ray->end, leave);
    ray->jitter = options->jitter ? pixel_random((uint32_t)x, (uint32_t)y) - 0.5 : 0;
    return ray->begin < ray->end;
}

ALWAYS_INLINE void locate(const mtm_raycast *raycast, const ray_span *ray, double distance,
                          sample_place *place) {
    for (int axis = 0; axis < 3; axis++) {
        const double position = ray->voxel_origin[axis] + distance * ray->voxel_direction[axis];
        const int last_cell = raycast->size[axis] > 1 ? raycast->size[axis] - 2 : 0;
        int cell = position > 0 ? (int)position : 0;
        cell = cell < last_cell ? cell : last_cell;
        const double fraction = position - cell;
        place->cell[axis] = cell;
        place->fraction[axis] = (float)(fraction > 0 ? (fraction < 1 ? fraction : 1) : 0);
    }
}

ALWAYS_INLINE float interpolate(const mtm_cell *cell, const float fraction[3]) {
    const float *c = cell->corner;
    const float y0 = lerp(lerp(c[0], c[1], fraction[0]), lerp(c[2], c[3], fraction[0]), fraction[1]);
    const float y1 = lerp(lerp(c[4], c[5], fraction[0]), lerp(c[6], c[7], fraction[0]), fraction[1]);
    return lerp(y0, y1, fraction[2]);
}

ALWAYS_INLINE float interpolate_edges(const float edges[4], float u, float v) {
    return lerp(lerp(edges[0], edges[1], u), lerp(edges[2], edges[3], u), v);
}

/* Derivative along one axis: central differences at the two planes of the cell (one-sided at the volume's faces),
 * interpolated; the same as interpolating the gradients of the eight corners. */
ALWAYS_INLINE float derivative(const mtm_raycast *raycast, const mtm_cell *loaded, const sample_place *place,
                               int axis) {
    static const int near_corner[3][4] = {{0, 2, 4, 6}, {0, 1, 4, 5}, {0, 1, 2, 3}};
    static const int far_step[3] = {1, 2, 4};
    static const int across[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    const float u = place->fraction[across[axis][0]];
    const float v = place->fraction[across[axis][1]];
    float near_edges[4];
    float far_edges[4];
    for (int edge = 0; edge < 4; edge++) {
        near_edges[edge] = loaded->corner[near_corner[axis][edge]];
        far_edges[edge] = loaded->corner[near_corner[axis][edge] + far_step[axis]];
    }
    const float before = interpolate_edges(loaded->before[axis], u, v);
    const float at_near = interpolate_edges(near_edges, u, v);
    const float at_far = interpolate_edges(far_edges, u, v);
    const float after = interpolate_edges(loaded->after[axis], u, v);
    const float near_scale = place->cell[axis] > 0 ? 0.5f : 1.0f;
    const float far_scale = place->cell[axis] + 2 < raycast->size[axis] ? 0.5f : 1.0f;
    return lerp(near_scale * (at_far - before), far_scale * (after - at_near), place->fraction[axis]);
}

/* Factors of the material and of white at a sample. */
typedef struct sample_shade {
    double material, white;
} sample_shade;

static double smoothstep(double from, double to, double x) {
    if (x <= from) return 0;
    if (x >= to) return 1;
    const double t = (x - from) / (to - from);
    return t * t * (3 - 2 * t);
}

/* Blinn–Phong (Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977). */
static sample_shade shade_sample(const mtm_raycast *raycast, const ray_span *ray, const sample_place *place,
                                 mtm_cell *loaded) {
    const mtm_shading *shading = &raycast->options.shading;
    sample_shade result = {shading->ambient, 0};
    if (!raycast->needs_gradient) return result;

    raycast->load_neighbors(raycast, place->cell, loaded);
    double normal[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; axis++) {
        const double slope = derivative(raycast, loaded, place, axis);
        for (int i = 0; i < 3; i++) normal[i] += slope * raycast->inverse_axes[axis][i];
    }
    const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    const double threshold = shading->gradient_threshold;
    const double strength = smoothstep(threshold, 2 * threshold, length * raycast->gradient_scale);
    if (!(length > 0) || strength == 0) return result;

    const double *direction = ray->direction;
    const double facing =
        (normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2]) / length;
    double diffuse = fabs(facing);
    double highlight = diffuse; /* a headlight's half vector is the view direction */
    if (!shading->is_headlight) {
        const double *light = raycast->light;
        const double sign = facing > 0 ? -1 / length : 1 / length; /* the normal turned to the viewer */
        const double toward[3] = {light[0] - direction[0], light[1] - direction[1], light[2] - direction[2]};
        const double half_length =
            sqrt(toward[0] * toward[0] + toward[1] * toward[1] + toward[2] * toward[2]);
        diffuse = sign * (normal[0] * light[0] + normal[1] * light[1] + normal[2] * light[2]);
        highlight = sign * (normal[0] * toward[0] + normal[1] * toward[1] + normal[2] * toward[2]);
        highlight = half_length > 0 && diffuse > 0 ? fmax(highlight / half_length, 0) : 0;
        diffuse = fmax(diffuse, 0);
    }
    result.material += strength * shading->diffuse * diffuse;
    if (shading->specular > 0 && diffuse > 0)
        result.white = strength * shading->specular * pow(highlight, shading->shininess);
    return result;
}

ALWAYS_INLINE void add_material(gathered *sum, const mtm_transfer_row *row, double weight, int lanes) {
    for (int i = 0; i < lanes; i++)
        sum->coefficients[i] += weight * lerp(row->segment->first[i], row->segment->last[i], row->share);
}

/* ∫T over `length` of matter, (1 - e^-τl)/τ, where `lost` is e^-τl - 1. */
ALWAYS_INLINE double seen_length(double extinction, double lost, double length) {
    return extinction > 0 ? -lost / extinction : length;
}

/* One sample that stands for `length` of the ray: light scattered toward the eye, then absorption (paper eq. 5). */
ALWAYS_INLINE void add_sample(const mtm_raycast *raycast, const ray_span *ray, const sample_place *place,
                              mtm_cell *loaded, float position, double length, gathered *sum, int lanes) {
    const mtm_transfer_row row = mtm_transfer_look_up(raycast->transfer, position);
    const double extinction = raycast->options.blend == MTM_BLEND_SUM ? 0 : (double)row.extinction;
    const double emission = row.emission;
    if (!(extinction > 0) && !(emission > 0)) return;

    const double lost = expm1(-extinction * length);
    const double seen = seen_length(extinction, lost, length); /* the material's emission is constant in it */
    if (emission > 0) {
        const sample_shade shade = shade_sample(raycast, ray, place, loaded);
        add_material(sum, &row, sum->transmittance * emission * seen * shade.material, lanes);
        /* Only matter that absorbs can shine: an X-ray material made black must vanish, highlights and all. */
        sum->highlight += sum->transmittance * fmin(emission, extinction) * seen * shade.white;
    }
    sum->transmittance += sum->transmittance * lost;
}

static size_t block_of(const mtm_raycast *raycast, const int cell[3]) {
    const size_t x = (size_t)(cell[0] / MTM_BLOCK_CELLS);
    const size_t y = (size_t)(cell[1] / MTM_BLOCK_CELLS);
    const size_t z = (size_t)(cell[2] / MTM_BLOCK_CELLS);
    return (z * (size_t)raycast->block_size[1] + y) * (size_t)raycast->block_size[0] + x;
}

/* The first sample that can lie behind the block that holds `cell`. Samples within a rounding error of its far face
 * see only voxels of that face, which belong to the block, too. */
static int64_t sample_behind_block(const mtm_raycast *raycast, const ray_span *ray, const int cell[3],
                                   int64_t sample) {
    double leave = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double direction = ray->voxel_direction[axis];
        if (direction == 0) continue;
        const int block = cell[axis] / MTM_BLOCK_CELLS;
        const int face = direction > 0 ? (block + 1) * MTM_BLOCK_CELLS : block * MTM_BLOCK_CELLS;
        leave = fmin(leave, (face - ray->voxel_origin[axis]) / direction);
    }
    const double next = ceil((leave - ray->entry) / raycast->step - 0.5 - ray->jitter - 1e-6);
    return next > (double)(sample + 1) ? (int64_t)fmin(next, 1e9) : sample + 1;
}

/* The part of sample `k`'s step that lies in the clipped ray. */
ALWAYS_INLINE double covered_length(const mtm_raycast *raycast, const ray_span *ray, int64_t k) {
    const double from = ray->entry + (double)k * raycast->step;
    return fmin(from + raycast->step, ray->end) - fmax(from, ray->begin);
}

ALWAYS_INLINE void walk(const mtm_raycast *raycast, const ray_span *ray, gathered *sum, int lanes) {
    const int64_t last = (int64_t)ceil((ray->end - ray->entry) / raycast->step);
    for (int64_t k = (int64_t)floor((ray->begin - ray->entry) / raycast->step); k < last;) {
        const double distance = ray->entry + ((double)k + 0.5 + ray->jitter) * raycast->step;
        sample_place place;
        locate(raycast, ray, distance, &place);
        if (!raycast->is_block_visible[block_of(raycast, place.cell)]) {
            k = sample_behind_block(raycast, ray, place.cell, k);
            continue;
        }
        const double length = covered_length(raycast, ray, k);
        k++;
        if (!(length > 0)) continue;
        mtm_cell loaded;
        raycast->load_corners(raycast, place.cell, &loaded);
        const float position = mtm_transfer_clamp(interpolate(&loaded, place.fraction));
        add_sample(raycast, ray, &place, &loaded, position, length, sum, lanes);
        if (sum->transmittance < raycast->options.termination) break;
    }
}

/* Maximum intensity: the largest value among the samples, then classified once (Wallis, Miller, "Three-dimensional
 * display in nuclear medicine", IEEE TMI 8(4), 1989). */
static void find_maximum(const mtm_raycast *raycast, const ray_span *ray, gathered *sum, int lanes) {
    const int64_t last = (int64_t)ceil((ray->end - ray->entry) / raycast->step);
    float highest = -HUGE_VALF;
    for (int64_t k = (int64_t)floor((ray->begin - ray->entry) / raycast->step); k < last;) {
        const double distance = ray->entry + ((double)k + 0.5 + ray->jitter) * raycast->step;
        sample_place place;
        locate(raycast, ray, distance, &place);
        if (raycast->block_highest[block_of(raycast, place.cell)] <= highest) {
            k = sample_behind_block(raycast, ray, place.cell, k);
            continue;
        }
        if (covered_length(raycast, ray, k++) > 0) {
            mtm_cell loaded;
            raycast->load_corners(raycast, place.cell, &loaded);
            highest = fmaxf(highest, interpolate(&loaded, place.fraction));
        }
    }
    if (highest == -HUGE_VALF) return;
    const double length = raycast->transfer->opacity_length;
    const mtm_transfer_row row = mtm_transfer_look_up(raycast->transfer, mtm_transfer_clamp(highest));
    const double lost = expm1(-row.extinction * length);
    add_material(sum, &row, row.emission * seen_length(row.extinction, lost, length), lanes);
    sum->transmittance += lost;
}

ALWAYS_INLINE void render_pixel(const mtm_raycast *raycast, int x, int y, mtm_image *image, int lanes) {
    float *pixel = image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)lanes;
    memset(pixel, 0, (size_t)lanes * sizeof *pixel);
    ray_span ray;
    if (!aim(raycast, x, y, &ray)) return;
    gathered sum = {.transmittance = 1};
    if (raycast->options.blend == MTM_BLEND_MAXIMUM)
        find_maximum(raycast, &ray, &sum, lanes);
    else
        walk(raycast, &ray, &sum, lanes);
    const int dimension = image->dimension;
    for (int i = 0; i < dimension; i++)
        pixel[i] = (float)(sum.coefficients[i] + sum.highlight * raycast->transfer->white[i]);
    pixel[dimension] = (float)(1 - sum.transmittance);
}

ALWAYS_INLINE void render_tile(const mtm_raycast *raycast, int x, int y, mtm_image *image, int lanes) {
    for (int j = y; j < y + MTM_TILE_PIXELS && j < image->height; j++)
        for (int i = x; i < x + MTM_TILE_PIXELS && i < image->width; i++)
            render_pixel(raycast, i, j, image, lanes);
}

void mtm_raycast_tile(const mtm_raycast *raycast, int x, int y, mtm_image *image) {
    switch (image->lanes) {
    case 4: render_tile(raycast, x, y, image, 4); break;
    case 8: render_tile(raycast, x, y, image, 8); break;
    case 16: render_tile(raycast, x, y, image, 16); break;
    default: render_tile(raycast, x, y, image, image->lanes); break;
    }
}
