/* SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include "palette/goals_document.h"

/* Two designed materials, a given one, a given light and a designed one, in front of the goals. */
#define PALETTE                                                                                              \
    "\"materials\": [{\"name\": \"block\", \"design\": \"physical\"},"                                       \
    " {\"name\": \"ghost\", \"design\": \"artificial\"}, {\"name\": \"card\", \"srgb\": \"#c08040\"}],"      \
    " \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": \"lamp\", \"design\": "          \
    "\"physical\"}]"
#define ROW(content) "{" PALETTE ", \"goals\": [{" content "}]}"
#define CELL         "\"material\": \"block\", \"light\": \"day\", "
#define GOAL         "\"goals\": [{" CELL "\"black\": true}]"

static void defaults_are_those_of_the_manual(void **state) {
    (void)state;
    mtm_goals *goals = goals_parse("{" PALETTE ", " GOAL "}");
    assert_string_equal(goals->basis, "factors:7");
    assert_near(goals->tolerance, 1, 0);
    assert_string_equal(goals->folder, METAMER_SOURCE_DIR "/data/spectra");
    assert_int_equal(goals->palette.material_count, 3);
    assert_int_equal(goals->palette.light_count, 2);
    assert_int_equal(goals->search_count, 0);
    assert_true(goals->materials[0].is_designed && goals->materials[0].is_physical);
    assert_true(goals->materials[1].is_designed && !goals->materials[1].is_physical);
    assert_false(goals->materials[2].is_designed || goals->lights[0].is_designed);
    assert_true(goals->lights[1].is_designed && goals->lights[1].is_physical);
    assert_near(goals->materials[0].smoothness, 1, 0);
    assert_near(goals->materials[0].pull, 0, 0);
    assert_near(goals->palette.materials[0].reflectance.value[40], 0, 0); /* zeros until it is found */
    assert_true(goals->palette.lights[0].emission.value[40] > 0);
    mtm_goals_destroy(goals);
}

static void every_key_of_a_spectrum_is_read(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum expected;
    mtm_goals *goals = goals_parse(
        "{\"metamer\": 1, \"basis\": \"sharpened:5\", \"tolerance\": 0.5, \"smoothness\": 4, \"materials\": ["
        " {\"name\": \"a\", \"design\": \"physical\", \"smoothness\": 0.3},"
        " {\"name\": \"b\", \"design\": \"artificial\","
        "  \"near\": {\"spectrum\": \"reflectance_ces99.csv:CES05\", \"pull\": 2.5}},"
        " {\"name\": \"c\", \"spectrum\": \"reflectance_ces99.csv:CES05\"}],"
        " \"lights\": [{\"name\": \"l\", \"design\": \"artificial\", \"near\": {\"blackbody\": 2856}},"
        "  {\"name\": \"m\", \"illuminant\": \"E\", \"through\": [\"c\"]}],"
        " \"goals\": [{\"material\": \"a\", \"light\": \"m\", \"black\": true}]}");
    assert_string_equal(goals->basis, "sharpened:5");
    assert_near(goals->tolerance, 0.5, 0);
    assert_near(goals->materials[0].smoothness, 0.3, 0);
    assert_near(goals->materials[1].smoothness, 4, 0);
    assert_near(goals->materials[1].pull, 2.5, 0);
    assert_memory_equal(&goals->materials[1].anchor, &goals->palette.materials[2].reflectance,
                        sizeof expected);
    assert_ok(mtm_blackbody(2856, &expected, &error), error);
    assert_memory_equal(&goals->lights[0].anchor, &expected, sizeof expected);
    assert_near(goals->lights[0].pull, 1, 0);
    assert_near(goals->lights[0].smoothness, 4, 0);
    assert_false(goals->lights[0].is_physical);
    mtm_goals_destroy(goals);
}

