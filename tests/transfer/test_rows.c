/* SPDX-License-Identifier: BSD-3-Clause
 * The summed-up rows of the transfer function against the transfer function itself. */
#include "transfer/rows.h"

#include <stdio.h>

#include "fixture.h"

enum { ROWS_MOST = 65536, POINTS = 7 };

/* Voxels with stored values low … high, and where the points' first and last physical values are. */
typedef struct rows_case {
    const char *name;
    double low, high;
    bool is_integer;
    double slope, intercept;
    double first, last;
} rows_case;

static const rows_case cases[] = {
    {"bytes", 0, 255, true, 1, 0, 20, 230},
    {"bytes, points beyond", 0, 255, true, 1, 0, -100, 400},
    {"signed bytes, falling", -128, 127, true, -0.5, 3, -50, 60},
    {"tomography", 0, 4095, true, 1, -1024, -800, 2000},
    {"words, points close together", 0, 65535, true, 0.001, 0, 30, 30.2},
    {"64 bits", -1e15, 1e15, true, 1e-15, 0, -0.7, 0.6},
    {"few integers", 3, 5, true, 1, 0, 3.2, 4.9},
    {"floats", 0, 1, false, 1, 0, 0.1, 0.9},
    {"floats, falling", -3, 9, false, -2, 1, -15, 6},
    {"huge floats", -1e30, 1e30, false, 1, 0, -5e29, 9e29},
    {"tiny floats", 0, 1e-30, false, 1, 0, 1e-31, 9e-31},
    {"a narrow range far from 0", 1e6, 1e6 + 1, false, 1, 0, 1e6 + 0.1, 1e6 + 0.9},
    {"all below the points", 0, 100, true, 1, 0, 150, 300},
    {"all above the points", 0, 1, false, 1, 0, -3, -2},
    {"one value", 7, 7, true, 1, 0, 0, 10},
};
enum { CASES = sizeof cases / sizeof *cases };

static mtm_transfer *create_transfer(int count, const mtm_transfer_point *points, double opacity_length,
                                     const char *basis_name) {
    mtm_error error;
    mtm_transfer *transfer = NULL;
    mtm_basis *basis = fixture_basis(basis_name, NULL);
    assert_ok(mtm_transfer_create(count, points, opacity_length, basis, &transfer, &error), error);
    mtm_basis_destroy(basis);
    return transfer;
}

/* Over shares of the points' range: invisible ends, a jump, emission of its own; visible from 0.2 to 0.9. */
static mtm_transfer *create_uneven(const rows_case *from, bool has_emission, const char *basis_name) {
    mtm_transfer_point points[POINTS] = {{0, 0, 0, false, 0},
                                         {0.2, 0, 0, false, 1},
                                         {0.45, 0.6, 0, false, 1},
                                         {0.45, 0.1, 0.4, has_emission, 2},
                                         {0.7, 0.5, 0.05, has_emission, 0},
                                         {0.9, 0, 0, false, 0},
                                         {1, 0, 0, false, 0}};
    for (int i = 0; i < POINTS; i++)
        points[i].value = from->first + points[i].value * (from->last - from->first);
    return create_transfer(POINTS, points, 2, basis_name);
}

static mtm_transfer_rows create_rows(const rows_case *from, const mtm_transfer *transfer) {
    mtm_error error;
    mtm_transfer_rows rows;
    assert_ok(mtm_transfer_rows_create(transfer, from->slope, from->intercept, from->low, from->high,
                                       from->is_integer, &rows, &error),
              error);
    assert_true(rows.count >= 1 && rows.count <= ROWS_MOST && rows.spacing > 0 && isfinite(rows.spacing));
    return rows;
}

static double value_of_row(const rows_case *from, const mtm_transfer_rows *rows, int i) {
    return from->slope * (rows->first + i * rows->spacing) + from->intercept;
}

/* Means of rows low … high - 1; `dimension` coefficients. */
typedef struct row_means {
    double extinction, emission, highlight;
    double coefficients[MTM_DIMENSION_MAX];
} row_means;

