/* SPDX-License-Identifier: BSD-3-Clause
 * The plain raycaster: one ray at a time, double precision where errors add up along the ray, classified by the
 * transfer function itself. It is what the packets of raycast_kernel.c are held against, and finds maxima.
 * Levoy, "Display of surfaces from volume data", CG&A 8(3), 1988; Max, "Optical models for direct volume rendering",
 * TVCG 1(2), 1995; paper section 5, eqs. 5 and 6. */
#include <math.h>
#include <string.h>

#include "render/raycast_plain.h"

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

static float lerp(float a, float b, float fraction) {
    return a + fraction * (b - a);
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
    ray->jitter = options->jitter ? mtm_pixel_random((uint32_t)x, (uint32_t)y) - 0.5 : 0;
    return ray->begin < ray->end;
}

static void locate(const mtm_raycast *raycast, const ray_span *ray, double distance, sample_place *place) {
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

static float interpolate(const mtm_cell *cell, const float fraction[3]) {
    const float *c = cell->corner;
    const float y0 = lerp(lerp(c[0], c[1], fraction[0]), lerp(c[2], c[3], fraction[0]), fraction[1]);
    const float y1 = lerp(lerp(c[4], c[5], fraction[0]), lerp(c[6], c[7], fraction[0]), fraction[1]);
    return lerp(y0, y1, fraction[2]);
}

static float interpolate_edges(const float edges[4], float u, float v) {
    return lerp(lerp(edges[0], edges[1], u), lerp(edges[2], edges[3], u), v);
}

/* Derivative along one axis: central differences at the two planes of the cell (one-sided at the volume's faces),
 * interpolated; the same as interpolating the gradients of the eight corners. */
static float derivative(const mtm_raycast *raycast, const mtm_cell *loaded, const sample_place *place,
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

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double smoothstep(double from, double to, double x) {
    if (x <= from) return 0;
    if (x >= to) return 1;
    const double t = (x - from) / (to - from);
    return t * t * (3 - 2 * t);
}

/* The gradient in world axes, per world unit, in positions. */
static void world_gradient(const mtm_raycast *raycast, const sample_place *place, mtm_cell *loaded,
                           double gradient[3]) {
    mtm_raycast_load_neighbors(raycast, place->cell, loaded);
    for (int i = 0; i < 3; i++) gradient[i] = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double slope = (double)derivative(raycast, loaded, place, axis);
        for (int i = 0; i < 3; i++) gradient[i] += slope * raycast->inverse_axes[axis][i];
    }
}

/* Blinn–Phong (Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977). */
static sample_shade shade(const mtm_raycast *raycast, const ray_span *ray, const double normal[3]) {
    const mtm_shading *shading = &raycast->options.shading;
    sample_shade result = {shading->ambient, 0};
    const double length = sqrt(dot(normal, normal));
    const double threshold = shading->gradient_threshold;
    const double strength = smoothstep(threshold, 2 * threshold, length * raycast->gradient_scale);
    if (!(length > 0) || strength == 0) return result;

    const double facing = dot(normal, ray->direction) / length;
    double diffuse = fabs(facing);
    double highlight = diffuse; /* a headlight's half vector is the view direction */
    if (!shading->is_headlight) {
        const double *light = raycast->light;
        const double sign = facing > 0 ? -1 / length : 1 / length; /* the normal turned to the viewer */
        const double toward[3] = {light[0] - ray->direction[0], light[1] - ray->direction[1],
                                  light[2] - ray->direction[2]};
        const double half_length = sqrt(dot(toward, toward));
        diffuse = fmax(sign * dot(normal, light), 0);
        highlight = half_length > 0 ? fmax(sign * dot(normal, toward) / half_length, 0) : 0;
    }
    result.material += strength * shading->diffuse * diffuse;
    if (shading->specular > 0 && diffuse > 0)
        result.white = strength * shading->specular * pow(highlight, shading->shininess);
    return result;
}

/* What the transfer function makes of a stretch of values: means over it. */
typedef struct stretch {
    double extinction, emission;
    double
        highlight; /* of the smaller of both: only matter that absorbs can shine, so that an X-ray material made
                         black vanishes, highlights and all */
    double coefficients[MTM_DIMENSION_MAX]; /* of emission · coefficients */
} stretch;

enum { STRETCH_PARTS = 64 };

/* Means over the values between two positions, from midpoints of equal parts. */
static void classify(const mtm_raycast *raycast, float front, float back, stretch *mean) {
    const mtm_transfer *transfer = raycast->transfer;
    const int parts = front == back ? 1 : STRETCH_PARTS;
    const bool is_sum = raycast->options.blend == MTM_BLEND_SUM;
    *mean = (stretch){0};
    for (int n = 0; n < parts; n++) {
        const float position = mtm_transfer_clamp(lerp(front, back, ((float)n + 0.5f) / (float)parts));
        const mtm_transfer_row row = mtm_transfer_look_up(transfer, position);
        const double extinction = is_sum ? 0 : (double)row.extinction / parts;
        const double emission = (double)row.emission / parts;
        mean->extinction += extinction;
        mean->emission += emission;
        mean->highlight += fmin(extinction, emission);
        for (int i = 0; i < transfer->dimension && emission > 0; i++)
            mean->coefficients[i] +=
                emission * (double)lerp(row.segment->first[i], row.segment->last[i], row.share);
    }
}

/* ∫T over `length` of matter, (1 - e^-τl)/τ, where `lost` is e^-τl - 1. */
static double seen_length(double extinction, double lost, double length) {
    return extinction > 0 ? -lost / extinction : length;
}

/* `length` of the ray: light scattered toward the eye, then absorption (paper eq. 5). */
static void add_stretch(const mtm_raycast *raycast, const stretch *mean, const sample_shade *shade,
                        double length, gathered *sum) {
    const double lost = expm1(-mean->extinction * length);
    const double seen = sum->transmittance * seen_length(mean->extinction, lost, length);
    for (int i = 0; i < raycast->transfer->dimension; i++)
        sum->coefficients[i] += seen * shade->material * mean->coefficients[i];
    sum->highlight += seen * shade->white * mean->highlight;
    sum->transmittance += sum->transmittance * lost;
}

/* A point of the ray with what was read there. */
typedef struct ray_point {
    sample_place place;
    mtm_cell loaded;
    float position;
} ray_point;

static void read_point(const mtm_raycast *raycast, const ray_span *ray, double distance, ray_point *point) {
    locate(raycast, ray, distance, &point->place);
    mtm_raycast_load_corners(raycast, point->place.cell, &point->loaded);
    point->position = mtm_transfer_clamp(interpolate(&point->loaded, point->place.fraction));
}

/* Whether the transfer function may show anything between two points of the ray. */
static bool may_see(const mtm_raycast *raycast, const ray_span *ray, double from, double to) {
    if ((raycast->options.without & MTM_WITHOUT_SKIPPING) != 0) return true;
    double low[3];
    double high[3];
    for (int axis = 0; axis < 3; axis++) {
        const double a = ray->voxel_origin[axis] + from * ray->voxel_direction[axis];
        const double b = ray->voxel_origin[axis] + to * ray->voxel_direction[axis];
        /* The last sample may lie behind the volume's face; it reads there. */
        low[axis] = fmin(fmin(a, b), raycast->size[axis] - 1) - 1e-6;
        high[axis] = fmax(fmax(a, b), 0) + 1e-6;
    }
    return mtm_occupancy_any(raycast->occupancy, low, high);
}

/* What lies between two points, as shares of the way from `front` to `back`: the mean of the transfer function over the
 * values there, lit with the gradient in the middle. */
static void add_part(const mtm_raycast *raycast, const ray_span *ray, ray_point *front, ray_point *back,
                     float from, float to, double length, gathered *sum) {
    stretch mean;
    classify(raycast, lerp(front->position, back->position, from), lerp(front->position, back->position, to),
             &mean);
    if (!(mean.extinction > 0) && !(mean.emission > 0)) return;
    sample_shade shaded = {raycast->options.shading.ambient, 0};
    if (raycast->needs_gradient) {
        double normal[3];
        double other[3];
        const double middle = 0.5 * (double)(from + to);
        world_gradient(raycast, &front->place, &front->loaded, normal);
        world_gradient(raycast, &back->place, &back->loaded, other);
        for (int i = 0; i < 3; i++) normal[i] += middle * (other[i] - normal[i]);
        shaded = shade(raycast, ray, normal);
    }
    add_stretch(raycast, &mean, &shaded, length, sum);
}

/* A step from point to point, in two halves where it absorbs much. Or a step that one sample in its middle stands for:
 * then both points are that sample. */
static void add_step(const mtm_raycast *raycast, const ray_span *ray, double from, double to, double length,
                     gathered *sum) {
    if (!(length > 0) || !may_see(raycast, ray, from, to)) return;
    ray_point front;
    ray_point back;
    stretch whole;
    read_point(raycast, ray, from, &front);
    read_point(raycast, ray, to, &back);
    classify(raycast, front.position, back.position, &whole);
    if (front.position != back.position && whole.extinction * length > MTM_DEEP_STEP) {
        add_part(raycast, ray, &front, &back, 0, 0.5f, 0.5 * length, sum);
        add_part(raycast, ray, &front, &back, 0.5f, 1, 0.5 * length, sum);
    } else {
        add_part(raycast, ray, &front, &back, 0, 1, length, sum);
    }
}

static double clamp(double x, double low, double high) {
    return x > low ? (x < high ? x : high) : low;
}

/* A jittered ray's first and last step may lie half a step outside of what an even ray has. */
static void walk(const mtm_raycast *raycast, const ray_span *ray, gathered *sum) {
    const double step = raycast->step;
    const int64_t last = (int64_t)ceil((ray->end - ray->entry) / step) + 1;
    int64_t k = (int64_t)floor((ray->begin - ray->entry) / step) - 1;
    for (; k < last && sum->transmittance >= raycast->options.termination; k++) {
        const double from = ray->entry + (double)k * step;
        const double shift = ray->jitter * step;
        if (raycast->options.is_preintegrated) {
            const double front = clamp(from + shift, ray->begin, ray->end);
            const double back = clamp(from + shift + step, ray->begin, ray->end);
            add_step(raycast, ray, front, back, back - front, sum);
        } else {
            const double sample = from + 0.5 * step + shift;
            const double length = fmin(from + step, ray->end) - fmax(from, ray->begin);
            add_step(raycast, ray, sample, sample, length, sum);
        }
    }
}

static size_t block_of(const mtm_occupancy *blocks, const int cell[3]) {
    const size_t x = (size_t)(cell[0] >> blocks->cells_log2);
    const size_t y = (size_t)(cell[1] >> blocks->cells_log2);
    const size_t z = (size_t)(cell[2] >> blocks->cells_log2);
    return (z * (size_t)blocks->size[1] + y) * (size_t)blocks->size[0] + x;
}

/* Maximum intensity: the largest value among the samples, then classified once (Wallis, Miller, "Three-dimensional
 * display in nuclear medicine", IEEE TMI 8(4), 1989). */
static void find_maximum(const mtm_raycast *raycast, const ray_span *ray, gathered *sum) {
    const mtm_transfer *transfer = raycast->transfer;
    const int64_t last = (int64_t)ceil((ray->end - ray->entry) / raycast->step);
    float highest = -HUGE_VALF;
    for (int64_t k = (int64_t)floor((ray->begin - ray->entry) / raycast->step); k < last; k++) {
        const double from = ray->entry + (double)k * raycast->step;
        if (!(fmin(from + raycast->step, ray->end) > fmax(from, ray->begin))) continue;
        ray_point point;
        locate(raycast, ray, from + (0.5 + ray->jitter) * raycast->step, &point.place);
        const double bound = (double)raycast->block_highest[block_of(raycast->occupancy, point.place.cell)];
        if (mtm_transfer_position(transfer, bound) <= highest) continue;
        mtm_raycast_load_corners(raycast, point.place.cell, &point.loaded);
        highest = fmaxf(highest, interpolate(&point.loaded, point.place.fraction));
    }
    if (highest == -HUGE_VALF) return;
    stretch mean;
    classify(raycast, highest, highest, &mean);
    add_stretch(raycast, &mean, &(sample_shade){1, 0}, transfer->opacity_length, sum);
}

static void render_pixel(const mtm_raycast *raycast, int x, int y, mtm_image *image) {
    const size_t lanes = (size_t)image->lanes;
    float *pixel = image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * lanes;
    memset(pixel, 0, lanes * sizeof *pixel);
    ray_span ray;
    if (!aim(raycast, x, y, &ray)) return;
    gathered sum = {.transmittance = 1};
    if (raycast->options.blend == MTM_BLEND_MAXIMUM)
        find_maximum(raycast, &ray, &sum);
    else
        walk(raycast, &ray, &sum);
    const int dimension = image->dimension;
    for (int i = 0; i < dimension; i++)
        pixel[i] = (float)(sum.coefficients[i] + sum.highlight * (double)raycast->transfer->white[i]);
    pixel[dimension] = (float)(1 - sum.transmittance);
}

void mtm_raycast_plain_tile(const mtm_raycast *raycast, const mtm_lattice *lattice, int across, int down,
                            mtm_image *image) {
    for (int j = 0; j < MTM_TILE_PIXELS; j++) {
        for (int i = 0; i < MTM_TILE_PIXELS; i++) {
            const int x = lattice->x + (across * MTM_TILE_PIXELS + i) * lattice->stride;
            const int y = lattice->y + (down * MTM_TILE_PIXELS + j) * lattice->stride;
            if (x < image->width && y < image->height) render_pixel(raycast, x, y, image);
        }
    }
}
