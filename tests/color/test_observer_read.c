/* SPDX-License-Identifier: BSD-3-Clause
 * Observers and cameras from tables, and a chart through a camera, against the tables of tests/data/expected/. */
#include <math.h>

#include "base/file.h"
#include "color/observer.h"
#include "comma_locale.h"
#include "expected.h"
#include "metamer/color.h"

static const char *const table_path = "observer_read.csv";

static mtm_status read_text(const char *text, mtm_observer *observer, mtm_error *error) {
    assert_ok(mtm_file_write(table_path, text, strlen(text), error), *error);
    const mtm_status status = mtm_observer_read(table_path, observer, error);
    (void)remove(table_path);
    return status;
}

static void refuse(const char *text, mtm_status status, const char *message) {
    mtm_observer observer;
    mtm_error error;
    assert_fails(read_text(text, &observer, &error), status, error, message);
    assert_non_null(strstr(error.message, table_path));
}

/* The three columns hold 1, 2 and 3, whatever their order. */
static void assert_columns(const char *header, int first, int second, int third, bool is_camera) {
    char text[256];
    mtm_observer observer;
    mtm_error error;
    (void)snprintf(text, sizeof text, "wavelength_nm,%s\n500,%d,%d,%d\n505,%d,%d,%d\n", header, first, second,
                   third, first, second, third);
    assert_ok(read_text(text, &observer, &error), error);
    assert_int_equal(observer.is_camera, is_camera);
    assert_true(observer.x.value[24] == 1 && observer.y.value[24] == 2 && observer.z.value[24] == 3);
    assert_string_equal(observer.name, "observer_read");
}

static void columns_are_known_by_their_names(void **state) {
    (void)state;
    assert_columns("x_bar,y_bar,z_bar", 1, 2, 3, false);
    assert_columns("z_bar,X_BAR,y_bar", 3, 1, 2, false);
    assert_columns("y,z,x", 2, 3, 1, false);
    assert_columns("R,G,B", 1, 2, 3, true);
    assert_columns("b,g,r", 3, 2, 1, true);
    assert_columns("Green,red,BLUE", 2, 1, 3, true);
}

static void other_columns_are_refused(void **state) {
    (void)state;
    refuse("wavelength_nm,x,y\n500,1,1\n", MTM_FORMAT,
           "its 2 columns beside wavelength_nm are x, y, expected three: x_bar, y_bar, z_bar of an observer "
           "or R, G, B "
           "of a camera");
    refuse("wavelength_nm,R,G,B,IR\n500,1,1,1,1\n", MTM_FORMAT,
           "its 4 columns beside wavelength_nm are R, G, B, IR");
    refuse("wavelength_nm,x,y,B\n500,1,1,1\n", MTM_FORMAT, "are x, y, B, expected three");
    refuse("wavelength_nm,R,r,B\n500,1,1,1\n", MTM_FORMAT, "are R, r, B, expected three");
    refuse("wavelength_nm,x_bar,y,z\n500,1,1,1\n", MTM_FORMAT, "are x_bar, y, z, expected three");
    refuse("wavelength_nm,x,y,z\n500,1,1,nan\n", MTM_FORMAT, "'nan'");
    refuse("nothing", MTM_FORMAT, "wavelength_nm");
    mtm_observer observer;
    mtm_error error;
    assert_fails(mtm_observer_read("nowhere/eye.csv", &observer, &error), MTM_IO, error, "nowhere/eye.csv");
}

