/* SPDX-License-Identifier: BSD-3-Clause
 * Designs do what their goals ask, the same on every machine; what cannot be is said. */
#include <stdio.h>

#include "palette/designs.h"

static const char pair[] =
    "{\"metamer\": 1, \"materials\": [{\"name\": \"a\", \"design\": \"physical\"}, {\"name\": \"b\", "
    "\"design\": "
    "\"physical\"}], \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": \"lamp\", "
    "\"illuminant\": "
    "\"A\"}, {\"name\": \"new\", \"design\": \"physical\"}], \"goals\": ["
    "{\"material\": \"a\", \"light\": \"day\", \"srgb\": \"#9a8f80\"},"
    "{\"material\": \"b\", \"light\": \"day\", \"same_as\": {\"material\": \"a\"}},"
    "{\"material\": \"b\", \"light\": \"lamp\", \"differs_from\": {\"material\": \"a\"}, \"by\": 10},"
    "{\"material\": \"b\", \"light\": \"new\", \"differs_from\": {\"material\": \"a\"}, \"by\": 15}]}";

/* The largest |second difference| of a spectrum. */
static double roughest(const mtm_spectrum *spectrum) {
    double worst = 0;
    for (int i = 1; i + 1 < N; i++)
        worst = fmax(worst, fabs(spectrum->value[i - 1] - 2 * spectrum->value[i] + spectrum->value[i + 1]));
    return worst;
}

static void a_metameric_pair_is_physical_and_smooth(void **state) {
    (void)state;
    mtm_design *design = design_of(pair);
    assert_met(design, 0.1, 0.1);
    assert_physical(design);
    for (int m = 0; m < 2; m++) assert_true(roughest(&design->palette.materials[m].reflectance) < 0.05);
    const mtm_cell cells[3] = {{0, 0}, {0, 1}, {0, 2}}, others[3] = {{1, 0}, {1, 1}, {1, 2}};
    for (int l = 0; l < 3; l++)
        print_message(
            "%s: %.3f in full spectra, %.3f in factors:7, %.3f in sharpened:7\n",
            design->palette.lights[l].name,
            mtm_ciede2000(look(&design->palette, cells[l], NULL), look(&design->palette, others[l], NULL)),
            mtm_ciede2000(look(&design->palette, cells[l], "factors:7"),
                          look(&design->palette, others[l], "factors:7")),
            mtm_ciede2000(look(&design->palette, cells[l], "sharpened:7"),
                          look(&design->palette, others[l], "sharpened:7")));
    mtm_design_destroy(design);
}

/* Given materials get a light that shows the white card as a lamp does and red in another color: a metamer of the lamp. */
static void lights_are_found_for_given_materials(void **state) {
    (void)state;
    mtm_design *design = design_of(
        "{\"metamer\": 1, \"materials\": [{\"name\": \"white\", \"spectrum\": "
        "\"reflectance_colorchecker_ohta.csv:white_9.5_.05_d\"}, {\"name\": \"red\", \"spectrum\": "
        "\"reflectance_colorchecker_ohta.csv:red\"}], \"lights\": [{\"name\": \"lamp\", \"illuminant\": "
        "\"A\"}, "
        "{\"name\": \"new\", \"design\": \"physical\"}], \"goals\": [{\"material\": \"white\", \"light\": "
        "\"new\", "
        "\"same_as\": {\"light\": \"lamp\"}}, {\"material\": \"red\", \"light\": \"new\", \"differs_from\": "
        "{\"light\": \"lamp\"}, \"by\": 12}]}");
    assert_met(design, 0.1, 0.1);
    assert_physical(design);
    assert_int_equal(design->materials[0], MTM_HONESTY_GIVEN);
    assert_int_equal(design->lights[0], MTM_HONESTY_GIVEN);
    assert_int_equal(design->lights[1], MTM_HONESTY_PHYSICAL);
    mtm_design_destroy(design);
}

static void reports_are_the_same_for_every_thread_count(void **state) {
    (void)state;
    char *first = NULL;
    for (int threads = 1; threads <= 3; threads++) {
        mtm_design_options options = mtm_design_defaults();
        options.thread_count = threads;
        mtm_design *design =
            design_with("{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 7\"}]}", &options);
        char *palette = mtm_palette_format(&design->palette);
        if (first == NULL)
            first = palette;
        else
            assert_string_equal(palette, first);
        if (first != palette) mtm_text_free(palette);
        mtm_design_destroy(design);
    }
    mtm_text_free(first);
}

