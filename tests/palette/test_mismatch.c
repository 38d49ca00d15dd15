/* SPDX-License-Identifier: BSD-3-Clause
 * The widest separation of metamers: what holds of every pair, and all metamers of a case small enough to try them. */
#include <math.h>

#include "base/linear.h"
#include "fixture.h"
#include "metamer/palette.h"

static mtm_mismatch find(const char *first, const char *second, const mtm_spectrum *reflectance,
                         double bend) {
    mtm_error error;
    mtm_mismatch found;
    const mtm_illumination a = fixture_illumination(first);
    const mtm_illumination b = fixture_illumination(second);
    assert_ok(mtm_mismatch_find(&a, &b, mtm_illuminate(&a, reflectance), bend, &found, &error), error);
    return found;
}

static void assert_same_color(mtm_rgb a, mtm_rgb b, double tolerance) {
    assert_near(a.r, b.r, tolerance);
    assert_near(a.g, b.g, tolerance);
    assert_near(a.b, b.b, tolerance);
}

static const char *const lights[][2] = {{"D65", "A"}, {"D65", "FL11"}, {"FL11", "A"}, {"LED-B1", "D65"}};

static void both_are_physical_match_and_part_as_said(void **state) {
    (void)state;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    fixture_reflectances(reflectances);
    for (int n = 0; n < 4; n++)
        for (int i = 0; i < FIXTURE_MATERIALS; i++) {
            const mtm_mismatch found = find(lights[n][0], lights[n][1], &reflectances[i], 0);
            const mtm_illumination first = fixture_illumination(lights[n][0]);
            const mtm_illumination second = fixture_illumination(lights[n][1]);
            mtm_lab labs[2];
            for (int side = 0; side < 2; side++) {
                const mtm_spectrum *metamer = &found.reflectances[side];
                for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
                    assert_true(metamer->value[k] >= 0 && metamer->value[k] <= 1);
                assert_same_color(mtm_illuminate(&first, metamer), mtm_illuminate(&first, &reflectances[i]),
                                  1e-6);
                labs[side] = mtm_lab_shown(mtm_illuminate(&second, metamer));
            }
            assert_near(found.separation, mtm_ciede2000(labs[0], labs[1]), 1e-9);
            assert_true(found.separation > 3);
        }
}

static double largest_bend(const mtm_spectrum *spectrum) {
    double largest = 0;
    for (int k = 1; k + 1 < MTM_SPECTRUM_SAMPLES; k++)
        largest =
            fmax(largest, fabs(spectrum->value[k - 1] - 2 * spectrum->value[k] + spectrum->value[k + 1]));
    return largest;
}

static void smoother_reflectances_part_less(void **state) {
    (void)state;
    static const double bends[] = {0.001, 0.005, 0.02, 0.1, 0};
    const mtm_spectrum gray = mtm_spectrum_constant(0.4);
    for (int n = 0; n < 4; n++) {
        double before = 0;
        for (int i = 0; i < 5; i++) {
            const mtm_mismatch found = find(lights[n][0], lights[n][1], &gray, bends[i]);
            assert_true(found.separation > before);
            before = found.separation;
            for (int side = 0; side < 2 && bends[i] > 0; side++)
                assert_true(largest_bend(&found.reflectances[side]) <= bends[i] * (1 + 1e-6) + 1e-8);
        }
    }
}

/* Against the second light's own white, measured apart from the library: D65 to A 22.8, with curves on a grid of 10 nm of
 * second differences up to 0.02 13.0; on 5 nm those are a quarter. */
static void a_gray_parts_from_its_metamers_as_measured_elsewhere(void **state) {
    (void)state;
    const mtm_spectrum gray = mtm_spectrum_constant(0.4);
    const mtm_spectrum white = mtm_spectrum_constant(1);
    const mtm_illumination second = fixture_illumination("A");
    const mtm_xyz own_white = mtm_xyz_from_rgb(mtm_illuminate(&second, &white));
    const double expected[] = {22.8, 13.0};
    for (int smooth = 0; smooth < 2; smooth++) {
        const mtm_mismatch found = find("D65", "A", &gray, smooth ? 0.005 : 0);
        const mtm_lab from = mtm_lab_from_xyz(mtm_xyz_from_rgb(mtm_illuminate(&second, &gray)), own_white);
        double farthest = 0;
        for (int side = 0; side < 2; side++) {
            const mtm_rgb rgb = mtm_illuminate(&second, &found.reflectances[side]);
            farthest =
                fmax(farthest, mtm_ciede2000(from, mtm_lab_from_xyz(mtm_xyz_from_rgb(rgb), own_white)));
        }
        print_message("%.2f, expected %.1f\n", farthest, expected[smooth]);
        assert_near(farthest, expected[smooth], 0.5);
    }
}

