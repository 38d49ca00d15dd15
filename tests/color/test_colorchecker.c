/* SPDX-License-Identifier: BSD-3-Clause
 * The whole way from measured reflectances to encoded sRGB, against the tables of tests/data/expected/. */
#include <math.h>

#include "comma_locale.h"
#include "expected.h"
#include "metamer/color.h"

typedef struct chart {
    const char *reflectances; /* in data/spectra/ */
    const char *light;
    const char *expected;
} chart;

/* A light, its white and the adaptation to D65. */
typedef struct viewing {
    mtm_observer observer;
    mtm_spectrum light;
    mtm_xyz white;
    double to_d65[3][3];
} viewing;

static viewing viewing_under(const char *light) {
    viewing v;
    mtm_error error;
    assert_ok(mtm_observer_get("cie1931", &v.observer, &error), error);
    assert_ok(mtm_illuminant(light, &v.light, &error), error);
    assert_ok(mtm_light_normalize(&v.light, &v.observer, &v.light, &error), error);
    v.white = mtm_xyz_of(&v.light, &v.observer);
    mtm_bradford(v.white, mtm_white_d65(), v.to_d65);
    return v;
}

static mtm_xyz adapt(const double matrix[3][3], mtm_xyz v) {
    return (mtm_xyz){matrix[0][0] * v.x + matrix[0][1] * v.y + matrix[0][2] * v.z,
                     matrix[1][0] * v.x + matrix[1][1] * v.y + matrix[1][2] * v.z,
                     matrix[2][0] * v.x + matrix[2][1] * v.y + matrix[2][2] * v.z};
}

static void check_patch(deviation *seen, const expected_table *expected, int row, const viewing *v,
                        const mtm_spectrum *reflectance) {
    const mtm_spectrum stimulus = mtm_spectrum_multiply(&v->light, reflectance);
    const mtm_xyz xyz = mtm_xyz_of(&stimulus, &v->observer);
    const double sum = xyz.x + xyz.y + xyz.z;
    const mtm_lab lab = mtm_lab_from_xyz(xyz, v->white);
    const mtm_rgb plain = mtm_rgb_from_xyz(xyz);
    const mtm_rgb adapted = mtm_rgb_from_xyz(adapt((const double(*)[3])v->to_d65, xyz));
    const struct {
        const char *column;
        double value;
    } checks[] = {
        {"X", 100 * xyz.x},
        {"Y", 100 * xyz.y},
        {"Z", 100 * xyz.z},
        {"x", xyz.x / sum},
        {"y", xyz.y / sum},
        {"L", lab.l},
        {"a", lab.a},
        {"b", lab.b},
        {"lin_R", plain.r},
        {"lin_G", plain.g},
        {"lin_B", plain.b},
        {"enc_R", mtm_srgb_encode(plain.r)},
        {"enc_G", mtm_srgb_encode(plain.g)},
        {"enc_B", mtm_srgb_encode(plain.b)},
        {"linB_R", adapted.r},
        {"linB_G", adapted.g},
        {"linB_B", adapted.b},
        {"encB_R", mtm_srgb_encode(adapted.r)},
        {"encB_G", mtm_srgb_encode(adapted.g)},
        {"encB_B", mtm_srgb_encode(adapted.b)},
    };
    assert_int_equal(expected->column_count, 1 + sizeof checks / sizeof *checks);
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++)
        check_near(seen, checks[i].value, expected_value(expected, row, checks[i].column), 1e-7,
                   expected->names[row], checks[i].column);
}

static void check_chart(const chart *c) {
    char path[512];
    (void)snprintf(path, sizeof path, "%s/data/spectra/%s", METAMER_SOURCE_DIR, c->reflectances);
    expected_table *expected = read_expected(c->expected);
    const viewing v = viewing_under(c->light);
    mtm_spectrum_table table;
    mtm_error error;
    assert_ok(mtm_spectrum_table_read(path, &table, &error), error);
    deviation seen = {0};
    assert_in_range(expected->row_count, 24, 25);
    for (int row = 0; row < expected->row_count; row++) {
        mtm_spectrum reflectance = mtm_spectrum_constant(1); /* the last row is the perfect white */
        if (row < table.column_count)
            assert_ok(mtm_spectrum_table_column(&table, path, expected->names[row], MTM_KIND_REFLECTANCE,
                                                &reflectance, &error),
                      error);
        check_patch(&seen, expected, row, &v, &reflectance);
    }
    print_message("%s: largest deviation %.2g\n", c->expected, seen.largest);
    mtm_spectrum_table_free(&table);
    free(expected);
}

static void the_colorchecker_under_d65_has_the_expected_colors(void **state) {
    (void)state;
    check_chart(&(chart){"reflectance_colorchecker_ohta.csv", "D65", "colorchecker_ohta_D65_2deg.csv"});
}

static void the_colorchecker_under_a_has_the_expected_colors(void **state) {
    (void)state;
    check_chart(&(chart){"reflectance_colorchecker_ohta.csv", "A", "colorchecker_ohta_A_2deg.csv"});
}

static void the_colorchecker_under_fl11_has_the_expected_colors(void **state) {
    (void)state;
    check_chart(&(chart){"reflectance_colorchecker_ohta.csv", "FL11", "colorchecker_ohta_FL11_2deg.csv"});
}

static void a_chart_at_10_nm_has_the_expected_colors(void **state) {
    (void)state;
    check_chart(
        &(chart){"reflectance_colorchecker_babelcolor.csv", "D65", "colorchecker_babelcolor_D65_2deg.csv"});
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_colorchecker_under_d65_has_the_expected_colors),
        cmocka_unit_test(the_colorchecker_under_a_has_the_expected_colors),
        cmocka_unit_test(the_colorchecker_under_fl11_has_the_expected_colors),
        cmocka_unit_test(a_chart_at_10_nm_has_the_expected_colors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL) + run_group_in_comma_locale(tests);
}