/* Other machines have other mathematical functions in their last digits; that must not lead elsewhere. */
static void costs_are_the_same_on_every_machine(void **state) {
    (void)state;
    const struct {
        const char *text;
        double cost;
    } known[] = {{pair, 0.00349574470816},
                 {"{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 7\"}]}", 0.0131417164129}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        mtm_design *design = design_of(known[i].text);
        if (!(fabs(design->objective / known[i].cost - 1) < 1e-6))
            fail_msg("%zu: %.12g", i, design->objective);
        mtm_design_destroy(design);
    }
}

/* --- what cannot be --- */

static const mtm_design_problem *problem_of(const mtm_design *design, int goal) {
    int found = 0;
    while (found < design->problem_count && design->problems[found].goal != goal) found++;
    assert_true(found < design->problem_count);
    return &design->problems[found];
}

static void assert_reason(const mtm_design *design, int goal, const char *text) {
    const mtm_design_problem *problem = problem_of(design, goal);
    if (strstr(problem->reason, text) == NULL) fail_msg("'%s' does not contain '%s'", problem->reason, text);
}

/* Black under daylight leaves no light to be bright in under a lamp that overlaps it: both goals are named. */
static void goals_that_block_each_other_are_named(void **state) {
    (void)state;
    mtm_design *design = design_of("{\"metamer\": 1, \"materials\": [{\"name\": \"a\", \"design\": "
                                   "\"physical\"}], \"lights\": [{\"name\": \"day\", "
                                   "\"illuminant\": \"D65\"}, {\"name\": \"lamp\", \"illuminant\": \"A\"}], "
                                   "\"goals\": [{\"material\": \"a\", "
                                   "\"light\": \"day\", \"black\": true}, {\"material\": \"a\", \"light\": "
                                   "\"lamp\", \"srgb\": \"#a08060\"}]}");
    assert_int_equal(design->problem_count, 2);
    assert_int_equal(problem_of(design, 0)->blocker_count, 1);
    assert_int_equal(problem_of(design, 0)->blockers[0], 1);
    assert_true(problem_of(design, 0)->is_proven);
    assert_int_equal(problem_of(design, 1)->blockers[0], 0);
    assert_reason(design, 0, "a under day: possible alone, but blocked by a under lamp");
    mtm_design_destroy(design);
}

/* What is known of the nearest color: a saturated green as bright as this is outside what any reflectance shows. */
static void a_color_outside_the_object_color_solid_is_proven_so(void **state) {
    (void)state;
    mtm_design *design = design_of("{\"metamer\": 1, \"materials\": [{\"name\": \"a\", \"design\": "
                                   "\"physical\"}], \"lights\": [{\"name\": \"day\", "
                                   "\"illuminant\": \"D65\"}], \"goals\": [{\"material\": \"a\", \"light\": "
                                   "\"day\", \"xyz\": [0.2, 0.7, 0.05]}]}");
    const mtm_design_problem *problem = problem_of(design, 0);
    assert_true(problem->is_proven);
    assert_int_equal(problem->blocker_count, 0);
    assert_reason(design, 0, "outside the object-color solid");
    assert_true(design->results[0].ciede2000 > 2);
    mtm_design_destroy(design);
}

static void what_is_given_altogether_is_said_to_be(void **state) {
    (void)state;
    mtm_design *design = design_of("{\"metamer\": 1, \"materials\": [{\"name\": \"a\", \"design\": "
                                   "\"physical\"}, {\"name\": \"card\", \"srgb\": "
                                   "\"#808080\"}], \"lights\": [{\"name\": \"day\", \"illuminant\": "
                                   "\"D65\"}], \"goals\": [{\"material\": \"card\", "
                                   "\"light\": \"day\", \"srgb\": \"#ff0000\"}]}");
    assert_reason(design, 0, "all its spectra are given and show #808080");
    assert_true(problem_of(design, 0)->is_proven);
    mtm_design_destroy(design);
}

