/* SPDX-License-Identifier: BSD-3-Clause
 * Every recipe, goal by goal. Materials and lights are brought in the order in which the recipe's lists name them. */
#include <stdio.h>

#include "palette/goals_document.h"

#define RECIPE(content) "{\"goals\": [{\"recipe\": " content "}]}"

static void metamers_part_under_other_lights(void **state) {
    (void)state;
    ASSERT_GOALS(RECIPE("\"metamers\", \"materials\": [\"a\", \"b\", \"c\"], \"under\": [\"u\", \"v\"], "
                        "\"apart\": [\"x\", \"y\"]"),
                 1, SAME(1, 0, 0, 0), SAME(2, 0, 0, 0), SAME(1, 1, 0, 1), SAME(2, 1, 0, 1),
                 DIFFERENT(1, 2, 0, 2, 15), DIFFERENT(2, 2, 1, 2, 15), DIFFERENT(1, 3, 0, 3, 15),
                 DIFFERENT(2, 3, 1, 3, 15));
    ASSERT_GOALS(RECIPE("\"metamers\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\", \"v\"], "
                        "\"apart\": [\"x\"], \"by\": 30, \"srgb\": \"#808080\", \"weight\": 2"),
                 2, COLOR(0, 0, "#808080"), SAME(1, 0, 0, 0), SAME(1, 1, 0, 1), DIFFERENT(1, 2, 0, 2, 30));
    ASSERT_GOALS(RECIPE("\"metamers\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\", \"v\"], "
                        "\"apart\": [\"x\"], \"colors\": [\"#808080\", \"#ff8000\"]"),
                 1, COLOR(0, 0, "#808080"), SAME(1, 0, 0, 0), COLOR(0, 1, "#ff8000"), SAME(1, 1, 0, 1),
                 DIFFERENT(1, 2, 0, 2, 15));
}

static void blacks_may_be_visible_elsewhere(void **state) {
    (void)state;
    ASSERT_GOALS(RECIPE("\"black\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\", \"v\"]"), 1,
                 BLACK(0, 0), BLACK(0, 1), BLACK(1, 0), BLACK(1, 1));
    ASSERT_GOALS(RECIPE("\"black\", \"materials\": [\"a\"], \"under\": [\"u\"], \"visible\": [\"x\", \"y\"]"),
                 1, BLACK(0, 0), VISIBLE(0, 1, 30), VISIBLE(0, 2, 30));
    ASSERT_GOALS(
        RECIPE("\"black\", \"materials\": [\"a\"], \"under\": [\"u\"], \"visible\": [\"x\"], \"by\": 5, "
               "\"weight\": 0.5"),
        0.5, BLACK(0, 0), VISIBLE(0, 1, 5));
}

static void constant_materials_keep_their_color(void **state) {
    (void)state;
    ASSERT_GOALS(RECIPE("\"constant\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\", \"v\", \"w\"]"), 1,
                 SAME(0, 1, 0, 0), SAME(0, 2, 0, 0), SAME(1, 1, 1, 0), SAME(1, 2, 1, 0));
    ASSERT_GOALS(RECIPE("\"constant\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\", \"v\"], \"srgb\": "
                        "\"#405060\", \"weight\": 3"),
                 3, COLOR(0, 0, "#405060"), SAME(0, 1, 0, 0), COLOR(1, 0, "#405060"), SAME(1, 1, 1, 0));
    ASSERT_GOALS(RECIPE("\"constant\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\", \"v\"], \"colors\": "
                        "[\"#405060\", \"#a0b0c0\"]"),
                 1, COLOR(0, 0, "#405060"), SAME(0, 1, 0, 0), COLOR(1, 0, "#a0b0c0"), SAME(1, 1, 1, 0));
}

