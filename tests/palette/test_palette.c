/* SPDX-License-Identifier: BSD-3-Clause */
#include "metamer/palette.h"

#include <stdio.h>

#include "fixture.h"

static mtm_palette parse(const char *text) {
    mtm_error error;
    mtm_palette palette;
    assert_ok(mtm_palette_parse("test.json", text, METAMER_SOURCE_DIR "/data/spectra", &palette, &error),
              error);
    return palette;
}

static void assert_refused(const char *text, const char *message) {
    mtm_error error;
    mtm_palette palette;
    assert_fails(mtm_palette_parse("test.json", text, ".", &palette, &error), MTM_FORMAT, error, message);
    if (strncmp(error.message, "test.json", 9) != 0) fail_msg("'%s' does not name the file", error.message);
    assert_null(palette.materials);
}

static void every_source_of_a_spectrum_is_read(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum expected;
    mtm_palette palette = parse(
        "{\"materials\": [{\"name\": \"card\", \"srgb\": \"#c08040\"},"
        " {\"name\": \"patch\", \"spectrum\": \"reflectance_colorchecker_ohta.csv:foliage\"}],"
        " \"lights\": [{\"name\": \"day\", \"daylight\": 6504}, {\"name\": \"lamp\", \"blackbody\": 2856},"
        " {\"name\": \"tube\", \"illuminant\": \"fl11\"}, {\"name\": \"blue\", \"srgb\": \"#4060ff\"},"
        " {\"name\": \"green\", \"illuminant\": \"E\", \"through\": [\"patch\", \"card\"]}]}");
    assert_int_equal(palette.material_count, 2);
    assert_int_equal(palette.light_count, 5);
    assert_ok(mtm_blackbody(2856, &expected, &error), error);
    assert_memory_equal(&palette.lights[1].emission, &expected, sizeof expected);
    expected = mtm_spectrum_multiply(&palette.materials[0].reflectance, &palette.materials[1].reflectance);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        assert_near(palette.lights[4].emission.value[i] / palette.lights[4].emission.value[0],
                    expected.value[i] / expected.value[0], 1e-12);
    assert_int_equal(mtm_palette_find_light(&palette, "tube"), 2);
    assert_int_equal(mtm_palette_find_material(&palette, "tube"), -1);
    mtm_palette_free(&palette);
}

static void a_material_of_a_color_shows_it_under_daylight(void **state) {
    (void)state;
    mtm_palette palette = parse("{\"materials\": [{\"name\": \"card\", \"srgb\": \"#c08040\"}],"
                                " \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"},"
                                " {\"name\": \"orange\", \"srgb\": \"#c08040\"}]}");
    const mtm_spectrum white = mtm_spectrum_constant(1);
    const mtm_illumination day = fixture_illumination("D65");
    const mtm_rgb card = mtm_illuminate(&day, &palette.materials[0].reflectance);
    assert_near(mtm_srgb_encode(card.r), 0xc0 / 255.0, 1e-4);
    assert_near(mtm_srgb_encode(card.g), 0x80 / 255.0, 1e-4);
    assert_near(mtm_srgb_encode(card.b), 0x40 / 255.0, 1e-4);
    /* A light of that color has its chromaticity on white, at Y = 1. */
    const mtm_spectrum mixed = mtm_palette_mix(&palette, (const double[2]){0, 1}, 1);
    const mtm_illumination orange = mtm_illumination_of(&mixed, &day.observer, 0);
    const mtm_rgb shown = mtm_illuminate(&orange, &white);
    assert_near(shown.r / shown.g, card.r / card.g, 1e-3);
    assert_near(shown.b / shown.g, card.b / card.g, 1e-3);
    mtm_palette_free(&palette);
}

static void written_palettes_read_back_bit_for_bit(void **state) {
    (void)state;
    mtm_error error;
    mtm_palette palette;
    mtm_palette again;
    assert_ok(mtm_palette_defaults(&palette, &error), error);
    char *text = mtm_palette_format(&palette);
    assert_non_null(text);
    assert_ok(mtm_palette_parse("again", text, ".", &again, &error), error);
    assert_int_equal(again.material_count, 3);
    assert_int_equal(again.light_count, 3);
    for (int i = 0; i < 3; i++) {
        assert_string_equal(again.materials[i].name, palette.materials[i].name);
        assert_memory_equal(&again.materials[i].reflectance, &palette.materials[i].reflectance,
                            sizeof(mtm_spectrum));
        assert_memory_equal(&again.lights[i].emission, &palette.lights[i].emission, sizeof(mtm_spectrum));
    }
    char *second = mtm_palette_format(&again);
    assert_string_equal(text, second);
    mtm_text_free(second);
    mtm_text_free(text);
    mtm_palette_free(&palette);
    mtm_palette_free(&again);
}

static void a_mix_is_the_weighted_sum_of_equally_bright_lights(void **state) {
    (void)state;
    mtm_error error;
    mtm_palette palette;
    mtm_observer observer;
    assert_ok(mtm_palette_defaults(&palette, &error), error);
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    const mtm_spectrum mixed = mtm_palette_mix(&palette, (const double[3]){0.5, 0, 0.25}, 2);
    assert_near(mtm_xyz_of(&mixed, &observer).y, 1.5, 1e-12); /* weights are not renormalised */
    const mtm_spectrum dark = mtm_palette_mix(&palette, (const double[3]){0, 0, 0}, 1);
    assert_near(mtm_xyz_of(&dark, &observer).y, 0, 0);
    mtm_palette_free(&palette);
}

