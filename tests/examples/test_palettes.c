/* SPDX-License-Identifier: BSD-3-Clause
 * The examples' palettes come from their goals (make palettes) and meet them. */
#include <stdio.h>

#include "fixture.h"

static const char *const examples[] = {"engine", "hipiph", "uncbrain", "tomato", "frog"};
enum { EXAMPLES = sizeof examples / sizeof *examples };

static mtm_design *design_again(const char *name) {
    mtm_error error;
    mtm_goals *goals = NULL;
    mtm_design *design = NULL;
    char path[512];
    const mtm_design_options options = mtm_design_defaults();
    (void)snprintf(path, sizeof path, "%s/examples/%s/%s.goals.json", METAMER_SOURCE_DIR, name, name);
    assert_ok(mtm_goals_read(path, &goals, &error), error);
    assert_ok(mtm_design_find(goals, &options, &design, &error), error);
    mtm_goals_destroy(goals);
    return design;
}

static mtm_scene *read_scene(const char *name) {
    mtm_error error;
    mtm_scene *scene = NULL;
    char path[512];
    (void)snprintf(path, sizeof path, "%s/examples/%s/%s.json", METAMER_SOURCE_DIR, name, name);
    assert_ok(mtm_scene_read(path, &scene, &error), error);
    return scene;
}

/* CIELAB of a material alone under a light alone. */
static mtm_lab color(mtm_scene *scene, const mtm_palette *palette, int material, int light) {
    mtm_error error;
    assert_ok(mtm_scene_use_light(scene, "the light", &palette->lights[light].emission, &error), error);
    const mtm_illumination illumination = mtm_scene_illumination(scene);
    const mtm_rgb rgb = mtm_illuminate(&illumination, &palette->materials[material].reflectance);
    return mtm_lab_from_xyz(mtm_xyz_from_rgb(rgb), mtm_white_d65());
}

/* The largest difference of two spectra, in shares of the largest value of one. */
static double apart(const mtm_spectrum *a, const mtm_spectrum *b) {
    double largest = 0;
    double difference = 0;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        largest = fmax(largest, fabs(b->value[i]));
        difference = fmax(difference, fabs(a->value[i] - b->value[i]));
    }
    return difference / largest;
}

static void assert_same_palette(mtm_scene *scene, const mtm_palette *again) {
    mtm_error error;
    mtm_palette kept;
    double spectra = 0;
    double colors = 0;
    assert_ok(mtm_palette_copy(&scene->palette, &kept, &error), error);
    assert_int_equal(again->material_count, kept.material_count);
    assert_int_equal(again->light_count, kept.light_count);
    for (int i = 0; i < kept.material_count; i++) {
        assert_string_equal(again->materials[i].name, kept.materials[i].name);
        spectra = fmax(spectra, apart(&again->materials[i].reflectance, &kept.materials[i].reflectance));
    }
    for (int k = 0; k < kept.light_count; k++) {
        assert_string_equal(again->lights[k].name, kept.lights[k].name);
        spectra = fmax(spectra, apart(&again->lights[k].emission, &kept.lights[k].emission));
        for (int i = 0; i < kept.material_count; i++)
            colors = fmax(colors, mtm_ciede2000(color(scene, again, i, k), color(scene, &kept, i, k)));
    }
    print_message("spectra %.2g and colors %.2g from those of the repository\n", spectra, colors);
    assert_true(spectra <= 1e-5);
    assert_true(colors <= 1e-6);
    mtm_palette_free(&kept);
}

static void assert_physical(const mtm_palette *palette) {
    for (int i = 0; i < palette->material_count; i++)
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
            assert_true(palette->materials[i].reflectance.value[k] >= 0 &&
                        palette->materials[i].reflectance.value[k] <= 1);
    for (int i = 0; i < palette->light_count; i++)
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) assert_true(palette->lights[i].emission.value[k] >= 0);
}

static void assert_goals_met(const mtm_design *design) {
    double full = 0;
    double basis = 0;
    assert_string_equal(design->basis, "factors:7");
    for (int i = 0; i < design->result_count; i++) {
        full = fmax(full, design->results[i].ciede2000);
        basis = fmax(basis, design->results[i].ciede2000_basis);
    }
    print_message("%d goals: at most %.2f off in full spectra, %.2f in %s\n", design->result_count, full,
                  basis, design->basis);
    assert_true(full <= 1);
    assert_true(basis <= 2);
}

static void designing_again_gives_the_palettes_of_the_repository(void **state) {
    (void)state;
    for (int i = 0; i < EXAMPLES; i++) {
        print_message("%s\n", examples[i]);
        mtm_scene *scene = read_scene(examples[i]);
        mtm_design *design = design_again(examples[i]);
        assert_physical(&scene->palette);
        assert_goals_met(design);
        assert_same_palette(scene, &design->palette);
        mtm_design_destroy(design);
        mtm_scene_destroy(scene);
    }
}

/* How many spectra of an example are designed, the others being measured or of a standard. */
static void count_designed(const char *name, int *materials, int *lights) {
    mtm_design *design = design_again(name);
    *materials = *lights = 0;
    for (int i = 0; i < design->palette.material_count; i++)
        *materials += design->materials[i] != MTM_HONESTY_GIVEN;
    for (int i = 0; i < design->palette.light_count; i++) *lights += design->lights[i] != MTM_HONESTY_GIVEN;
    mtm_design_destroy(design);
}

static void tomato_and_frog_mix_measured_spectra_with_designed_ones(void **state) {
    (void)state;
    int materials;
    int lights;
    count_designed("tomato", &materials, &lights); /* of 2 and 2 */
    assert_int_equal(materials, 1);
    assert_int_equal(lights, 1);
    count_designed("frog", &materials, &lights); /* of 3 and 3 */
    assert_int_equal(materials, 1);
    assert_int_equal(lights, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(designing_again_gives_the_palettes_of_the_repository),
        cmocka_unit_test(tomato_and_frog_mix_measured_spectra_with_designed_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
