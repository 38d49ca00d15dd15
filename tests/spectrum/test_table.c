/* SPDX-License-Identifier: BSD-3-Clause */
#include "spectrum/table.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/file.h"
#include "comma_locale.h"
#include "test.h"

static mtm_status parse(const char *text, mtm_spectrum_table *table, mtm_error *error) {
    return mtm_spectrum_table_parse(text, strlen(text), "lamp.csv", table, error);
}

/* The text is refused with this message (file, line, value and all), and nothing is left to free. */
static void refuse(const char *text, mtm_status expected_status, const char *message) {
    mtm_spectrum_table table;
    mtm_error error = {{0}};
    assert_int_equal(parse(text, &table, &error), expected_status);
    assert_string_equal(error.message, message);
    assert_null(table.names);
    assert_null(table.values);
    assert_null(table.wavelength_nm);
}

static void a_table_is_read_as_written(void **state) {
    (void)state;
    mtm_spectrum_table table;
    mtm_error error;
    assert_ok(parse("wavelength_nm,a,b\n380,1,2\n400.5,-3,4e-1\n", &table, &error), error);
    assert_int_equal(table.column_count, 2);
    assert_int_equal(table.row_count, 2);
    assert_string_equal(table.names[0], "a");
    assert_string_equal(table.names[1], "b");
    const double wavelength_nm[] = {380, 400.5};
    const double values[] = {1, 2, -3, 0.4};
    assert_memory_equal(table.wavelength_nm, wavelength_nm, sizeof wavelength_nm);
    assert_memory_equal(table.values, values, sizeof values);
    mtm_spectrum_table_free(&table);
}

static void spreadsheets_and_notes_are_understood(void **state) {
    (void)state;
    const char *text = "\xEF\xBB\xBF# measured by hand\r\n\r\n \"Wavelength_nm\" , \"a, \"\"b\"\"\" ,\tc \r\n"
                       "\r\n# begins here\r\n 400 , 1 ,\"2\"\r\n410,3,4";
    mtm_spectrum_table table;
    mtm_error error;
    assert_ok(parse(text, &table, &error), error);
    assert_string_equal(table.names[0], "a, \"b\"");
    assert_string_equal(table.names[1], "c");
    const double values[] = {1, 2, 3, 4};
    assert_int_equal(table.row_count, 2);
    assert_memory_equal(table.values, values, sizeof values);
    mtm_spectrum_table_free(&table);
}

static void numbers_have_a_decimal_point_in_every_locale(void **state) {
    (void)state;
    mtm_spectrum_table table;
    mtm_error error;
    if (!enter_comma_locale()) skip();
    const mtm_status status = parse("wavelength_nm,a\n500.5,0.25\n", &table, &error);
    leave_comma_locale();
    assert_int_equal(status, MTM_OK);
    assert_true(table.wavelength_nm[0] == 500.5 && table.values[0] == 0.25);
    mtm_spectrum_table_free(&table);
}

static void a_text_without_data_is_refused(void **state) {
    (void)state;
    refuse("", MTM_FORMAT, "lamp.csv: the file is empty, expected a header row wavelength_nm,name,...");
    refuse("\xEF\xBB\xBF\n\r\n# nothing\n", MTM_FORMAT,
           "lamp.csv: the file is empty, expected a header row wavelength_nm,name,...");
    refuse("wavelength_nm,a\n\n# none\n", MTM_FORMAT,
           "lamp.csv: no data after the header row, expected a row per wavelength");
}

static void a_wrong_header_is_refused(void **state) {
    (void)state;
    refuse("\n380,1\n", MTM_FORMAT, "lamp.csv:2: the header row begins with '380', expected wavelength_nm");
    refuse("wavelength_um,a\n0.38,1\n", MTM_FORMAT,
           "lamp.csv:1: the header row begins with 'wavelength_um', expected wavelength_nm");
    refuse("wavelength_nm\n380\n", MTM_FORMAT,
           "lamp.csv:1: the header row has no column beside wavelength_nm, expected at least one");
    refuse("wavelength_nm,a,,c\n380,1,2,3\n", MTM_FORMAT, "lamp.csv:1: column 3 has no name, expected one");
    refuse("wavelength_nm,a,b,\"a\"\n380,1,2,3\n", MTM_FORMAT,
           "lamp.csv:1: columns 2 and 4 are both called 'a', expected different names");
    refuse("wavelength_nm,\"a\n380,1\n", MTM_FORMAT,
           "lamp.csv:1: the quotes of cell 2 do not end it, expected a cell like \"name\" or name");
    refuse("wavelength_nm,\"a\" b\n380,1\n", MTM_FORMAT,
           "lamp.csv:1: the quotes of cell 2 do not end it, expected a cell like \"name\" or name");
}