static row_means means_of(const mtm_transfer_rows *rows, int low, int high, int dimension) {
    const double count = high - low;
    row_means means = {
        .extinction =
            (rows->extinction[high] - rows->extinction[low]) * (double)rows->extinction_step / count,
        .emission = (rows->emission[high] - rows->emission[low]) * (double)rows->emission_step / count,
        .highlight = (rows->highlight[high] - rows->highlight[low]) * (double)rows->highlight_step / count};
    for (int k = 0; k < dimension; k++)
        means.coefficients[k] =
            ((double)rows->coefficients[high * rows->lanes + k] - rows->coefficients[low * rows->lanes + k]) *
            (double)rows->coefficient_step / count;
    return means;
}

static void add_classified(const mtm_transfer *transfer, double value, double weight, int dimension,
                           row_means *means) {
    float coefficients[MTM_DIMENSION_MAX];
    const mtm_classified found = mtm_transfer_classify(transfer, value, coefficients);
    means->extinction += weight * (double)found.extinction;
    means->emission += weight * (double)found.emission;
    means->highlight += weight * fmin((double)found.extinction, (double)found.emission);
    for (int k = 0; k < dimension; k++)
        means->coefficients[k] += weight * (double)found.emission * (double)coefficients[k];
}

/* Each sum is rounded to half a step. */
static void assert_means_near(const row_means *found, const row_means *expected,
                              const mtm_transfer_rows *rows, int dimension, double steps, double share) {
    const double of_extinction = steps * (double)rows->extinction_step + share * (double)expected->extinction;
    const double of_emission = steps * (double)rows->emission_step + share * (double)expected->emission;
    assert_near(found->extinction, expected->extinction, of_extinction);
    assert_near(found->emission, expected->emission, of_emission);
    assert_near(found->highlight, expected->highlight,
                steps * (double)rows->highlight_step + share * expected->highlight);
    for (int k = 0; k < dimension; k++)
        assert_near(found->coefficients[k], expected->coefficients[k],
                    steps * (double)rows->coefficient_step + share * 4 * expected->emission);
}

static void check_rows(const rows_case *from, const mtm_transfer *transfer, int dimension) {
    mtm_transfer_rows rows = create_rows(from, transfer);
    row_means all = {0};
    for (int i = 0; i < rows.count; i++) {
        row_means expected = {0};
        const double value = value_of_row(from, &rows, i);
        const row_means found = means_of(&rows, i, i + 1, dimension);
        add_classified(transfer, value, 1, dimension, &expected);
        add_classified(transfer, value, 1.0 / rows.count, dimension, &all);
        assert_means_near(&found, &expected, &rows, dimension, 1.001, 1e-6);
    }
    const row_means found = means_of(&rows, 0, rows.count, dimension);
    assert_means_near(&found, &all, &rows, dimension, 1, 1e-6);
    for (int k = dimension; k < rows.lanes; k++)
        for (int i = 0; i <= rows.count; i++) assert_int_equal(rows.coefficients[i * rows.lanes + k], 0);
    mtm_transfer_rows_free(&rows);
}

static void every_row_is_the_transfer_function_at_its_value(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int dimension;
    } bases[] = {{"materials", 4}, {"sharpened:9", 9}, {"wavelengths", 81}};
    for (int i = 0; i < CASES; i++) {
        for (int b = 0; b < (i == 0 ? 3 : 2); b++) {
            mtm_transfer *transfer = create_uneven(&cases[i], b != 1, bases[b].name);
            check_rows(&cases[i], transfer, bases[b].dimension);
            mtm_transfer_destroy(transfer);
        }
    }
}

static int nearest_row(const mtm_transfer_rows *rows, double stored) {
    const double row = (stored - rows->first) / rows->spacing;
    return (int)lrint(fmin(fmax(row, 0), rows->count - 1));
}

/* Between two values, the mean over the rows nearest to them and those between is the mean over the values, up to a row
 * at either end. */
