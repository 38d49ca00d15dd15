/* SPDX-License-Identifier: BSD-3-Clause
 * Packed voxels against differences of the volume's own values. */
#include "volume/packed.h"

#include "fixture.h"

static uint32_t next_random(uint32_t *random) {
    return (*random = *random * 1664525U + 1013904223U) >> 8;
}

/* Waves of the type's whole range, or noise, whose steepest differences are at the faces. */
static mtm_volume *create_volume(const mtm_grid *grid, mtm_voxel_type type, double slope, bool is_rough) {
    mtm_error error;
    mtm_volume *volume = NULL;
    const int *size = grid->size;
    const size_t count = (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
    uint16_t *voxels = malloc(count * sizeof *voxels);
    assert_non_null(voxels);
    uint32_t random = 9;
    for (size_t n = 0; n < count; n++) {
        const size_t x = n % (size_t)size[0];
        const double wave = sin(0.21 * (double)x) * cos(0.3 * (double)(n / (size_t)size[0]));
        const uint32_t word =
            is_rough ? next_random(&random) % 65536 : (uint32_t)lrint(32767.5 + 32767 * wave);
        /* signed types: the same, half the range lower */
        if (type == MTM_VOXEL_UINT8) ((uint8_t *)voxels)[n] = (uint8_t)(word >> 8);
        if (type == MTM_VOXEL_INT8) ((int8_t *)voxels)[n] = (int8_t)((int)(word >> 8) - 128);
        if (type == MTM_VOXEL_UINT16) voxels[n] = (uint16_t)word;
        if (type == MTM_VOXEL_INT16) ((int16_t *)voxels)[n] = (int16_t)((int)word - 32768);
    }
    assert_ok(mtm_volume_create(grid, type, voxels, slope, 100, &volume, &error), error);
    free(voxels);
    return volume;
}

static double stored_value(const mtm_volume *volume, const int voxel[3]) {
    return (mtm_volume_value(volume, voxel[0], voxel[1], voxel[2]) - mtm_volume_intercept(volume)) /
           mtm_volume_slope(volume);
}

/* Of stored values per world unit: central, one-sided at faces, 0 along an axis of one voxel. */
static void find_gradient(const mtm_volume *volume, const int voxel[3], double world[3]) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    double inverse[3][3];
    mtm_grid_inverse_axes(grid, inverse);
    for (int i = 0; i < 3; i++) world[i] = 0;
    for (int axis = 0; axis < 3; axis++) {
        int before[3] = {voxel[0], voxel[1], voxel[2]};
        int after[3] = {voxel[0], voxel[1], voxel[2]};
        if (voxel[axis] > 0) before[axis]--;
        if (voxel[axis] + 1 < grid->size[axis]) after[axis]++;
        const int distance = after[axis] - before[axis];
        if (distance == 0) continue;
        const double difference = (stored_value(volume, after) - stored_value(volume, before)) / distance;
        for (int i = 0; i < 3; i++) world[i] += difference * inverse[axis][i];
    }
}

static double component_of(const mtm_packed *packed, size_t n, int component) {
    return packed->voxel_bytes == 4 ? ((const uint8_t *)packed->voxels)[4 * n + (size_t)component]
                                    : ((const int16_t *)packed->voxels)[4 * n + (size_t)component];
}

static void check_voxel(const mtm_volume *volume, const mtm_packed *packed, const int voxel[3], size_t n) {
    const double low = packed->voxel_bytes == 4 ? 0 : -32768;
    const double high = packed->voxel_bytes == 4 ? 255 : 32767;
    double gradient[3];
    find_gradient(volume, voxel, gradient);
    assert_near(component_of(packed, n, 0) + packed->value_base, stored_value(volume, voxel), 1e-6);
    for (int i = 0; i < 3; i++) {
        const double wanted = gradient[i] * packed->gradient_scale + packed->gradient_bias;
        assert_true(wanted > low - 0.5 && wanted < high + 0.5); /* the steepest just fits */
        /* rounded, and computed in floats of 24 bits */
        assert_near(component_of(packed, n, i + 1), wanted, 0.5 + 0.01);
    }
}

static void check_volume(const mtm_volume *volume, int thread_count) {
    mtm_error error;
    mtm_packed packed;
    const int *size = mtm_volume_grid(volume)->size;
    assert_true(mtm_packed_is_possible(volume));
    assert_ok(mtm_packed_create(volume, thread_count, NULL, &packed, &error), error);
    const size_t bytes = mtm_voxel_type_bytes(mtm_volume_type(volume)) * 4;
    assert_int_equal(packed.voxel_bytes, bytes);
    assert_true(mtm_packed_bytes(volume) >= bytes * mtm_volume_voxel_count(volume));
    size_t n = 0;
    for (int z = 0; z < size[2]; z++) {
        for (int y = 0; y < size[1]; y++) {
            for (int x = 0; x < size[0]; x++) check_voxel(volume, &packed, (const int[3]){x, y, z}, n++);
        }
    }
    mtm_packed_free(&packed);
    assert_true(packed.voxels == NULL && packed.voxel_bytes == 0);
}

