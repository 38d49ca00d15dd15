/* SPDX-License-Identifier: BSD-3-Clause
 * What is found in palettes made for it: materials that match, vanish, keep their color, or look alike to some eyes. */
#include <math.h>

#include "fixture.h"
#include "metamer/palette.h"

static mtm_palette parse(const char *text) {
    mtm_error error;
    mtm_palette palette;
    assert_ok(mtm_palette_parse("test.json", text, METAMER_SOURCE_DIR "/data/spectra", &palette, &error),
              error);
    return palette;
}

static mtm_analysis analyze_adapted(const mtm_palette *palette, double adapted_y) {
    mtm_error error;
    mtm_observer observer;
    mtm_analysis analysis;
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_palette_analyze(palette, &observer, adapted_y, &analysis, &error), error);
    return analysis;
}

static mtm_analysis analyze(const mtm_palette *palette) {
    return analyze_adapted(palette, 0);
}

/* A gray and one of its metamers under D65 that parts far under A. */
static mtm_palette metameric_palette(void) {
    mtm_error error;
    mtm_mismatch found;
    mtm_palette palette = parse("{\"materials\": [{\"name\": \"one\", \"srgb\": \"#909090\"}, {\"name\": "
                                "\"two\", \"srgb\": \"#808080\"},"
                                " {\"name\": \"red\", \"srgb\": \"#c03020\"}],"
                                " \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": "
                                "\"lamp\", \"illuminant\": \"A\"}]}");
    const mtm_illumination day = fixture_illumination("D65");
    const mtm_illumination lamp = fixture_illumination("A");
    const mtm_rgb color = mtm_illuminate(&day, &palette.materials[0].reflectance);
    assert_ok(mtm_mismatch_find(&day, &lamp, color, 0, &found, &error), error);
    palette.materials[0].reflectance = found.reflectances[0];
    palette.materials[1].reflectance = found.reflectances[1];
    return palette;
}

static void metamers_match_under_one_light_and_part_under_another(void **state) {
    (void)state;
    mtm_palette palette = metameric_palette();
    mtm_analysis analysis = analyze(&palette);
    assert_int_equal(analysis.metamer_count, 1);
    assert_int_equal(analysis.metamers_left_out, 0);
    const mtm_metamers *found = &analysis.metamers[0];
    assert_int_equal(found->materials[0], 0);
    assert_int_equal(found->materials[1], 1);
    assert_int_equal(found->match_light, 0);
    assert_int_equal(found->other_light, 1);
    assert_near(mtm_analysis_difference(&analysis, MTM_VISION_NORMAL, 0, 0, 1, 0), 0, 0.01);
    assert_near(found->difference, mtm_analysis_difference(&analysis, MTM_VISION_NORMAL, 0, 1, 1, 1), 0);
    print_message("%.2f of %.2f, %.2f where smooth\n", found->difference, found->largest,
                  found->largest_smooth);
    assert_true(found->difference > 30);
    assert_near(found->largest, found->difference, 0.02 * found->difference);
    assert_true(found->largest_smooth > 10 && found->largest_smooth < found->largest);
    mtm_analysis_free(&analysis);
    mtm_palette_free(&palette);
}

/* The same as pictures are judged elsewhere. */
static void differences_are_those_of_picture_colors(void **state) {
    (void)state;
    mtm_palette palette;
    mtm_error error;
    assert_ok(mtm_palette_defaults(&palette, &error), error);
    mtm_analysis analysis = analyze(&palette);
    assert_int_equal(analysis.material_count, 3);
    assert_int_equal(analysis.light_count, 3);
    for (int light = 0; light < 3; light++) {
        double weights[3] = {0, 0, 0};
        weights[light] = 1;
        mtm_observer observer;
        assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
        const mtm_spectrum mix = mtm_palette_mix(&palette, weights, 1);
        const mtm_illumination shining = mtm_illumination_of(&mix, &observer, 0);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                const mtm_rgb rgb_a = mtm_illuminate(&shining, &palette.materials[a].reflectance);
                const mtm_rgb rgb_b = mtm_illuminate(&shining, &palette.materials[b].reflectance);
                assert_near(mtm_analysis_difference(&analysis, MTM_VISION_NORMAL, a, light, b, light),
                            mtm_ciede2000(mtm_lab_shown(rgb_a), mtm_lab_shown(rgb_b)), 1e-9);
                const mtm_rgb seen_a = mtm_vision_see(MTM_VISION_DEUTAN, 1, mtm_rgb_clip(rgb_a));
                const mtm_rgb seen_b = mtm_vision_see(MTM_VISION_DEUTAN, 1, mtm_rgb_clip(rgb_b));
                assert_near(mtm_analysis_difference(&analysis, MTM_VISION_DEUTAN, a, light, b, light),
                            mtm_ciede2000(mtm_lab_shown(seen_a), mtm_lab_shown(seen_b)), 1e-9);
            }
    }
    mtm_analysis_free(&analysis);
    mtm_palette_free(&palette);
}

/* Blue paint under the yellow line of sodium, nearly: a light with no power where the paint reflects. */
static void a_material_without_light_to_send_back_is_invisible(void **state) {
    (void)state;
    mtm_palette palette = metameric_palette();
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
        palette.materials[2].reflectance.value[k] = k < 30 ? 0.8 : 0;
        palette.lights[1].emission.value[k] = k >= 36 && k < 44;
    }
    mtm_analysis analysis = analyze(&palette);
    assert_true(mtm_analysis_from_black(&analysis, MTM_VISION_NORMAL, 2, 0) > MTM_DIFFERENCE_INVISIBLE);
    assert_true(mtm_analysis_from_black(&analysis, MTM_VISION_NORMAL, 2, 1) < MTM_DIFFERENCE_INVISIBLE);
    mtm_analysis_free(&analysis);
    mtm_palette_free(&palette);
}