static void means_over_rows_are_means_over_values(void **state) {
    (void)state;
    enum { SAMPLES = 4000 };
    for (int i = 0; i < CASES; i++) {
        const rows_case *from = &cases[i];
        mtm_transfer *transfer = create_uneven(from, true, "materials");
        mtm_transfer_rows rows = create_rows(from, transfer);
        for (int n = 0; n < 20; n++) {
            const double a = from->low + (from->high - from->low) * (n * 7 % 20) / 19.0;
            const double b = from->low + (from->high - from->low) * (n * 11 % 20) / 19.0;
            const int low = nearest_row(&rows, fmin(a, b));
            const int high = nearest_row(&rows, fmax(a, b)) + 1;
            /* Outside of the rows the end rows hold, which a mean over rows alone does not weigh as long. */
            if (fmin(a, b) < rows.first || fmax(a, b) > rows.first + (rows.count - 1) * rows.spacing)
                continue;
            if (high - low < 20) continue;
            double expected = 0;
            for (int k = 0; k < SAMPLES; k++) {
                const double stored = a + (b - a) * (k + 0.5) / SAMPLES;
                expected +=
                    (double)mtm_transfer_classify(transfer, from->slope * stored + from->intercept, NULL)
                        .extinction /
                    SAMPLES;
            }
            const double highest = -log(1 - 0.6) / 2;
            assert_near(means_of(&rows, low, high, 0).extinction, expected, 2 * highest / (high - low));
        }
        mtm_transfer_rows_free(&rows);
        mtm_transfer_destroy(transfer);
    }
}

static void integers_fall_on_rows_and_the_ends_are_held(void **state) {
    (void)state;
    for (int i = 0; i < CASES; i++) {
        const rows_case *from = &cases[i];
        mtm_transfer *transfer = create_uneven(from, true, "materials");
        mtm_transfer_rows rows = create_rows(from, transfer);
        for (int n = 0; n <= 500; n++) {
            double stored = from->low + (from->high - from->low) * n / 500;
            if (from->is_integer) stored = floor(stored);
            const int row = nearest_row(&rows, stored);
            const double exact = (stored - rows.first) / rows.spacing;
            const bool is_inside = exact >= 0 && exact <= rows.count - 1;
            if (is_inside && from->is_integer && from->high - from->low < 65536)
                assert_true(exact == floor(exact));
            if (is_inside) continue;
            const mtm_classified held =
                mtm_transfer_classify(transfer, from->slope * stored + from->intercept, NULL);
            assert_near(means_of(&rows, row, row + 1, 0).extinction, held.extinction,
                        1.001 * (double)rows.extinction_step);
        }
        mtm_transfer_rows_free(&rows);
        mtm_transfer_destroy(transfer);
    }
}

static void invisible_rows_are_told(void **state) {
    (void)state;
    for (int i = 0; i < CASES; i++) {
        mtm_transfer *transfer = create_uneven(&cases[i], i % 2 == 0, "materials");
        mtm_transfer_rows rows = create_rows(&cases[i], transfer);
        int begin = 0;
        int end = 0;
        bool is_following = true;
        for (int n = 0; n < rows.count; n++) {
            const mtm_classified found =
                mtm_transfer_classify(transfer, value_of_row(&cases[i], &rows, n), NULL);
            is_following = is_following && found.extinction == found.emission;
            if (found.extinction == 0 && found.emission == 0) continue;
            if (end == 0) begin = n;
            end = n + 1;
        }
        assert_int_equal(rows.visible_begin, begin);
        assert_int_equal(rows.visible_end, end);
        assert_int_equal(rows.is_following, is_following);
        mtm_transfer_rows_free(&rows);
        mtm_transfer_destroy(transfer);
    }
}

/* Packets read a row's sum and the next one, also those of the row behind the last. */
static void the_last_sums_stand_twice(void **state) {
    (void)state;
    mtm_transfer *transfer = create_uneven(&cases[1], true, "materials");
    mtm_transfer_rows rows = create_rows(&cases[1], transfer);
    const int last = rows.count;
    assert_int_equal(rows.extinction[0], 0);
    assert_true(rows.extinction[last] > 1 << 28);
    assert_int_equal(rows.extinction[last + 1], rows.extinction[last]);
    assert_int_equal(rows.emission[last + 1], rows.emission[last]);
    assert_int_equal(rows.highlight[last + 1], rows.highlight[last]);
    mtm_transfer_rows_free(&rows);
    mtm_transfer_destroy(transfer);
}