static void a_row_of_another_length_is_refused(void **state) {
    (void)state;
    refuse("wavelength_nm,a,b\n380,1,2\n# note\n385,1\n", MTM_FORMAT,
           "lamp.csv:4: the row has 2 cells, expected 3 as in the header");
    refuse("wavelength_nm,a,b\n380,1,2,\n", MTM_FORMAT,
           "lamp.csv:2: the row has 4 cells, expected 3 as in the header");
}

static void what_is_no_finite_number_is_refused(void **state) {
    (void)state;
    refuse("wavelength_nm,a,b\n380,1,dark\n", MTM_FORMAT,
           "lamp.csv:2: column 'b' is 'dark', expected a finite number");
    refuse("wavelength_nm,a\n380,\n", MTM_FORMAT, "lamp.csv:2: column 'a' is '', expected a finite number");
    refuse("wavelength_nm,a\n380,nan\n", MTM_FORMAT,
           "lamp.csv:2: column 'a' is 'nan', expected a finite number");
    refuse("wavelength_nm,a\n380,1\n385,-inf\n", MTM_FORMAT,
           "lamp.csv:3: column 'a' is '-inf', expected a finite number");
    refuse("wavelength_nm,a\n380,1e999\n", MTM_FORMAT,
           "lamp.csv:2: column 'a' is '1e999', expected a finite number");
    refuse("wavelength_nm,a\nred,1\n", MTM_FORMAT,
           "lamp.csv:2: column 'wavelength_nm' is 'red', expected a finite number");
    refuse("wavelength_nm,a\n380,1.0 nm\n", MTM_FORMAT,
           "lamp.csv:2: column 'a' is '1.0 nm', expected a finite number");
    char text[400] = "wavelength_nm,a\n380,";
    memset(text + strlen(text), '1', 300);
    refuse(text, MTM_FORMAT,
           "lamp.csv:2: column 'a' is '1111111111111111111111111111111111111111111111111111111111111111', "
           "expected a finite number");
}

static void wavelengths_that_do_not_rise_are_refused(void **state) {
    (void)state;
    refuse("wavelength_nm,a\n380,1\n390,1\n385.5,1\n", MTM_FORMAT,
           "lamp.csv:4: wavelength 385.5 nm, expected one above the row before's 390 nm");
    refuse("wavelength_nm,a\n380,1\n380,1\n", MTM_FORMAT,
           "lamp.csv:3: wavelength 380 nm, expected one above the row before's 380 nm");
}

static void wavelengths_in_another_unit_are_refused(void **state) {
    (void)state;
    refuse("wavelength_nm,a\n0.38,1\n0.78,1\n", MTM_FORMAT,
           "lamp.csv: wavelengths 0.38 to 0.78, expected some within 380 to 780 nm");
    refuse("wavelength_nm,a\n3800,1\n7800,1\n", MTM_FORMAT,
           "lamp.csv: wavelengths 3800 to 7800, expected some within 380 to 780 nm");
}

static void bytes_that_are_no_text_are_refused(void **state) {
    (void)state;
    const char text[] = "wavelength_nm,a\n380,1\0\n";
    mtm_spectrum_table table;
    mtm_error error;
    assert_fails(mtm_spectrum_table_parse(text, sizeof text - 1, "lamp.csv", &table, &error), MTM_FORMAT,
                 error, "lamp.csv: contains a zero byte, expected CSV text");
}

/* A text of `lines` equal lines after a header. */
static char *repeat(const char *header, const char *piece, size_t count) {
    const size_t length = strlen(piece);
    char *text = malloc(strlen(header) + count * length + 1);
    assert_non_null(text);
    char *to = text + sprintf(text, "%s", header);
    for (size_t i = 0; i < count; i++) to += sprintf(to, "%s", piece);
    return text;
}

static void sizes_beyond_the_limits_are_refused(void **state) {
    (void)state;
    char *wide = repeat("wavelength_nm", ",a", 4097);
    refuse(wide, MTM_LIMIT, "lamp.csv:1: more than 4096 columns");
    free(wide);

    enum { ROWS = 100001, LINE = 16 };
    char *text = malloc((size_t)LINE * (ROWS + 2));
    assert_non_null(text);
    char *to = text + sprintf(text, "wavelength_nm,a\n");
    for (int i = 0; i < ROWS; i++) to += sprintf(to, "%d,1\n", 380 + i);
    refuse(text, MTM_LIMIT, "lamp.csv:100002: more than 100000 rows");
    *strrchr(text, '1') = '\0';  /* "…,1\n" becomes "…," */
    *strrchr(text, '\n') = '\0'; /* and the last row is gone: exactly the limit */
    mtm_spectrum_table table;
    mtm_error error;
    assert_ok(parse(text, &table, &error), error);
    assert_int_equal(table.row_count, 100000);
    mtm_spectrum_table_free(&table);
    free(text);

    char *huge = repeat("", "# sixteen bytes\n", ((size_t)64 << 20) / 16 + 1);
    refuse(huge, MTM_LIMIT, "lamp.csv: 67108880 bytes, expected at most 67108864");
    assert_ok(mtm_file_write("huge_table.csv", huge, strlen(huge), &error), error);
    assert_fails(mtm_spectrum_table_read("huge_table.csv", &table, &error), MTM_LIMIT, error,
                 "huge_table.csv");
    (void)remove("huge_table.csv");
    free(huge);
}

