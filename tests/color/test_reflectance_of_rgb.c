/* SPDX-License-Identifier: BSD-3-Clause
 * Burns' smoothest reflectances: color, bounds, and the conditions that only the minimum fulfils. */
#include <math.h>

#include "base/linear.h"
#include "color/smoothest.h"
#include "expected.h"
#include "metamer/color.h"

enum { N = MTM_SPECTRUM_SAMPLES, LEVELS = 9 };

/* The weights of linear red, green and blue at each wavelength under D65, each summing to 1. */
static void fill_weights(double weights[3][N]) {
    mtm_observer observer;
    mtm_spectrum light;
    mtm_error error;
    double matrix[3][3];
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_illuminant("D65", &light, &error), error);
    mtm_rgb_from_xyz_matrix(matrix);
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < N; i++) {
            weights[k][i] =
                light.value[i] * (matrix[k][0] * observer.x.value[i] + matrix[k][1] * observer.y.value[i] +
                                  matrix[k][2] * observer.z.value[i]);
            sum += weights[k][i];
        }
        for (int i = 0; i < N; i++) weights[k][i] /= sum;
    }
}

/* The color through the public path, against rgb scaled to the white of the tabulated D65. */
static double color_error(const mtm_spectrum *reflectance, mtm_rgb rgb) {
    mtm_observer observer;
    mtm_spectrum light;
    mtm_error error;
    assert_ok(mtm_observer_get("cie1931", &observer, &error), error);
    assert_ok(mtm_illuminant("D65", &light, &error), error);
    assert_ok(mtm_light_normalize(&light, &observer, &light, &error), error);
    const mtm_spectrum stimulus = mtm_spectrum_multiply(&light, reflectance);
    const mtm_rgb white = mtm_rgb_from_xyz(mtm_xyz_of(&light, &observer));
    const mtm_rgb shown = mtm_rgb_from_xyz(mtm_xyz_of(&stimulus, &observer));
    return fmax(fabs(shown.r - rgb.r * white.r),
                fmax(fabs(shown.g - rgb.g * white.g), fabs(shown.b - rgb.b * white.b)));
}

/* Half the derivative of Σ(ρᵢ₊₁ − ρᵢ)² by ρᵢ. */
static double slope_gradient(const mtm_spectrum *s, int i) {
    double gradient = 0;
    if (i > 0) gradient += s->value[i] - s->value[i - 1];
    if (i < N - 1) gradient += s->value[i] - s->value[i + 1];
    return gradient;
}

static bool is_free(double value) {
    return value > 0 && value < 1;
}

/* The three multipliers that explain the gradient at the free samples best (least squares). False where too few
 * samples are free. */
static bool find_multipliers(const mtm_spectrum *s, double weights[3][N], double multipliers[3]) {
    double normal[3][3] = {{0}};
    memset(multipliers, 0, 3 * sizeof *multipliers);
    for (int i = 0; i < N; i++) {
        if (!is_free(s->value[i])) continue;
        for (int k = 0; k < 3; k++) {
            multipliers[k] += weights[k][i] * slope_gradient(s, i);
            for (int l = 0; l <= k; l++) normal[k][l] += weights[k][i] * weights[l][i];
        }
    }
    if (!mtm_cholesky_factor(3, 3, normal[0])) return false;
    mtm_cholesky_solve(3, 3, normal[0], multipliers);
    return true;
}

/* Karush, Kuhn, Tucker: the gradient minus the multipliers' weights is 0 at free samples, ≥ 0 at 0 and ≤ 0 at 1.
 * The program is convex, so this holds at the minimum only. Returns the largest violation. */
static double optimality_error(const mtm_spectrum *s, double weights[3][N]) {
    double multipliers[3];
    assert_true(find_multipliers(s, weights, multipliers));
    double worst = 0;
    for (int i = 0; i < N; i++) {
        double residual = slope_gradient(s, i);
        for (int k = 0; k < 3; k++) residual -= multipliers[k] * weights[k][i];
        const double violation = is_free(s->value[i]) ? fabs(residual)
                                 : s->value[i] == 0   ? -residual
                                                      : residual;
        worst = fmax(worst, violation);
    }
    return worst;
}