static void each_light_shows_one_material(void **state) {
    (void)state;
    ASSERT_GOALS(
        RECIPE("\"one_light_per_material\", \"materials\": [\"a\", \"b\"], \"lights\": [\"u\", \"v\"]"), 1,
        VISIBLE(0, 0, 40), BLACK(1, 0), BLACK(0, 1), VISIBLE(1, 1, 40));
    ASSERT_GOALS(
        RECIPE("\"one_light_per_material\", \"materials\": [\"a\", \"b\"], \"lights\": [\"u\", \"v\"], "
               "\"by\": 10, \"weight\": 4"),
        4, VISIBLE(0, 0, 10), BLACK(1, 0), BLACK(0, 1), VISIBLE(1, 1, 10));
    ASSERT_GOALS(
        RECIPE("\"one_light_per_material\", \"materials\": [\"a\", \"b\"], \"lights\": [\"u\", \"v\"], "
               "\"colors\": [\"#ff0000\", \"#00ff00\"]"),
        1, COLOR(0, 0, "#ff0000"), BLACK(1, 0), BLACK(0, 1), COLOR(1, 1, "#00ff00"));
}

static void figure_2_is_the_engine(void **state) {
    (void)state;
    mtm_goals *goals = goals_parse("{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 2\"}]}");
    static const char *const materials[] = {"smoke", "block", "inner"};
    static const char *const lights[] = {"light 1", "light 2", "light 3"};
    assert_int_equal(goals->palette.material_count, 3);
    assert_int_equal(goals->palette.light_count, 3);
    for (int i = 0; i < 3; i++) {
        assert_string_equal(goals->palette.materials[i].name, materials[i]);
        assert_string_equal(goals->palette.lights[i].name, lights[i]);
        assert_true(goals->materials[i].is_designed && goals->materials[i].is_physical);
        assert_true(goals->lights[i].is_designed && goals->lights[i].is_physical);
        assert_near(goals->materials[i].smoothness, 1, 0);
    }
    mtm_goals_destroy(goals);
    ASSERT_GOALS(RECIPE("\"figure 2\""), 1, COLOR(1, 0, "#6f9f6a"), SAME(2, 0, 1, 0), SAME(1, 1, 1, 0),
                 COLOR(2, 1, "#d08040"), BLACK(0, 0), BLACK(0, 1), COLOR(0, 2, "#8a70c0"));
    ASSERT_GOALS(
        RECIPE("\"figure 2\", \"weight\": 2, \"colors\": {\"inner\": \"#ff0000\", \"smoke\": \"#0000ff\"}"),
        2, COLOR(1, 0, "#6f9f6a"), SAME(2, 0, 1, 0), SAME(1, 1, 1, 0), COLOR(2, 1, "#ff0000"), BLACK(0, 0),
        BLACK(0, 1), COLOR(0, 2, "#0000ff"));
}

static void figure_5_takes_the_cloud_away(void **state) {
    (void)state;
    ASSERT_GOALS(RECIPE("\"figure 5\""), 1, COLOR(0, 0, "#d8d8d8"), BLACK(0, 1), COLOR(1, 0, "#e07a2f"),
                 SAME(1, 1, 1, 0));
    const mtm_goals *goals = goals_parse(RECIPE("\"figure 5\""));
    const mtm_lab cloud = mtm_lab_from_xyz(goals->goals[0].color, mtm_white_d65());
    assert_true(hypot(cloud.a, cloud.b) < 5); /* white */
    assert_string_equal(goals->palette.materials[0].name, "cloud");
    assert_string_equal(goals->palette.materials[1].name, "core");
    assert_string_equal(goals->palette.lights[1].name, "light 2");
    mtm_goals_destroy((mtm_goals *)goals);
}

static void figure_6_shows_three_materials_one_by_one(void **state) {
    (void)state;
    ASSERT_GOALS(RECIPE("\"figure 6\", \"colors\": {\"brain\": \"#0000ff\"}"), 1, COLOR(0, 0, "#c98f6b"),
                 BLACK(1, 0), BLACK(2, 0), BLACK(0, 1), COLOR(1, 1, "#0000ff"), BLACK(2, 1), BLACK(0, 2),
                 BLACK(1, 2), COLOR(2, 2, "#e6d9a8"));
    mtm_goals *goals = goals_parse(RECIPE("\"figure 6\""));
    assert_string_equal(goals->palette.materials[2].name, "fat");
    assert_string_equal(goals->palette.lights[2].name, "fat light");
    mtm_goals_destroy(goals);
}

