/* SPDX-License-Identifier: BSD-3-Clause
 * What must not change a picture of packets: the instruction set, threads, skipping, prefetching, a projector that made
 * other pictures before. */
#include "base/isa.h"
#include "packet_scenes.h"

static const char *const isa_names[] = {"baseline", "x86-64-v3", "x86-64-v4"};

/* Scenes whose rays part ways: every layout of voxels, both ways to step, and what has a branch in the packets. */
enum { SCENES = 18 };

static const mtm_transfer_point jump[] = {
    {0, 0, 0, false, 0}, {0.5, 0, 0, false, 0}, {0.5, 0.6, 0, false, 1}, {0.8, 0, 0.4, true, 2}};

static packet_scene make_scene(int n) {
    static const mtm_voxel_type types[] = {MTM_VOXEL_UINT8, MTM_VOXEL_INT16, MTM_VOXEL_FLOAT32};
    static const char *const bases[] = {"materials", "rgb", "sharpened:9", "wavelengths"};
    packet_scene scene = scene_defaults();
    scene.type = types[n % 3];
    scene.basis = bases[n % 4];
    scene.is_rough = n % 5 == 0;
    scene.options.is_preintegrated = n / 3 % 2 == 0;
    scene.options.memory_bytes = n % 6 == 5 ? 1 : 0;
    scene.options.termination = 0;
    scene.options.jitter = n % 4 == 1;
    scene.options.step = 0.3 + 0.1 * n;
    scene.options.shading.is_headlight = n % 7 != 3;
    scene.options.shading.shininess = 3.3 * n;
    scene.camera.azimuth = 50 * n;
    scene.camera.fov = n % 5 == 4 ? 0 : 30;
    if (n % 3 == 2) scene.camera.distance = 14;
    if (n % 4 == 3) scene.options.clip_high[n % 3] = 0.6;
    if (n % 2 == 1) {
        scene.point_count = 4;
        memcpy(scene.points, jump, sizeof jump);
    }
    return scene;
}

static void end_rays_early(packet_scene *scene) {
    scene->opacity_length = 0.5;
    scene->options.termination = 1.0 / 64;
}

static void assert_same_bits(const mtm_image *a, const mtm_image *b, int scene, const char *what) {
    if (memcmp(a->pixels, b->pixels, scene_floats(a) * sizeof *a->pixels) != 0)
        fail_msg("scene %d, %s: apart by %g", scene, what, fixture_largest_difference(a, b));
}

/* Without termination no ray ends a step earlier for a difference in the last bit. */
static void every_instruction_set_gives_the_same_picture(void **state) {
    (void)state;
    for (int n = 0; n < SCENES; n++) {
        const packet_scene scene = make_scene(n);
        mtm_volume *volume = scene_volume(&scene);
        mtm_image *images[3];
        for (mtm_isa isa = MTM_ISA_BASELINE; isa <= mtm_isa_highest(); isa++) {
            assert_int_equal(setenv("METAMER_ISA", isa_names[isa], 1), 0);
            images[isa] = scene_render(&scene, volume);
            const double apart = fixture_largest_difference(images[isa], images[0]);
            if (!(apart < 1e-5)) fail_msg("scene %d: %s is off by %g", n, isa_names[isa], apart);
        }
        assert_true(scene_brightest(images[0]) > 0.01);
        for (mtm_isa isa = MTM_ISA_BASELINE; isa <= mtm_isa_highest(); isa++) mtm_image_destroy(images[isa]);
        mtm_volume_destroy(volume);
    }
    assert_int_equal(unsetenv("METAMER_ISA"), 0);
}

static void any_number_of_threads_gives_the_same_bits(void **state) {
    (void)state;
    static const int counts[] = {2, 3, 5};
    for (int n = 0; n < SCENES; n++) {
        packet_scene scene = make_scene(n);
        mtm_volume *volume = scene_volume(&scene);
        mtm_image *one = scene_render(&scene, volume);
        for (int i = 0; i < 3; i++) {
            scene.options.thread_count = counts[i];
            mtm_image *many = scene_render(&scene, volume);
            assert_same_bits(many, one, n, "threads");
            mtm_image_destroy(many);
        }
        mtm_image_destroy(one);
        mtm_volume_destroy(volume);
    }
}

static void check_without(int first_without) {
    static const int without[] = {MTM_WITHOUT_SKIPPING, MTM_WITHOUT_PREFETCH,
                                  MTM_WITHOUT_SKIPPING | MTM_WITHOUT_PREFETCH};
    for (int n = 0; n < SCENES; n++) {
        packet_scene scene = make_scene(n);
        end_rays_early(&scene);
        mtm_volume *volume = scene_volume(&scene);
        scene.options.without = first_without;
        mtm_image *all = scene_render(&scene, volume);
        for (int i = 0; i < 3; i++) {
            scene.options.without = first_without | without[i];
            mtm_image *image = scene_render(&scene, volume);
            assert_same_bits(image, all, n, i == 1 ? "prefetch" : "skipping");
            mtm_image_destroy(image);
        }
        mtm_image_destroy(all);
        mtm_volume_destroy(volume);
    }
}

