/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/table_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "test.h"

static const double curves[] = {0.25, -1, 7, 1.0 / 3, 0, 8};
static const table_columns groups[] = {{"a", 1, curves, 3}, {"b", 1, curves + 3, 3}};

static void a_table_has_a_header_and_twelve_decimals(void **state) {
    (void)state;
    char folder[] = "table-XXXXXX";
    char path[64], text[256];
    mtm_error error;
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/t.csv", folder);
    for (int time = 0; time < 2; time++) { /* the second replaces the first */
        assert_ok(table_write(folder, "t.csv", 400, 2, 2, groups, &error), error);
        FILE *stream = fopen(path, "r");
        assert_non_null(stream);
        text[fread(text, 1, sizeof text - 1, stream)] = '\0';
        (void)fclose(stream);
        assert_string_equal(text, "wavelength_nm,a_1,b_1\n400,0.250000000000,0.333333333333\n"
                                  "405,-1.000000000000,0.000000000000\n");
    }
    assert_int_equal(remove(path), 0);
    assert_int_equal(rmdir(folder), 0); /* nothing else is left in it */
}

static void a_table_that_cannot_be_written_is_an_error(void **state) {
    (void)state;
    char long_name[5000];
    mtm_error error;
    assert_fails(table_write("no-folder", "t.csv", 400, 2, 2, groups, &error), MTM_IO, error,
                 "no-folder/t.csv");
    memset(long_name, 'x', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    assert_fails(table_write(".", long_name, 400, 2, 2, groups, &error), MTM_LIMIT, error, "too long");
    char folder[] = "table-XXXXXX";
    assert_non_null(mkdtemp(folder));
    assert_fails(table_write(".", folder, 400, 2, 2, groups, &error), MTM_IO, error, "cannot be written");
    assert_int_equal(rmdir(folder), 0);
    (void)snprintf(long_name, sizeof long_name, "%s.part", folder);
    assert_int_not_equal(access(long_name, F_OK), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_has_a_header_and_twelve_decimals),
        cmocka_unit_test(a_table_that_cannot_be_written_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
