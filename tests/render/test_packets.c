/* SPDX-License-Identifier: BSD-3-Clause
 * Packets of rays against the plain raycaster at the same step, over everything that has a branch of its own. */
#include "packet_scenes.h"

static void nothing(packet_scene *scene) {
    (void)scene;
}

static void rough(packet_scene *scene) {
    scene->is_rough = true;
}

static void set_size(packet_scene *scene, int x, int y, int z) {
    scene->grid = mtm_grid_defaults(x, y, z);
}

static void smallest_cube(packet_scene *scene) {
    set_size(scene, 2, 2, 2);
    rough(scene);
}

static void column(packet_scene *scene) {
    set_size(scene, 2, 2, 97);
    rough(scene);
}

static void long_rows(packet_scene *scene) {
    set_size(scene, 301, 3, 5);
}

static void anisotropic(packet_scene *scene) {
    scene->grid.axes[2][2] = 4;
}

static void sheared(packet_scene *scene) {
    memcpy(scene->grid.axes, (const double[3][3]){{1, 0.3, 0}, {-0.2, 0.8, 0.1}, {0, 0.4, -1.5}},
           sizeof scene->grid.axes);
    memcpy(scene->grid.origin, (const double[3]){5, -3, 40}, sizeof scene->grid.origin);
}

static void falling(packet_scene *scene) {
    scene->is_falling = true;
}

static void int8(packet_scene *scene) {
    scene->type = MTM_VOXEL_INT8;
}

static void int16(packet_scene *scene) {
    scene->type = MTM_VOXEL_INT16;
}

static void falling_uint16(packet_scene *scene) {
    scene->type = MTM_VOXEL_UINT16;
    scene->is_falling = true;
}

static void int32(packet_scene *scene) {
    scene->type = MTM_VOXEL_INT32;
}

static void uint64(packet_scene *scene) {
    scene->type = MTM_VOXEL_UINT64;
}

static void floats(packet_scene *scene) {
    scene->type = MTM_VOXEL_FLOAT32;
}

static void falling_doubles(packet_scene *scene) {
    scene->type = MTM_VOXEL_FLOAT64;
    scene->is_falling = true;
}

static void eye_inside(packet_scene *scene) {
    scene->camera.distance = 3;
    scene->camera.fov = 90;
}

static void orthographic(packet_scene *scene) {
    scene->camera.fov = 0;
}

/* Along an axis: directions of 0, and rays in faces. */
static void orthographic_along_an_axis(packet_scene *scene) {
    scene->camera = fixture_front_camera(24);
}

/* A million edges of the volume away; the view just holds it. */
static void far_away(packet_scene *scene) {
    scene->camera.distance = 23e6;
    scene->camera.fov = 2 * atan(20 / 23e6) * 180 / 3.14159265358979;
}

static void jittered(packet_scene *scene) {
    scene->options.jitter = true;
}

static void jittered_and_clipped(packet_scene *scene) {
    scene->options.jitter = true;
    scene->options.clip_low[0] = 0.21;
    scene->options.clip_high[1] = 0.77;
    scene->options.clip_high[2] = 0.9;
}

static void thinly_clipped(packet_scene *scene) {
    scene->options.clip_low[1] = 0.5;
    scene->options.clip_high[1] = 0.51;
    scene->camera.elevation = 60;
}

static void sum_blend(packet_scene *scene) {
    scene->options.blend = MTM_BLEND_SUM;
}

static void emission_without_opacity(packet_scene *scene) {
    scene->points[1] = (mtm_transfer_point){0.6, 0, 0.3, true, 1};
    scene->points[2] = (mtm_transfer_point){1, 0.1, 0.6, true, 2};
}

static void jump(packet_scene *scene) {
    const mtm_transfer_point points[] = {
        {0, 0, 0, false, 0}, {0.5, 0, 0, false, 0}, {0.5, 0.3, 0, false, 1}, {1, 0.3, 0, false, 2}};
    scene->point_count = 4;
    memcpy(scene->points, points, sizeof points);
}

static void narrow_peak(packet_scene *scene) {
    const mtm_transfer_point points[] = {{0, 0, 0, false, 0},
                                         {0.58, 0, 0, false, 1},
                                         {0.6, 0.7, 0, false, 1},
                                         {0.62, 0, 0, false, 1},
                                         {1, 0, 0, false, 2}};
    scene->point_count = 5;
    memcpy(scene->points, points, sizeof points);
}

static void four_lanes(packet_scene *scene) {
    scene->basis = "rgb";
}

