/* SPDX-License-Identifier: BSD-3-Clause
 * The engine scene as the report uses it: other palettes, and RGB relit as a plain renderer does. */
#include <stdio.h>

#include "accuracy/engine.h"
#include "test.h"

static const engine_options options = {
    .source_folder = METAMER_SOURCE_DIR, .edge = 24, .step = 4, .thread_count = 1};
enum { FL11 = 3 };

typedef struct fixture {
    mtm_scene *scene;
    mtm_volume *volume;
} fixture;

static fixture create(void) {
    fixture made;
    mtm_error error;
    assert_ok(engine_read(&options, &made.scene, &made.volume, &error), error);
    return made;
}

static void destroy(fixture *made) {
    mtm_volume_destroy(made->volume);
    mtm_scene_destroy(made->scene);
}

static mtm_rgb light_color(const char *name) {
    mtm_observer observer;
    mtm_spectrum light;
    mtm_error error;
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_illuminant(name, &light, &error), error);
    assert_ok(mtm_light_normalize(&light, &observer, &light, &error), error);
    return mtm_rgb_from_xyz(mtm_xyz_of(&light, &observer));
}

static void palettes_replace_the_materials_in_their_order(void **state) {
    (void)state;
    static const char *const columns[] = {"foliage", "orange", "blue_sky"};
    fixture made = create();
    const mtm_spectrum own = made.scene->palette.materials[0].reflectance;
    mtm_error error;
    assert_ok(engine_use_palette(METAMER_SOURCE_DIR, 0, made.scene, &error), error);
    assert_memory_equal(&made.scene->palette.materials[0].reflectance, &own, sizeof own);
    assert_ok(engine_use_palette(METAMER_SOURCE_DIR, 1, made.scene, &error), error);
    for (int i = 0; i < 3; i++) {
        char name[128];
        mtm_spectrum expected;
        (void)snprintf(name, sizeof name, "data/spectra/reflectance_colorchecker_ohta.csv:%s", columns[i]);
        assert_ok(mtm_spectrum_read(METAMER_SOURCE_DIR, name, MTM_KIND_REFLECTANCE, &expected, &error),
                  error);
        assert_memory_equal(&made.scene->palette.materials[i].reflectance, &expected, sizeof expected);
    }
    destroy(&made);
}

/* Every channel of every pixel is that under D65, times the light's over D65's. */
static void rgb_is_relit_channel_by_channel(void **state) {
    (void)state;
    fixture made = create();
    mtm_image *image = NULL;
    mtm_picture *picture = NULL;
    mtm_error error;
    assert_ok(engine_render(made.scene, made.volume, "rgb", &image, &error), error);
    assert_ok(engine_relight(made.scene, image, FL11, &picture, &error), error);
    const mtm_rgb lamp = light_color("FL11");
    const mtm_rgb d65 = light_color("D65");
    const double factors[] = {lamp.r / d65.r, lamp.g / d65.g, lamp.b / d65.b};
    double sum = 0;
    for (int i = 0; i < options.edge * options.edge; i++)
        for (int channel = 0; channel < 3; channel++) {
            const double before = image->pixels[i * image->lanes + channel];
            assert_float_equal(picture->rgba[4 * i + channel], factors[channel] * before, 1e-6);
            sum += before;
        }
    assert_true(sum > 1);
    mtm_picture_destroy(picture);
    mtm_image_destroy(image);
    destroy(&made);
}

/* Both are exact. */
static void a_picture_does_not_depend_on_an_exact_basis(void **state) {
    (void)state;
    static const char *const bases[] = {"wavelengths", "materials"};
    fixture made = create();
    mtm_image *images[2] = {NULL, NULL};
    mtm_picture *pictures[2] = {NULL, NULL};
    mtm_comparison comparison;
    mtm_error error;
    for (int i = 0; i < 2; i++) {
        assert_ok(engine_render(made.scene, made.volume, bases[i], &images[i], &error), error);
        assert_ok(engine_relight(made.scene, images[i], FL11, &pictures[i], &error), error);
        assert_string_equal(images[i]->basis, bases[i]);
    }
    assert_ok(mtm_picture_compare(pictures[0], pictures[1], &comparison, &error), error);
    assert_true(comparison.max_error < 1e-5);
    for (int i = 0; i < 2; i++) {
        mtm_picture_destroy(pictures[i]);
        mtm_image_destroy(images[i]);
    }
    destroy(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(palettes_replace_the_materials_in_their_order),
        cmocka_unit_test(rgb_is_relit_channel_by_channel),
        cmocka_unit_test(a_picture_does_not_depend_on_an_exact_basis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