static void bases_get_their_full_names(void **state) {
    (void)state;
    static const char *const names[][2] = {
        {"factors", "factors:7"},   {"factors:9", "factors:9"},     {"sharpened", "sharpened:7"},
        {"materials", "materials"}, {"wavelengths", "wavelengths"}, {"wavelengths:31", "wavelengths:31"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[1024];
        (void)snprintf(text, sizeof text, "{\"basis\": \"%s\", " PALETTE ", " GOAL "}", names[i][0]);
        mtm_goals *goals = goals_parse(text);
        assert_string_equal(goals->basis, names[i][1]);
        mtm_goals_destroy(goals);
    }
}

static void every_kind_of_goal_is_read(void **state) {
    (void)state;
    ASSERT_GOALS(
        "{" PALETTE ", \"goals\": ["
        "{\"material\": \"ghost\", \"light\": \"lamp\", \"srgb\": \"#6f9f6a\"},"
        "{\"material\": \"block\", \"light\": \"day\", \"black\": true},"
        "{\"material\": \"block\", \"light\": \"day\", \"same_as\": {\"material\": \"ghost\"}},"
        "{\"material\": \"block\", \"light\": \"day\", \"same_as\": {\"light\": \"lamp\"}},"
        "{\"material\": \"block\", \"light\": \"day\", \"same_as\": {\"material\": \"card\", \"light\": "
        "\"lamp\"}},"
        "{\"material\": \"card\", \"light\": \"lamp\", \"differs_from\": {\"light\": \"day\"}, \"by\": 20},"
        "{\"material\": \"card\", \"light\": \"lamp\", \"differs_from\": \"black\", \"by\": 100}]}",
        1, COLOR(1, 1, "#6f9f6a"), BLACK(0, 0), SAME(0, 0, 1, 0), SAME(0, 0, 0, 1), SAME(0, 0, 2, 1),
        DIFFERENT(2, 1, 2, 0, 20), VISIBLE(2, 1, 100));
    ASSERT_GOALS(ROW(CELL "\"black\": true, \"weight\": 0.25"), 0.25, BLACK(0, 0));
}

static void the_same_color_is_written_in_three_ways(void **state) {
    (void)state;
    mtm_goals *goals = goals_parse("{" PALETTE ", \"goals\": ["
                                   "{" CELL "\"xyz\": [0.2, 0.25, 0.3]},"
                                   "{" CELL "\"lab\": [50, -10, 20]}]}");
    assert_near(goals->goals[0].color.x, 0.2, 0);
    assert_near(goals->goals[0].color.y, 0.25, 0);
    assert_near(goals->goals[0].color.z, 0.3, 0);
    const mtm_lab lab = mtm_lab_from_xyz(goals->goals[1].color, mtm_white_d65());
    assert_near(lab.l, 50, 1e-12);
    assert_near(lab.a, -10, 1e-12);
    assert_near(lab.b, 20, 1e-12);
    mtm_goals_destroy(goals);
}

static void rows_may_say_the_same_twice(void **state) {
    (void)state;
    ASSERT_GOALS("{" PALETTE ", \"goals\": [{" CELL "\"black\": true}, {" CELL "\"black\": true}]}", 1,
                 BLACK(0, 0), BLACK(0, 0));
}

#define NEEDS_GOAL                                                                                           \
    "has no goal: one of \"srgb\", \"lab\", \"xyz\", \"black\", \"same_as\", \"differs_from\" is needed"
#define MATERIAL(content) "{\"materials\": [{\"name\": \"a\"" content "}], " GOAL "}"
#define LIGHT(content)                                                                                       \
    "{\"materials\": [{\"name\": \"a\", \"design\": \"physical\"}], \"lights\": [{\"name\": \"l\"" content   \
    "}], " GOAL "}"

static const goals_refusal bad_documents[] = {
    {"[]", "the document is [], must be an object"},
    {"{\"goal\": []}", "goal is not a known key; the nearest is \"goals\""},
    {"{\"metamer\": 2, " PALETTE ", " GOAL "}", "metamer is version 2, this program reads version 1"},
    {"{\"basis\": \"rgb\", " PALETTE ", " GOAL "}",
     "basis \"rgb\" holds colors under one light and cannot be relit, so that there is no cell to design"},
    {"{\"basis\": \"auto\", " PALETTE ", " GOAL "}",
     "basis \"auto\" depends on how many materials there are; name the one that the picture will have"},
    {"{\"basis\": \"factors:12\", " PALETTE ", " GOAL "}",
     "basis is not usable: basis \"factors:12\": the dimension of factors is 3 … 9"},
    {"{\"basis\": 7, " PALETTE ", " GOAL "}", "basis is 7, must be text in quotes, not empty"},
    {"{\"tolerance\": 0, " PALETTE ", " GOAL "}", "tolerance is 0, must be a number from 0.001 to 100"},
    {"{\"smoothness\": 1001, " PALETTE ", " GOAL "}",
     "smoothness is 1001, must be a number from 0.001 to 1000"},
    {"{" PALETTE "}", "goals is missing"},
    {"{" PALETTE ", \"goals\": {}}", "goals is {}, must be an array"},
    {"{" PALETTE ", \"goals\": []}", "goals asks for nothing: at least one goal is needed"},
    {"{" PALETTE ", \"goals\": [5]}", "goals[0] is 5, must be an object"},
    {"{\"materials\": [{\"name\": \"a\", \"srgb\": \"#ffffff\"}], \"lights\": [{\"name\": \"l\", "
     "\"illuminant\": "
     "\"E\"}], \"goals\": [{\"material\": \"a\", \"light\": \"l\", \"black\": true}]}",
     "the document designs nothing: no material and no light has the key \"design\""},
};

static const goals_refusal bad_spectra[] = {
    {"{\"materials\": 7, " GOAL "}", "materials is 7, must be an array"},
    {"{\"materials\": [7], " GOAL "}", "materials[0] is 7, must be an object"},
    {MATERIAL(", \"desing\": \"physical\""),
     "materials[0].desing is not a known key; the nearest is \"design\""},
    {MATERIAL(""),
     "materials[0] has no spectrum: \"design\", or one of \"spectrum\", \"illuminant\", \"blackbody\", "
     "\"daylight\", \"srgb\", \"values\" is needed"},
    {MATERIAL(", \"design\": \"real\""),
     "materials[0].design is \"real\", must be one of \"physical\", \"artificial\""},
    {MATERIAL(", \"design\": \"physical\", \"srgb\": \"#ffffff\""),
     "materials[0].srgb stands beside \"design\"; a spectrum is given or designed, and \"near\" says what a "
     "designed "
     "one is to be like"},
    {MATERIAL(", \"srgb\": \"#ffffff\", \"smoothness\": 1"),
     "materials[0].smoothness is for spectra with \"design\", this one is given"},
    {MATERIAL(", \"srgb\": \"#ffffff\", \"near\": {}"),
     "materials[0].near is for spectra with \"design\", this one is given"},
    {MATERIAL(", \"illuminant\": \"E\""),
     "materials[0].illuminant is a light's spectrum, a material needs a reflectance"},
    {MATERIAL(", \"design\": \"physical\", \"smoothness\": 0"),
     "materials[0].smoothness is 0, must be a number from 0.001 to 1000"},
    {MATERIAL(", \"design\": \"physical\", \"near\": \"t.csv:a\""),
     "materials[0].near is \"t.csv:a\", must be an object"},
    {MATERIAL(", \"design\": \"physical\", \"near\": {}"),
     "materials[0].near names no spectrum: one of \"spectrum\", \"illuminant\", \"blackbody\", \"daylight\", "
     "\"srgb\", \"values\" is needed"},
    {MATERIAL(", \"design\": \"physical\", \"near\": {\"srgb\": \"#ffffff\", \"pull\": 0}"),
     "materials[0].near.pull is 0, must be a number from 0.001 to 1000"},
    {MATERIAL(", \"design\": \"physical\", \"near\": {\"srgb\": \"#ffffff\", \"push\": 1}"),
     "materials[0].near.push is not a known key; the nearest is \"pull\""},
    {MATERIAL(", \"design\": \"physical\", \"near\": {\"blackbody\": 3000}"),
     "materials[0].near.blackbody is a light's spectrum, a material needs a reflectance"},
    {MATERIAL(", \"design\": \"physical\"}, {\"name\": \"a\", \"srgb\": \"#ffffff\""),
     "materials[1].name \"a\" is the name of an earlier material, too"},
    {"{\"materials\": [{\"design\": \"physical\"}], " GOAL "}", "materials[0].name is missing"},
    {LIGHT(", \"design\": \"physical\", \"through\": [\"a\"]"),
     "lights[0].through is for lights that are given, this one is designed"},
    {LIGHT(", \"illuminant\": \"E\", \"through\": [\"a\"]"),
     "lights[0].through holds \"a\", which is designed; filters must be given"},
    {LIGHT(", \"illuminant\": \"E\", \"through\": [\"b\"]"),
     "lights[0].through is \"b\", which is no material of the palette; the nearest is \"a\""},
    {LIGHT(", \"design\": \"physical\", \"near\": {\"illuminant\": \"D56\"}"),
     "lights[0].near.illuminant is not usable: unknown illuminant 'D56', did you mean 'D50'?"},
    {LIGHT(", \"design\": \"physical\", \"near\": {\"srgb\": \"#000000\"}"),
     "lights[0].near is no usable light: a light's luminance is 0, expected a positive finite number"},
    {LIGHT(", \"design\": \"physical\"}, {\"name\": \"l\", \"design\": \"physical\""),
     "lights[1].name \"l\" is the name of an earlier light, too"},
};

static const goals_refusal bad_cells[] = {
    {ROW("\"material\": \"block\", \"light\": \"day\", \"srbg\": \"#ffffff\""),
     "goals[0].srbg is not a known key; the nearest is \"srgb\""},
    {ROW("\"receipe\": \"figure 2\""), "goals[0].receipe is not a known key; the nearest is \"recipe\""},
    {ROW("\"light\": \"day\", \"black\": true"), "goals[0].material is missing"},
    {ROW("\"material\": \"block\", \"black\": true"), "goals[0].light is missing"},
    {ROW("\"material\": \"blok\", \"light\": \"day\", \"black\": true"),
     "goals[0].material is \"blok\", which is no material of the palette; the nearest is \"block\""},
    {ROW("\"material\": \"block\", \"light\": \"days\", \"black\": true"),
     "goals[0].light is \"days\", which is no light of the palette; the nearest is \"day\""},
    {ROW("\"material\": 3, \"light\": \"day\", \"black\": true"),
     "goals[0].material is 3, must be text in quotes, not empty"},
    {"{" GOAL "}", "goals[0].material is \"block\", but the palette has no material"},
    {ROW("\"material\": \"block\", \"light\": \"day\""), "goals[0] " NEEDS_GOAL},
    {ROW(CELL "\"weight\": 2"), "goals[0] " NEEDS_GOAL},
    {ROW(CELL "\"black\": true, \"srgb\": \"#000000\""),
     "goals[0].black stands beside \"srgb\"; a row has exactly one goal"},
    {ROW(CELL "\"srgb\": \"green\""), "goals[0].srgb is no color: color 'green', expected the form #rrggbb"},
    {ROW(CELL "\"srgb\": [1, 0, 0]"), "goals[0].srgb is [1,0,0], must be a color, \"#rrggbb\""},
    {ROW(CELL "\"lab\": [50, 0]"), "goals[0].lab is [50,0], must be an array of 3 numbers"},
    {ROW(CELL "\"lab\": [101, 0, 0]"), "goals[0].lab has a lightness of 101, must be 0 to 100"},
    {ROW(CELL "\"lab\": [-1, 0, 0]"), "goals[0].lab has a lightness of -1, must be 0 to 100"},
    {ROW(CELL "\"lab\": [50, 300, 0]"), "goals[0].lab[1] is 300, must be a number from -200 to 200"},
    {ROW(CELL "\"lab\": [20, 0, 90]"),
     "goals[0].lab is [20, 0, 90], more colorful than any light: its X is 0.0284, its Z -0.0388"},
    {ROW(CELL "\"xyz\": [19, 20, 21]"),
     "goals[0].xyz has 19; white has Y = 1 here, values to 100 must be divided by 100"},
    {ROW(CELL "\"xyz\": [0.1, -0.1, 0]"), "goals[0].xyz[1] is -0.1, must be a number, 0 or more"},
    {ROW(CELL "\"black\": false"),
     "goals[0].black is false; \"differs_from\": \"black\" asks for what is not black"},
    {ROW(CELL "\"black\": 1"), "goals[0].black is 1, must be true or false"},
    {ROW(CELL "\"same_as\": {}"),
     "goals[0].same_as is the cell itself; it must name another material or light"},
    {ROW(CELL "\"same_as\": {\"light\": \"day\"}"),
     "goals[0].same_as is the cell itself; it must name another material or light"},
    {ROW(CELL "\"same_as\": \"black\""), "goals[0].same_as is \"black\", must be an object"},
    {ROW(CELL "\"same_as\": {\"lihgt\": \"day\"}"),
     "goals[0].same_as.lihgt is not a known key; the nearest is \"light\""},
    {ROW(CELL "\"same_as\": {\"light\": \"lamb\"}"),
     "goals[0].same_as.light is \"lamb\", which is no light of the palette; the nearest is \"lamp\""},
    {ROW(CELL "\"same_as\": {\"light\": \"lamp\"}, \"by\": 5"),
     "goals[0].by is for \"differs_from\", this row has \"same_as\""},
    {ROW(CELL "\"differs_from\": \"white\", \"by\": 5"),
     "goals[0].differs_from is \"white\", must be \"black\" or an object with a material or a light"},
    {ROW(CELL "\"differs_from\": \"black\""), "goals[0].by is missing"},
    {ROW(CELL "\"differs_from\": \"black\", \"by\": 0"),
     "goals[0].by is 0, must be a number from 0.001 to 100"},
    {ROW(CELL "\"differs_from\": {\"material\": \"block\"}, \"by\": 5"),
     "goals[0].differs_from is the cell itself; it must name another material or light"},
    {ROW(CELL "\"black\": true, \"weight\": 0"), "goals[0].weight is 0, must be a number from 0.001 to 1000"},
};

static void assert_all_refused(const goals_refusal *refusals, size_t count) {
    for (size_t i = 0; i < count; i++) goals_assert_refused(refusals[i].text, refusals[i].message);
}

static void bad_documents_are_refused_with_key_and_value(void **state) {
    (void)state;
    assert_all_refused(bad_documents, sizeof bad_documents / sizeof *bad_documents);
}

static void bad_spectra_are_refused_with_key_and_value(void **state) {
    (void)state;
    assert_all_refused(bad_spectra, sizeof bad_spectra / sizeof *bad_spectra);
}

static void bad_cells_are_refused_with_key_and_value(void **state) {
    (void)state;
    assert_all_refused(bad_cells, sizeof bad_cells / sizeof *bad_cells);
}

/* `begin`, then `count` times `element` with its index for %d, then `end`. */
static const char *repeat(const char *begin, const char *element, int count, const char *end) {
    static char text[1 << 16];
    size_t length = (size_t)snprintf(text, sizeof text, "%s", begin);
    for (int i = 0; i < count; i++) {
        char one[256];
        const char *place = strstr(element, "%d");
        const int before = place == NULL ? (int)strlen(element) : (int)(place - element);
        const int after = place == NULL ? 0 : snprintf(one, sizeof one, "%d%s", i, place + 2);
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%.*s%s", i > 0 ? "," : "", before,
                                   element, after > 0 ? one : "");
    }
    (void)snprintf(text + length, sizeof text - length, "%s", end);
    return text;
}