static void a_missing_file_is_named(void **state) {
    (void)state;
    mtm_spectrum_table table;
    mtm_spectrum spectrum;
    mtm_error error;
    assert_fails(mtm_spectrum_table_read("nowhere/lamp.csv", &table, &error), MTM_IO, error,
                 "nowhere/lamp.csv");
    assert_fails(mtm_spectrum_read("nowhere", "lamp.csv:a", MTM_KIND_LIGHT, &spectrum, &error), MTM_IO, error,
                 "nowhere/lamp.csv");
}

static void an_unknown_column_names_the_nearest(void **state) {
    (void)state;
    mtm_spectrum_table table;
    mtm_spectrum spectrum;
    mtm_error error;
    assert_ok(parse("wavelength_nm,orange,blue_sky\n500,0.5,0.25\n", &table, &error), error);
    assert_fails(mtm_spectrum_table_column(&table, "lamp.csv", "blue-sky", MTM_KIND_LIGHT, &spectrum, &error),
                 MTM_ARGUMENT, error, "lamp.csv: unknown column 'blue-sky', did you mean 'blue_sky'?");
    assert_ok(mtm_spectrum_table_column(&table, "lamp.csv", "blue_sky", MTM_KIND_LIGHT, &spectrum, &error),
              error);
    assert_true(spectrum.value[0] == 0.25 && spectrum.value[80] == 0.25);
    mtm_spectrum_table_free(&table);
}

static void a_spectrum_is_read_by_file_and_column(void **state) {
    (void)state;
    const char *text = "wavelength_nm,a,b\n380,1,2\n780,1,6\n";
    mtm_spectrum spectrum;
    mtm_error error;
    assert_ok(mtm_file_write("table:1.csv", text, strlen(text), &error), error);
    assert_ok(mtm_spectrum_read(".", "table:1.csv:b", MTM_KIND_REFLECTANCE, &spectrum, &error), error);
    assert_true(spectrum.value[0] == 2 && spectrum.value[40] == 4 && spectrum.value[80] == 6);
    assert_fails(mtm_spectrum_read(".", "table:1.csv:c", MTM_KIND_LIGHT, &spectrum, &error), MTM_ARGUMENT,
                 error, "./table:1.csv: unknown column 'c', did you mean");
    (void)remove("table:1.csv");
}

static void a_reference_without_file_or_column_is_refused(void **state) {
    (void)state;
    const char *const references[] = {"lamp.csv", "lamp.csv:", ":a", ""};
    for (size_t i = 0; i < sizeof references / sizeof *references; i++) {
        mtm_spectrum spectrum;
        mtm_error error;
        assert_fails(mtm_spectrum_read(".", references[i], MTM_KIND_LIGHT, &spectrum, &error), MTM_ARGUMENT,
                     error, ", expected FILE.csv:COLUMN");
        assert_non_null(strstr(error.message, references[i]));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_is_read_as_written),
        cmocka_unit_test(spreadsheets_and_notes_are_understood),
        cmocka_unit_test(numbers_have_a_decimal_point_in_every_locale),
        cmocka_unit_test(a_text_without_data_is_refused),
        cmocka_unit_test(a_wrong_header_is_refused),
        cmocka_unit_test(a_row_of_another_length_is_refused),
        cmocka_unit_test(what_is_no_finite_number_is_refused),
        cmocka_unit_test(wavelengths_that_do_not_rise_are_refused),
        cmocka_unit_test(wavelengths_in_another_unit_are_refused),
        cmocka_unit_test(bytes_that_are_no_text_are_refused),
        cmocka_unit_test(sizes_beyond_the_limits_are_refused),
        cmocka_unit_test(a_missing_file_is_named),
        cmocka_unit_test(an_unknown_column_names_the_nearest),
        cmocka_unit_test(a_spectrum_is_read_by_file_and_column),
        cmocka_unit_test(a_reference_without_file_or_column_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