static void twelve_lanes(packet_scene *scene) {
    scene->basis = "sharpened:9";
}

static void eighty_four_lanes(packet_scene *scene) {
    scene->basis = "wavelengths";
}

static void odd_shininess(packet_scene *scene) {
    scene->options.shading.specular = 1;
    scene->options.shading.shininess = 7.37;
}

static void tiny_shininess(packet_scene *scene) {
    scene->options.shading.specular = 1;
    scene->options.shading.shininess = 0.25;
}

static void light_from_the_side(packet_scene *scene) {
    scene->options.shading.is_headlight = false;
    memcpy(scene->options.shading.direction, (const double[3]){2, 1, -0.5}, 3 * sizeof(double));
}

static void no_threshold(packet_scene *scene) {
    scene->options.shading.gradient_threshold = 0;
}

static void high_threshold(packet_scene *scene) {
    scene->options.shading.gradient_threshold = 0.1;
}

static void unshaded(packet_scene *scene) {
    scene->options.shading.ambient = 1;
    scene->options.shading.diffuse = scene->options.shading.specular = 0;
}

static void no_termination(packet_scene *scene) {
    scene->opacity_length = 0.3; /* so that most rays could end early */
    scene->options.termination = 0;
}

static void early_termination(packet_scene *scene) {
    scene->opacity_length = 0.3;
    scene->options.termination = 0.01;
}

static void coarse_steps(packet_scene *scene) {
    scene->options.step = 2.3;
}

static void fine_steps(packet_scene *scene) {
    scene->options.step = 0.07;
}

/* How far packets are off: PSNR in dB and the largest difference as a share of the brightest coefficient. */
typedef struct packet_error {
    double psnr, largest;
} packet_error;

typedef struct packet_case {
    const char *name;
    packet_variation vary;
    packet_error packed, native; /* the worse of means and middles, with little to spare */
} packet_case;

#define CASE(variation, packed_psnr, packed_largest, native_psnr, native_largest)                            \
    {                                                                                                        \
#variation, variation, {packed_psnr, packed_largest }, {                                             \
            native_psnr, native_largest                                                                      \
        }                                                                                                    \
    }

/* Where voxels are packed, their gradients of 8 bits are what differs; 16 bits hardly do. The faces of noise have
 * one-sided differences beyond what packed gradients hold, and the smallest volumes are all faces. Of native voxels it
 * is the rows of the table: a value takes the nearest one, and next to a jump or in a narrow peak of five rows that
 * shows. */

static const packet_case cases[] = {
    CASE(nothing, 58, 0.02, 71, 0.002),
    CASE(rough, 54, 0.05, 63, 0.008),
    CASE(smallest_cube, 38, 0.09, 55, 0.02),
    CASE(column, 60, 0.07, 85, 0.002),
    CASE(long_rows, 84, 0.003, 86, 0.002),
    CASE(anisotropic, 61, 0.02, 78, 0.002),
    CASE(sheared, 64, 0.008, 73, 0.002),
    CASE(falling, 58, 0.02, 70, 0.002),
    CASE(int8, 58, 0.02, 71, 0.002),
    CASE(int16, 79, 0.002, 79, 0.002),
    CASE(falling_uint16, 79, 0.002, 79, 0.002),
    CASE(int32, 79, 0.002, 79, 0.002),
    CASE(uint64, 79, 0.002, 79, 0.002),
    CASE(floats, 71, 0.002, 71, 0.002),
    CASE(falling_doubles, 70, 0.002, 70, 0.002),
    CASE(eye_inside, 57, 0.02, 71, 0.002),
    CASE(orthographic, 59, 0.01, 71, 0.002),
    CASE(orthographic_along_an_axis, 55, 0.02, 73, 0.002),
    CASE(far_away, 64, 0.009, 76, 0.003),
    CASE(jittered, 58, 0.02, 71, 0.002),
    CASE(jittered_and_clipped, 62, 0.009, 71, 0.002),
    CASE(thinly_clipped, 58, 0.03, 62, 0.009),
    CASE(sum_blend, 58, 0.02, 70, 0.004),
    CASE(emission_without_opacity, 55, 0.02, 68, 0.003),
    CASE(jump, 45, 0.2, 46, 0.2),
    CASE(narrow_peak, 39, 0.08, 39, 0.08),
    CASE(four_lanes, 55, 0.02, 71, 0.002),
    CASE(twelve_lanes, 54, 0.02, 72, 0.002),
    CASE(eighty_four_lanes, 53, 0.02, 72, 0.002),
    CASE(odd_shininess, 54, 0.02, 70, 0.002),
    CASE(tiny_shininess, 51, 0.06, 70, 0.002),
    CASE(light_from_the_side, 54, 0.03, 71, 0.003),
    CASE(no_threshold, 60, 0.02, 71, 0.002),
    CASE(high_threshold, 73, 0.002, 74, 0.002),
    CASE(unshaded, 68, 0.003, 68, 0.003),
    CASE(no_termination, 50, 0.05, 65, 0.006),
    CASE(early_termination, 50, 0.05, 64, 0.008),
    CASE(coarse_steps, 53, 0.04, 54, 0.02),
    CASE(fine_steps, 58, 0.02, 80, 0.0008),
};

