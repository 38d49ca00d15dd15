/* SPDX-License-Identifier: BSD-3-Clause */
#include "metamer/volume.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "test.h"

static mtm_volume *create(const mtm_grid *grid, mtm_voxel_type type, const void *voxels, double slope,
                          double intercept) {
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_ok(mtm_volume_create(grid, type, voxels, slope, intercept, &volume, &error), error);
    return volume;
}

static void assert_range(const mtm_volume *volume, double smallest, double largest) {
    double found[2];
    mtm_volume_range(volume, &found[0], &found[1]);
    assert_true(found[0] == smallest && found[1] == largest);
}

static void every_type_has_its_size_and_name(void **state) {
    (void)state;
    const size_t bytes[MTM_VOXEL_TYPE_COUNT] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    for (int type = 0; type < MTM_VOXEL_TYPE_COUNT; type++)
        assert_int_equal(mtm_voxel_type_bytes((mtm_voxel_type)type), bytes[type]);
    assert_string_equal(mtm_voxel_type_name(MTM_VOXEL_UINT8), "uint8");
    assert_string_equal(mtm_voxel_type_name(MTM_VOXEL_FLOAT64), "float64");
}

typedef struct extremes {
    mtm_voxel_type type;
    const void *voxels;
    double first, second;
} extremes;

static void every_type_keeps_its_extreme_values(void **state) {
    (void)state;
    const extremes cases[] = {
        {MTM_VOXEL_INT8, (int8_t[]){INT8_MIN, INT8_MAX}, -128, 127},
        {MTM_VOXEL_UINT8, (uint8_t[]){0, UINT8_MAX}, 0, 255},
        {MTM_VOXEL_INT16, (int16_t[]){INT16_MIN, INT16_MAX}, -32768, 32767},
        {MTM_VOXEL_UINT16, (uint16_t[]){0, UINT16_MAX}, 0, 65535},
        {MTM_VOXEL_INT32, (int32_t[]){INT32_MIN, INT32_MAX}, -0x1p31, 0x1p31 - 1},
        {MTM_VOXEL_UINT32, (uint32_t[]){0, UINT32_MAX}, 0, 0x1p32 - 1},
        {MTM_VOXEL_INT64, (int64_t[]){INT64_MIN, INT64_MAX}, -0x1p63, 0x1p63},
        {MTM_VOXEL_UINT64, (uint64_t[]){0, UINT64_MAX}, 0, 0x1p64},
        {MTM_VOXEL_FLOAT32, (float[]){-FLT_MAX, FLT_MAX}, -FLT_MAX, FLT_MAX},
        {MTM_VOXEL_FLOAT64, (double[]){-DBL_MAX, DBL_MAX}, -DBL_MAX, DBL_MAX},
    };
    const mtm_grid grid = mtm_grid_defaults(1, 2, 1);
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        mtm_volume *volume = create(&grid, cases[n].type, cases[n].voxels, 1.0, 0.0);
        assert_true(mtm_volume_value(volume, 0, 0, 0) == cases[n].first);
        assert_true(mtm_volume_value(volume, 0, 1, 0) == cases[n].second);
        assert_range(volume, cases[n].first, cases[n].second);
        uint64_t counts[3];
        mtm_volume_histogram(volume, 3, counts);
        assert_true(counts[0] == 1 && counts[1] == 0 && counts[2] == 1);
        mtm_volume_destroy(volume);
    }
}

static void x_is_fastest_and_slope_and_intercept_apply(void **state) {
    (void)state;
    int16_t voxels[24];
    for (int n = 0; n < 24; n++) voxels[n] = (int16_t)n;
    const mtm_grid grid = mtm_grid_defaults(2, 3, 4);
    mtm_volume *volume = create(&grid, MTM_VOXEL_INT16, voxels, -2.0, 10.0);
    assert_true(mtm_volume_value(volume, 1, 2, 3) == 10.0 - 2.0 * 23.0);
    assert_true(mtm_volume_value(volume, 1, 0, 0) == 8.0);
    assert_true(mtm_volume_value(volume, 0, 1, 0) == 6.0);
    assert_true(mtm_volume_value(volume, 0, 0, 1) == -2.0);
    assert_range(volume, -36.0, 10.0); /* the negative slope turns the range round */
    assert_true(mtm_volume_slope(volume) == -2.0 && mtm_volume_intercept(volume) == 10.0);
    assert_int_equal(mtm_volume_voxel_count(volume), 24);
    assert_memory_equal(mtm_volume_voxels(volume), voxels, sizeof voxels);
    mtm_volume_destroy(volume);
}

static void voxels_that_are_not_finite_count_for_nothing(void **state) {
    (void)state;
    const float voxels[] = {NAN, 2.0f, INFINITY, -1.0f, -INFINITY, 0.5f};
    const mtm_grid grid = mtm_grid_defaults(6, 1, 1);
    mtm_volume *volume = create(&grid, MTM_VOXEL_FLOAT32, voxels, 1.0, 0.0);
    assert_range(volume, -1.0, 2.0);
    uint64_t counts[2];
    mtm_volume_histogram(volume, 2, counts);
    assert_int_equal(counts[0], 1);
    assert_int_equal(counts[1], 2);
    mtm_volume_destroy(volume);
}