static void figure_7_parts_the_gel_from_the_flesh(void **state) {
    (void)state;
    ASSERT_GOALS(RECIPE("\"figure 7\""), 1, COLOR(0, 0, "#b8584a"), SAME(1, 0, 0, 0), SAME(0, 1, 0, 0),
                 COLOR(1, 1, "#a8964c"));
    mtm_goals *goals = goals_parse(RECIPE("\"figure 7\""));
    assert_string_equal(goals->palette.materials[1].name, "gel");
    const mtm_lab flesh = mtm_lab_from_xyz(goals->goals[0].color, mtm_white_d65());
    const mtm_lab gel = mtm_lab_from_xyz(goals->goals[3].color, mtm_white_d65());
    assert_true(mtm_ciede2000(flesh, gel) > 20); /* clearly */
    mtm_goals_destroy(goals);
}

static void a_recipe_takes_the_names_it_is_given(void **state) {
    (void)state;
    /* Given and designed ones are mixed, and the order is the recipe's, not the palette's. */
    static const char text[] = "{\"materials\": [{\"name\": \"card\", \"srgb\": \"#c08040\"}, {\"name\": "
                               "\"jelly\", \"design\": \"artificial\"}],"
                               " \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": "
                               "\"lamp\", \"illuminant\": \"A\"}],"
                               " \"goals\": [{\"recipe\": \"figure 7\", \"materials\": [\"jelly\", "
                               "\"card\"], \"lights\": [\"lamp\", \"day\"],"
                               "  \"colors\": {\"flesh\": \"#102030\"}}]}";
    ASSERT_GOALS(text, 1, COLOR(1, 1, "#102030"), SAME(0, 1, 1, 1), SAME(1, 0, 1, 1), COLOR(0, 0, "#a8964c"));
}

static void only_what_the_document_does_not_list_is_brought(void **state) {
    (void)state;
    mtm_goals *goals =
        goals_parse("{\"smoothness\": 5, \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"},"
                    " {\"name\": \"lamp\", \"illuminant\": \"A\"}], \"goals\": ["
                    " {\"material\": \"b\", \"light\": \"lamp\", \"srgb\": \"#ffffff\"},"
                    " {\"recipe\": \"constant\", \"materials\": [\"a\"], \"under\": [\"day\", \"lamp\"]},"
                    " {\"recipe\": \"metamers\", \"materials\": [\"a\", \"b\"], \"under\": [\"day\"],"
                    "  \"apart\": [\"lamp\"]}]}");
    assert_int_equal(goals->palette.material_count, 2);
    assert_int_equal(goals->palette.light_count, 2);
    assert_string_equal(goals->palette.materials[1].name, "b");
    assert_near(goals->materials[1].smoothness, 5, 0);
    assert_false(goals->lights[0].is_designed);
    /* In the order of the rows, though the first names what the last brings. */
    assert_goals(goals, 4,
                 (const expected_goal[]){COLOR(1, 1, "#ffffff"), SAME(0, 1, 0, 0), SAME(1, 0, 0, 0),
                                         DIFFERENT(1, 1, 0, 1, 15)},
                 1);
    mtm_goals_destroy(goals);
}

static void a_library_is_searched_for_materials(void **state) {
    (void)state;
    mtm_goals *goals =
        goals_parse("{\"goals\": [{\"recipe\": \"figure 6\"},"
                    " {\"recipe\": \"from_library\", \"materials\": [\"fat\", \"skin\"],"
                    "  \"tables\": [\"reflectance_ces99.csv\", \"../spectra/reflectance_vrhel170.csv\"]},"
                    " {\"recipe\": \"from_library\", \"materials\": [\"brain\"], \"tables\": "
                    "[\"reflectance_ces99.csv\"]}]}");
    assert_int_equal(goals->goal_count, 9); /* none of its own */
    assert_int_equal(goals->search_count, 2);
    const mtm_library_search *search = &goals->searches[0];
    assert_int_equal(search->material_count, 2);
    assert_int_equal(search->materials[0], 2);
    assert_int_equal(search->materials[1], 0);
    assert_int_equal(search->table_count, 2);
    assert_string_equal(search->tables[0], "reflectance_ces99.csv");
    assert_string_equal(search->tables[1], "../spectra/reflectance_vrhel170.csv");
    assert_int_equal(goals->searches[1].materials[0], 1);
    mtm_goals_destroy(goals);
}

