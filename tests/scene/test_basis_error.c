/* SPDX-License-Identifier: BSD-3-Clause
 * The largest error of a scene's basis against full spectra. */
#include <stdio.h>

#include "fixture.h"

static const char document[] =
    "{\"volume\": {\"file\": \"none.nrrd\"},"
    " \"palette\": {\"materials\": [{\"name\": \"flat\", \"srgb\": \"#808080\"},"
    "                            {\"name\": \"line\", \"srgb\": \"#ffffff\"}],"
    "             \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": \"tube\", "
    "\"illuminant\": \"FL11\"}]},"
    " \"transfer\": {\"points\": [{\"value\": 0, \"opacity\": 0, \"material\": \"flat\"}]}}";

/* A scene whose second material reflects a band of 10 nm only. */
static mtm_scene *make_scene(const char *basis) {
    mtm_error error;
    mtm_scene *scene = NULL;
    assert_ok(mtm_scene_parse("scene", document, ".", &scene, &error), error);
    (void)snprintf(scene->basis, sizeof scene->basis, "%s", basis);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        scene->palette.materials[1].reflectance.value[i] =
            i == 33 || i == 34; /* 545 and 550 nm, FL11's line */
    return scene;
}

static void exact_bases_have_none(void **state) {
    (void)state;
    static const char *const exact[] = {"auto", "materials", "wavelengths", "rgb"};
    for (int i = 0; i < 4; i++) {
        mtm_error error;
        mtm_basis_error largest;
        mtm_scene *scene = make_scene(exact[i]);
        assert_ok(mtm_scene_basis_error(scene, &largest, &error), error);
        assert_true(largest.ciede2000 < 1e-3);
        mtm_scene_destroy(scene);
    }
}

/* Flat gray is in every basis, so the error is that of the band; a picture of both says how large. */
static void few_coefficients_cannot_hold_a_band(void **state) {
    (void)state;
    static const char *const few[] = {"factors:3", "factors:7", "sharpened:7"};
    for (int i = 0; i < 3; i++) {
        mtm_error error;
        mtm_basis_error largest;
        mtm_scene *scene = make_scene(few[i]);
        assert_ok(mtm_scene_basis_error(scene, &largest, &error), error);
        assert_true(largest.ciede2000 > 5);
        assert_int_equal(largest.material, 1);
        scene->palette.light_count = 1;
        mtm_basis_error by_day;
        assert_ok(mtm_scene_basis_error(scene, &by_day, &error), error);
        assert_int_equal(by_day.light, 0);
        assert_true(by_day.ciede2000 <= largest.ciede2000);
        mtm_scene_destroy(scene);
    }
}

static void a_basis_that_cannot_be_made_fails(void **state) {
    (void)state;
    mtm_error error;
    mtm_basis_error largest;
    mtm_scene *scene = make_scene("factors:2");
    assert_fails(mtm_scene_basis_error(scene, &largest, &error), MTM_ARGUMENT, error, "factors:2");
    mtm_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_bases_have_none),
        cmocka_unit_test(few_coefficients_cannot_hold_a_band),
        cmocka_unit_test(a_basis_that_cannot_be_made_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
