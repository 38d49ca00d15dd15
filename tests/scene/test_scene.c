/* SPDX-License-Identifier: BSD-3-Clause
 * The scene document and the two halves it drives; what the command line does with bad documents is tested there. */
#include "metamer/scene.h"

#include <stdio.h>

#include "fixture.h"

static const char full[] =
    "{\"metamer\": 1, \"volume\": {\"file\": \"a/b.nrrd\", \"size\": [3, 4, 5]},"
    " \"palette\": {\"materials\": [{\"name\": \"haze\", \"srgb\": \"#8090a0\"},"
    "   {\"name\": \"core\", \"srgb\": \"#c08040\"}],"
    "   \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": \"lamp\", \"blackbody\": "
    "2856.5},"
    "   {\"name\": \"tube\", \"illuminant\": \"FL11\"}]},"
    " \"transfer\": {\"opacity_length\": 2.5, \"points\": [{\"value\": -1.25, \"opacity\": 0, \"material\": "
    "\"haze\"},"
    "   {\"value\": 10, \"opacity\": 0.1, \"emission\": 0.3, \"material\": \"core\"}]},"
    " \"camera\": {\"azimuth\": 12.5, \"elevation\": -7, \"distance\": 99, \"target\": [1, 2, 3], \"up\": "
    "[0, 0, 1],"
    "   \"fov\": 0, \"height\": 40},"
    " \"shading\": {\"ambient\": 0.1, \"diffuse\": 0.2, \"specular\": 0.4, \"shininess\": 7, \"direction\": "
    "[1, 2, 3],"
    "   \"gradient_threshold\": 0.03},"
    " \"clip\": {\"box\": [[0.1, 0.2, 0.3], [0.7, 0.8, 0.9]]}, \"background\": {\"material\": \"core\"},"
    " \"render\": {\"renderer\": \"raycast\", \"basis\": \"wavelengths\", \"size\": [30, 20], \"step\": 0.7,"
    "   \"blend\": \"sum\", \"jitter\": true, \"termination\": 0.1},"
    " \"observer\": \"cie1931\", \"white\": \"light\","
    " \"lights\": {\"weights\": {\"lamp\": 0.25, \"tube\": 2}, \"intensity\": 1.5,"
    "   \"dial\": {\"dot\": [0.1, -0.2], \"bulbs\": {\"lamp\": {\"at\": [1, 0], \"on\": false}}},"
    "   \"stops\": [{\"name\": \"one\", \"weights\": {\"day\": 1}}]}}";

static mtm_scene *parse(const char *text) {
    mtm_error error;
    mtm_scene *scene = NULL;
    assert_ok(mtm_scene_parse("test.json", text, ".", &scene, &error), error);
    return scene;
}

static void every_key_arrives(void **state) {
    (void)state;
    mtm_scene *scene = parse(full);
    assert_string_equal(scene->volume_file, "a/b.nrrd");
    assert_int_equal(scene->volume_size[2], 5);
    assert_int_equal(scene->palette.material_count, 2);
    assert_near(scene->opacity_length, 2.5, 0);
    assert_int_equal(scene->point_count, 2);
    assert_near(scene->points[0].value, -1.25, 0);
    assert_false(scene->points[0].has_emission);
    assert_near(scene->points[1].emission, 0.3, 0);
    assert_int_equal(scene->points[1].material, 1);
    assert_near(scene->camera.azimuth, 12.5, 0);
    assert_near(scene->camera.elevation, -7, 0);
    assert_near(scene->camera.target[2], 3, 0);
    assert_near(scene->camera.up[2], 1, 0);
    assert_near(scene->camera.height, 40, 0);
    assert_near(scene->render.shading.shininess, 7, 0);
    assert_false(scene->render.shading.is_headlight);
    assert_near(scene->render.clip_low[1], 0.2, 0);
    assert_near(scene->render.clip_high[2], 0.9, 0);
    assert_int_equal(scene->background, MTM_BACKGROUND_MATERIAL);
    assert_int_equal(scene->background_material, 1);
    assert_string_equal(scene->basis, "wavelengths");
    assert_int_equal(scene->render.height, 20);
    assert_int_equal(scene->render.blend, MTM_BLEND_SUM);
    assert_true(scene->render.jitter && scene->is_white_adapted);
    assert_near(scene->lights.weights[0], 0, 0);
    assert_near(scene->lights.weights[2], 2, 0);
    assert_near(scene->lights.intensity, 1.5, 0);
    assert_true(scene->lights.has_dot);
    assert_int_equal(scene->lights.bulb_count, 1);
    assert_false(scene->lights.bulbs[0].is_on);
    assert_int_equal(scene->stop_count, 1);
    assert_near(scene->stops[0].mix.weights[0], 1, 0);
    mtm_scene_destroy(scene);
}