#define METAMERS(content)                                                                                    \
    RECIPE("\"metamers\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\"], \"apart\": [\"v\"]" content)
#define EACH(content)    RECIPE("\"one_light_per_material\", \"materials\": [\"a\", \"b\"], " content)
#define LIBRARY(content) RECIPE("\"from_library\", \"materials\": [\"a\"]" content)
#define LISTED                                                                                               \
    "{\"materials\": [{\"name\": \"a\", \"design\": \"physical\"}, {\"name\": \"card\", \"srgb\": "          \
    "\"#c08040\"}],"                                                                                         \
    " \"lights\": [{\"name\": \"u\", \"illuminant\": \"E\"}, {\"name\": \"v\", \"illuminant\": \"A\"}], "    \
    "\"goals\": [{"

static const goals_refusal bad_recipes[] = {
    {RECIPE("5"), "goals[0].recipe is 5, must be text in quotes, not empty"},
    {RECIPE("\"metamer\""),
     "goals[0].recipe is \"metamer\", which is no recipe; the nearest is \"metamers\""},
    {METAMERS(", \"visible\": []"), "goals[0].visible is not a known key; the nearest is \"recipe\""},
    {METAMERS(", \"weight\": -1"), "goals[0].weight is -1, must be a number from 0.001 to 1000"},
    {METAMERS(", \"by\": 101"), "goals[0].by is 101, must be a number from 0.001 to 100"},
    {METAMERS(", \"srgb\": \"red\""), "goals[0].srgb is no color: color 'red', expected the form #rrggbb"},
    {METAMERS(", \"srgb\": \"#ff0000\", \"colors\": [\"#ff0000\"]"),
     "goals[0].colors stands beside \"srgb\"; only one of them can hold"},
    {METAMERS(", \"colors\": \"#ff0000\""), "goals[0].colors is \"#ff0000\", must be an array"},
    {METAMERS(", \"colors\": [5]"), "goals[0].colors[0] is 5, must be a color, \"#rrggbb\""},
    {METAMERS(", \"colors\": [\"#ff0000\", \"#ff0000\"]"),
     "goals[0].colors has 2, \"under\" has 1; there must be one for each"},
    {RECIPE("\"metamers\", \"under\": [\"u\"], \"apart\": [\"v\"]"), "goals[0].materials is missing"},
    {RECIPE("\"metamers\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\"]"), "goals[0].apart is missing"},
    {RECIPE("\"metamers\", \"materials\": [\"a\"], \"under\": [\"u\"], \"apart\": [\"v\"]"),
     "goals[0].materials has 1 name, 2 or more are needed"},
    {RECIPE("\"metamers\", \"materials\": [\"a\", \"b\"], \"under\": [], \"apart\": [\"v\"]"),
     "goals[0].under has 0 names, 1 or more are needed"},
    {RECIPE("\"metamers\", \"materials\": [\"a\", \"a\"], \"under\": [\"u\"], \"apart\": [\"v\"]"),
     "goals[0].materials[1] is \"a\" for the second time"},
    {RECIPE("\"metamers\", \"materials\": \"a\", \"under\": [\"u\"], \"apart\": [\"v\"]"),
     "goals[0].materials is \"a\", must be an array"},
    {RECIPE("\"metamers\", \"materials\": [\"a\", 5], \"under\": [\"u\"], \"apart\": [\"v\"]"),
     "goals[0].materials[1] is 5, must be the name of a material"},
    {RECIPE("\"metamers\", \"materials\": [\"a\", \"b\"], \"under\": [{}], \"apart\": [\"v\"]"),
     "goals[0].under[0] is {}, must be the name of a light"},
    {RECIPE("\"metamers\", \"materials\": [\"a\", \"b\"], \"under\": [\"u\", \"v\"], \"apart\": [\"v\"]"),
     "goals[0].apart names \"v\", which \"under\" names, too"},
    {RECIPE("\"black\", \"materials\": [\"a\"], \"under\": [\"u\"], \"visible\": [\"u\"]"),
     "goals[0].visible names \"u\", which \"under\" names, too"},
    {RECIPE("\"black\", \"materials\": [\"a\"], \"under\": [\"u\"], \"by\": 10"),
     "goals[0].by is for \"visible\", which this row has not"},
    {RECIPE("\"constant\", \"materials\": [\"a\"], \"under\": [\"u\"]"),
     "goals[0].under has 1 name, 2 or more are needed"},
    {EACH("\"lights\": [\"u\", \"v\", \"w\"]"),
     "goals[0].lights has 3 names, must have one for each of the 2 materials"},
    {EACH("\"lights\": [\"u\", \"v\"], \"colors\": [\"#ffffff\"]"),
     "goals[0].colors has 1, \"materials\" has 2; there must be one for each"},
    {EACH("\"lights\": [\"u\", \"v\"], \"by\": 5, \"colors\": [\"#ffffff\", \"#808080\"]"),
     "goals[0].by stands beside \"colors\", which say how far from black the materials are"},
    {RECIPE("\"figure 2\", \"materials\": [\"a\", \"b\"]"),
     "goals[0].materials has 2 names, this recipe needs 3"},
    {RECIPE("\"figure 5\", \"lights\": [\"a\"]"), "goals[0].lights has 1 name, this recipe needs 2"},
    {RECIPE("\"figure 2\", \"colors\": {\"blok\": \"#ffffff\"}"),
     "goals[0].colors.blok is not a known key; the nearest is \"block\""},
    {RECIPE("\"figure 2\", \"colors\": [\"#ffffff\"]"),
     "goals[0].colors is [\"#ffffff\"], must be an object"},
    {RECIPE("\"figure 2\", \"colors\": {\"block\": \"#fff\"}"),
     "goals[0].colors.block is no color: color '#fff', expected the form #rrggbb"},
    {RECIPE("\"figure 5\", \"color\": {}"), "goals[0].color is not a known key; the nearest is \"colors\""},
    {LISTED "\"recipe\": \"figure 5\"}]}",
     "goals[0].materials is missing, and \"cloud\", the recipe's own, is no material of the palette"},
    {LISTED "\"recipe\": \"figure 5\", \"materials\": [\"a\", \"card\"]}]}",
     "goals[0].lights is missing, and \"light 1\", the recipe's own, is no light of the palette"},
    {LISTED "\"recipe\": \"constant\", \"materials\": [\"crad\"], \"under\": [\"u\", \"v\"]}]}",
     "goals[0].materials[0] is \"crad\", which is no material of the palette; the nearest is \"card\""},
    {LISTED "\"recipe\": \"constant\", \"materials\": [\"a\"], \"under\": [\"u\", \"vv\"]}]}",
     "goals[0].under[1] is \"vv\", which is no light of the palette; the nearest is \"v\""},
    {LISTED "\"recipe\": \"from_library\", \"materials\": [\"card\"], \"tables\": []}]}",
     "goals[0].materials names \"card\", whose spectrum is given"},
    {LIBRARY(""), "goals[0].tables is missing"},
    {LIBRARY(", \"tables\": []"), "goals[0].tables is empty, at least one file is needed"},
    {LIBRARY(", \"tables\": [\"\"]"), "goals[0].tables[0] is \"\", must be the name of a CSV file"},
    {LIBRARY(", \"tables\": [\"../../LICENSE\"]"), "goals[0].tables[0] is not usable: " METAMER_SOURCE_DIR
                                                   "/data/spectra/../../LICENSE:1: the header row begins "
                                                   "with 'BSD 3-Clause License', expected wavelength_nm"},
    {LIBRARY(", \"tables\": [\"reflectance_ces99.csv\"]"),
     "goals asks for nothing: at least one goal is needed"},
    {LIBRARY(", \"tables\": "
             "[\"1\",\"2\",\"3\",\"4\",\"5\",\"6\",\"7\",\"8\",\"9\",\"10\",\"11\",\"12\",\"13\",\"14\","
             "\"15\",\"16\",\"17\"]"),
     "goals[0].tables has 17 elements, at most 16 are allowed"},
};