/* A basis whose coefficients are partly negative, so that sums rise and fall; opaque and bright beyond measure. */
static void no_sum_overflows(void **state) {
    (void)state;
    static const double emissions[] = {1e-10, 1, 1e30};
    static const double lengths[] = {1e-6, 1, 1e6};
    int64_t lowest = 0;
    mtm_error error;
    mtm_basis *basis = NULL;
    mtm_spectrum narrow[3];
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
        for (int m = 0; m < 3; m++) narrow[m].value[k] = k / 3 % 9 == 3 * m ? 1 : 0;
    assert_ok(mtm_basis_create("sharpened:9", 3, narrow, NULL, &basis, &error), error);
    for (int i = 0; i < 9; i++) {
        const mtm_transfer_point points[] = {
            {0, 1, 0, false, 0}, {0.5, 1, emissions[i % 3], true, 1}, {1, 0, emissions[i % 3], true, 2}};
        mtm_transfer *transfer = NULL;
        assert_ok(mtm_transfer_create(3, points, lengths[i / 3], basis, &transfer, &error), error);
        const rows_case unit = {"", 0, 1, false, 1, 0, 0, 1};
        mtm_transfer_rows rows = create_rows(&unit, transfer);
        int64_t widest = 0;
        for (int n = 0; n <= rows.count; n++) {
            if (n > 0) assert_true(rows.extinction[n] >= rows.extinction[n - 1]);
            if (n > 0) assert_true(rows.emission[n] >= rows.emission[n - 1]);
            for (int k = 0; k < 9; k++) {
                const int64_t sum = rows.coefficients[n * rows.lanes + k];
                widest = sum > widest ? sum : -sum > widest ? -sum : widest;
                lowest = sum < lowest ? sum : lowest;
            }
        }
        /* differences of any two sums fit 32 bits, and no digits are given away */
        assert_true(widest <= (1 << 30) + 128 && widest > 1 << 28);
        assert_in_range(rows.extinction[rows.count], 1 << 28, (1 << 30) + 128);
        assert_in_range(rows.emission[rows.count], 1 << 28, (1 << 30) + 128);
        check_rows(&unit, transfer, 9);
        mtm_transfer_rows_free(&rows);
        mtm_transfer_destroy(transfer);
    }
    assert_true(lowest < -(1 << 20));
    mtm_basis_destroy(basis);
}

static void one_point_and_nothing_visible_are_rows_too(void **state) {
    (void)state;
    for (int i = 0; i < CASES; i++) {
        const mtm_transfer_point constant = {cases[i].first, 0.3, 0, false, 1};
        const mtm_transfer_point nothing = {cases[i].first, 0, 0, false, 1};
        mtm_transfer *transfer = create_transfer(1, &constant, 1, "materials");
        mtm_transfer *invisible = create_transfer(1, &nothing, 1, "materials");
        mtm_transfer_rows rows = create_rows(&cases[i], transfer);
        assert_near(means_of(&rows, 0, rows.count, 0).extinction, -log(0.7), 1e-6);
        assert_near(means_of(&rows, rows.count / 2, rows.count / 2 + 1, 0).extinction, -log(0.7),
                    1e-6 + (double)rows.extinction_step);
        assert_true(rows.is_following && rows.visible_begin == 0 && rows.visible_end == rows.count);
        mtm_transfer_rows_free(&rows);
        rows = create_rows(&cases[i], invisible);
        assert_int_equal(rows.extinction[rows.count], 0);
        assert_true(rows.visible_begin >= rows.visible_end);
        mtm_transfer_rows_free(&rows);
        mtm_transfer_destroy(transfer);
        mtm_transfer_destroy(invisible);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_is_the_transfer_function_at_its_value),
        cmocka_unit_test(means_over_rows_are_means_over_values),
        cmocka_unit_test(integers_fall_on_rows_and_the_ends_are_held),
        cmocka_unit_test(invisible_rows_are_told),
        cmocka_unit_test(the_last_sums_stand_twice),
        cmocka_unit_test(no_sum_overflows),
        cmocka_unit_test(one_point_and_nothing_visible_are_rows_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