static void limits_hold_and_one_more_is_refused(void **state) {
    (void)state;
    static const char designed[] = "{\"name\": \"m%d\", \"design\": \"physical\"}";
    static const char given[] = "{\"name\": \"m%d\", \"srgb\": \"#808080\"}";
    static const char end[] = "], \"lights\": [{\"name\": \"day\", \"illuminant\": \"E\"}],"
                              " \"goals\": [{\"material\": \"m0\", \"light\": \"day\", \"black\": true}]}";
    static const char row[] = "{" CELL "\"differs_from\": \"black\", \"by\": 20}";
    mtm_goals_destroy(goals_parse(repeat("{\"materials\": [", designed, MTM_DESIGNED_MAX, end)));
    goals_assert_refused(repeat("{\"materials\": [", designed, MTM_DESIGNED_MAX + 1, end),
                         "materials[32] makes one designed spectrum more than the 32 that are allowed");
    goals_assert_refused(repeat("{\"materials\": [", given, MTM_MATERIALS_MAX + 1, end),
                         "materials has 83 elements, at most 82 are allowed");
    goals_assert_refused(repeat("{\"lights\": [", given, MTM_LIGHTS_MAX + 1, "], \"goals\": []}"),
                         "lights has 257 elements, at most 256 are allowed");
    mtm_goals_destroy(goals_parse(repeat("{" PALETTE ", \"goals\": [", row, MTM_GOALS_MAX, "]}")));
    goals_assert_refused(repeat("{" PALETTE ", \"goals\": [", row, MTM_GOALS_MAX + 1, "]}"),
                         "goals has 257 elements, at most 256 are allowed");
}

