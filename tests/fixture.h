/* SPDX-License-Identifier: BSD-3-Clause
 * Small volumes, palettes and renders for the tests of the renderers. */
#ifndef METAMER_TEST_RENDER_FIXTURE_H
#define METAMER_TEST_RENDER_FIXTURE_H

#include <math.h>
#include <stdlib.h>

#include "metamer/metamer.h"
#include "test.h"

enum { FIXTURE_MATERIALS = 3 };

/* Three reflectances that no light shows alike. */
static inline void fixture_reflectances(mtm_spectrum reflectances[FIXTURE_MATERIALS]) {
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        const double x = i / 80.0;
        reflectances[0].value[i] = 0.2 + 0.6 * x;
        reflectances[1].value[i] = 0.5 + 0.4 * sin(9 * x);
        reflectances[2].value[i] = exp(-30 * (x - 0.4) * (x - 0.4));
    }
}

static inline mtm_illumination fixture_illumination(const char *illuminant) {
    mtm_error error;
    mtm_spectrum light;
    mtm_spectrum normalized;
    mtm_observer observer;
    assert_ok(mtm_illuminant(illuminant, &light, &error), error);
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_light_normalize(&light, &observer, &normalized, &error), error);
    return mtm_illumination_of(&normalized, &observer, 0);
}

static inline mtm_basis *fixture_basis(const char *name, const mtm_illumination *illumination) {
    mtm_error error;
    mtm_basis *basis = NULL;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    fixture_reflectances(reflectances);
    assert_ok(mtm_basis_create(name, FIXTURE_MATERIALS, reflectances, illumination, &basis, &error), error);
    return basis;
}

/* A float volume whose voxels are value(x, y, z) at their world positions. */
static inline mtm_volume *fixture_volume(const mtm_grid *grid, double (*value)(const double world[3])) {
    mtm_error error;
    mtm_volume *volume = NULL;
    const size_t count = (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
    float *voxels = malloc(count * sizeof *voxels);
    assert_non_null(voxels);
    size_t n = 0;
    for (int k = 0; k < grid->size[2]; k++) {
        for (int j = 0; j < grid->size[1]; j++) {
            for (int i = 0; i < grid->size[0]; i++) {
                double world[3];
                mtm_grid_to_world(grid, (const double[3]){i, j, k}, world);
                voxels[n++] = (float)value(world);
            }
        }
    }
    assert_ok(mtm_volume_create(grid, MTM_VOXEL_FLOAT32, voxels, 1, 0, &volume, &error), error);
    free(voxels);
    return volume;
}

/* The ways to render a volume: ray by ray in double precision, which is exact; in packets from voxels of 32 bits as they
 * are; and in packets from voxels of 16 bits packed with their gradients. Each once with a step's middle and once with
 * the mean of the transfer function over its values. */
typedef enum fixture_way {
    PLAIN,
    PLAIN_MEANS,
    NATIVE,
    NATIVE_MEANS,
    PACKED,
    PACKED_MEANS,
} fixture_way;

/* A test of a way, which is its state; and of all of them. */
#define FIXTURE_WAY(test, way)                                                                               \
    {                                                                                                        \
#test " " #way, test, NULL, NULL, (void *)&(fixture_way) {                                           \
            way                                                                                              \
        }                                                                                                    \
    }
#define FIXTURE_PACKETS(test)                                                                                \
    FIXTURE_WAY(test, NATIVE), FIXTURE_WAY(test, NATIVE_MEANS), FIXTURE_WAY(test, PACKED),                   \
        FIXTURE_WAY(test, PACKED_MEANS)
#define FIXTURE_WAYS(test) FIXTURE_WAY(test, PLAIN), FIXTURE_WAY(test, PLAIN_MEANS), FIXTURE_PACKETS(test)

static inline fixture_way fixture_way_of(void **state) {
    return *(const fixture_way *)*state;
}

static inline bool fixture_is_plain(fixture_way way) {
    return way <= PLAIN_MEANS;
}