static void skipping_and_prefetching_change_no_bit(void **state) {
    (void)state;
    check_without(0);
}

static void skipping_changes_no_bit_of_the_plain_raycaster(void **state) {
    (void)state;
    check_without(MTM_WITHOUT_PACKETS);
}

/* Renders with a projector that is kept, and, for comparison, with one of its own. */
static void check_kept(mtm_projector *projector, const mtm_volume *volume, const mtm_transfer *transfer,
                       const packet_scene *scene, int n) {
    mtm_error error;
    mtm_image *images[2];
    for (int i = 0; i < 2; i++)
        assert_ok(mtm_image_create(scene->options.width, scene->options.height, 4, "materials", NULL, NULL,
                                   &images[i], &error),
                  error);
    for (size_t k = 0; k < scene_floats(images[0]); k++)
        images[0]->pixels[k] = NAN; /* what it held is replaced */
    assert_ok(mtm_projector_render(projector, &scene->camera, &scene->options, NULL, images[0], &error),
              error);
    assert_ok(
        mtm_render("raycast", volume, transfer, &scene->camera, &scene->options, NULL, images[1], &error),
        error);
    assert_true(scene_brightest(images[1]) > 0.01);
    assert_same_bits(images[0], images[1], n, "kept");
    mtm_image_destroy(images[0]);
    mtm_image_destroy(images[1]);
}

static void a_projector_renders_as_if_it_were_new(void **state) {
    (void)state;
    mtm_error error;
    for (int type = 0; type < 3; type++) {
        packet_scene scene = make_scene(type);
        mtm_projector *projector = NULL;
        mtm_transfer *transfers[3];
        mtm_volume *volume = scene_volume(&scene);
        mtm_basis *basis = fixture_basis("materials", NULL);
        assert_ok(mtm_projector_create("raycast", volume, &scene.options, NULL, &projector, &error), error);
        for (int n = 0; n < 3; n++) {
            const packet_scene other = make_scene(n);
            assert_ok(
                mtm_transfer_create(other.point_count, other.points, 1 + n, basis, &transfers[n], &error),
                error);
        }
        for (int n = 0; n < 12; n++) {
            const mtm_transfer *transfer = transfers[n / 2 % 3];
            scene.camera.azimuth += 40;
            scene.options.step = 0.4 + 0.1 * n;
            scene.options.is_preintegrated = n % 3 != 0;
            scene.options.blend = n % 4 == 3 ? MTM_BLEND_SUM : MTM_BLEND_COMPOSITE;
            if (n % 2 == 0) assert_ok(mtm_projector_set_transfer(projector, transfer, &error), error);
            check_kept(projector, volume, transfer, &scene, n);
        }
        for (int n = 0; n < 3; n++) mtm_transfer_destroy(transfers[n]);
        mtm_projector_destroy(projector);
        mtm_basis_destroy(basis);
        mtm_volume_destroy(volume);
    }
}

/* A pixel does not depend on which rays share its packet. */
static void a_part_of_a_wider_picture_is_the_same_bits(void **state) {
    (void)state;
    for (int n = 0; n < SCENES; n++) {
        packet_scene scene = make_scene(n);
        scene.options.jitter = false; /* which is by pixel */
        end_rays_early(&scene);
        mtm_volume *volume = scene_volume(&scene);
        mtm_image *narrow = scene_render(&scene, volume);
        scene.options.width = 43; /* 3 pixels more on either side */
        mtm_image *wide = scene_render(&scene, volume);
        for (int y = 0; y < narrow->height; y++)
            for (int x = 0; x < narrow->width; x++)
                for (int k = 0; k < narrow->lanes; k++)
                    if (fixture_pixel(narrow, x, y)[k] != fixture_pixel(wide, x + 3, y)[k])
                        fail_msg("scene %d: lane %d of (%d, %d) differs by %g", n, k, x, y,
                                 (double)fixture_pixel(narrow, x, y)[k] - fixture_pixel(wide, x + 3, y)[k]);
        mtm_image_destroy(narrow);
        mtm_image_destroy(wide);
        mtm_volume_destroy(volume);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_set_gives_the_same_picture),
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
        cmocka_unit_test(skipping_and_prefetching_change_no_bit),
        cmocka_unit_test(skipping_changes_no_bit_of_the_plain_raycaster),
        cmocka_unit_test(a_projector_renders_as_if_it_were_new),
        cmocka_unit_test(a_part_of_a_wider_picture_is_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
