/* SPDX-License-Identifier: BSD-3-Clause */
#include "metamer/spectrum.h"

#include <ctype.h>

#include "test.h"

/* Published values at 380, 560 and 780 nm. */
static void illuminants_have_their_published_values(void **state) {
    (void)state;
    const struct {
        const char *name;
        double first, middle, last;
    } published[] = {
        {"A", 9.7951, 100, 241.675},    {"C", 33.0, 105.3, 59.1},
        {"D65", 49.9755, 100, 63.3828}, {"E", 1, 1, 1},
        {"FL2", 1.18, 16.16, 0.27},     {"FL11", 0.91, 2.83, 0.09},
        {"FL3.15", 300, 368, 37},       {"HP1", 1.9, 20.78, 6.69},
        {"LED-B1", 0, 14.23, 0.61},
    };
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        mtm_spectrum light;
        mtm_error error;
        assert_ok(mtm_illuminant(published[i].name, &light, &error), error);
        assert_float_equal(light.value[0], published[i].first, 1e-4);
        assert_float_equal(light.value[36], published[i].middle, 1e-4);
        assert_float_equal(light.value[80], published[i].last, 1e-4);
    }
}

static void every_name_is_known_in_any_case(void **state) {
    (void)state;
    assert_int_equal(mtm_illuminant_count(), 48);
    for (int i = 0; i < mtm_illuminant_count(); i++) {
        char name[32] = {0};
        for (int j = 0; mtm_illuminant_name(i)[j] != '\0'; j++)
            name[j] = (char)tolower((unsigned char)mtm_illuminant_name(i)[j]);
        mtm_spectrum upper, lower;
        mtm_error error;
        assert_ok(mtm_illuminant(mtm_illuminant_name(i), &upper, &error), error);
        assert_ok(mtm_illuminant(name, &lower, &error), error);
        assert_memory_equal(&upper, &lower, sizeof upper);
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) assert_true(upper.value[k] >= 0);
    }
}

static void names_come_in_the_documented_order(void **state) {
    (void)state;
    assert_string_equal(mtm_illuminant_name(0), "A");
    assert_string_equal(mtm_illuminant_name(6), "E");
    assert_string_equal(mtm_illuminant_name(18), "FL12");
    assert_string_equal(mtm_illuminant_name(33), "FL3.15");
    assert_string_equal(mtm_illuminant_name(38), "HP5");
    assert_string_equal(mtm_illuminant_name(47), "LED-V2");
    assert_null(mtm_illuminant_name(-1));
    assert_null(mtm_illuminant_name(48));
}

static void an_unknown_illuminant_names_the_nearest(void **state) {
    (void)state;
    mtm_spectrum light;
    mtm_error error;
    assert_fails(mtm_illuminant("d56", &light, &error), MTM_ARGUMENT, error,
                 "unknown illuminant 'd56', did you mean 'D50'?");
    assert_fails(mtm_illuminant("LEDB3", &light, &error), MTM_ARGUMENT, error, "'LED-B3'");
    assert_fails(mtm_illuminant("", &light, &error), MTM_ARGUMENT, error, "unknown illuminant ''");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(illuminants_have_their_published_values),
        cmocka_unit_test(every_name_is_known_in_any_case),
        cmocka_unit_test(names_come_in_the_documented_order),
        cmocka_unit_test(an_unknown_illuminant_names_the_nearest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
