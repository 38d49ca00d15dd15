/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/random.h"

#include "test.h"

/* The first numbers of the reference implementation (S. Vigna, splitmix64.c) from the seed 1234567. */
static void the_generator_is_splitmix64(void **state) {
    (void)state;
    const uint64_t expected[] = {UINT64_C(6457827717110365317), UINT64_C(3203168211198807973),
                                 UINT64_C(9817491932198370423), UINT64_C(4593380528125082431),
                                 UINT64_C(16408922859458223821)};
    random_state random = 1234567;
    for (int i = 0; i < 5; i++) assert_true(random_bits(&random) == expected[i]);
}

static void numbers_fill_their_range_evenly(void **state) {
    (void)state;
    enum { COUNT = 70000, BINS = 7 };
    random_state random = 1;
    int bins[BINS] = {0};
    double sum = 0;
    for (int n = 0; n < COUNT; n++) {
        const int bin = random_below(&random, BINS);
        assert_in_range(bin, 0, BINS - 1);
        bins[bin]++;
        const double number = random_between(&random, -2, 4);
        assert_true(number >= -2 && number < 4);
        sum += number;
    }
    for (int i = 0; i < BINS; i++) assert_in_range(bins[i], 9600, 10400); /* 10000 ± 4 deviations */
    assert_float_equal(sum / COUNT, 1, 0.03);
}

/* The first reflectance pool is named twice: half of the draws are from it, whatever the sizes of the pools. */
static void draws_follow_the_pools(void **state) {
    (void)state;
    enum { COUNT = 20000 };
    static product_draw draws[COUNT];
    const index_pool lights[] = {{5, 3}};
    const index_pool reflectances[] = {{0, 2}, {0, 2}, {10, 1}, {20, 100}};
    const draw_pools pools = {1, 4, lights, reflectances};
    draw_products(&pools, 7, COUNT, draws);
    int from_first = 0;
    int from_second = 0;
    for (int n = 0; n < COUNT; n++) {
        assert_in_range(draws[n].light, 5, 7);
        for (int i = 0; i < DRAW_REFLECTANCES; i++) {
            const int index = draws[n].reflectance[i];
            assert_true(index == 0 || index == 1 || index == 10 || (index >= 20 && index < 120));
            from_first += index < 2;
            from_second += index == 10;
        }
    }
    assert_float_equal(from_first / (3.0 * COUNT), 0.5, 0.01);
    assert_float_equal(from_second / (3.0 * COUNT), 0.25, 0.01);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_generator_is_splitmix64),
        cmocka_unit_test(numbers_fill_their_range_evenly),
        cmocka_unit_test(draws_follow_the_pools),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
