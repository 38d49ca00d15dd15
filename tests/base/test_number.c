/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/number.h"

#include <math.h>
#include <stdlib.h>

#include "comma_locale.h"

static void a_number_is_read_and_written_whatever_the_locale(void **state) {
    (void)state;
    double value = 0;
    char text[MTM_NUMBER_TEXT];
    if (!enter_comma_locale()) skip();
    assert_true(mtm_number_parse(" 1.5e2 ", &value));
    (void)mtm_number_format(0.25, text);
    leave_comma_locale();
    assert_float_equal(value, 150.0, 0.0);
    assert_string_equal(text, "0.25");
}

static void text_that_is_no_number_is_refused(void **state) {
    (void)state;
    double value = 7;
    assert_false(mtm_number_parse("", &value));
    assert_false(mtm_number_parse("1,5", &value));
    assert_false(mtm_number_parse("1.5 x", &value));
    assert_float_equal(value, 7.0, 0.0);
}

static void an_integer_beyond_int_is_refused(void **state) {
    (void)state;
    int value = 7;
    assert_true(mtm_integer_parse("-12", &value));
    assert_int_equal(value, -12);
    assert_false(mtm_integer_parse("99999999999", &value));
    assert_false(mtm_integer_parse("1.5", &value));
}

static void formatted_numbers_read_back_as_the_same_double(void **state) {
    (void)state;
    const double numbers[] = {0.1, 1.0 / 3.0, 1e-300, 380.0, -2.5, 0x1.fffffffffffffp+1023};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        char text[MTM_NUMBER_TEXT];
        double value = 0;
        assert_true(mtm_number_parse(mtm_number_format(numbers[i], text), &value));
        assert_true(value == numbers[i]);
    }
    char text[MTM_NUMBER_TEXT];
    assert_string_equal(mtm_number_format(0.1, text), "0.1");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_number_is_read_and_written_whatever_the_locale),
        cmocka_unit_test(text_that_is_no_number_is_refused),
        cmocka_unit_test(an_integer_beyond_int_is_refused),
        cmocka_unit_test(formatted_numbers_read_back_as_the_same_double),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