static void every_srgb_color_has_its_smoothest_bounded_reflectance(void **state) {
    (void)state;
    double weights[3][N];
    fill_weights(weights);
    deviation color = {0}, optimality = {0};
    int bound_colors = 0;
    for (int code = 0; code < LEVELS * LEVELS * LEVELS; code++) {
        const mtm_rgb rgb = {mtm_srgb_decode(code % LEVELS / (LEVELS - 1.0)),
                             mtm_srgb_decode(code / LEVELS % LEVELS / (LEVELS - 1.0)),
                             mtm_srgb_decode(code / LEVELS / LEVELS / (LEVELS - 1.0))};
        char name[64];
        (void)snprintf(name, sizeof name, "(%g, %g, %g)", rgb.r, rgb.g, rgb.b);
        mtm_spectrum s;
        mtm_error error;
        assert_ok(mtm_reflectance_of_rgb(rgb, &s, &error), error);
        bool is_bound = false;
        for (int i = 0; i < N; i++) {
            if (!(s.value[i] >= 0 && s.value[i] <= 1))
                fail_msg("%s: %.17g at sample %d", name, s.value[i], i);
            is_bound |= !is_free(s.value[i]);
        }
        bound_colors += is_bound;
        check_near(&color, color_error(&s, rgb), 0, 1e-10, name, "color");
        if (code != 0 && code != LEVELS * LEVELS * LEVELS - 1)
            check_near(&optimality, optimality_error(&s, weights), 0, 1e-9, name, "optimality");
    }
    print_message("%d of %d touch a bound; largest color error %.2g, optimality error %.2g\n", bound_colors,
                  LEVELS * LEVELS * LEVELS, color.largest, optimality.largest);
}

static void colors_near_black_and_white_are_reached(void **state) {
    (void)state;
    const double steps[] = {1e-2, 1.0 / 255 / 12.92, 1e-6, 1e-9};
    for (int code = 1; code < 8; code++) {
        for (int i = 0; i < 4; i++) {
            const mtm_rgb dark = {steps[i] * (code & 1), steps[i] * (code >> 1 & 1),
                                  steps[i] * (code >> 2 & 1)};
            const mtm_rgb bright = {1 - dark.r, 1 - dark.g, 1 - dark.b};
            mtm_spectrum s;
            mtm_error error;
            assert_ok(mtm_reflectance_of_rgb(dark, &s, &error), error);
            assert_float_equal(color_error(&s, dark), 0, 1e-10);
            assert_ok(mtm_reflectance_of_rgb(bright, &s, &error), error);
            assert_float_equal(color_error(&s, bright), 0, 1e-10);
            for (int k = 0; k < N; k++) assert_true(s.value[k] >= 0 && s.value[k] <= 1);
        }
    }
}

static void white_is_all_ones_black_all_zeros_and_gray_constant(void **state) {
    (void)state;
    for (int level = 0; level <= 10; level++) {
        const double gray = level / 10.0;
        mtm_spectrum s;
        mtm_error error;
        assert_ok(mtm_reflectance_of_rgb((mtm_rgb){gray, gray, gray}, &s, &error), error);
        for (int i = 0; i < N; i++) {
            if (level == 0 || level == 10) assert_true(s.value[i] == gray);
            assert_float_equal(s.value[i], gray, 1e-13);
        }
    }
}

/* The bounds treat 0 and 1 alike, so the reflectance of the complement is the complement of the reflectance. */
static void complements_have_complementary_reflectances(void **state) {
    (void)state;
    const mtm_rgb colors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.9, 0.2, 0.05}, {0.3, 0.3, 0.8}};
    for (int c = 0; c < 5; c++) {
        mtm_spectrum s, other;
        mtm_error error;
        assert_ok(mtm_reflectance_of_rgb(colors[c], &s, &error), error);
        assert_ok(mtm_reflectance_of_rgb((mtm_rgb){1 - colors[c].r, 1 - colors[c].g, 1 - colors[c].b}, &other,
                                         &error),
                  error);
        for (int i = 0; i < N; i++) assert_float_equal(s.value[i] + other.value[i], 1, 1e-9);
    }
}

static double next_number(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)*seed / 4294967296.0;
}

static double slope_of(const mtm_spectrum *s) {
    double sum = 0;
    for (int i = 0; i + 1 < N; i++) sum += (s->value[i + 1] - s->value[i]) * (s->value[i + 1] - s->value[i]);
    return sum;
}

/* By brute force: small random metameric changes (four random samples, of which three undo what the fourth does to
 * the three sums) never make the curve smoother. */
static void no_metameric_change_makes_it_smoother(void **state) {
    (void)state;
    double weights[3][N];
    fill_weights(weights);
    mtm_spectrum s;
    mtm_error error;
    uint32_t seed = 11;
    assert_ok(mtm_reflectance_of_rgb((mtm_rgb){0.05, 0.1, 0.8}, &s, &error), error);
    const double smoothest = slope_of(&s);
    int tried = 0;
    for (int trial = 0; trial < 20000; trial++) {
        int at[4];
        for (int k = 0; k < 4; k++) at[k] = (int)(N * next_number(&seed));
        mtm_matrix3 three, inverse;
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++) three.m[k][l] = weights[k][at[l]];
        if (!mtm_matrix3_invert(three, &inverse)) continue;
        const double change = 1e-4 * (next_number(&seed) - 0.5);
        mtm_spectrum changed = s;
        changed.value[at[3]] += change;
        for (int l = 0; l < 3; l++)
            for (int k = 0; k < 3; k++) changed.value[at[l]] -= inverse.m[l][k] * weights[k][at[3]] * change;
        bool is_bounded = true;
        for (int i = 0; i < N; i++) is_bounded &= changed.value[i] >= 0 && changed.value[i] <= 1;
        if (!is_bounded || color_error(&changed, (mtm_rgb){0.05, 0.1, 0.8}) > 1e-12) continue;
        /* The color kept to 1e-12 leaves that much times the multipliers, which are about 1. */
        assert_true(slope_of(&changed) >= smoothest - 1e-11);
        tried++;
    }
    assert_in_range(tried, 1000, 20000);
}

