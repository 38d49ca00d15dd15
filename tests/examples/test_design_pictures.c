/* SPDX-License-Identifier: BSD-3-Clause
 * The examples' palettes keep their promises in the picture: finished images are given other reflectances, as metamer
 * relight --palette does, and what that changes is measured. */
#include <stdio.h>

#include "fixture.h"

enum { EDGE = 128, PIXELS = EDGE * EDGE };

typedef struct finished {
    mtm_scene *scene;
    mtm_image *image;
    int white; /* of the image's coefficients: the highlights */
} finished;

/* Renders the example; false where its volume is not on this machine. */
static bool render(const char *name, finished *example) {
    mtm_error error;
    mtm_volume *volume = NULL;
    char path[512];
    (void)snprintf(path, sizeof path, "%s/examples/%s/%s.json", METAMER_SOURCE_DIR, name, name);
    assert_ok(mtm_scene_read(path, &example->scene, &error), error);
    const mtm_status status = mtm_scene_load_volume(example->scene, NULL, &volume, &error);
    if (status == MTM_IO) {
        print_message("%s: %s\n", name, error.message);
        mtm_scene_destroy(example->scene);
        return false;
    }
    assert_ok(status, error);
    example->scene->render.width = example->scene->render.height = EDGE;
    assert_ok(mtm_scene_render(example->scene, volume, NULL, &example->image, &error), error);
    assert_string_equal(example->image->basis, "materials");
    example->white = example->scene->palette.material_count;
    mtm_volume_destroy(volume);
    return true;
}

static void release(finished *example) {
    mtm_image_destroy(example->image);
    mtm_scene_destroy(example->scene);
}

static int material(const finished *example, const char *name) {
    const int found = mtm_palette_find_material(&example->scene->palette, name);
    assert_true(found >= 0);
    return found;
}

/* The finished image under one light. */
static mtm_picture *light(finished *example, const char *name) {
    mtm_error error;
    mtm_picture *picture = NULL;
    mtm_scene_clear_weights(example->scene);
    assert_ok(mtm_scene_set_weight(example->scene, name, 1, &error), error);
    assert_ok(mtm_scene_relight(example->scene, example->image, 0, &picture, &error), error);
    return picture;
}

/* The same with other reflectances for the same coefficients. */
static mtm_picture *light_changed(finished *example, const char *name, const mtm_palette *changed) {
    mtm_error error;
    mtm_palette original;
    assert_ok(mtm_palette_copy(&example->scene->palette, &original, &error), error);
    assert_ok(mtm_scene_override_palette(example->scene, changed, &error), error);
    mtm_picture *picture = light(example, name);
    assert_ok(mtm_scene_override_palette(example->scene, &original, &error), error);
    mtm_palette_free(&original);
    return picture;
}

/* With the reflectance of `to` for the material `from`; NULL: with none at all. */
static mtm_picture *light_replaced(finished *example, const char *name, const char *from, const char *to) {
    mtm_error error;
    mtm_palette changed;
    assert_ok(mtm_palette_copy(&example->scene->palette, &changed, &error), error);
    mtm_spectrum *reflectance = &changed.materials[material(example, from)].reflectance;
    *reflectance = to == NULL ? (mtm_spectrum){{0}} : changed.materials[material(example, to)].reflectance;
    mtm_picture *picture = light_changed(example, name, &changed);
    mtm_palette_free(&changed);
    return picture;
}

/* With one material alone, the others black. */
static mtm_picture *light_alone(finished *example, const char *name, const char *kept) {
    mtm_error error;
    mtm_palette changed;
    assert_ok(mtm_palette_copy(&example->scene->palette, &changed, &error), error);
    for (int i = 0; i < changed.material_count; i++)
        if (i != material(example, kept)) changed.materials[i].reflectance = (mtm_spectrum){{0}};
    mtm_picture *picture = light_changed(example, name, &changed);
    mtm_palette_free(&changed);
    return picture;
}

/* CIELAB of a pixel as a display shows it over black. */
static mtm_lab shown(const mtm_picture *picture, int pixel) {
    const float *rgba = picture->rgba + 4 * (size_t)pixel;
    const mtm_rgb rgb = {fmin(fmax(rgba[0], 0), 1), fmin(fmax(rgba[1], 0), 1), fmin(fmax(rgba[2], 0), 1)};
    return mtm_lab_from_xyz(mtm_xyz_from_rgb(rgb), mtm_white_d65());
}

/* Pixels where a material gives more than the share `least` of the light that all materials give, and something is
 * seen of it; if `is_matte` without highlights, which have the light's color and not the material's. */
typedef struct region {
    int material; /* -1: every pixel */
    double least;
    bool is_matte;
} region;

static bool is_inside(const finished *example, region within, int pixel) {
    const float *weights = example->image->pixels + (size_t)pixel * (size_t)example->image->lanes;
    double sum = 0;
    for (int i = 0; i < example->white; i++) sum += weights[i];
    if (within.material < 0) return true;
    const double weight = weights[within.material];
    if (within.is_matte && weights[example->white] > 0.02 * weight) return false;
    return weight > 0.02 && weight > within.least * sum;
}

typedef struct difference {
    int pixels;
    double mean, max;
} difference;