/* A gray under adapted eyes. */
static void adaptation_keeps_the_color_of_a_gray(void **state) {
    (void)state;
    mtm_palette palette = metameric_palette();
    palette.materials[0].reflectance = mtm_spectrum_constant(0.3);
    mtm_analysis plain = analyze(&palette);
    mtm_analysis adapted = analyze_adapted(&palette, 1);
    assert_true(mtm_analysis_difference(&plain, MTM_VISION_NORMAL, 0, 0, 0, 1) > 10);
    assert_true(mtm_analysis_difference(&adapted, MTM_VISION_NORMAL, 0, 0, 0, 1) < MTM_DIFFERENCE_MATCH);
    mtm_analysis_free(&plain);
    mtm_analysis_free(&adapted);
    mtm_palette_free(&palette);
}

static void color_blind_eyes_confuse_what_others_tell_apart(void **state) {
    (void)state;
    mtm_palette palette = parse("{\"materials\": [{\"name\": \"red\", \"srgb\": \"#c08070\"}, {\"name\": "
                                "\"green\", \"srgb\": \"#939170\"}],"
                                " \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}]}");
    mtm_analysis analysis = analyze(&palette);
    static const mtm_verdict expected[] = {MTM_VERDICT_DIFFER, MTM_VERDICT_SIMILAR, MTM_VERDICT_SIMILAR,
                                           MTM_VERDICT_DIFFER};
    for (int n = 0; n < MTM_VISION_COUNT; n++)
        assert_int_equal(mtm_verdict_of(mtm_analysis_difference(&analysis, (mtm_vision)n, 0, 0, 1, 0)),
                         expected[n]);
    mtm_analysis_free(&analysis);
    mtm_palette_free(&palette);
}

static void verdicts_change_at_their_thresholds(void **state) {
    (void)state;
    assert_int_equal(mtm_verdict_of(0), MTM_VERDICT_MATCH);
    assert_int_equal(mtm_verdict_of(1), MTM_VERDICT_MATCH);
    assert_int_equal(mtm_verdict_of(1.01), MTM_VERDICT_SIMILAR);
    assert_int_equal(mtm_verdict_of(5), MTM_VERDICT_SIMILAR);
    assert_int_equal(mtm_verdict_of(5.01), MTM_VERDICT_DIFFER);
}

/* 82 materials of one color are 3321 pairs that match; with 2 lights twice that. */
static void what_would_take_too_long_is_counted(void **state) {
    (void)state;
    mtm_palette small = metameric_palette();
    static mtm_material materials[MTM_MATERIALS_MAX];
    for (int i = 0; i < MTM_MATERIALS_MAX; i++) materials[i] = small.materials[0];
    const mtm_palette large = {MTM_MATERIALS_MAX, materials, small.light_count, small.lights};
    mtm_analysis analysis = analyze(&large);
    assert_int_equal(analysis.metamer_count, MTM_METAMERS_MAX);
    assert_int_equal(analysis.metamers_left_out, 2 * 3321 - MTM_METAMERS_MAX);
    mtm_analysis_free(&analysis);
    mtm_palette_free(&small);
}

/* Artificial spectra match as well, but no reflectance need have their color. */
static void what_no_reflectance_shows_has_no_largest_separation(void **state) {
    (void)state;
    mtm_palette palette = metameric_palette();
    palette.materials[0].reflectance = palette.materials[1].reflectance = mtm_spectrum_constant(1.5);
    mtm_analysis analysis = analyze(&palette);
    assert_int_equal(analysis.metamer_count, 2);
    assert_true(isnan(analysis.metamers[0].largest) && isnan(analysis.metamers[0].largest_smooth));
    mtm_analysis_free(&analysis);
    mtm_palette_free(&palette);
}

static void two_that_are_invisible_are_no_metamers(void **state) {
    (void)state;
    mtm_palette palette = metameric_palette();
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
        palette.lights[0].emission.value[k] = k >= 36 && k < 44;
        palette.materials[0].reflectance.value[k] = k < 30 ? 0.8 : 0;
        palette.materials[1].reflectance.value[k] = k > 50 ? 0.8 : 0;
    }
    mtm_analysis analysis = analyze(&palette);
    assert_true(mtm_analysis_difference(&analysis, MTM_VISION_NORMAL, 0, 0, 1, 0) <= MTM_DIFFERENCE_MATCH);
    assert_int_equal(analysis.metamer_count, 0);
    mtm_analysis_free(&analysis);
    mtm_palette_free(&palette);
}

static void an_empty_palette_has_an_empty_analysis(void **state) {
    (void)state;
    const mtm_palette empty = {0};
    mtm_analysis analysis = analyze(&empty);
    assert_int_equal(analysis.metamer_count, 0);
    mtm_analysis_free(&analysis);
    mtm_analysis_free(&analysis);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metamers_match_under_one_light_and_part_under_another),
        cmocka_unit_test(differences_are_those_of_picture_colors),
        cmocka_unit_test(a_material_without_light_to_send_back_is_invisible),
        cmocka_unit_test(adaptation_keeps_the_color_of_a_gray),
        cmocka_unit_test(color_blind_eyes_confuse_what_others_tell_apart),
        cmocka_unit_test(verdicts_change_at_their_thresholds),
        cmocka_unit_test(what_would_take_too_long_is_counted),
        cmocka_unit_test(what_no_reflectance_shows_has_no_largest_separation),
        cmocka_unit_test(two_that_are_invisible_are_no_metamers),
        cmocka_unit_test(an_empty_palette_has_an_empty_analysis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