static void bad_recipes_are_refused_with_key_and_value(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof bad_recipes / sizeof *bad_recipes; i++)
        goals_assert_refused(bad_recipes[i].text, bad_recipes[i].message);
}

static void names_that_recipes_bring_are_checked(void **state) {
    (void)state;
    char text[2048];
    char names[512] = "";
    goals_assert_refused(RECIPE("\"constant\", \"materials\": "
                                "[\"nnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnnn\"], "
                                "\"under\": [\"u\", \"v\"]"),
                         "goals[0].materials[0] has 64 bytes, at most 63 are allowed");
    for (int i = 0; i < MTM_DESIGNED_MAX + 1; i++)
        (void)snprintf(names + strlen(names), sizeof names - strlen(names), "%s\"m%d\"", i > 0 ? "," : "", i);
    (void)snprintf(text, sizeof text, RECIPE("\"constant\", \"materials\": [%s], \"under\": [\"u\", \"v\"]"),
                   names);
    goals_assert_refused(
        text, "goals[0].materials[32] makes one designed spectrum more than the 32 that are allowed");
}

static void more_goals_than_a_document_may_have_are_refused(void **state) {
    (void)state;
    /* Sixteen by sixteen make 16·16 goals, the limit. */
    char text[2048] = "{\"goals\": [{\"recipe\": \"one_light_per_material\"";
    for (int kind = 0; kind < 2; kind++) {
        (void)strcat(text, kind == 0 ? ", \"materials\": [" : ", \"lights\": [");
        for (int i = 0; i < 16; i++)
            (void)snprintf(text + strlen(text), sizeof text - strlen(text), "%s\"n%d\"", i > 0 ? "," : "", i);
        (void)strcat(text, "]");
    }
    const size_t length = strlen(text);
    (void)strcat(text, "}]}");
    mtm_goals *goals = goals_parse(text);
    assert_int_equal(goals->goal_count, MTM_GOALS_MAX);
    mtm_goals_destroy(goals);
    (void)snprintf(text + length, sizeof text - length,
                   "}, {\"material\": \"n0\", \"light\": \"n0\", \"black\": true}]}");
    goals_assert_refused(text, "goals[1] makes more goals than the 256 that a document may have");
}