enum { LINES = 5, CORNERS_MAX = 40, SHARES = 40 };

static const int lines[LINES] = {14, 26, 34, 42, 52}; /* 450, 510, 550, 590, 640 nm */

/* A light of five lines. */
static mtm_illumination line_light(const double powers[LINES]) {
    mtm_error error;
    mtm_observer observer;
    mtm_spectrum light = {{0}};
    mtm_spectrum normalized;
    for (int i = 0; i < LINES; i++) light.value[lines[i]] = powers[i];
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_light_normalize(&light, &observer, &normalized, &error), error);
    return mtm_illumination_of(&normalized, &observer, 0);
}

/* The reflectance with two lines fixed that shows the color; whether it is physical. */
static bool solve_corner(const mtm_illumination *light, mtm_rgb color, const int fixed[2],
                         const double values[2], mtm_spectrum *corner) {
    mtm_matrix3 matrix;
    mtm_matrix3 inverse;
    int free_lines[3];
    int count = 0;
    *corner = mtm_spectrum_constant(0);
    for (int i = 0; i < LINES; i++)
        if (i != fixed[0] && i != fixed[1]) free_lines[count++] = lines[i];
    for (int i = 0; i < 2; i++) corner->value[lines[fixed[i]]] = values[i];
    const mtm_rgb part = mtm_illuminate(light, corner);
    const double rest[3] = {color.r - part.r, color.g - part.g, color.b - part.b};
    for (int j = 0; j < 3; j++) {
        mtm_spectrum one = {{0}};
        one.value[free_lines[j]] = 1;
        const mtm_rgb column = mtm_illuminate(light, &one);
        matrix.m[0][j] = column.r;
        matrix.m[1][j] = column.g;
        matrix.m[2][j] = column.b;
    }
    if (!mtm_matrix3_invert(matrix, &inverse)) return false;
    bool is_physical = true;
    for (int j = 0; j < 3; j++) {
        double *value = &corner->value[free_lines[j]];
        for (int i = 0; i < 3; i++) *value += inverse.m[j][i] * rest[i];
        is_physical = is_physical && *value >= -1e-12 && *value <= 1 + 1e-12;
    }
    return is_physical;
}

static int find_corners(const mtm_illumination *light, mtm_rgb color, mtm_spectrum corners[CORNERS_MAX]) {
    int count = 0;
    for (int a = 0; a < LINES; a++)
        for (int b = a + 1; b < LINES; b++)
            for (int bits = 0; bits < 4; bits++)
                count += solve_corner(light, color, (const int[2]){a, b},
                                      (const double[2]){bits % 2, bits / 2}, &corners[count]);
    return count;
}

/* Five lines and three sums leave a polygon of metamers. Its corners have two lines at 0 or 1; the widest pair is looked
 * for among many points of its edges and diagonals. */