static void curves_that_cannot_work_are_refused(void **state) {
    (void)state;
    refuse("wavelength_nm,x,y,z\n500,1,0,1\n", MTM_FORMAT,
           "curve y has the sum 0 over 380 to 780 nm, expected a");
    refuse("wavelength_nm,R,G,B\n500,1,1,-1\n", MTM_FORMAT,
           "curve b has the sum -1 over 380 to 780 nm, expected a");
    refuse("wavelength_nm,x,y,z\n500,0,1,1\n", MTM_FORMAT, "curve x has the sum 0");
    refuse("wavelength_nm,x,y,z\n501,1,1,1\n", MTM_FORMAT,
           "curve x has the sum 0"); /* between the grid's samples */
    refuse("wavelength_nm,x,y,z\n500,1,1e-31,1\n", MTM_FORMAT, "curve y has the sum 1e-31");
    refuse("wavelength_nm,R,G,B\n500,1,1e31,1\n", MTM_FORMAT, "curve g has the sum 1e+31");
    refuse("wavelength_nm,x,y,z\n500,1,1,2e6\n", MTM_FORMAT, "curve z is 2e+06 at 500 nm");
    refuse("wavelength_nm,x,y,z\n500,1e308,1,1\n505,1e308,1,1\n", MTM_FORMAT, "curve x is 1e+308 at 500 nm");
}

static void a_failure_leaves_the_observer_as_it_was(void **state) {
    (void)state;
    mtm_observer observer;
    mtm_error error;
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    const mtm_observer before = observer;
    assert_fails(read_text("wavelength_nm,R,G,B\n500,1,0,1\n", &observer, &error), MTM_FORMAT, error,
                 "curve g");
    assert_memory_equal(&observer, &before, sizeof before);
}

static void the_name_is_the_files(void **state) {
    (void)state;
    static const char *const names[][2] = {
        {"my camera.csv", "my camera"}, {"eye.CSV", "eye"}, {"plain", "plain"}, {"\xFF.csv", "observer"}};
    static const char text[] = "wavelength_nm,R,G,B\n500,1,1,1\n";
    mtm_observer observer;
    mtm_error error;
    char longest[80] = "";
    memset(longest, 'n', 62);
    strcat(longest, "\xC3\xA4.csv"); /* the last character that fits has two bytes and does not */
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        assert_ok(mtm_file_write(names[i][0], text, strlen(text), &error), error);
        assert_ok(mtm_observer_read(names[i][0], &observer, &error), error);
        assert_string_equal(observer.name, names[i][1]);
        (void)remove(names[i][0]);
    }
    assert_ok(mtm_file_write(longest, text, strlen(text), &error), error);
    assert_ok(mtm_observer_read(longest, &observer, &error), error);
    assert_int_equal(strlen(observer.name), 62);
    (void)remove(longest);
}

/* Sensitivities are read at the grid's wavelengths, of fine tables too, and there are none beyond a table's ends. */
static void sensitivities_are_interpolated_and_end_in_darkness(void **state) {
    (void)state;
    mtm_observer observer;
    mtm_error error;
    assert_ok(read_text("wavelength_nm,R,G,B\n500,1,1,1\n510,3,1,0\n520,1,1,4\n", &observer, &error), error);
    assert_true(observer.x.value[25] == 2 && observer.z.value[27] == 2); /* 505 and 515 nm */
    assert_true(observer.y.value[23] == 0 && observer.y.value[24] == 1);
    assert_true(observer.y.value[28] == 1 && observer.y.value[29] == 0);
    /* A mean over 5 nm would be 0.2 at 500 nm and something at 505 nm. */
    assert_ok(
        read_text("wavelength_nm,x,y,z\n499,0,1,1\n500,1,1,1\n501,0,1,1\n502,0,1,1\n503,7,1,1\n504,0,1,1\n",
                  &observer, &error),
        error);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        assert_true(observer.x.value[i] == (i == 24));
        assert_true(observer.y.value[i] == (i == 24));
    }
}

static void read_from_data(const char *file, mtm_observer *observer) {
    char path[512];
    mtm_error error;
    (void)snprintf(path, sizeof path, "%s/data/spectra/%s", METAMER_SOURCE_DIR, file);
    assert_ok(mtm_observer_read(path, observer, &error), error);
}