static void a_volume_without_finite_voxels_has_the_range_zero(void **state) {
    (void)state;
    const double voxels[] = {NAN, INFINITY};
    const mtm_grid grid = mtm_grid_defaults(2, 1, 1);
    mtm_volume *volume = create(&grid, MTM_VOXEL_FLOAT64, voxels, 3.0, 5.0);
    assert_range(volume, 0.0, 0.0);
    uint64_t count = 7;
    mtm_volume_histogram(volume, 1, &count);
    assert_int_equal(count, 0);
    mtm_volume_destroy(volume);
}

static void a_volume_made_of_nothing_is_zero(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 3, 3);
    mtm_volume *volume = create(&grid, MTM_VOXEL_FLOAT32, NULL, 1.0, 0.0);
    assert_range(volume, 0.0, 0.0);
    uint64_t counts[4];
    mtm_volume_histogram(volume, 4, counts);
    assert_int_equal(counts[3], 27); /* the only value is also the largest */
    mtm_volume_destroy(volume);
    mtm_volume_destroy(NULL);
}

static void the_range_and_histogram_see_every_voxel_of_uneven_slabs(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(101, 67, 13);
    const size_t count = 101 * 67 * 13;
    uint16_t *voxels = malloc(count * sizeof *voxels);
    assert_non_null(voxels);
    for (size_t n = 0; n < count; n++) voxels[n] = (uint16_t)(1000 + n * 7919 % 50000);
    voxels[count - 1] = 3;
    voxels[0] = 65000;
    mtm_volume *volume = create(&grid, MTM_VOXEL_UINT16, voxels, 1.0, 0.0);
    assert_range(volume, 3.0, 65000.0);
    uint64_t counts[64998];
    mtm_volume_histogram(volume, 64998, counts);
    uint64_t sum = 0;
    for (size_t n = 0; n < 64998; n++) sum += counts[n];
    assert_int_equal(sum, count);
    assert_int_equal(counts[64997], 1);
    mtm_volume_destroy(volume);
    free(voxels);
}

/* "abc" is an example of FIPS 180-4; the other sum is of "abcd". */
static void the_hash_is_that_of_the_little_endian_voxels(void **state) {
    (void)state;
    char hex[65];
    mtm_grid grid = mtm_grid_defaults(3, 1, 1);
    mtm_volume *volume = create(&grid, MTM_VOXEL_UINT8, "abc", 1.0, 0.0);
    mtm_volume_sha256(volume, hex);
    assert_string_equal(hex, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    mtm_volume_destroy(volume);

    const uint16_t words[] = {'a' + 256 * 'b', 'c' + 256 * 'd'};
    grid = mtm_grid_defaults(2, 1, 1);
    volume = create(&grid, MTM_VOXEL_UINT16, words, 2.0, 1.0);
    mtm_volume_sha256(volume, hex);
    assert_string_equal(hex, "88d4266fd4e6338d13b845fcf289579d209c897823b9217da3e161936f031589");
    mtm_volume_destroy(volume);
}

static void volumes_that_cannot_be_used_are_refused(void **state) {
    (void)state;
    mtm_volume *volume = NULL;
    mtm_error error;
    mtm_grid grid = mtm_grid_defaults(2, 2, 2);
    assert_fails(mtm_volume_create(&grid, MTM_VOXEL_INT8, NULL, 0.0, 0.0, &volume, &error), MTM_ARGUMENT,
                 error, "slope 0");
    assert_fails(mtm_volume_create(&grid, MTM_VOXEL_INT8, NULL, 1.0, NAN, &volume, &error), MTM_ARGUMENT,
                 error, "intercept nan");
    grid.axes[1][1] = 0.0;
    assert_fails(mtm_volume_create(&grid, MTM_VOXEL_INT8, NULL, 1.0, 0.0, &volume, &error), MTM_ARGUMENT,
                 error, "axis of length 0");
    grid = mtm_grid_defaults(INT_MAX, INT_MAX, INT_MAX);
    assert_fails(mtm_volume_create(&grid, MTM_VOXEL_INT8, NULL, 1.0, 0.0, &volume, &error), MTM_LIMIT, error,
                 "2^40");
    grid = mtm_grid_defaults(1 << 20, 1 << 18, 1);
    assert_fails(mtm_volume_create(&grid, MTM_VOXEL_INT64, NULL, 1.0, 0.0, &volume, &error), MTM_LIMIT, error,
                 "1048576 x 262144 x 1 voxels of type int64");
    assert_null(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_type_has_its_size_and_name),
        cmocka_unit_test(every_type_keeps_its_extreme_values),
        cmocka_unit_test(x_is_fastest_and_slope_and_intercept_apply),
        cmocka_unit_test(voxels_that_are_not_finite_count_for_nothing),
        cmocka_unit_test(a_volume_without_finite_voxels_has_the_range_zero),
        cmocka_unit_test(a_volume_made_of_nothing_is_zero),
        cmocka_unit_test(the_range_and_histogram_see_every_voxel_of_uneven_slabs),
        cmocka_unit_test(the_hash_is_that_of_the_little_endian_voxels),
        cmocka_unit_test(volumes_that_cannot_be_used_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