static void check_packets(const packet_case *packets, packet_scene *scene, const mtm_volume *volume) {
    scene->options.without = MTM_WITHOUT_PACKETS | MTM_WITHOUT_SKIPPING;
    mtm_image *plain = scene_render(scene, volume);
    const double brightest = scene_brightest(plain);
    assert_true(brightest > 0.01);
    scene->options.without = 0;
    for (int is_native = 0; is_native < 2; is_native++) {
        scene->options.memory_bytes = is_native == 1 ? 1 : 0;
        mtm_image *image = scene_render(scene, volume);
        const double psnr = scene_psnr(image, plain);
        const double largest = fixture_largest_difference(image, plain) / brightest;
        const packet_error *allowed = is_native == 1 ? &packets->native : &packets->packed;
        if (!(psnr >= allowed->psnr && largest <= allowed->largest))
            fail_msg("%s, %s, %s: %.1f dB, %g", packets->name, is_native == 1 ? "native" : "packed",
                     scene->options.is_preintegrated ? "means" : "middles", psnr, largest);
        mtm_image_destroy(image);
    }
    mtm_image_destroy(plain);
}

static void packets_are_near_the_plain_raycaster(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        packet_scene scene = scene_defaults();
        cases[i].vary(&scene);
        mtm_volume *volume = scene_volume(&scene);
        for (int has_means = 0; has_means < 2; has_means++) {
            scene.options.is_preintegrated = has_means == 1;
            check_packets(&cases[i], &scene, volume);
        }
        mtm_volume_destroy(volume);
    }
}

/* As the plain raycaster has it: without extent along an axis there is nothing to see, nor in a clip box without. */
static void flat_volumes_and_empty_clip_boxes_are_empty_pictures(void **state) {
    (void)state;
    static const int sizes[][3] = {{1, 1, 9}, {9, 1, 9}, {1, 1, 1}, {9, 9, 9}, {9, 9, 9}};
    for (int i = 0; i < 5; i++) {
        packet_scene scene = scene_defaults();
        set_size(&scene, sizes[i][0], sizes[i][1], sizes[i][2]);
        if (i == 3) scene.options.clip_low[1] = scene.options.clip_high[1] = 0.4;
        if (i == 4) scene.options.clip_low[0] = 1;
        mtm_volume *volume = scene_volume(&scene);
        for (int n = 0; n < 4; n++) {
            scene.options.memory_bytes = n & 1;
            scene.options.is_preintegrated = (n & 2) != 0;
            mtm_image *image = scene_render(&scene, volume);
            assert_true(scene_brightest(image) == 0);
            mtm_image_destroy(image);
        }
        mtm_volume_destroy(volume);
    }
}

/* On a peak that a step strides over, means at step 1 are nearer to the picture at step 1/20 than middles are. */
static void means_see_a_thin_peak_at_coarse_steps(void **state) {
    (void)state;
    packet_scene scene = scene_defaults();
    narrow_peak(&scene);
    unshaded(&scene);
    scene.type = MTM_VOXEL_UINT16;
    mtm_volume *volume = scene_volume(&scene);
    double psnr[2];
    scene.options.step = 0.05;
    mtm_image *fine = scene_render(&scene, volume);
    scene.options.step = 1;
    for (int has_means = 0; has_means < 2; has_means++) {
        scene.options.is_preintegrated = has_means == 1;
        mtm_image *coarse = scene_render(&scene, volume);
        psnr[has_means] = scene_psnr(coarse, fine);
        mtm_image_destroy(coarse);
    }
    assert_true(psnr[1] > psnr[0] + 12);
    mtm_image_destroy(fine);
    mtm_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packets_are_near_the_plain_raycaster),
        cmocka_unit_test(flat_volumes_and_empty_clip_boxes_are_empty_pictures),
        cmocka_unit_test(means_see_a_thin_peak_at_coarse_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
