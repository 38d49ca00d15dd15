/* SPDX-License-Identifier: BSD-3-Clause
 * Scenes for the tests of packets: small volumes of any type over the values 0 … 1, and what varies between them. */
#ifndef METAMER_TEST_PACKET_SCENES_H
#define METAMER_TEST_PACKET_SCENES_H

#include "fixture.h"

enum { SCENE_POINTS = 6 };

typedef struct packet_scene {
    mtm_grid grid;
    mtm_voxel_type type;
    bool is_rough;   /* every voxel is random; else waves some voxels long */
    bool is_falling; /* negative slope */
    mtm_camera camera;
    mtm_render_options options;
    int point_count;
    mtm_transfer_point points[SCENE_POINTS];
    double opacity_length;
    const char *basis;
} packet_scene;

/* Any function that makes a scene another one. */
typedef void (*packet_variation)(packet_scene *scene);

static inline packet_scene scene_defaults(void) {
    packet_scene scene = {.grid = mtm_grid_defaults(18, 21, 23),
                          .type = MTM_VOXEL_UINT8,
                          .camera = mtm_camera_defaults(),
                          .options = mtm_render_defaults(),
                          .point_count = 3,
                          .points = {{0.2, 0, 0, false, 0}, {0.6, 0.2, 0, false, 1}, {1, 0.5, 0, false, 2}},
                          .opacity_length = 2,
                          .basis = "materials"};
    scene.options.width = 37; /* parts of tiles and of packets */
    scene.options.height = 35;
    scene.options.thread_count = 1;
    return scene;
}

/* Stored values that are the values 0 and 1. */
static inline void scene_stored_ends(mtm_voxel_type type, double ends[2]) {
    static const double all[MTM_VOXEL_TYPE_COUNT][2] = {
        {-128, 127},      {0, 255},      {-32768, 32767}, {0, 65535}, {-2e9, 2e9},
        {0, 4294967295.}, {-1e15, 1e15}, {0, 1e15},       {-3, 7},    {-1e-5, 2e-5}};
    memcpy(ends, all[type], sizeof all[type]);
}

static inline void scene_store(mtm_voxel_type type, void *voxels, size_t n, double stored) {
    switch (type) {
    case MTM_VOXEL_INT8: ((int8_t *)voxels)[n] = (int8_t)lrint(stored); break;
    case MTM_VOXEL_UINT8: ((uint8_t *)voxels)[n] = (uint8_t)lrint(stored); break;
    case MTM_VOXEL_INT16: ((int16_t *)voxels)[n] = (int16_t)lrint(stored); break;
    case MTM_VOXEL_UINT16: ((uint16_t *)voxels)[n] = (uint16_t)lrint(stored); break;
    case MTM_VOXEL_INT32: ((int32_t *)voxels)[n] = (int32_t)lrint(stored); break;
    case MTM_VOXEL_UINT32: ((uint32_t *)voxels)[n] = (uint32_t)llrint(stored); break;
    case MTM_VOXEL_INT64: ((int64_t *)voxels)[n] = llrint(stored); break;
    case MTM_VOXEL_UINT64: ((uint64_t *)voxels)[n] = (uint64_t)llrint(stored); break;
    case MTM_VOXEL_FLOAT32: ((float *)voxels)[n] = (float)stored; break;
    default: ((double *)voxels)[n] = stored; break;
    }
}

static inline double scene_wave(size_t x, size_t y, size_t z) {
    return 0.5 + 0.5 * sin(0.31 * (double)x + 0.2) * cos(0.27 * (double)y) * sin(0.24 * (double)z + 1);
}

static inline double scene_noise(size_t n) {
    uint32_t h = (uint32_t)n * 0x9E3779B1u;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    return (double)(h ^ h >> 13) / UINT32_MAX;
}

static inline mtm_volume *scene_volume(const packet_scene *scene) {
    mtm_error error;
    mtm_volume *volume = NULL;
    double ends[2];
    const size_t across = (size_t)scene->grid.size[0];
    const size_t down = (size_t)scene->grid.size[1];
    const size_t count = across * down * (size_t)scene->grid.size[2];
    void *voxels = malloc(count * mtm_voxel_type_bytes(scene->type));
    assert_non_null(voxels);
    scene_stored_ends(scene->type, ends);
    for (size_t n = 0; n < count; n++) {
        const double value =
            scene->is_rough ? scene_noise(n) : scene_wave(n % across, n / across % down, n / (across * down));
        scene_store(scene->type, voxels, n, ends[0] + value * (ends[1] - ends[0]));
    }
    const double slope = (scene->is_falling ? -1 : 1) / (ends[1] - ends[0]);
    const double intercept = (scene->is_falling ? 1 : 0) - slope * ends[0];
    assert_ok(mtm_volume_create(&scene->grid, scene->type, voxels, slope, intercept, &volume, &error), error);
    free(voxels);
    return volume;
}

static inline mtm_image *scene_render(const packet_scene *scene, const mtm_volume *volume) {
    const bool needs_light = strcmp(scene->basis, "rgb") == 0;
    const mtm_illumination light = fixture_illumination("D65");
    mtm_basis *basis = fixture_basis(scene->basis, needs_light ? &light : NULL);
    mtm_image *image = fixture_render(volume, scene->point_count, scene->points, scene->opacity_length, basis,
                                      &scene->camera, &scene->options);
    mtm_basis_destroy(basis);
    return image;
}

static inline size_t scene_floats(const mtm_image *image) {
    return (size_t)image->width * (size_t)image->height * (size_t)image->lanes;
}

static inline double scene_brightest(const mtm_image *image) {
    double brightest = 0;
    for (size_t n = 0; n < scene_floats(image); n++)
        brightest = fmax(brightest, fabs((double)image->pixels[n]));
    return brightest;
}

/* Peak signal to noise of all coefficients and alpha, dB, against the brightest of them. */
static inline double scene_psnr(const mtm_image *image, const mtm_image *reference) {
    double squares = 0;
    for (size_t n = 0; n < scene_floats(reference); n++)
        squares += pow((double)image->pixels[n] - reference->pixels[n], 2);
    /* padding lanes do not count */
    const double numbers = (double)reference->width * reference->height * (reference->dimension + 1);
    return 10 * log10(pow(scene_brightest(reference), 2) * numbers / fmax(squares, 1e-30));
}

#endif