static void no_pair_of_all_metamers_of_a_small_case_is_wider(void **state) {
    (void)state;
    const mtm_illumination first = line_light((const double[LINES]){1, 1, 1, 1, 1});
    const mtm_illumination second = line_light((const double[LINES]){0.6, 1.5, 0.3, 1.2, 0.8});
    static const double levels[][LINES] = {
        {0.4, 0.4, 0.4, 0.4, 0.4}, {0.2, 0.7, 0.5, 0.3, 0.6}, {0.7, 0.3, 0.4, 0.2, 0.1}};
    for (int n = 0; n < 3; n++) {
        mtm_error error;
        mtm_mismatch found;
        mtm_spectrum corners[CORNERS_MAX];
        static mtm_lab points[CORNERS_MAX * CORNERS_MAX * SHARES];
        mtm_spectrum reflectance = {{0}};
        for (int i = 0; i < LINES; i++) reflectance.value[lines[i]] = levels[n][i];
        const mtm_rgb color = mtm_illuminate(&first, &reflectance);
        const int count = find_corners(&first, color, corners);
        assert_in_range(count, 3, 10);
        int point_count = 0;
        for (int a = 0; a < count; a++)
            for (int b = 0; b < a; b++)
                for (int share = 0; share <= SHARES; share++) {
                    mtm_spectrum mixed;
                    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
                        mixed.value[k] = corners[a].value[k] +
                                         share * (corners[b].value[k] - corners[a].value[k]) / SHARES;
                    points[point_count++] = mtm_lab_shown(mtm_illuminate(&second, &mixed));
                }
        double widest = 0;
        for (int a = 0; a < point_count; a++)
            for (int b = 0; b < a; b++) widest = fmax(widest, mtm_ciede2000(points[a], points[b]));
        assert_ok(mtm_mismatch_find(&first, &second, color, 0, &found, &error), error);
        print_message("%d corners: %.3f, found %.3f\n", count, widest, found.separation);
        assert_near(found.separation, widest, 0.01 * widest);
    }
}

/* Against 606 directions and 12 starts, which take a hundred times longer, where the first directions alone give a tenth
 * less. */
static void little_is_missed_with_few_directions(void **state) {
    (void)state;
    static const struct {
        const char *first, *second, *hex;
        double bend, separation;
    } cases[] = {{"FL11", "HP1", "#808080", 0, 88.554},
                 {"FL11", "LED-RGB1", "#c04040", 0.01, 12.622},
                 {"HP1", "LED-RGB1", "#4060c0", 0, 107.706},
                 {"A", "FL11", "#808080", 0, 110.652}};
    for (int n = 0; n < 4; n++) {
        mtm_error error;
        mtm_rgb color;
        mtm_spectrum reflectance;
        assert_ok(mtm_rgb_parse(cases[n].hex, &color, &error), error);
        assert_ok(mtm_reflectance_of_rgb(color, &reflectance, &error), error);
        const mtm_mismatch found = find(cases[n].first, cases[n].second, &reflectance, cases[n].bend);
        print_message("%.3f of %.3f\n", found.separation, cases[n].separation);
        assert_true(found.separation > 0.97 * cases[n].separation);
        assert_true(found.separation < 1.005 * cases[n].separation);
    }
}

static void white_has_no_other_metamer(void **state) {
    (void)state;
    for (int n = 0; n < 2; n++) {
        const mtm_spectrum plain = mtm_spectrum_constant(n);
        assert_near(find("D65", "A", &plain, 0).separation, 0, 0.01);
    }
}

static void nothing_parts_under_the_same_light(void **state) {
    (void)state;
    const mtm_spectrum gray = mtm_spectrum_constant(0.4);
    assert_near(find("FL11", "FL11", &gray, 0).separation, 0, 1e-3);
}

static void a_color_that_no_reflectance_has_is_refused(void **state) {
    (void)state;
    mtm_error error;
    mtm_mismatch found;
    const mtm_illumination day = fixture_illumination("D65");
    const mtm_illumination lamp = fixture_illumination("A");
    assert_fails(mtm_mismatch_find(&day, &lamp, (mtm_rgb){0, 1.2, 0}, 0, &found, &error), MTM_NUMERIC, error,
                 "no reflectance between 0 and 1 has the linear sRGB color (0, 1.2, 0)");
    assert_fails(mtm_mismatch_find(&day, &lamp, (mtm_rgb){0.8, 0, 0}, 0.001, &found, &error), MTM_NUMERIC,
                 error, "second differences up to 0.001");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_are_physical_match_and_part_as_said),
        cmocka_unit_test(smoother_reflectances_part_less),
        cmocka_unit_test(a_gray_parts_from_its_metamers_as_measured_elsewhere),
        cmocka_unit_test(no_pair_of_all_metamers_of_a_small_case_is_wider),
        cmocka_unit_test(little_is_missed_with_few_directions),
        cmocka_unit_test(white_has_no_other_metamer),
        cmocka_unit_test(nothing_parts_under_the_same_light),
        cmocka_unit_test(a_color_that_no_reflectance_has_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