/* The colors of a wavy spectrum under four lights are twelve numbers; full spectra have them, seven numbers cannot. */
static void what_only_the_basis_lacks_is_counted(void **state) {
    (void)state;
    mtm_error error;
    mtm_palette palette;
    char text[2048] = "{\"metamer\": 1, \"materials\": [{\"name\": \"a\", \"design\": \"physical\"}], ";
    static const char lights[] =
        "\"lights\": [{\"name\": \"1\", \"illuminant\": \"D65\"}, {\"name\": \"2\", \"illuminant\": \"A\"}, "
        "{\"name\": \"3\", \"illuminant\": \"FL11\"}, {\"name\": \"4\", \"illuminant\": \"LED-RGB1\"}]";
    char only_lights[512];
    mtm_material wavy = {.name = "wavy"};
    for (int i = 0; i < N; i++) wavy.reflectance.value[i] = 0.5 + 0.4 * sin(i);
    (void)snprintf(only_lights, sizeof only_lights, "{%s}", lights);
    assert_ok(mtm_palette_parse("t", only_lights, NULL, &palette, &error), error);
    const mtm_palette shown = {1, &wavy, palette.light_count, palette.lights};
    (void)snprintf(text + strlen(text), sizeof text - strlen(text), "%s, \"goals\": [", lights);
    for (int l = 0; l < 4; l++) {
        const mtm_lab lab = look(&shown, (mtm_cell){0, l}, NULL);
        (void)snprintf(text + strlen(text), sizeof text - strlen(text),
                       "%s{\"material\": \"a\", \"light\": \"%d\", \"lab\": [%.12g, %.12g, %.12g]}",
                       l == 0 ? "" : ", ", l + 1, lab.l, lab.a, lab.b);
    }
    (void)snprintf(text + strlen(text), sizeof text - strlen(text), "]}");
    mtm_design *design = design_of(text);
    assert_met(design, 1, 100);
    assert_true(design->problem_count > 0);
    for (int i = 0; i < design->problem_count; i++) {
        assert_true(design->problems[i].is_basis_only);
        assert_reason(design, design->problems[i].goal,
                      "7 numbers for a reflectance, and the goals on a fix 12");
    }
    mtm_design_destroy(design);
    mtm_palette_free(&palette);
}

/* --- options and kinds of spectra --- */

/* The distance of a material from a table's column. */
static double distance(const mtm_spectrum *a, const mtm_spectrum *b) {
    double sum = 0;
    for (int i = 0; i < N; i++) sum += (a->value[i] - b->value[i]) * (a->value[i] - b->value[i]);
    return sqrt(sum / N);
}

static void an_anchor_draws_a_spectrum_near(void **state) {
    (void)state;
    mtm_error error;
    mtm_spectrum foliage;
    char text[1024];
    double distances[2];
    assert_ok(mtm_spectrum_read(METAMER_SOURCE_DIR "/data/spectra",
                                "reflectance_colorchecker_ohta.csv:foliage", MTM_KIND_REFLECTANCE, &foliage,
                                &error),
              error);
    for (int k = 0; k < 2; k++) {
        (void)snprintf(
            text, sizeof text,
            "{\"metamer\": 1, \"materials\": [{\"name\": \"a\", \"design\": \"physical\"%s}], \"lights\": "
            "[{\"name\": \"day\", \"illuminant\": \"D65\"}], \"goals\": [{\"material\": \"a\", \"light\": "
            "\"day\", "
            "\"srgb\": \"#596a3e\"}]}",
            k == 0 ? "" : ", \"near\": {\"spectrum\": \"reflectance_colorchecker_ohta.csv:foliage\"}");
        mtm_design *design = design_of(text);
        assert_met(design, 0.1, 0.1);
        distances[k] = distance(&design->palette.materials[0].reflectance, &foliage);
        mtm_design_destroy(design);
    }
    assert_true(distances[1] < 0.02);
    assert_true(distances[1] < distances[0] / 3);
}

/* A black under equal-energy light that a lamp shows bright cannot be physical, but artificial it can. */
static void artificial_spectra_do_what_physical_ones_cannot(void **state) {
    (void)state;
    static const char form[] = "{\"metamer\": 1, \"basis\": \"materials\", \"materials\": [{\"name\": \"a\", "
                               "\"design\": \"%s\"}], \"lights\": "
                               "[{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": \"lamp\", "
                               "\"illuminant\": \"A\"}], \"goals\": "
                               "[{\"material\": \"a\", \"light\": \"day\", \"black\": true}, {\"material\": "
                               "\"a\", \"light\": \"lamp\", \"srgb\": "
                               "\"#604020\"}]}";
    char text[1024];
    (void)snprintf(text, sizeof text, form, "artificial");
    mtm_design *design = design_of(text);
    assert_true(design->results[0].is_met && design->results[1].is_met);
    assert_int_equal(design->materials[0], MTM_HONESTY_ARTIFICIAL);
    assert_int_equal(design->problem_count, 0);
    mtm_design_destroy(design);
    (void)snprintf(text, sizeof text, form, "physical");
    design = design_of(text);
    assert_int_equal(design->materials[0], MTM_HONESTY_PHYSICAL);
    assert_int_equal(design->problem_count, 2);
    mtm_design_destroy(design);
}

