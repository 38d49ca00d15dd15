/* SPDX-License-Identifier: BSD-3-Clause
 * What observers and cameras make of a reflectance under a light. */
#include "fixture.h"

static const char *const observers[] = {"cie1931", "cie1964", "cie2015", "cie2015_10deg"};
static const char *const lights[] = {"D65", "A", "FL11", "HP1", "E"};
enum { OBSERVERS = 4, LIGHTS = 5 };

static mtm_observer observer_called(const char *name) {
    mtm_error error;
    mtm_observer observer;
    assert_ok(mtm_observer_get(name, &observer, &error), error);
    return observer;
}

static mtm_observer nikon(void) {
    mtm_error error;
    mtm_observer camera;
    assert_ok(mtm_observer_read(METAMER_SOURCE_DIR "/data/spectra/camera_nikon_d5100.csv", &camera, &error),
              error);
    return camera;
}

/* Of luminance 1 to the CIE 1931 observer. */
static mtm_spectrum light_called(const char *name) {
    return fixture_illumination(name).light;
}

static mtm_rgb color_of(const mtm_spectrum *light, const mtm_observer *observer, double adapted_y,
                        const mtm_spectrum *reflectance) {
    const mtm_illumination illumination = mtm_illumination_of(light, observer, adapted_y);
    return mtm_illuminate(&illumination, reflectance);
}

static void assert_rgb(mtm_rgb color, mtm_rgb expected, double tolerance) {
    assert_near(color.r, expected.r, tolerance);
    assert_near(color.g, expected.g, tolerance);
    assert_near(color.b, expected.b, tolerance);
}

/* Plain CIE 1931 is the matrix of sRGB alone. */
static void the_exposure_of_cie1931_is_1(void **state) {
    (void)state;
    double matrix[3][3];
    mtm_rgb_from_xyz_matrix(matrix);
    const mtm_illumination plain = fixture_illumination("FL2");
    assert_memory_equal(plain.rgb_from_xyz, matrix, sizeof matrix);
}

/* y of white is 1 under equal-energy light, whoever looks; the CIE 1964 sums would give 1.0915. */
static void equal_energy_is_as_bright_to_every_observer(void **state) {
    (void)state;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    const mtm_spectrum light = light_called("E");
    for (int i = 0; i < OBSERVERS; i++) {
        const mtm_observer observer = observer_called(observers[i]);
        assert_near(mtm_xyz_from_rgb(color_of(&light, &observer, 0, &white)).y, 1, 1e-12);
    }
    const mtm_observer camera = nikon();
    assert_near(color_of(&light, &camera, 0, &white).g, 1, 1e-12);
}

/* Their ratios are those of the table; D65 and A are not equal energy, so green is only near 1. */
static void a_camera_shows_its_responses(void **state) {
    (void)state;
    const mtm_observer camera = nikon();
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    const mtm_spectrum flat = mtm_spectrum_constant(1);
    fixture_reflectances(reflectances);
    const mtm_observer standard = observer_called("cie1931");
    const double exposure = mtm_xyz_of(&flat, &standard).y / mtm_xyz_of(&flat, &camera).y;
    for (int i = 0; i < LIGHTS; i++) {
        const mtm_spectrum light = light_called(lights[i]);
        for (int k = 0; k < FIXTURE_MATERIALS; k++) {
            const mtm_spectrum stimulus = mtm_spectrum_multiply(&light, &reflectances[k]);
            const mtm_xyz response = mtm_xyz_of(&stimulus, &camera);
            assert_rgb(color_of(&light, &camera, 0, &reflectances[k]),
                       (mtm_rgb){exposure * response.x, exposure * response.y, exposure * response.z}, 1e-12);
        }
    }
}

/* Exposures know no light: what two lights show together is what each shows, added. */
static void a_mix_of_lights_is_a_mix_of_pictures(void **state) {
    (void)state;
    const mtm_observer seen_by[] = {observer_called("cie1964"), nikon()};
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    fixture_reflectances(reflectances);
    const mtm_spectrum a = light_called("A");
    const mtm_spectrum b = light_called("FL11");
    mtm_spectrum mix;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) mix.value[i] = 0.3 * a.value[i] + 2 * b.value[i];
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < FIXTURE_MATERIALS; k++) {
            const mtm_rgb under_a = color_of(&a, &seen_by[i], 0, &reflectances[k]);
            const mtm_rgb under_b = color_of(&b, &seen_by[i], 0, &reflectances[k]);
            assert_rgb(color_of(&mix, &seen_by[i], 0, &reflectances[k]),
                       (mtm_rgb){0.3 * under_a.r + 2 * under_b.r, 0.3 * under_a.g + 2 * under_b.g,
                                 0.3 * under_a.b + 2 * under_b.b},
                       1e-12);
        }
    }
}

/* At the y that is asked for; sRGB's matrix has four digits, a camera needs none. */
static void adapted_white_is_white_to_all(void **state) {
    (void)state;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    const mtm_observer camera = nikon();
    for (int i = 0; i < LIGHTS; i++) {
        const mtm_spectrum light = light_called(lights[i]);
        const mtm_spectrum bright = mtm_spectrum_scale(&light, 2);
        for (int k = 0; k < OBSERVERS; k++) {
            const mtm_observer observer = observer_called(observers[k]);
            assert_rgb(color_of(&bright, &observer, 2, &white), (mtm_rgb){2, 2, 2}, 1e-3);
        }
        assert_rgb(color_of(&bright, &camera, 2, &white), (mtm_rgb){2, 2, 2}, 1e-12);
    }
}

/* A deep red line: the channel that does not see it stays as it was instead of becoming infinite. */
static void a_channel_without_response_has_nothing_to_adapt(void **state) {
    (void)state;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    mtm_observer camera = nikon();
    mtm_spectrum line = mtm_spectrum_constant(0);
    mtm_spectrum light;
    mtm_error error;
    line.value[52] = 1; /* 640 nm */
    camera.z.value[52] = 0;
    const mtm_observer standard = observer_called("cie1931");
    assert_ok(mtm_light_normalize(&line, &standard, &light, &error), error);
    assert_rgb(color_of(&light, &camera, 1, &white), (mtm_rgb){1, 1, 0}, 1e-12);
    const mtm_spectrum dark = mtm_spectrum_constant(0);
    assert_rgb(color_of(&dark, &camera, 1, &white), (mtm_rgb){0, 0, 0}, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_exposure_of_cie1931_is_1),
        cmocka_unit_test(equal_energy_is_as_bright_to_every_observer),
        cmocka_unit_test(a_camera_shows_its_responses),
        cmocka_unit_test(a_mix_of_lights_is_a_mix_of_pictures),
        cmocka_unit_test(adapted_white_is_white_to_all),
        cmocka_unit_test(a_channel_without_response_has_nothing_to_adapt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
