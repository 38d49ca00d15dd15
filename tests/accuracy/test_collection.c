/* SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "accuracy/collection.h"
#include "accuracy/synthetic_lights.h"
#include "test.h"

static int count_part(const collection_list *list, collection_part part) {
    int count = 0;
    for (int i = 0; i < list->count; i++) count += list->items[i].part == part;
    return count;
}

static void the_split_has_the_parts_that_it_names(void **state) {
    (void)state;
    collection spectra;
    mtm_error error;
    assert_ok(collection_read(METAMER_SOURCE_DIR, NULL, &spectra, &error), error);
    assert_int_equal(count_part(&spectra.lights, PART_TRAIN), 20);
    assert_int_equal(count_part(&spectra.lights, PART_SMOOTH), 5);
    assert_int_equal(count_part(&spectra.lights, PART_LED), 4);
    assert_int_equal(count_part(&spectra.lights, PART_FLUORESCENT), 7);
    assert_int_equal(spectra.lights.count, 36);
    assert_int_equal(count_part(&spectra.reflectances, PART_TRAIN), 61);
    assert_int_equal(count_part(&spectra.reflectances, PART_TEST), 62); /* without the Munsell chips */
    assert_int_equal(spectra.reflectances.count, 123);
    assert_string_equal(spectra.lights.items[0].name, "A");
    collection_free(&spectra);
}

static void lights_show_white_with_luminance_one(void **state) {
    (void)state;
    collection spectra;
    mtm_observer observer;
    mtm_spectrum d65;
    mtm_error error;
    assert_ok(collection_read(METAMER_SOURCE_DIR, NULL, &spectra, &error), error);
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_illuminant("D65", &d65, &error), error);
    for (int i = 0; i < spectra.lights.count; i++) {
        const collection_item *item = &spectra.lights.items[i];
        assert_float_equal(mtm_xyz_of(&item->spectrum, &observer).y, 1, 1e-12);
        if (strcmp(item->name, "D65") == 0)
            for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
                assert_float_equal(item->spectrum.value[k] / item->spectrum.value[36],
                                   d65.value[k] / d65.value[36], 1e-12);
    }
    collection_free(&spectra);
}

static void synthetic_lights_have_the_white_of_measured_ones(void **state) {
    (void)state;
    collection spectra;
    mtm_observer observer;
    mtm_error error;
    assert_ok(collection_read(METAMER_SOURCE_DIR, NULL, &spectra, &error), error);
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    const int measured = spectra.lights.count;
    const int rounds = 100;
    assert_ok(synthetic_lights_append(rounds * measured, 3, measured, &spectra.lights, &error), error);
    assert_int_equal(spectra.lights.count, (rounds + 1) * measured);
    for (int i = measured; i < spectra.lights.count; i++) {
        const mtm_spectrum *light = &spectra.lights.items[i].spectrum;
        const mtm_spectrum *origin = &spectra.lights.items[i % measured].spectrum;
        const mtm_xyz white = mtm_xyz_of(light, &observer);
        const mtm_xyz expected = mtm_xyz_of(origin, &observer);
        assert_float_equal(white.x, expected.x, 1e-9);
        assert_float_equal(white.y, expected.y, 1e-9);
        assert_float_equal(white.z, expected.z, 1e-9);
        assert_memory_not_equal(light, origin, sizeof *light);
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) assert_true(light->value[k] >= 0);
    }
    collection_free(&spectra);
}

static void a_light_beyond_all_lines_has_no_synthetic_one(void **state) {
    (void)state;
    collection_list lights = {0};
    collection_item green = {.name = "green"};
    mtm_error error;
    green.spectrum.value[(500 - MTM_WAVELENGTH_FIRST_NM) / MTM_WAVELENGTH_STEP_NM] = 1;
    assert_ok(collection_append(&lights, &green, &error), error);
    assert_fails(synthetic_lights_append(1, 3, 1, &lights, &error), MTM_NUMERIC, error, "light 'green'");
    assert_int_equal(lights.count, 1);
    collection_list_free(&lights);
}