static void only_volume_and_transfer_are_required(void **state) {
    (void)state;
    mtm_scene *scene = parse("{\"volume\": {\"file\": \"v.nrrd\"}, \"transfer\": {\"points\":"
                             " [{\"value\": 1, \"opacity\": 0.5, \"material\": \"middle\"}]}}");
    assert_int_equal(scene->palette.material_count, 3);
    assert_near(scene->lights.weights[0], 1, 0); /* the first light shines */
    assert_near(scene->lights.weights[1], 0, 0);
    assert_string_equal(scene->basis, "auto");
    assert_near(scene->render.termination, 1.0 / 1024, 0);
    mtm_scene_destroy(scene);
}

static void a_written_scene_reads_back_as_the_same_text(void **state) {
    (void)state;
    mtm_scene *scene = parse(full);
    char *first = mtm_scene_format(scene);
    mtm_scene *again = parse(first);
    char *second = mtm_scene_format(again);
    assert_string_equal(first, second);
    assert_memory_equal(&again->camera, &scene->camera, sizeof scene->camera);
    assert_memory_equal(again->palette.lights, scene->palette.lights, 3 * sizeof(mtm_light));
    assert_near(again->lights.weights[1], 0.25, 0);
    assert_memory_equal(again->points, scene->points, 2 * sizeof *scene->points);
    assert_memory_equal(&again->render, &scene->render, sizeof scene->render);
    assert_string_equal(again->volume_file, "b.nrrd"); /* a document that travels names no folder */
    mtm_text_free(first);
    mtm_text_free(second);
    mtm_scene_destroy(scene);
    mtm_scene_destroy(again);
}

/* A small scene whose observer is this. */
static mtm_status parse_observer(const char *observer, const char *folder, mtm_scene **scene,
                                 mtm_error *error) {
    static const char form[] =
        "{\"volume\": {\"file\": \"v.nrrd\"}, \"transfer\": {\"points\": [{\"value\": 1,"
        " \"opacity\": 0.5, \"material\": \"middle\"}]}, \"observer\": %s}";
    const size_t size = sizeof form + strlen(observer);
    char *text = malloc(size);
    assert_non_null(text);
    (void)snprintf(text, size, form, observer);
    const mtm_status status = mtm_scene_parse("test.json", text, folder, scene, error);
    free(text);
    return status;
}

/* Written and read back as an embedded document: the same observer, and the same text. */
static void assert_observer_travels(const mtm_scene *scene) {
    mtm_error error;
    mtm_scene *again = NULL;
    char *first = mtm_scene_format(scene);
    assert_ok(mtm_scene_parse("again.json", first, NULL, &again, &error), error);
    char *second = mtm_scene_format(again);
    assert_string_equal(first, second);
    assert_string_equal(again->observer.name, scene->observer.name);
    assert_int_equal(again->observer.is_camera, scene->observer.is_camera);
    assert_memory_equal(&again->observer.x, &scene->observer.x, sizeof scene->observer.x);
    assert_memory_equal(&again->observer.y, &scene->observer.y, sizeof scene->observer.y);
    assert_memory_equal(&again->observer.z, &scene->observer.z, sizeof scene->observer.z);
    mtm_text_free(first);
    mtm_text_free(second);
    mtm_scene_destroy(again);
}

