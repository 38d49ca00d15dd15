/* SPDX-License-Identifier: BSD-3-Clause */
#include "metamer/transfer.h"

#include "fixture.h"

static mtm_transfer *create(int count, const mtm_transfer_point *points, double opacity_length) {
    mtm_error error;
    mtm_transfer *transfer = NULL;
    mtm_basis *basis = fixture_basis("materials", NULL);
    assert_ok(mtm_transfer_create(count, points, opacity_length, basis, &transfer, &error), error);
    mtm_basis_destroy(basis);
    return transfer;
}

static void opacity_is_linear_in_value_between_points(void **state) {
    (void)state;
    const mtm_transfer_point points[] = {{10, 0.1, 0, false, 0}, {30, 0.9, 0, false, 1}};
    mtm_transfer *transfer = create(2, points, 2);
    for (double value = 10; value <= 30; value += 0.037) {
        float mix[4];
        const double share = (value - 10) / 20;
        const mtm_classified found = mtm_transfer_classify(transfer, value, mix);
        assert_near(found.extinction, -log(1 - (0.1 + 0.8 * share)) / 2, 2e-6);
        assert_near(found.emission, found.extinction, 0);
        assert_near(mix[0], 1 - share, 1e-6);
        assert_near(mix[1], share, 1e-6);
        assert_near(mix[2], 0, 0);
    }
    mtm_transfer_destroy(transfer);
}

static void the_ends_are_held_outside(void **state) {
    (void)state;
    const mtm_transfer_point points[] = {{10, 0.1, 0, false, 0}, {30, 0.9, 0, false, 1}};
    mtm_transfer *transfer = create(2, points, 1);
    float mix[4];
    assert_near(mtm_transfer_classify(transfer, -1e30, mix).extinction, -log(0.9), 1e-7);
    assert_near(mix[0], 1, 0);
    assert_near(mtm_transfer_classify(transfer, 1e30, mix).extinction, -log(0.1), 1e-6);
    assert_near(mix[1], 1, 0);
    mtm_transfer_destroy(transfer);
}

static void two_points_of_one_value_jump_and_the_later_wins(void **state) {
    (void)state;
    const mtm_transfer_point points[] = {{0, 0.1, 0, false, 0},
                                         {100, 0.1, 0, false, 0},
                                         {100, 0.5, 0, false, 1},
                                         {200, 0.5, 0, false, 1},
                                         {200, 0.9, 0, false, 2}};
    mtm_transfer *transfer = create(5, points, 1);
    float mix[4];
    assert_near(mtm_transfer_classify(transfer, 99.999, mix).extinction, -log(0.9), 1e-6);
    assert_near(mix[0], 1, 1e-6);
    assert_near(mtm_transfer_classify(transfer, 100, mix).extinction, -log(0.5), 1e-6);
    assert_near(mix[1], 1, 1e-6);
    assert_near(mtm_transfer_classify(transfer, 199.99, mix).extinction, -log(0.5), 1e-6);
    assert_near(mtm_transfer_classify(transfer, 200, mix).extinction, -log(0.1), 1e-6);
    assert_near(mix[2], 1, 1e-6);
    mtm_transfer_destroy(transfer);
}

static void a_jump_at_the_first_point_holds_the_earlier_one_below(void **state) {
    (void)state;
    const mtm_transfer_point points[] = {{5, 0, 0, false, 0}, {5, 0.5, 0, false, 1}};
    mtm_transfer *transfer = create(2, points, 1);
    assert_near(mtm_transfer_classify(transfer, 4.999, NULL).extinction, 0, 0);
    assert_near(mtm_transfer_classify(transfer, 5, NULL).extinction, -log(0.5), 1e-6);
    assert_near(mtm_transfer_classify(transfer, 6, NULL).extinction, -log(0.5), 1e-6);
    mtm_transfer_destroy(transfer);
}

static void opacity_1_is_capped(void **state) {
    (void)state;
    const mtm_transfer_point points[] = {{0, 1, 0, false, 0}};
    mtm_transfer *transfer = create(1, points, 4);
    assert_near(mtm_transfer_classify(transfer, 0, NULL).extinction, -log(1e-4) / 4, 1e-5);
    mtm_transfer_destroy(transfer);
}

static void emission_of_its_own_is_linear_and_per_opacity_length(void **state) {
    (void)state;
    const mtm_transfer_point points[] = {{0, 0, 2, true, 0}, {1, 0.5, 0, false, 1}};
    mtm_transfer *transfer = create(2, points, 4);
    assert_near(mtm_transfer_classify(transfer, 0, NULL).emission, 0.5, 1e-6);
    assert_near(mtm_transfer_classify(transfer, 0, NULL).extinction, 0, 0);
    assert_near(mtm_transfer_classify(transfer, 1, NULL).emission, log(2) / 4, 1e-6);
    assert_near(mtm_transfer_classify(transfer, 0.5, NULL).emission, (0.5 + log(2) / 4) / 2, 1e-6);
    mtm_transfer_destroy(transfer);
}

static void visibility_is_asked_of_a_range(void **state) {
    (void)state;
    const mtm_transfer_point points[] = {{0, 0, 0, false, 0},  {50, 0, 0, false, 0}, {60, 0.2, 0, false, 1},
                                         {70, 0, 0, false, 1}, {90, 0, 0, true, 2},  {100, 0, 1, true, 2},
                                         {110, 0, 0, true, 2}};
    mtm_transfer *transfer = create(7, points, 1);
    assert_false(mtm_transfer_is_visible(transfer, -5, 49));
    assert_true(mtm_transfer_is_visible(transfer, 40, 50.1));
    assert_true(mtm_transfer_is_visible(transfer, 0, 1000));
    assert_false(mtm_transfer_is_visible(transfer, 70.5, 89));
    assert_true(mtm_transfer_is_visible(transfer, 95, 95)); /* emission counts */
    assert_false(mtm_transfer_is_visible(transfer, 111, 2000));
    mtm_transfer_destroy(transfer);
    mtm_transfer_destroy(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(opacity_is_linear_in_value_between_points),
        cmocka_unit_test(the_ends_are_held_outside),
        cmocka_unit_test(two_points_of_one_value_jump_and_the_later_wins),
        cmocka_unit_test(a_jump_at_the_first_point_holds_the_earlier_one_below),
        cmocka_unit_test(opacity_1_is_capped),
        cmocka_unit_test(emission_of_its_own_is_linear_and_per_opacity_length),
        cmocka_unit_test(visibility_is_asked_of_a_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