static void the_files_of_the_cie_are_the_known_observers(void **state) {
    (void)state;
    static const char *const pairs[][2] = {{"cie1931", "cie_observer_1931_2deg.csv"},
                                           {"cie1964", "cie_observer_1964_10deg.csv"},
                                           {"cie2015", "cie_observer_2015_2deg.csv"},
                                           {"cie2015_10deg", "cie_observer_2015_10deg.csv"}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        mtm_observer known;
        mtm_observer read;
        mtm_error error;
        assert_ok(mtm_observer_get(pairs[i][0], &known, &error), error);
        read_from_data(pairs[i][1], &read);
        assert_false(read.is_camera);
        assert_memory_equal(&known.x, &read.x, sizeof read.x);
        assert_memory_equal(&known.y, &read.y, sizeof read.y);
        assert_memory_equal(&known.z, &read.z, sizeof read.z);
    }
}

static void every_camera_of_the_data_is_read(void **state) {
    (void)state;
    static const char *const names[] = {"camera_nikon_d5100", "camera_canon_eos_5d_mk2", "camera_sony_a7s2",
                                        "camera_arri_d21"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char file[64];
        mtm_observer camera;
        (void)snprintf(file, sizeof file, "%s.csv", names[i]);
        read_from_data(file, &camera);
        assert_true(camera.is_camera);
        assert_string_equal(camera.name, names[i]);
    }
}

/* Σ light · reflectance · sensor / Σ light · green sensor. */
static void check_chart(const char *light_name, const char *expected_file) {
    char path[512];
    expected_table *expected = read_expected(expected_file);
    mtm_spectrum_table table;
    mtm_observer camera;
    mtm_spectrum light;
    mtm_error error;
    deviation seen = {0};
    (void)snprintf(path, sizeof path, "%s/data/spectra/reflectance_colorchecker_ohta.csv",
                   METAMER_SOURCE_DIR);
    read_from_data("camera_nikon_d5100.csv", &camera);
    assert_ok(mtm_illuminant(light_name, &light, &error), error);
    assert_ok(mtm_spectrum_table_read(path, &table, &error), error);
    assert_int_equal(expected->row_count, 25);
    const double green = mtm_xyz_of(&light, &camera).y;
    for (int row = 0; row < expected->row_count; row++) {
        const char *name = expected->names[row];
        mtm_spectrum reflectance = mtm_spectrum_constant(1); /* the last row is the perfect white */
        if (row < table.column_count)
            assert_ok(
                mtm_spectrum_table_column(&table, path, name, MTM_KIND_REFLECTANCE, &reflectance, &error),
                error);
        const mtm_spectrum stimulus = mtm_spectrum_multiply(&light, &reflectance);
        const mtm_xyz response = mtm_xyz_of(&stimulus, &camera);
        check_near(&seen, response.x / green, expected_value(expected, row, "R"), 1e-8, name, "R");
        check_near(&seen, response.y / green, expected_value(expected, row, "G"), 1e-8, name, "G");
        check_near(&seen, response.z / green, expected_value(expected, row, "B"), 1e-8, name, "B");
    }
    print_message("%s: largest deviation %.2g\n", expected_file, seen.largest);
    mtm_spectrum_table_free(&table);
    free(expected);
}

static void a_camera_sees_the_colorchecker_as_expected(void **state) {
    (void)state;
    check_chart("D65", "camera_nikon_d5100_D65.csv");
    check_chart("A", "camera_nikon_d5100_A.csv");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_are_known_by_their_names),
        cmocka_unit_test(other_columns_are_refused),
        cmocka_unit_test(curves_that_cannot_work_are_refused),
        cmocka_unit_test(a_failure_leaves_the_observer_as_it_was),
        cmocka_unit_test(the_name_is_the_files),
        cmocka_unit_test(sensitivities_are_interpolated_and_end_in_darkness),
        cmocka_unit_test(the_files_of_the_cie_are_the_known_observers),
        cmocka_unit_test(every_camera_of_the_data_is_read),
        cmocka_unit_test(a_camera_sees_the_colorchecker_as_expected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL) + run_group_in_comma_locale(tests);
}
