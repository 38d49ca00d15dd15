/* SPDX-License-Identifier: BSD-3-Clause
 * The examples do what examples/README.md says of them, in full spectra. */
#include <stdio.h>

#include "fixture.h"

static mtm_scene *read_example(const char *path) {
    mtm_error error;
    mtm_scene *scene = NULL;
    char full[512];
    (void)snprintf(full, sizeof full, "%s/examples/%s", METAMER_SOURCE_DIR, path);
    assert_ok(mtm_scene_read(full, &scene, &error), error);
    return scene;
}

/* CIELAB (against D65) of a material as a picture shows it, clipped, under one light alone. */
static mtm_lab look(mtm_scene *scene, const char *material, const char *light) {
    mtm_error error;
    const int index = mtm_palette_find_material(&scene->palette, material);
    assert_true(index >= 0);
    mtm_scene_clear_weights(scene);
    assert_ok(mtm_scene_set_weight(scene, light, 1, &error), error);
    const mtm_illumination illumination = mtm_scene_illumination(scene);
    const mtm_rgb rgb = mtm_illuminate(&illumination, &scene->palette.materials[index].reflectance);
    const mtm_rgb shown = {fmin(fmax(rgb.r, 0), 1), fmin(fmax(rgb.g, 0), 1), fmin(fmax(rgb.b, 0), 1)};
    return mtm_lab_from_xyz(mtm_xyz_from_rgb(shown), mtm_white_d65());
}

static double apart(mtm_scene *scene, const char *a, const char *b, const char *light) {
    return mtm_ciede2000(look(scene, a, light), look(scene, b, light));
}

static void assert_physical(const mtm_palette *palette) {
    for (int i = 0; i < palette->material_count; i++)
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
            assert_true(palette->materials[i].reflectance.value[k] >= 0 &&
                        palette->materials[i].reflectance.value[k] <= 1);
    for (int i = 0; i < palette->light_count; i++)
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) assert_true(palette->lights[i].emission.value[k] >= 0);
}

static void the_engine_merges_parts_and_hides_its_smoke(void **state) {
    (void)state;
    mtm_scene *scene = read_example("engine/engine.json");
    assert_physical(&scene->palette);
    assert_true(apart(scene, "block", "inner", "light 1") < 0.3);
    assert_true(apart(scene, "block", "inner", "light 2") > 40);
    assert_near(look(scene, "smoke", "light 1").l, 0, 0);
    assert_near(look(scene, "smoke", "light 2").l, 0, 0);
    assert_true(look(scene, "smoke", "light 3").l > 20);
    assert_true(mtm_ciede2000(look(scene, "block", "light 1"), look(scene, "block", "light 2")) < 0.3);
    mtm_scene_destroy(scene);
}

static void the_cloud_of_hipiph_is_white_then_black(void **state) {
    (void)state;
    mtm_scene *scene = read_example("hipiph/hipiph.json");
    assert_physical(&scene->palette);
    const mtm_lab white = look(scene, "cloud", "light 1");
    assert_true(white.l > 90 && hypot(white.a, white.b) < 1);
    assert_near(look(scene, "cloud", "light 2").l, 0, 0);
    assert_true(mtm_ciede2000(look(scene, "core", "light 1"), look(scene, "core", "light 2")) < 0.3);
    mtm_scene_destroy(scene);
}

static void each_light_of_uncbrain_shows_one_material(void **state) {
    (void)state;
    static const char *const names[3] = {"skin", "brain", "fat"};
    static const char *const lights[3] = {"skin light", "brain light", "fat light"};
    mtm_scene *scene = read_example("uncbrain/uncbrain.json");
    assert_physical(&scene->palette);
    for (int light = 0; light < 3; light++)
        for (int i = 0; i < 3; i++) {
            const double lightness = look(scene, names[i], lights[light]).l;
            assert_true(i == light ? lightness > 50 : lightness == 0);
        }
    mtm_scene_destroy(scene);
}

static void the_tomato_is_one_fruit_then_two(void **state) {
    (void)state;
    mtm_scene *scene = read_example("tomato/tomato.json");
    assert_physical(&scene->palette);
    assert_true(apart(scene, "flesh", "gel", "light 1") < 0.3);
    assert_true(apart(scene, "flesh", "gel", "light 2") > 25);
    mtm_scene_destroy(scene);
}

/* Giving the inner parts the block's reflectance changes nothing under light 1 and much under light 2: the merge
 * shows in the picture, not only in the palette. */
static void the_engine_picture_itself_merges(void **state) {
    (void)state;
    mtm_error error;
    mtm_volume *volume = NULL;
    mtm_image *image = NULL;
    mtm_scene *scene = read_example("engine/engine.json");
    scene->render.width = scene->render.height = 96;
    scene->render.step = 1;
    assert_ok(mtm_scene_load_volume(scene, NULL, &volume, &error), error);
    assert_ok(mtm_scene_render(scene, volume, NULL, &image, &error), error);
    mtm_palette merged;
    assert_ok(mtm_palette_copy(&scene->palette, &merged, &error), error);
    merged.materials[mtm_palette_find_material(&merged, "inner")].reflectance =
        merged.materials[mtm_palette_find_material(&merged, "block")].reflectance;
    for (int light = 0; light < 2; light++) {
        mtm_picture *pictures[2];
        mtm_comparison comparison;
        mtm_palette original;
        assert_ok(mtm_palette_copy(&scene->palette, &original, &error), error);
        mtm_scene_clear_weights(scene);
        scene->lights.weights[light] = 1;
        assert_ok(mtm_scene_relight(scene, image, 0, &pictures[0], &error), error);
        assert_ok(mtm_scene_override_palette(scene, &merged, &error), error);
        assert_ok(mtm_scene_relight(scene, image, 0, &pictures[1], &error), error);
        assert_ok(mtm_scene_override_palette(scene, &original, &error), error);
        assert_ok(mtm_picture_compare(pictures[0], pictures[1], &comparison, &error), error);
        assert_true(light == 0 ? comparison.ciede2000_max < 1 : comparison.ciede2000_p99 > 20);
        mtm_palette_free(&original);
        mtm_picture_destroy(pictures[0]);
        mtm_picture_destroy(pictures[1]);
    }
    mtm_palette_free(&merged);
    mtm_image_destroy(image);
    mtm_volume_destroy(volume);
    mtm_scene_destroy(scene);
}

static void every_example_scene_reads(void **state) {
    (void)state;
    static const char *const paths[] = {"engine/engine.json", "hipiph/hipiph.json", "uncbrain/uncbrain.json",
                                        "tomato/tomato.json", "frog/frog.json"};
    for (int i = 0; i < 5; i++) mtm_scene_destroy(read_example(paths[i]));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_engine_merges_parts_and_hides_its_smoke),
        cmocka_unit_test(the_cloud_of_hipiph_is_white_then_black),
        cmocka_unit_test(each_light_of_uncbrain_shows_one_material),
        cmocka_unit_test(the_tomato_is_one_fruit_then_two),
        cmocka_unit_test(the_engine_picture_itself_merges),
        cmocka_unit_test(every_example_scene_reads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