static void observers_travel_by_name_or_with_their_curves(void **state) {
    (void)state;
    static const struct {
        const char *observer, *folder, *name, *text; /* as given; then as written */
        bool is_camera;
    } cases[] = {
        {"\"cie1964\"", NULL, "cie1964", "\"observer\": \"cie1964\"", false},
        {"{\"file\": \"camera_arri_d21.csv\"}", METAMER_SOURCE_DIR "/data/spectra", "camera_arri_d21",
         "\"r\": [0.0001", true},
        {"{\"file\": \"cie_observer_2015_2deg.csv\"}", METAMER_SOURCE_DIR "/data/spectra",
         "cie_observer_2015_2deg", "\"x\": [0", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mtm_error error;
        mtm_scene *scene = NULL;
        assert_ok(parse_observer(cases[i].observer, cases[i].folder, &scene, &error), error);
        assert_string_equal(scene->observer.name, cases[i].name);
        assert_int_equal(scene->observer.is_camera, cases[i].is_camera);
        assert_observer_travels(scene);
        char *text = mtm_scene_format(scene);
        assert_non_null(strstr(text, cases[i].text));
        assert_null(strstr(text, ".csv"));
        mtm_text_free(text);
        mtm_scene_destroy(scene);
    }
}

/* A table called as a known observer: its name must not stand for the curves. */
static void curves_with_a_known_name_are_kept(void **state) {
    (void)state;
    mtm_error error;
    mtm_scene *scene = NULL;
    assert_ok(parse_observer("\"cie1931\"", NULL, &scene, &error), error);
    scene->observer.z.value[7] *= 1.5;
    assert_observer_travels(scene);
    assert_ok(mtm_observer_get("cie1931", &scene->observer, &error), error);
    scene->observer.is_camera = true;
    assert_observer_travels(scene);
    mtm_scene_destroy(scene);
}

static void observers_that_cannot_be_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *observer, *message;
        mtm_status status;
    } cases[] = {
        {"5", "observer is 5, must be a name or an object", MTM_FORMAT},
        {"null", "observer is null, must be a name or an object", MTM_FORMAT},
        {"\"cie1932\"", "observer is not usable: unknown observer 'cie1932', expected one of: cie1931,",
         MTM_FORMAT},
        {"{}", "observer.name is missing", MTM_FORMAT},
        {"{\"name\": \"n\", \"x\": [1]}", "observer.x is [1], must be an array of 81 numbers", MTM_FORMAT},
        {"{\"name\": \"0123456789012345678901234567890123456789012345678901234567890123\"}",
         "observer.name has 64 bytes, at most 63 are allowed", MTM_FORMAT},
        {"{\"nmae\": \"n\"}", "observer.nmae is not a known key; the nearest is \"name\"", MTM_FORMAT},
        {"{\"name\": \"n\", \"r\": [], \"x\": []}", "observer.x is not a known key", MTM_FORMAT},
        {"{\"file\": \"a.csv\", \"name\": \"n\"}",
         "observer.name is not a known key; the nearest is \"file\"", MTM_FORMAT},
        {"{\"file\": 5}", "observer.file is 5", MTM_FORMAT},
        {"{\"file\": \"nowhere.csv\"}", "observer.file is not usable: ./nowhere.csv", MTM_IO},
    };
    mtm_error error;
    mtm_scene *scene = NULL;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_fails(parse_observer(cases[i].observer, ".", &scene, &error), cases[i].status, error,
                     cases[i].message);
    assert_fails(parse_observer("{\"file\": \"nowhere.csv\"}", NULL, &scene, &error), MTM_FORMAT, error,
                 "observer.file names a file, but an embedded document stands alone");
}