static void an_embedded_document_names_no_file(void **state) {
    (void)state;
    static const char text[] =
        MATERIAL(", \"design\": \"physical\", \"near\": {\"spectrum\": \"reflectance_ces99.csv:CES05\"}");
    mtm_error error;
    mtm_goals *goals = NULL;
    assert_fails(mtm_goals_parse("test.json", text, NULL, &goals, &error), MTM_FORMAT, error,
                 "materials[0].near.spectrum names a file, but an embedded document stands alone");
    assert_ok(mtm_goals_parse("test.json", "{" PALETTE ", " GOAL "}", NULL, &goals, &error), error);
    assert_null(goals->folder);
    mtm_goals_destroy(goals);
}

static void what_is_wrong_with_a_file_keeps_its_status(void **state) {
    (void)state;
    mtm_error error;
    mtm_goals *goals = NULL;
    assert_fails(mtm_goals_read("no such goals.json", &goals, &error), MTM_IO, error, "no such goals.json");
    assert_fails(
        mtm_goals_parse("test.json",
                        MATERIAL(", \"design\": \"physical\", \"near\": {\"spectrum\": \"none.csv:a\"}"),
                        METAMER_SOURCE_DIR, &goals, &error),
        MTM_IO, error, "materials[0].near.spectrum is not usable: " METAMER_SOURCE_DIR "/none.csv");
    assert_fails(mtm_goals_parse("test.json", "{\"goals\": [", NULL, &goals, &error), MTM_FORMAT, error,
                 "test.json:1");
    assert_null(goals);
    mtm_goals_destroy(NULL);
}