static inline bool fixture_has_means(fixture_way way) {
    return way % 2 == 1;
}

static inline void fixture_set_way(fixture_way way, mtm_render_options *options) {
    options->without = fixture_is_plain(way) ? MTM_WITHOUT_PACKETS : 0;
    options->is_preintegrated = fixture_has_means(way);
}

/* Levels of 16 bits to the value 1: halves, 20ths and 40ths are whole levels. */
enum { FIXTURE_LEVELS = 64000 };

/* fixture_volume for a way: floats, or, to be packed, 16 bits for values 0 … 1. */
static inline mtm_volume *fixture_volume_for(fixture_way way, const mtm_grid *grid,
                                             double (*value)(const double world[3])) {
    mtm_error error;
    mtm_volume *packed = NULL;
    mtm_volume *volume = fixture_volume(grid, value);
    if (way < PACKED) return volume;
    const float *from = mtm_volume_voxels(volume);
    const size_t count = mtm_volume_voxel_count(volume);
    uint16_t *voxels = malloc(count * sizeof *voxels);
    assert_non_null(voxels);
    for (size_t n = 0; n < count; n++)
        voxels[n] = (uint16_t)lrint(fmin(fmax((double)from[n], 0), 1) * FIXTURE_LEVELS);
    assert_ok(mtm_volume_create(grid, MTM_VOXEL_UINT16, voxels, 1.0 / FIXTURE_LEVELS, 0, &packed, &error),
              error);
    free(voxels);
    mtm_volume_destroy(volume);
    return packed;
}

/* Unshaded, orthographic along z, no early termination, small. */
static inline mtm_render_options fixture_plain_options(void) {
    mtm_render_options options = mtm_render_defaults();
    options.width = options.height = 9;
    options.termination = 0;
    options.shading.ambient = 1;
    options.shading.diffuse = options.shading.specular = 0;
    return options;
}

static inline mtm_camera fixture_front_camera(double height) {
    mtm_camera camera = mtm_camera_defaults();
    camera.azimuth = camera.elevation = 0;
    camera.fov = 0;
    camera.height = height;
    return camera;
}

static inline mtm_image *fixture_render(const mtm_volume *volume, int point_count,
                                        const mtm_transfer_point *points, double opacity_length,
                                        const mtm_basis *basis, const mtm_camera *camera,
                                        const mtm_render_options *options) {
    mtm_error error;
    mtm_transfer *transfer = NULL;
    mtm_image *image = NULL;
    assert_ok(mtm_transfer_create(point_count, points, opacity_length, basis, &transfer, &error), error);
    assert_ok(mtm_image_create(options->width, options->height, mtm_basis_dimension(basis),
                               mtm_basis_name(basis), NULL, NULL, &image, &error),
              error);
    assert_ok(mtm_render("raycast", volume, transfer, camera, options, NULL, image, &error), error);
    mtm_transfer_destroy(transfer);
    return image;
}

static inline const float *fixture_pixel(const mtm_image *image, int x, int y) {
    return image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->lanes;
}

static inline double fixture_largest_difference(const mtm_image *a, const mtm_image *b) {
    double largest = 0;
    assert_int_equal(a->lanes, b->lanes);
    const size_t count = (size_t)a->width * (size_t)a->height * (size_t)a->lanes;
    for (size_t i = 0; i < count; i++) largest = fmax(largest, fabs((double)a->pixels[i] - b->pixels[i]));
    return largest;
}

/* cmocka compares doubles in float; this does not, and NaN fails. */
#define assert_near(a, b, tolerance)                                                                         \
    do {                                                                                                     \
        const double assert_a = (a);                                                                         \
        const double assert_b = (b);                                                                         \
        if (!(fabs(assert_a - assert_b) <= (tolerance)))                                                     \
            fail_msg("%s is %.9g, %s is %.9g, apart by more than %g", #a, assert_a, #b, assert_b,            \
                     (double)(tolerance));                                                                   \
    } while (0)

#endif