/* Sums of rough curves near the edge of what is possible, far outside sRGB: bounds are taken up and given back. */
static void sums_of_rough_curves_have_their_smoothest_curve_too(void **state) {
    (void)state;
    double weights[3][N];
    fill_weights(weights);
    mtm_spectrum rows[3];
    for (int k = 0; k < 3; k++) memcpy(rows[k].value, weights[k], sizeof rows[k].value);
    uint32_t seed = 3;
    deviation sums = {0}, optimality = {0};
    for (int trial = 0; trial < 300; trial++) {
        const int from = (int)(N * next_number(&seed));
        const int to = from + 1 + (int)((N - from) * next_number(&seed));
        const double low = 0.01 * next_number(&seed);
        double target[3] = {0};
        for (int i = 0; i < N; i++)
            for (int k = 0; k < 3; k++) target[k] += weights[k][i] * (i >= from && i < to ? 1 - low : low);
        mtm_spectrum s;
        mtm_error error;
        assert_ok(mtm_smoothest_curve(rows, target, &s, &error), error);
        for (int k = 0; k < 3; k++) {
            double sum = 0;
            for (int i = 0; i < N; i++) sum += weights[k][i] * s.value[i];
            check_near(&sums, sum, target[k], 1e-9, "rough curve", "sum");
        }
        check_near(&optimality, optimality_error(&s, weights), 0, 1e-7, "rough curve", "optimality");
    }
    print_message("largest sum error %.2g, optimality error %.2g\n", sums.largest, optimality.largest);
}

static void the_result_repeats_bit_by_bit(void **state) {
    (void)state;
    mtm_spectrum first, second;
    mtm_error error;
    assert_ok(mtm_reflectance_of_rgb((mtm_rgb){0.9, 0.01, 0.4}, &first, &error), error);
    assert_ok(mtm_reflectance_of_rgb((mtm_rgb){0.9, 0.01, 0.4}, &second, &error), error);
    assert_memory_equal(&first, &second, sizeof first);
}

static void colors_outside_the_cube_are_refused(void **state) {
    (void)state;
    const mtm_rgb colors[] = {{-0.01, 0, 0}, {0, 1.01, 0}, {0, 0, NAN}, {INFINITY, 0, 0}};
    for (int i = 0; i < 4; i++) {
        mtm_spectrum s;
        mtm_error error;
        assert_fails(mtm_reflectance_of_rgb(colors[i], &s, &error), MTM_ARGUMENT, error,
                     "expected channels of 0 to 1");
    }
}

/* No color of the cube lacks a reflectance, so the contradiction is shown on the program itself: a sum above that
 * of all ones, and a monochromatic red brighter than any bounded curve is. */
static void sums_that_no_bounded_curve_has_are_refused(void **state) {
    (void)state;
    double weights[3][N];
    fill_weights(weights);
    mtm_spectrum rows[3];
    for (int k = 0; k < 3; k++) memcpy(rows[k].value, weights[k], sizeof rows[k].value);
    const double targets[][3] = {{1.01, 1.01, 1.01}, {-0.01, 0, 0}, {2, 0, 0}, {0, 0, 3}, {1.2, -0.5, 0}};
    for (int i = 0; i < 5; i++) {
        mtm_spectrum s;
        mtm_error error;
        assert_fails(mtm_smoothest_curve(rows, targets[i], &s, &error), MTM_NUMERIC, error,
                     "no curve within 0 to 1");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_srgb_color_has_its_smoothest_bounded_reflectance),
        cmocka_unit_test(colors_near_black_and_white_are_reached),
        cmocka_unit_test(white_is_all_ones_black_all_zeros_and_gray_constant),
        cmocka_unit_test(complements_have_complementary_reflectances),
        cmocka_unit_test(no_metameric_change_makes_it_smoother),
        cmocka_unit_test(sums_of_rough_curves_have_their_smoothest_curve_too),
        cmocka_unit_test(the_result_repeats_bit_by_bit),
        cmocka_unit_test(colors_outside_the_cube_are_refused),
        cmocka_unit_test(sums_that_no_bounded_curve_has_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