static void tables_are_looked_for_beside_the_document(void **state) {
    (void)state;
    mtm_error error;
    mtm_goals *goals = NULL;
    FILE *file = fopen("goals_beside.json", "w");
    assert_non_null(file);
    (void)fputs("{\"materials\": [{\"name\": \"a\", \"design\": \"physical\","
                " \"near\": {\"spectrum\": \"goals_beside.csv:x\"}}],"
                " \"lights\": [{\"name\": \"l\", \"illuminant\": \"E\"}],"
                " \"goals\": [{\"material\": \"a\", \"light\": \"l\", \"black\": true}]}",
                file);
    assert_int_equal(fclose(file), 0);
    file = fopen("goals_beside.csv", "w");
    assert_non_null(file);
    (void)fputs("wavelength_nm,x\n380,0.25\n780,0.25\n", file);
    assert_int_equal(fclose(file), 0);
    assert_ok(mtm_goals_read("goals_beside.json", &goals, &error), error);
    assert_string_equal(goals->folder, ".");
    assert_near(goals->materials[0].anchor.value[7], 0.25, 0);
    mtm_goals_destroy(goals);
    (void)remove("goals_beside.json");
    (void)remove("goals_beside.csv");
}

/* More of them only make the search long: nine rows for one cell, of which any two contradict each other. */
static void a_cell_has_few_wishes(void **state) {
    (void)state;
    mtm_error error;
    mtm_goals *goals = NULL;
    char text[2048] =
        "{\"materials\": [{\"name\": \"a\", \"design\": \"physical\"}], \"lights\": [{\"name\": \"l\", "
        "\"illuminant\": \"D65\"}], \"goals\": [";
    for (int i = 0; i < 9; i++)
        (void)snprintf(text + strlen(text), sizeof text - strlen(text),
                       "%s{\"material\": \"a\", \"light\": \"l\", \"srgb\": \"#80808%d\"}",
                       i == 0 ? "" : ", ", i);
    (void)snprintf(text + strlen(text), sizeof text - strlen(text), "]}");
    assert_fails(mtm_goals_parse("t.json", text, NULL, &goals, &error), MTM_FORMAT, error,
                 "goals[8] fixes the color of a cell that 8 goals fix already");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_those_of_the_manual),
        cmocka_unit_test(every_key_of_a_spectrum_is_read),
        cmocka_unit_test(bases_get_their_full_names),
        cmocka_unit_test(every_kind_of_goal_is_read),
        cmocka_unit_test(the_same_color_is_written_in_three_ways),
        cmocka_unit_test(rows_may_say_the_same_twice),
        cmocka_unit_test(bad_documents_are_refused_with_key_and_value),
        cmocka_unit_test(bad_spectra_are_refused_with_key_and_value),
        cmocka_unit_test(bad_cells_are_refused_with_key_and_value),
        cmocka_unit_test(limits_hold_and_one_more_is_refused),
        cmocka_unit_test(an_embedded_document_names_no_file),
        cmocka_unit_test(what_is_wrong_with_a_file_keeps_its_status),
        cmocka_unit_test(tables_are_looked_for_beside_the_document),
        cmocka_unit_test(a_cell_has_few_wishes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