static void a_library_that_is_missing_is_an_io_failure(void **state) {
    (void)state;
    static const char text[] = LIBRARY(", \"tables\": [\"reflectance_ces99.csv\", \"none.csv\"]");
    mtm_error error;
    mtm_goals *goals = NULL;
    assert_fails(mtm_goals_parse("test.json", text, METAMER_SOURCE_DIR "/data/spectra", &goals, &error),
                 MTM_IO, error,
                 "test.json: goals[0].tables[1] is not usable: " METAMER_SOURCE_DIR "/data/spectra/none.csv");
    assert_fails(mtm_goals_parse("test.json", text, NULL, &goals, &error), MTM_FORMAT, error,
                 "goals[0].tables[0] names a file, but an embedded document stands alone");
    assert_null(goals);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metamers_part_under_other_lights),
        cmocka_unit_test(blacks_may_be_visible_elsewhere),
        cmocka_unit_test(constant_materials_keep_their_color),
        cmocka_unit_test(each_light_shows_one_material),
        cmocka_unit_test(figure_2_is_the_engine),
        cmocka_unit_test(figure_5_takes_the_cloud_away),
        cmocka_unit_test(figure_6_shows_three_materials_one_by_one),
        cmocka_unit_test(figure_7_parts_the_gel_from_the_flesh),
        cmocka_unit_test(a_recipe_takes_the_names_it_is_given),
        cmocka_unit_test(only_what_the_document_does_not_list_is_brought),
        cmocka_unit_test(a_library_is_searched_for_materials),
        cmocka_unit_test(bad_recipes_are_refused_with_key_and_value),
        cmocka_unit_test(names_that_recipes_bring_are_checked),
        cmocka_unit_test(more_goals_than_a_document_may_have_are_refused),
        cmocka_unit_test(a_library_that_is_missing_is_an_io_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