static void smoothness_makes_spectra_smoother(void **state) {
    (void)state;
    double rough[2];
    for (int k = 0; k < 2; k++) {
        char text[512];
        (void)snprintf(
            text, sizeof text,
            "{\"metamer\": 1, \"smoothness\": %s, \"materials\": [{\"name\": \"a\", \"design\": "
            "\"physical\"}], "
            "\"lights\": [{\"name\": \"l\", \"design\": \"physical\"}], \"goals\": [{\"material\": \"a\", "
            "\"light\": \"l\", \"srgb\": \"#e02010\"}]}",
            k == 0 ? "0.01" : "100");
        mtm_design *design = design_of(text);
        assert_met(design, 0.5, 0.5);
        rough[k] = roughest(&design->palette.materials[0].reflectance);
        mtm_design_destroy(design);
    }
    assert_true(rough[1] < rough[0]);
}

/* Artificial and pulled at with very different strengths: no step settles everywhere, which is no failure. */
static void goals_of_very_different_weights_are_no_failure(void **state) {
    (void)state;
    mtm_design *design = design_of(
        "{\"metamer\": 1, \"materials\": [{\"name\": \"m\", \"design\": \"physical\"}], \"lights\": "
        "[{\"name\": \"l\", "
        "\"design\": \"artificial\"}], \"goals\": [{\"material\": \"m\", \"light\": \"l\", \"black\": true}, "
        "{\"material\": \"m\", \"light\": \"l\", \"black\": true, \"weight\": 1000}, {\"material\": \"m\", "
        "\"light\": "
        "\"l\", \"differs_from\": \"black\", \"by\": 30, \"weight\": 1000}]}");
    assert_true(design->problem_count > 0);
    mtm_design_destroy(design);
}

/* Two colors 1.5 apart are each within 1 of what lies between them: missing one is no proof that both cannot be. */
static void what_is_met_within_the_tolerance_is_not_proven_impossible(void **state) {
    (void)state;
    mtm_design *design = design_of("{\"metamer\": 1, \"materials\": [{\"name\": \"a\", \"design\": "
                                   "\"physical\"}], \"lights\": [{\"name\": \"d\", "
                                   "\"illuminant\": \"D65\"}], \"goals\": [{\"material\": \"a\", \"light\": "
                                   "\"d\", \"lab\": [50, 0, 0], \"weight\": "
                                   "1000}, {\"material\": \"a\", \"light\": \"d\", \"lab\": [51.6, 0, 0]}]}");
    for (int i = 0; i < design->problem_count; i++) assert_false(design->problems[i].is_proven);
    mtm_design_destroy(design);
}

static bool stop(void *user, double fraction) {
    (void)fraction;
    ++*(int *)user;
    return false;
}

static void a_design_can_be_cancelled(void **state) {
    (void)state;
    int calls = 0;
    mtm_error error;
    mtm_goals *goals = NULL;
    mtm_design *design = NULL;
    mtm_design_options options = mtm_design_defaults();
    options.progress = (mtm_progress){stop, &calls};
    assert_ok(mtm_goals_parse("t", "{\"metamer\": 1, \"goals\": [{\"recipe\": \"figure 2\"}]}", NULL, &goals,
                              &error),
              error);
    assert_fails(mtm_design_find(goals, &options, &design, &error), MTM_CANCELLED, error, "cancelled");
    assert_true(calls > 0);
    assert_null(design);
    mtm_goals_destroy(goals);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_metameric_pair_is_physical_and_smooth),
        cmocka_unit_test(lights_are_found_for_given_materials),
        cmocka_unit_test(reports_are_the_same_for_every_thread_count),
        cmocka_unit_test(costs_are_the_same_on_every_machine),
        cmocka_unit_test(goals_that_block_each_other_are_named),
        cmocka_unit_test(a_color_outside_the_object_color_solid_is_proven_so),
        cmocka_unit_test(what_is_given_altogether_is_said_to_be),
        cmocka_unit_test(what_only_the_basis_lacks_is_counted),
        cmocka_unit_test(an_anchor_draws_a_spectrum_near),
        cmocka_unit_test(artificial_spectra_do_what_physical_ones_cannot),
        cmocka_unit_test(smoothness_makes_spectra_smoother),
        cmocka_unit_test(goals_of_very_different_weights_are_no_failure),
        cmocka_unit_test(what_is_met_within_the_tolerance_is_not_proven_impossible),
        cmocka_unit_test(a_design_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