static void overriding_goes_by_name_and_keeps_the_order(void **state) {
    (void)state;
    mtm_error error;
    mtm_palette palette;
    assert_ok(mtm_palette_defaults(&palette, &error), error);
    mtm_palette other = parse("{\"materials\": [{\"name\": \"stranger\", \"srgb\": \"#ffffff\"},"
                              " {\"name\": \"dense\", \"srgb\": \"#102030\"}],"
                              " \"lights\": [{\"name\": \"new\", \"illuminant\": \"C\"},"
                              " {\"name\": \"lamp\", \"illuminant\": \"E\"}]}");
    assert_ok(mtm_palette_override(&palette, &other, &error), error);
    assert_int_equal(palette.material_count, 3);
    assert_memory_equal(&palette.materials[2], &other.materials[1], sizeof(mtm_material));
    assert_int_equal(palette.light_count, 4);
    assert_memory_equal(&palette.lights[1], &other.lights[1], sizeof(mtm_light));
    assert_string_equal(palette.lights[3].name, "new");
    mtm_palette_free(&other);
    other = parse("{\"materials\": [{\"name\": \"stranger\", \"srgb\": \"#ffffff\"}]}");
    assert_fails(mtm_palette_override(&palette, &other, &error), MTM_ARGUMENT, error,
                 "no material that the old one knows");
    mtm_palette_free(&other);
    mtm_palette_free(&palette);
}

static void bad_palettes_are_refused_with_key_and_value(void **state) {
    (void)state;
    assert_refused("[]", "must be an object");
    assert_refused("{\"material\": []}", "the nearest is \"materials\"");
    assert_refused("{\"metamer\": 2}", "version 2");
    assert_refused("{\"materials\": [{\"srgb\": \"#fff\"}]}", "materials[0].name is missing");
    assert_refused("{\"materials\": [{\"name\": \"a\"}]}", "names no spectrum");
    assert_refused("{\"materials\": [{\"name\": \"a\", \"srgb\": \"#ffffff\", \"values\": []}]}",
                   "exactly one");
    assert_refused("{\"materials\": [{\"name\": \"a\", \"srgb\": \"red\"}]}", "red");
    assert_refused("{\"materials\": [{\"name\": \"a\", \"values\": [1, 2]}]}", "81 numbers");
    assert_refused("{\"materials\": [{\"name\": \"a\", \"illuminant\": \"E\"}]}", "needs a reflectance");
    assert_refused("{\"materials\": [{\"name\": \"a\", \"srgb\": \"#ffffff\"}, {\"name\": \"a\", \"srgb\": "
                   "\"#000000\"}]}",
                   "materials[1].name");
    assert_refused("{\"lights\": [{\"name\": \"l\", \"illuminant\": \"D56\"}]}", "D5");
    assert_refused("{\"lights\": [{\"name\": \"l\", \"blackbody\": 3}]}", "lights[0].blackbody");
    assert_refused("{\"lights\": [{\"name\": \"l\", \"daylight\": 1e9}]}", "lights[0].daylight");
    assert_refused("{\"lights\": [{\"name\": \"l\", \"srgb\": \"#000000\"}]}", "lights[0]");
    assert_refused("{\"lights\": [{\"name\": \"l\", \"illuminant\": \"E\", \"through\": [\"glass\"]}]}",
                   "glass");
    assert_refused("{\"lights\": [{\"name\": \"l\", \"illuminant\": \"E\", \"through\": [5]}]}", "holds 5");
    assert_refused("{\"lights\": [{\"name\": \"l\", \"illuminant\": \"E\", \"through\": [\"x\"]}]}",
                   "the palette has no material");
    char huge[81 * 5 + 80] = "{\"materials\": [{\"name\": \"a\", \"values\": [1e39";
    for (int i = 0; i < 80; i++) (void)strcat(huge, ",0");
    (void)strcat(huge, "]}]}");
    assert_refused(huge, "1e+39 at 380 nm");
    assert_refused("{\"materials\": 7}", "must be an array");
    assert_refused("{\"materials\": [", "test.json:1");
}

static void a_missing_file_is_an_io_failure_and_an_embedded_palette_names_none(void **state) {
    (void)state;
    static const char text[] = "{\"materials\": [{\"name\": \"a\", \"spectrum\": \"none.csv:x\"}]}";
    mtm_error error;
    mtm_palette palette;
    assert_fails(mtm_palette_parse("test.json", text, ".", &palette, &error), MTM_IO, error, "none.csv");
    assert_fails(mtm_palette_parse("test.json", text, NULL, &palette, &error), MTM_FORMAT, error,
                 "stands alone");
}

static void a_name_of_64_bytes_is_too_long(void **state) {
    (void)state;
    char name[66] = "";
    char text[256];
    memset(name, 'n', 64);
    (void)snprintf(text, sizeof text, "{\"materials\": [{\"name\": \"%s\", \"srgb\": \"#ffffff\"}]}", name);
    assert_refused(text, "64 bytes");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_source_of_a_spectrum_is_read),
        cmocka_unit_test(a_material_of_a_color_shows_it_under_daylight),
        cmocka_unit_test(written_palettes_read_back_bit_for_bit),
        cmocka_unit_test(a_mix_is_the_weighted_sum_of_equally_bright_lights),
        cmocka_unit_test(overriding_goes_by_name_and_keeps_the_order),
        cmocka_unit_test(bad_palettes_are_refused_with_key_and_value),
        cmocka_unit_test(a_missing_file_is_an_io_failure_and_an_embedded_palette_names_none),
        cmocka_unit_test(a_name_of_64_bytes_is_too_long),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