/* Curves from a document meet the same conditions as those from a table. */
static void inlined_curves_are_checked(void **state) {
    (void)state;
    static const char *const letters = "xyz";
    mtm_error error;
    mtm_scene *scene = NULL;
    for (int missing = 0; missing <= 3; missing++) { /* the curve without a sum; 3: none */
        char text[2048] = "{\"name\": \"eye\"";
        for (int k = 0; k < 3; k++) {
            size_t length = strlen(text);
            length += (size_t)snprintf(text + length, sizeof text - length, ", \"%c\": [%d", letters[k],
                                       k != missing);
            for (int i = 1; i < MTM_SPECTRUM_SAMPLES; i++)
                length += (size_t)snprintf(text + length, sizeof text - length, ",0");
            (void)snprintf(text + length, sizeof text - length, "]%s", k == 2 ? "}" : "");
        }
        char expected[64];
        (void)snprintf(expected, sizeof expected, "observer is not usable: eye: curve %c has the sum 0",
                       letters[missing % 3]);
        if (missing < 3) {
            assert_fails(parse_observer(text, NULL, &scene, &error), MTM_FORMAT, error, expected);
            continue;
        }
        assert_ok(parse_observer(text, NULL, &scene, &error), error);
        assert_near(scene->observer.z.value[0], 1, 0);
        mtm_scene_destroy(scene);
    }
}

static double ball(const double world[3]) {
    const double r = sqrt(pow(world[0] - 8, 2) + pow(world[1] - 8, 2) + pow(world[2] - 8, 2));
    return fmax(0, 100 - 12 * r);
}

static double largest_picture_difference(const mtm_picture *a, const mtm_picture *b) {
    double largest = 0;
    for (int n = 0; n < a->width * a->height * 4; n++)
        largest = fmax(largest, fabs((double)a->rgba[n] - b->rgba[n]));
    return largest;
}

static mtm_picture *relight(const mtm_scene *scene, const mtm_image *image) {
    mtm_error error;
    mtm_picture *picture = NULL;
    assert_ok(mtm_scene_relight(scene, image, 1, &picture, &error), error);
    return picture;
}

static mtm_image *render(const mtm_scene *scene, const mtm_volume *volume) {
    mtm_error error;
    mtm_image *image = NULL;
    assert_ok(mtm_scene_render(scene, volume, NULL, &image, &error), error);
    return image;
}

static mtm_volume *make_ball(void) {
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    return fixture_volume(&grid, ball);
}

static mtm_scene *default_scene(const mtm_volume *volume) {
    mtm_error error;
    mtm_scene *scene = NULL;
    assert_ok(mtm_scene_for_volume(volume, "ball.nrrd", &scene, &error), error);
    scene->render.width = scene->render.height = 32;
    return scene;
}

static void materials_and_wavelengths_give_the_same_picture(void **state) {
    (void)state;
    mtm_volume *volume = make_ball();
    mtm_scene *scene = default_scene(volume);
    mtm_image *exact = render(scene, volume);
    (void)strcpy(scene->basis, "wavelengths");
    mtm_image *reference = render(scene, volume);
    assert_int_equal(exact->dimension, 4);
    assert_int_equal(reference->dimension, 81);
    for (int light = 0; light < 3; light++) {
        mtm_scene_clear_weights(scene);
        scene->lights.weights[light] = 1.3;
        mtm_picture *a = relight(scene, exact);
        mtm_picture *b = relight(scene, reference);
        assert_true(largest_picture_difference(a, b) < 1e-5);
        mtm_picture_destroy(a);
        mtm_picture_destroy(b);
    }
    mtm_image_destroy(exact);
    mtm_image_destroy(reference);
    mtm_scene_destroy(scene);
    mtm_volume_destroy(volume);
}

static void new_reflectances_on_a_finished_image_are_rendering_again(void **state) {
    (void)state;
    mtm_error error;
    mtm_palette palette;
    mtm_volume *volume = make_ball();
    mtm_scene *scene = default_scene(volume);
    mtm_image *before = render(scene, volume);
    assert_ok(mtm_palette_parse("new.json",
                                "{\"materials\": [{\"name\": \"dense\", \"srgb\": \"#20c020\"},"
                                " {\"name\": \"soft\", \"srgb\": \"#c02020\"}],"
                                " \"lights\": [{\"name\": \"daylight\", \"illuminant\": \"FL2\"}]}",
                                ".", &palette, &error),
              error);
    mtm_picture *old = relight(scene, before);
    assert_ok(mtm_scene_override_palette(scene, &palette, &error), error);
    mtm_image *after = render(scene, volume);
    mtm_picture *relit = relight(scene, before);
    mtm_picture *again = relight(scene, after);
    assert_true(largest_picture_difference(relit, again) < 1e-6);
    assert_true(largest_picture_difference(relit, old) > 0.05);
    (void)strcpy(scene->basis, "wavelengths");
    mtm_image *fixed = render(scene, volume);
    mtm_picture *refused = NULL;
    mtm_scene *original = default_scene(volume);
    assert_fails(mtm_scene_relight(original, fixed, 1, &refused, &error), MTM_ARGUMENT, error, "soft");
    mtm_scene_destroy(original);
    mtm_image_destroy(fixed);
    mtm_picture_destroy(old);
    mtm_picture_destroy(relit);
    mtm_picture_destroy(again);
    mtm_image_destroy(before);
    mtm_image_destroy(after);
    mtm_palette_free(&palette);
    mtm_scene_destroy(scene);
    mtm_volume_destroy(volume);
}

