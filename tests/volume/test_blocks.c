/* SPDX-License-Identifier: BSD-3-Clause
 * Blocks hold every voxel that interpolation inside them reads, and no other. */
#include "volume/blocks.h"

#include "fixture.h"

static uint32_t next_random(uint32_t *random) {
    return (*random = *random * 1664525U + 1013904223U) >> 8;
}

/* Integers that floats do not hold exactly, so that bounds must be rounded outward; every 50th float is no number. */
static mtm_volume *create_volume(const int size[3], mtm_voxel_type type, double slope) {
    mtm_error error;
    mtm_volume *volume = NULL;
    const mtm_grid grid = mtm_grid_defaults(size[0], size[1], size[2]);
    const size_t count = (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
    double *voxels = malloc(count * sizeof *voxels);
    assert_non_null(voxels);
    uint32_t random = 5;
    for (size_t n = 0; n < count; n++) {
        const uint32_t number = next_random(&random);
        if (type == MTM_VOXEL_INT16) ((int16_t *)voxels)[n] = (int16_t)(number % 65536 - 32768);
        if (type == MTM_VOXEL_UINT32) ((uint32_t *)voxels)[n] = number * 256 + 77;
        if (type == MTM_VOXEL_FLOAT64)
            voxels[n] = number % 50 == 0 ? NAN : number % 50 == 1 ? INFINITY : (double)number / 3;
    }
    assert_ok(mtm_volume_create(&grid, type, voxels, slope, -3, &volume, &error), error);
    free(voxels);
    return volume;
}

static double usable_value(const mtm_volume *volume, int x, int y, int z) {
    double smallest = 0;
    double largest = 0;
    const double value = mtm_volume_value(volume, x, y, z);
    mtm_volume_range(volume, &smallest, &largest);
    return isfinite(value) ? value : smallest;
}

/* The bounds of a block from every voxel of its cells, the far faces included. */
static void find_bounds(const mtm_volume *volume, int cells_log2, const int block[3], double *low,
                        double *high) {
    const int *size = mtm_volume_grid(volume)->size;
    int first[3];
    int last[3];
    for (int axis = 0; axis < 3; axis++) {
        first[axis] = block[axis] << cells_log2;
        last[axis] = (block[axis] + 1) << cells_log2;
        last[axis] = last[axis] < size[axis] ? last[axis] : size[axis] - 1;
    }
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (int z = first[2]; z <= last[2]; z++) {
        for (int y = first[1]; y <= last[1]; y++) {
            for (int x = first[0]; x <= last[0]; x++) {
                *low = fmin(*low, usable_value(volume, x, y, z));
                *high = fmax(*high, usable_value(volume, x, y, z));
            }
        }
    }
}

/* Rounded outward, to the next float at most. */
static void check_block(const mtm_blocks *blocks, size_t n, double low, double high) {
    assert_true((double)blocks->lowest[n] <= low && (double)blocks->highest[n] >= high);
    assert_true((double)nextafterf(blocks->lowest[n], HUGE_VALF) > low);
    assert_true((double)nextafterf(blocks->highest[n], -HUGE_VALF) < high);
}

static void check_volume(const mtm_volume *volume, int cells_log2) {
    mtm_error error;
    mtm_blocks blocks;
    const int *size = mtm_volume_grid(volume)->size;
    assert_ok(mtm_blocks_create(volume, cells_log2, 2, NULL, &blocks, &error), error);
    size_t n = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int covered = blocks.size[axis] << cells_log2;
        assert_true(blocks.size[axis] >= 1 && covered >= size[axis] - 1); /* all cells … */
        assert_true(blocks.size[axis] == 1 ||
                    covered - (1 << cells_log2) < size[axis] - 1); /* … and no empty block */
    }
    for (int k = 0; k < blocks.size[2]; k++) {
        for (int j = 0; j < blocks.size[1]; j++) {
            for (int i = 0; i < blocks.size[0]; i++) {
                double low = 0;
                double high = 0;
                find_bounds(volume, cells_log2, (const int[3]){i, j, k}, &low, &high);
                check_block(&blocks, n++, low, high);
            }
        }
    }
    assert_int_equal(n, mtm_blocks_count(&blocks));
    mtm_blocks_free(&blocks);
}

static void bounds_are_those_of_every_voxel_of_the_block(void **state) {
    (void)state;
    static const int sizes[][3] = {{1, 1, 1},   {2, 2, 2},   {1, 9, 5},    {17, 1, 1},  {5, 4, 1},
                                   {9, 17, 33}, {8, 16, 32}, {10, 18, 34}, {65, 66, 3}, {70, 5, 64}};
    static const mtm_voxel_type types[] = {MTM_VOXEL_INT16, MTM_VOXEL_UINT32, MTM_VOXEL_FLOAT64};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (int t = 0; t < 3; t++) {
            mtm_volume *volume = create_volume(sizes[i], types[t], t == 1 ? -0.1 : 0.3);
            for (int cells_log2 = 0; cells_log2 <= 6; cells_log2++) check_volume(volume, cells_log2);
            mtm_volume_destroy(volume);
        }
    }
}

/* Rows are converted in pieces; a block may end where a piece does. */
static void long_rows_are_bounded_piece_by_piece(void **state) {
    (void)state;
    static const int lengths[] = {511, 512, 513, 514, 1024, 1025, 1026, 1537};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        mtm_volume *volume = create_volume((const int[3]){lengths[i], 2, 3}, MTM_VOXEL_FLOAT64, 1);
        for (int cells_log2 = 0; cells_log2 <= 6; cells_log2 += 2) check_volume(volume, cells_log2);
        mtm_volume_destroy(volume);
    }
}

static bool stop_at_once(void *user, double fraction) {
    (void)user;
    (void)fraction;
    return false;
}

static void cancelling_leaves_nothing(void **state) {
    (void)state;
    mtm_error error;
    mtm_blocks blocks;
    const mtm_progress progress = {stop_at_once, NULL};
    mtm_volume *volume = create_volume((const int[3]){9, 9, 90}, MTM_VOXEL_INT16, 1);
    assert_fails(mtm_blocks_create(volume, 0, 1, &progress, &blocks, &error), MTM_CANCELLED, error,
                 "cancelled");
    assert_true(blocks.lowest == NULL && blocks.highest == NULL);
    mtm_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_are_those_of_every_voxel_of_the_block),
        cmocka_unit_test(long_rows_are_bounded_piece_by_piece),
        cmocka_unit_test(cancelling_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