static const mtm_voxel_type types[] = {MTM_VOXEL_INT8, MTM_VOXEL_UINT8, MTM_VOXEL_INT16, MTM_VOXEL_UINT16};

/* 256 voxels of a row are packed at a time. */
static void voxels_of_every_size_hold_value_and_gradient(void **state) {
    (void)state;
    static const int sizes[][3] = {{1, 1, 1},   {2, 2, 2},   {1, 6, 1},   {6, 1, 7},   {3, 4, 5},
                                   {255, 3, 2}, {256, 2, 3}, {257, 3, 3}, {258, 2, 2}, {513, 2, 2}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (int type = 0; type < 4; type++) {
            const mtm_grid grid = mtm_grid_defaults(sizes[i][0], sizes[i][1], sizes[i][2]);
            for (int rough = 0; rough < 2; rough++) {
                mtm_volume *volume = create_volume(&grid, types[type], type % 2 == 0 ? 0.25 : -2, rough == 1);
                check_volume(volume, 1 + rough);
                mtm_volume_destroy(volume);
            }
        }
    }
}

static void spacing_and_shear_turn_gradients_into_the_world(void **state) {
    (void)state;
    static const double axes[][3][3] = {{{0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.04}},
                                        {{0, 0, -300}, {0, 200, 0}, {100, 0, 0}},
                                        {{1, 0.3, 0}, {-0.2, 0.8, 0.1}, {0, 0.4, -1.5}}};
    for (int i = 0; i < 3; i++) {
        for (int type = 0; type < 4; type++) {
            mtm_grid grid = mtm_grid_defaults(14, 15, 16);
            memcpy(grid.axes, axes[i], sizeof grid.axes);
            mtm_volume *volume = create_volume(&grid, types[type], 1, false);
            check_volume(volume, 2);
            mtm_volume_destroy(volume);
        }
    }
}

static void a_constant_volume_has_no_gradient(void **state) {
    (void)state;
    mtm_error error;
    mtm_packed packed;
    mtm_volume *volume = NULL;
    const mtm_grid grid = mtm_grid_defaults(4, 5, 6);
    assert_ok(mtm_volume_create(&grid, MTM_VOXEL_UINT16, NULL, 1, 0, &volume, &error), error);
    assert_ok(mtm_packed_create(volume, 1, NULL, &packed, &error), error);
    assert_true(packed.gradient_scale > 0 && isfinite(packed.gradient_scale));
    for (size_t n = 0; n < 4 * 5 * 6; n++) {
        assert_near(component_of(&packed, n, 0) + packed.value_base, 0, 0);
        for (int i = 1; i < 4; i++) assert_near(component_of(&packed, n, i), packed.gradient_bias, 0);
    }
    mtm_packed_free(&packed);
    mtm_volume_destroy(volume);
}

static bool stop_at_once(void *user, double fraction) {
    (void)user;
    (void)fraction;
    return false;
}

static void wider_types_cannot_be_packed_and_packing_can_be_cancelled(void **state) {
    (void)state;
    mtm_error error;
    mtm_packed packed;
    const mtm_progress progress = {stop_at_once, NULL};
    const mtm_grid grid = mtm_grid_defaults(9, 9, 90);
    mtm_volume *volume = create_volume(&grid, MTM_VOXEL_UINT8, 1, false);
    assert_fails(mtm_packed_create(volume, 1, &progress, &packed, &error), MTM_CANCELLED, error, "cancelled");
    assert_true(packed.voxels == NULL && packed.voxel_bytes == 0);
    mtm_volume_destroy(volume);
    for (mtm_voxel_type type = MTM_VOXEL_INT32; type < MTM_VOXEL_TYPE_COUNT; type++) {
        assert_ok(mtm_volume_create(&grid, type, NULL, 1, 0, &volume, &error), error);
        assert_false(mtm_packed_is_possible(volume));
        mtm_volume_destroy(volume);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(voxels_of_every_size_hold_value_and_gradient),
        cmocka_unit_test(spacing_and_shear_turn_gradients_into_the_world),
        cmocka_unit_test(a_constant_volume_has_no_gradient),
        cmocka_unit_test(wider_types_cannot_be_packed_and_packing_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