static void lights_are_set_by_name_stop_and_spectrum(void **state) {
    (void)state;
    mtm_error error;
    mtm_scene *scene = parse(full);
    const mtm_spectrum flat = mtm_spectrum_constant(1);
    assert_fails(mtm_scene_set_weight(scene, "lmap", 1, &error), MTM_ARGUMENT, error, "\"lamp\"");
    assert_fails(mtm_scene_use_stop(scene, "two", &error), MTM_ARGUMENT, error, "\"one\"");
    assert_ok(mtm_scene_use_stop(scene, "one", &error), error);
    assert_near(scene->lights.weights[0], 1, 0);
    assert_near(scene->lights.weights[2], 0, 0);
    assert_near(scene->lights.intensity, 1, 0);
    assert_ok(mtm_scene_use_light(scene, "E", &flat, &error), error);
    assert_int_equal(scene->palette.light_count, 4);
    assert_near(scene->lights.weights[0], 0, 0);
    assert_near(scene->lights.weights[3], 1, 0);
    assert_near(scene->stops[0].mix.weights[3], 0, 0);
    mtm_scene_destroy(scene);
}

static void a_default_scene_shows_the_object_and_not_the_air(void **state) {
    (void)state;
    mtm_volume *volume = make_ball();
    mtm_scene *scene = default_scene(volume);
    mtm_image *image = render(scene, volume);
    assert_true(fixture_pixel(image, 16, 16)[image->dimension] > 0.5f);
    assert_near(fixture_pixel(image, 0, 0)[image->dimension], 0, 0);
    mtm_image_destroy(image);
    mtm_scene_destroy(scene);
    mtm_volume_destroy(volume);
}

static void an_image_of_another_program_is_lit_by_the_default_lights(void **state) {
    (void)state;
    mtm_error error;
    mtm_image *image = NULL;
    mtm_scene *scene = NULL;
    assert_ok(mtm_image_create(2, 1, 81, "wavelengths", NULL, NULL, &image, &error), error);
    for (int i = 0; i <= 81; i++) image->pixels[i] = 1; /* one white pixel */
    assert_ok(mtm_scene_of_image(image, "foreign.exr", &scene, &error), error);
    mtm_picture *picture = relight(scene, image);
    for (int i = 0; i < 3; i++) assert_near(picture->rgba[i], 1, 1e-3); /* D65 on white */
    mtm_picture_destroy(picture);
    mtm_scene_destroy(scene);
    mtm_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_arrives),
        cmocka_unit_test(only_volume_and_transfer_are_required),
        cmocka_unit_test(a_written_scene_reads_back_as_the_same_text),
        cmocka_unit_test(observers_travel_by_name_or_with_their_curves),
        cmocka_unit_test(curves_with_a_known_name_are_kept),
        cmocka_unit_test(observers_that_cannot_be_are_refused),
        cmocka_unit_test(inlined_curves_are_checked),
        cmocka_unit_test(materials_and_wavelengths_give_the_same_picture),
        cmocka_unit_test(new_reflectances_on_a_finished_image_are_rendering_again),
        cmocka_unit_test(lights_are_set_by_name_stop_and_spectrum),
        cmocka_unit_test(a_default_scene_shows_the_object_and_not_the_air),
        cmocka_unit_test(an_image_of_another_program_is_lit_by_the_default_lights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
