/* SPDX-License-Identifier: BSD-3-Clause
 * Measured reflectances are found where there are some, by brute force over the same tables, and are anchors where not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "metamer/metamer.h"
#include "test.h"

#define TABLES METAMER_SOURCE_DIR "/data/spectra"
static const char table_name[] = "reflectance_ces99.csv";

/* Reflectances a and b that match under daylight and differ by this much under incandescent light. */
static mtm_design *find_pair(double by) {
    char text[1024];
    mtm_error error;
    mtm_goals *goals = NULL;
    mtm_design *design = NULL;
    (void)snprintf(
        text, sizeof text,
        "{\"metamer\": 1, \"materials\": [{\"name\": \"a\", \"design\": \"physical\"}, {\"name\": \"b\", "
        "\"design\": \"physical\"}], \"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": "
        "\"lamp\", \"illuminant\": \"A\"}], \"tolerance\": 2, \"goals\": [{\"recipe\": \"metamers\", "
        "\"materials\": [\"a\", \"b\"], \"under\": [\"day\"], \"apart\": [\"lamp\"], \"by\": %g}, "
        "{\"recipe\": "
        "\"from_library\", \"materials\": [\"a\", \"b\"], \"tables\": [\"%s\"]}]}",
        by, table_name);
    assert_ok(mtm_goals_parse("test.json", text, TABLES, &goals, &error), error);
    assert_ok(mtm_design_find(goals, NULL, &design, &error), error);
    mtm_goals_destroy(goals);
    return design;
}

static mtm_lab look(const mtm_spectrum *reflectance, const char *illuminant) {
    mtm_error error;
    mtm_spectrum light;
    mtm_observer observer;
    assert_ok(mtm_illuminant(illuminant, &light, &error), error);
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_light_normalize(&light, &observer, &light, &error), error);
    const mtm_illumination illumination = mtm_illumination_of(&light, &observer, 0);
    return mtm_lab_from_xyz(mtm_xyz_from_rgb(mtm_illuminate(&illumination, reflectance)), mtm_white_d65());
}

/* The least cost over all pairs of the table: the misses squared, as the search adds them. */
static double least_cost(double by) {
    mtm_error error;
    mtm_spectrum_table table;
    assert_ok(mtm_spectrum_table_read(TABLES "/reflectance_ces99.csv", &table, &error), error);
    mtm_lab(*labs)[2] = malloc((size_t)table.column_count * sizeof *labs);
    assert_non_null(labs);
    for (int i = 0; i < table.column_count; i++) {
        mtm_spectrum s;
        assert_ok(
            mtm_spectrum_table_column(&table, table_name, table.names[i], MTM_KIND_REFLECTANCE, &s, &error),
            error);
        labs[i][0] = look(&s, "D65");
        labs[i][1] = look(&s, "A");
    }
    double least = INFINITY;
    for (int i = 0; i < table.column_count; i++)
        for (int j = 0; j < i; j++) {
            const double match = mtm_ciede2000(labs[i][0], labs[j][0]);
            const double lack = fmax(0, by - mtm_ciede2000(labs[i][1], labs[j][1]));
            least = fmin(least, match * match + lack * lack);
        }
    free(labs);
    mtm_spectrum_table_free(&table);
    return least;
}

static void the_best_pair_of_a_table_is_taken(void **state) {
    (void)state;
    const double by = 2;
    mtm_design *design = find_pair(by);
    double cost = 0;
    for (int i = 0; i < design->result_count; i++)
        cost += design->results[i].ciede2000 * design->results[i].ciede2000;
    assert_float_equal(cost, least_cost(by), 1e-6);
    for (int m = 0; m < 2; m++) {
        mtm_error error;
        mtm_spectrum measured;
        assert_int_equal(design->materials[m], MTM_HONESTY_MEASURED);
        assert_ok(
            mtm_spectrum_read(TABLES, design->material_origins[m], MTM_KIND_REFLECTANCE, &measured, &error),
            error);
        assert_memory_equal(&measured, &design->palette.materials[m].reflectance, sizeof measured);
    }
    print_message("%s and %s\n", design->material_origins[0], design->material_origins[1]);
    mtm_design_destroy(design);
}

/* Nothing in the table parts so much; designed spectra do, and stay near what was measured. */
static void where_a_table_has_none_they_are_designed_near_it(void **state) {
    (void)state;
    const double by = 12;
    assert_true(least_cost(by) > 9);
    mtm_design *design = find_pair(by);
    for (int i = 0; i < design->result_count; i++) assert_true(design->results[i].is_met);
    for (int m = 0; m < 2; m++) {
        assert_int_equal(design->materials[m], MTM_HONESTY_PHYSICAL);
        assert_string_equal(design->material_origins[m], "");
    }
    mtm_design_destroy(design);
}

/* What the library has for daylight cannot be black under a light that is to be found; near it, a designed one can. */
static void a_measured_material_gives_way_to_goals_it_blocks(void **state) {
    (void)state;
    mtm_error error;
    mtm_goals *goals = NULL;
    mtm_design *design = NULL;
    assert_ok(
        mtm_goals_parse(
            "test.json",
            "{\"metamer\": 1, \"tolerance\": 2, \"materials\": [{\"name\": \"a\", \"design\": "
            "\"physical\"}], "
            "\"lights\": [{\"name\": \"day\", \"illuminant\": \"D65\"}, {\"name\": \"new\", \"design\": "
            "\"physical\"}], \"goals\": [{\"material\": \"a\", \"light\": \"day\", \"srgb\": \"#f1bdce\"}, "
            "{\"material\": \"a\", \"light\": \"new\", \"black\": true}, {\"recipe\": \"from_library\", "
            "\"materials\": [\"a\"], \"tables\": [\"reflectance_ces99.csv\"]}]}",
            TABLES, &goals, &error),
        error);
    assert_ok(mtm_design_find(goals, NULL, &design, &error), error);
    for (int i = 0; i < design->result_count; i++) assert_true(design->results[i].is_met);
    assert_int_equal(design->materials[0], MTM_HONESTY_PHYSICAL);
    mtm_design_destroy(design);
    mtm_goals_destroy(goals);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_best_pair_of_a_table_is_taken),
        cmocka_unit_test(where_a_table_has_none_they_are_designed_near_it),
        cmocka_unit_test(a_measured_material_gives_way_to_goals_it_blocks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
