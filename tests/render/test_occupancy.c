/* SPDX-License-Identifier: BSD-3-Clause
 * Whether anything in a box is visible, against a look at every block. */
#include "render/occupancy.h"

#include "fixture.h"

static uint32_t next_random(uint32_t *random) {
    return (*random = *random * 1664525U + 1013904223U) >> 8;
}

/* Mostly empty; the values of single voxels make single blocks visible. */
static mtm_volume *create_sparse(const int size[3], uint32_t *random) {
    mtm_error error;
    mtm_volume *volume = NULL;
    const mtm_grid grid = mtm_grid_defaults(size[0], size[1], size[2]);
    const size_t count = (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
    uint8_t *voxels = calloc(count, 1);
    assert_non_null(voxels);
    for (int n = 0; n < 5; n++) voxels[next_random(random) % count] = (uint8_t)(50 + 50 * n);
    assert_ok(mtm_volume_create(&grid, MTM_VOXEL_UINT8, voxels, 1, 0, &volume, &error), error);
    free(voxels);
    return volume;
}

static mtm_transfer *create_transfer(double from, double to) {
    mtm_error error;
    mtm_transfer *transfer = NULL;
    const mtm_transfer_point points[] = {{from - 1, 0, 0, false, 0},
                                         {from, 0.5, 0, false, 0},
                                         {to, 0.5, 0, false, 0},
                                         {to + 1, 0, 0, false, 0}};
    mtm_basis *basis = fixture_basis("materials", NULL);
    assert_ok(mtm_transfer_create(4, points, 1, basis, &transfer, &error), error);
    mtm_basis_destroy(basis);
    return transfer;
}

/* Blocks are closed boxes: one that only touches the asked box with its low faces counts, because a sample there is
 * read from it. `may` also counts those touched with their high faces. */
static void look_at_blocks(const mtm_occupancy *occupancy, const double low[3], const double high[3],
                           bool *must, bool *may) {
    const double edge = 1 << occupancy->cells_log2;
    *must = false;
    *may = false;
    for (int k = 0; k < occupancy->size[2]; k++) {
        for (int j = 0; j < occupancy->size[1]; j++) {
            for (int i = 0; i < occupancy->size[0]; i++) {
                const int block[3] = {i, j, k};
                bool is_inside = true;
                bool is_touched = true;
                for (int axis = 0; axis < 3; axis++) {
                    const double begin = block[axis] * edge;
                    const bool is_last = block[axis] + 1 == occupancy->size[axis];
                    const double end = begin + edge;
                    is_inside =
                        is_inside && high[axis] >= begin && (is_last ? low[axis] <= end : low[axis] < end);
                    is_touched = is_touched && high[axis] >= begin && low[axis] <= end;
                }
                const size_t n =
                    ((size_t)k * (size_t)occupancy->size[1] + (size_t)j) * (size_t)occupancy->size[0] +
                    (size_t)i;
                *must = *must || (is_inside && occupancy->is_visible[n] != 0);
                *may = *may || (is_touched && occupancy->is_visible[n] != 0);
            }
        }
    }
}

/* Corners within, on and far outside of the blocks. */
static double random_corner(const mtm_occupancy *occupancy, int axis, uint32_t *random) {
    const int edge = 1 << occupancy->cells_log2;
    const int extent = occupancy->size[axis] * edge;
    switch (next_random(random) % 4) {
    case 0: return (double)(next_random(random) % (uint32_t)(extent + 1)); /* on a voxel */
    case 1:
        return (double)(next_random(random) % (uint32_t)(occupancy->size[axis] + 1)) * edge; /* on a face */
    case 2: return ((double)next_random(random) / (1 << 24) * 3 - 1) * extent; /* outside, too */
    default: return next_random(random) % 2 == 0 ? -1e9 : 1e12;
    }
}

static void check_boxes(const mtm_occupancy *occupancy, uint32_t *random, int found[2]) {
    for (int n = 0; n < 500; n++) {
        double low[3];
        double high[3];
        bool must = false;
        bool may = false;
        for (int axis = 0; axis < 3; axis++) {
            const double a = random_corner(occupancy, axis, random);
            const double b = n % 3 == 0 ? a : random_corner(occupancy, axis, random); /* points, too */
            low[axis] = fmin(a, b);
            high[axis] = fmax(a, b);
        }
        look_at_blocks(occupancy, low, high, &must, &may);
        const bool any = mtm_occupancy_any(occupancy, low, high);
        if (any ? !may : must)
            fail_msg("any is %d in (%g, %g, %g) … (%g, %g, %g)", any, low[0], low[1], low[2], high[0],
                     high[1], high[2]);
        found[any]++;
    }
}

static void any_is_what_a_look_at_every_block_finds(void **state) {
    (void)state;
    static const int sizes[][3] = {{1, 1, 1}, {2, 2, 2}, {1, 30, 7}, {33, 17, 9}, {30, 21, 40}, {5, 5, 90}};
    uint32_t random = 11;
    int found[2] = {0, 0};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        mtm_volume *volume = create_sparse(sizes[i], &random);
        for (int cells_log2 = 0; cells_log2 <= 6; cells_log2 += 2) {
            mtm_error error;
            mtm_blocks blocks;
            mtm_occupancy occupancy;
            assert_ok(mtm_blocks_create(volume, cells_log2, 1, NULL, &blocks, &error), error);
            assert_ok(mtm_occupancy_create(&blocks, &occupancy, &error), error);
            /* one after another: an update leaves nothing of the one before */
            for (int from = 0; from < 250; from += 60) {
                mtm_transfer *transfer = create_transfer(from + 10, from + 60);
                mtm_occupancy_update(&occupancy, &blocks, transfer);
                check_boxes(&occupancy, &random, found);
                mtm_transfer_destroy(transfer);
            }
            mtm_occupancy_free(&occupancy);
            mtm_blocks_free(&blocks);
        }
        mtm_volume_destroy(volume);
    }
    assert_true(found[0] > 3000 && found[1] > 3000);
}

static void a_block_is_visible_where_its_values_are(void **state) {
    (void)state;
    mtm_error error;
    mtm_blocks blocks;
    mtm_occupancy occupancy;
    uint32_t random = 3;
    int visible = 0;
    mtm_volume *volume = create_sparse((const int[3]){20, 21, 22}, &random);
    mtm_transfer *transfer = create_transfer(120, 170);
    assert_ok(mtm_blocks_create(volume, 1, 1, NULL, &blocks, &error), error);
    assert_ok(mtm_occupancy_create(&blocks, &occupancy, &error), error);
    assert_false(mtm_occupancy_any(&occupancy, (const double[3]){0, 0, 0}, (const double[3]){99, 99, 99}));
    mtm_occupancy_update(&occupancy, &blocks, transfer);
    for (size_t n = 0; n < mtm_blocks_count(&blocks); n++) {
        /* interpolation from 0 passes through all values up to the highest */
        const bool expected = blocks.highest[n] > 119 && blocks.lowest[n] < 171;
        assert_int_equal(occupancy.is_visible[n] != 0, expected);
        visible += expected;
    }
    assert_true(visible > 0);
    mtm_occupancy_free(&occupancy);
    mtm_blocks_free(&blocks);
    mtm_transfer_destroy(transfer);
    mtm_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_is_what_a_look_at_every_block_finds),
        cmocka_unit_test(a_block_is_visible_where_its_values_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