/* CIEDE2000 within the region; both pictures are released. */
static difference compare(const finished *example, region within, mtm_picture *a, mtm_picture *b) {
    difference found = {0};
    for (int pixel = 0; pixel < PIXELS; pixel++) {
        if (!is_inside(example, within, pixel)) continue;
        const double apart = mtm_ciede2000(shown(a, pixel), shown(b, pixel));
        found.pixels++;
        found.mean += apart;
        found.max = fmax(found.max, apart);
    }
    found.mean /= fmax(found.pixels, 1);
    mtm_picture_destroy(a);
    mtm_picture_destroy(b);
    return found;
}

static const region everywhere = {-1, 0, false};

/* What the picture under the light loses or gains with another reflectance: at most 1 anywhere. */
static void assert_unseen(finished *example, const char *name, const char *from, const char *to) {
    const difference found =
        compare(example, everywhere, light(example, name), light_replaced(example, name, from, to));
    print_message("%s as %s under %s: at most %.3f\n", from, to == NULL ? "black" : to, name, found.max);
    assert_true(found.max <= 1);
}

/* The same: at least 8 in the mean where the material gives most of the light. */
static void assert_seen(finished *example, const char *name, const char *from, const char *to) {
    const region most = {material(example, from), 0.5, false};
    const difference found =
        compare(example, most, light(example, name), light_replaced(example, name, from, to));
    print_message("%s as %s under %s: %.1f in the mean of %d pixels\n", from, to == NULL ? "black" : to, name,
                  found.mean, found.pixels);
    assert_true(found.pixels > 100 && found.mean >= 8);
}

/* What a material adds to the picture, the others being black, keeps its color from one light to the other. */
static void assert_constant(finished *example, const char *name, const char *from, const char *to) {
    const region matte = {material(example, name), 0, true};
    const difference found =
        compare(example, matte, light_alone(example, from, name), light_alone(example, to, name));
    print_message("%s from %s to %s: at most %.3f in %d pixels\n", name, from, to, found.max, found.pixels);
    assert_true(found.pixels > 100 && found.max <= 2);
}

static void the_engine_merges_and_its_smoke_vanishes(void **state) {
    (void)state;
    finished engine;
    assert_true(render("engine", &engine));
    assert_unseen(&engine, "light 1", "inner", "block");
    assert_seen(&engine, "light 2", "inner", "block");
    assert_constant(&engine, "block", "light 1", "light 2");
    assert_constant(&engine, "inner", "light 2", "light 3");
    assert_unseen(&engine, "light 1", "smoke", NULL);
    assert_unseen(&engine, "light 2", "smoke", NULL);
    assert_seen(&engine, "light 3", "smoke", NULL);
    release(&engine);
}

static void the_cloud_of_hipiph_is_white_then_black(void **state) {
    (void)state;
    finished hipiph;
    assert_true(render("hipiph", &hipiph));
    const region cloud = {material(&hipiph, "cloud"), 0, true};
    mtm_picture *white = light_alone(&hipiph, "light 1", "cloud");
    double chroma = 0;
    double lightest = 0;
    int pixels = 0;
    for (int pixel = 0; pixel < PIXELS; pixel++) {
        if (!is_inside(&hipiph, cloud, pixel)) continue;
        const mtm_lab lab = shown(white, pixel);
        chroma = fmax(chroma, hypot(lab.a, lab.b));
        lightest = fmax(lightest, lab.l);
        pixels++;
    }
    print_message("cloud: chroma to %.2f and L* to %.1f in %d pixels\n", chroma, lightest, pixels);
    mtm_picture_destroy(white);
    assert_true(pixels > 100 && chroma <= 5 && lightest > 60);
    assert_seen(&hipiph, "light 1", "cloud", NULL);
    assert_unseen(&hipiph, "light 2", "cloud", NULL);
    assert_constant(&hipiph, "core", "light 1", "light 2");
    release(&hipiph);
}

static void each_light_of_uncbrain_shows_one_material(void **state) {
    (void)state;
    static const char *const names[] = {"skin", "brain", "fat"};
    static const char *const lights[] = {"skin light", "brain light", "fat light"};
    finished uncbrain;
    assert_true(render("uncbrain", &uncbrain));
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            (i == k ? assert_seen : assert_unseen)(&uncbrain, lights[k], names[i], NULL);
    release(&uncbrain);
}

static void the_tomato_merges(void **state) {
    (void)state;
    finished tomato;
    if (!render("tomato", &tomato)) skip();
    assert_unseen(&tomato, "light 1", "gel", "flesh");
    assert_seen(&tomato, "light 2", "gel", "flesh");
    assert_constant(&tomato, "flesh", "light 1", "light 2");
    release(&tomato);
}

static void the_frog_merges_under_two_measured_lights(void **state) {
    (void)state;
    finished frog;
    if (!render("frog", &frog)) skip();
    assert_unseen(&frog, "daylight", "organs", "muscle");
    assert_unseen(&frog, "tube", "organs", "muscle");
    assert_seen(&frog, "organ light", "organs", "muscle");
    assert_constant(&frog, "muscle", "daylight", "organ light");
    assert_constant(&frog, "bone", "daylight", "organ light");
    release(&frog);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_engine_merges_and_its_smoke_vanishes),
        cmocka_unit_test(the_cloud_of_hipiph_is_white_then_black),
        cmocka_unit_test(each_light_of_uncbrain_shows_one_material),
        cmocka_unit_test(the_tomato_merges),
        cmocka_unit_test(the_frog_merges_under_two_measured_lights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