/* A source folder of its own with one split, and an extra folder with a table. */
static int make_folders(void **state) {
    char *folder = malloc(32);
    if (folder == NULL) return 1;
    strcpy(folder, "collection-XXXXXX");
    *state = folder;
    return mkdtemp(folder) == NULL || chdir(folder) != 0 || mkdir("accuracy", 0777) != 0 ||
           mkdir("extra", 0777) != 0;
}

static int remove_folders(void **state) {
    (void)remove("accuracy/split.csv");
    (void)remove("extra/reflectance_munsell1269_matt_5nm.csv");
    (void)rmdir("accuracy");
    (void)rmdir("extra");
    const int result = chdir("..") != 0 || rmdir(*state) != 0;
    free(*state);
    return result;
}

static void write_text(const char *path, const char *text) {
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    assert_true(fputs(text, stream) >= 0);
    assert_int_equal(fclose(stream), 0);
}

static void the_optional_table_is_read_where_it_is(void **state) {
    (void)state;
    collection spectra;
    mtm_error error;
    write_text("accuracy/split.csv",
               "table,name,part\nilluminant,E,train\nreflectance_munsell1269_matt,b,test\n");
    assert_ok(collection_read(".", NULL, &spectra, &error), error);
    assert_int_equal(spectra.reflectances.count, 0);
    collection_free(&spectra);
    assert_fails(collection_read(".", "extra", &spectra, &error), MTM_IO, error,
                 "extra/reflectance_munsell1269_matt_5nm.csv");
    write_text("extra/reflectance_munsell1269_matt_5nm.csv",
               "wavelength_nm,a,b\n380,0.1,0.25\n780,0.1,0.25\n");
    assert_ok(collection_read(".", "extra", &spectra, &error), error);
    assert_int_equal(spectra.reflectances.count, 1);
    assert_true(spectra.reflectances.items[0].spectrum.value[40] == 0.25);
    collection_free(&spectra);
}

static void bad_splits_are_refused_with_file_and_line(void **state) {
    (void)state;
    static const struct {
        const char *text;
        mtm_status status;
        const char *message;
    } cases[] = {
        {"table,name\n", MTM_FORMAT, "accuracy/split.csv:1: expected the header 'table,name,part'"},
        {"table,name,part\nilluminant,A\n", MTM_FORMAT, "accuracy/split.csv:2: expected a row"},
        {"table,name,part\nilluminant,A,train,x\n", MTM_FORMAT, "accuracy/split.csv:2: expected a row"},
        {"table,name,part\nilluminant,A,train", MTM_FORMAT, "accuracy/split.csv:2: expected a row"},
        {"table,name,part\nilluminant,A,train\nilluminant,C,tset\n", MTM_FORMAT,
         "accuracy/split.csv:3: part 'tset', expected train"},
        {"table,name,part\nblackbody,hot,train\n", MTM_FORMAT, "accuracy/split.csv:2: black body of 'hot'"},
        {"table,name,part\nblackbody,5,train\n", MTM_ARGUMENT,
         "accuracy/split.csv:2: blackbody temperature 5 K"},
        {"table,name,part\nilluminant,Q,train\n", MTM_ARGUMENT,
         "accuracy/split.csv:2: unknown illuminant 'Q'"},
        {"table,name,part\nreflectance_none,a,train\n", MTM_IO,
         "accuracy/split.csv:2: ./data/spectra/reflectance_none.csv"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        collection spectra;
        mtm_error error;
        write_text("accuracy/split.csv", cases[i].text);
        assert_fails(collection_read(".", NULL, &spectra, &error), cases[i].status, error, cases[i].message);
    }
    (void)remove("accuracy/split.csv");
    collection spectra;
    mtm_error error;
    assert_fails(collection_read(".", NULL, &spectra, &error), MTM_IO, error, "./accuracy/split.csv");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_split_has_the_parts_that_it_names),
        cmocka_unit_test(lights_show_white_with_luminance_one),
        cmocka_unit_test(synthetic_lights_have_the_white_of_measured_ones),
        cmocka_unit_test(a_light_beyond_all_lines_has_no_synthetic_one),
        cmocka_unit_test_setup_teardown(the_optional_table_is_read_where_it_is, make_folders, remove_folders),
        cmocka_unit_test_setup_teardown(bad_splits_are_refused_with_file_and_line, make_folders,
                                        remove_folders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
