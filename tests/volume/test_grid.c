/* SPDX-License-Identifier: BSD-3-Clause */
#include "volume/grid.h"

#include <math.h>

#include "test.h"

/* In double and false for NaN, neither of which cmocka's assert_float_equal promises. */
static void assert_near(double value, double expected, double tolerance) {
    assert_true(fabs(value - expected) <= tolerance);
}

static mtm_grid oblique_grid(double scale) {
    mtm_grid grid = mtm_grid_defaults(4, 5, 6);
    const double axes[3][3] = {{0.8, 0.1, 0.0}, {-0.2, 1.3, 0.3}, {0.1, 0.4, -2.5}};
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < 3; i++) grid.axes[axis][i] = scale * axes[axis][i];
    grid.origin[0] = 12.5;
    grid.origin[1] = -70.25;
    grid.origin[2] = 1000.0;
    return grid;
}

static void the_default_grid_has_spacing_one_and_origin_zero(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(2, 3, 4);
    assert_int_equal(grid.size[2], 4);
    for (int axis = 0; axis < 3; axis++) assert_true(mtm_grid_spacing(&grid, axis) == 1.0);
    const double voxel[3] = {1, 2, 3};
    double world[3];
    mtm_grid_to_world(&grid, voxel, world);
    assert_memory_equal(world, voxel, sizeof voxel);
    assert_null(mtm_grid_fault(&grid));
}

static void the_spacing_is_the_length_of_the_axis(void **state) {
    (void)state;
    mtm_grid grid = mtm_grid_defaults(2, 2, 2);
    grid.axes[1][0] = 3.0;
    grid.axes[1][1] = 4.0;
    assert_true(mtm_grid_spacing(&grid, 1) == 5.0);
    assert_true(mtm_grid_smallest_spacing(&grid) == 1.0);
}

static void world_positions_lead_back_to_their_voxel(void **state) {
    (void)state;
    const mtm_grid grid = oblique_grid(1.0);
    const double voxels[][3] = {{0, 0, 0}, {1, 2, 3}, {-7.5, 0.25, 400}};
    for (size_t n = 0; n < sizeof voxels / sizeof *voxels; n++) {
        double position[3]; /* in place, which both functions allow */
        mtm_grid_to_world(&grid, voxels[n], position);
        mtm_grid_to_voxel(&grid, position, position);
        for (int i = 0; i < 3; i++) assert_near(position[i], voxels[n][i], 1e-10);
    }
}

static void the_inverse_times_the_axes_is_the_identity_at_every_scale(void **state) {
    (void)state;
    const double scales[] = {1.0, 1e-6, 1e9, 1e-200, 1e200};
    for (size_t n = 0; n < sizeof scales / sizeof *scales; n++) {
        const mtm_grid grid = oblique_grid(scales[n]);
        double inverse[3][3];
        mtm_grid_inverse_axes(&grid, inverse);
        for (int row = 0; row < 3; row++) {
            for (int axis = 0; axis < 3; axis++) {
                double sum = 0.0;
                for (int i = 0; i < 3; i++) sum += inverse[row][i] * grid.axes[axis][i];
                assert_near(sum, row == axis ? 1.0 : 0.0, 1e-14);
            }
        }
    }
}

static void grids_that_span_no_volume_are_refused(void **state) {
    (void)state;
    mtm_grid grid = oblique_grid(1.0);
    for (int i = 0; i < 3; i++) grid.axes[2][i] = grid.axes[0][i] + 2.0 * grid.axes[1][i];
    assert_string_equal(mtm_grid_fault(&grid), "has linearly dependent axes");
    for (int i = 0; i < 3; i++) grid.axes[2][i] = 0.0;
    assert_string_equal(mtm_grid_fault(&grid), "has an axis of length 0");
    grid.axes[2][0] = INFINITY;
    assert_string_equal(mtm_grid_fault(&grid), "has an axis whose length is not finite");
    grid = oblique_grid(1.0);
    grid.origin[1] = NAN;
    assert_string_equal(mtm_grid_fault(&grid), "has an origin that is not finite");
    grid = oblique_grid(1.0);
    grid.size[0] = 0;
    assert_string_equal(mtm_grid_fault(&grid), "has an axis with less than 1 voxel");
    grid = oblique_grid(1.0);
    memset(grid.unit, 'm', sizeof grid.unit);
    assert_string_equal(mtm_grid_fault(&grid), "has a unit of more than 15 bytes");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_default_grid_has_spacing_one_and_origin_zero),
        cmocka_unit_test(the_spacing_is_the_length_of_the_axis),
        cmocka_unit_test(world_positions_lead_back_to_their_voxel),
        cmocka_unit_test(the_inverse_times_the_axes_is_the_identity_at_every_scale),
        cmocka_unit_test(grids_that_span_no_volume_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
