/* SPDX-License-Identifier: BSD-3-Clause */
#include <sys/stat.h>

#include "comma_locale.h"
#include "metamer/volume.h"
#include "scratch.h"

static const char *const paths[] = {"a.nrrd", "a.nhdr"};

/* Writes, reads back and asks for the same grid and voxels, bit for bit. */
static void assert_round_trip(const mtm_volume *volume, const char *path,
                              const mtm_volume_write_options *options) {
    mtm_volume *back = NULL;
    mtm_error error;
    assert_ok(mtm_volume_write(volume, path, options, &error), error);
    assert_ok(mtm_volume_read(path, &back, &error), error);
    assert_same_voxels(volume, back);
    const mtm_grid *a = mtm_volume_grid(volume);
    const mtm_grid *b = mtm_volume_grid(back);
    assert_memory_equal(a->size, b->size, sizeof a->size);
    assert_memory_equal(a->axes, b->axes, sizeof a->axes);
    assert_memory_equal(a->origin, b->origin, sizeof a->origin);
    assert_int_equal(a->is_oriented, b->is_oriented);
    assert_string_equal(a->unit, b->unit);
    mtm_volume_destroy(back);
}

static void every_type_encoding_and_order_comes_back(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 5, 2);
    for (int type = 0; type < MTM_VOXEL_TYPE_COUNT; type++) {
        mtm_volume *volume = scratch_volume((mtm_voxel_type)type, &grid);
        for (int n = 0; n < 8; n++) {
            const mtm_volume_write_options options = {.is_gzip = n & 1, .is_big_endian = n & 2};
            assert_round_trip(volume, paths[n / 4], &options);
        }
        mtm_volume_destroy(volume);
    }
}

static void every_grid_comes_back_bit_for_bit(void **state) {
    (void)state;
    (void)enter_comma_locale();
    mtm_grid grids[5];
    for (int n = 0; n < 5; n++) grids[n] = mtm_grid_defaults(2, 2, 2);
    for (int axis = 0; axis < 3; axis++) grids[1].axes[axis][axis] = 0.1 * (axis + 1);
    strcpy(grids[1].unit, "mm");
    grids[2].origin[2] = -1.0 / 3.0;
    grids[3].axes[0][1] = -0.0; /* equal to the default, but not the same bits */
    grids[3].axes[1][1] = -2.0;
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < 3; i++) grids[4].axes[axis][i] = 1.0 / (1 + axis + i) + (axis == i ? 1e-17 : 0.0);
    grids[4].axes[2][2] = 1e10;
    grids[4].is_oriented = true;
    strcpy(grids[4].unit, "\"\\ mm");
    const mtm_volume_write_options options = mtm_volume_write_defaults();
    for (int n = 0; n < 5; n++) {
        mtm_volume *volume = scratch_volume(MTM_VOXEL_UINT8, &grids[n]);
        assert_round_trip(volume, "a.nrrd", &options);
        mtm_volume_destroy(volume);
    }
    leave_comma_locale();
}

static void a_volume_of_several_chunks_comes_back(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(101, 97, 31);
    mtm_volume *volume = scratch_volume(MTM_VOXEL_INT32, &grid);
    for (int n = 0; n < 4; n++) {
        const mtm_volume_write_options options = {.is_gzip = n & 1, .is_big_endian = n & 2};
        assert_round_trip(volume, "a.nrrd", &options);
    }
    mtm_volume_destroy(volume);
}

static size_t read_back(const char *name, char *bytes, size_t capacity) {
    FILE *stream = fopen(name, "rb");
    assert_non_null(stream);
    const size_t count = fread(bytes, 1, capacity, stream);
    (void)fclose(stream);
    return count;
}

static void the_same_volume_gives_the_same_bytes(void **state) {
    (void)state;
    char bytes[2][1024];
    const mtm_grid grid = mtm_grid_defaults(4, 4, 4);
    mtm_volume *volume = scratch_volume(MTM_VOXEL_UINT16, &grid);
    const mtm_volume_write_options options = mtm_volume_write_defaults();
    const char *const names[] = {"first.nrrd", "second.nrrd"};
    size_t counts[2];
    for (int n = 0; n < 2; n++) {
        mtm_error error;
        assert_ok(mtm_volume_write(volume, names[n], &options, &error), error);
        counts[n] = read_back(names[n], bytes[n], sizeof bytes[n]);
    }
    assert_int_equal(counts[0], counts[1]);
    assert_memory_equal(bytes[0], bytes[1], counts[0]);
    const char *gzip = strstr(bytes[0], "\n\n") + 2;
    assert_memory_equal(gzip, "\x1f\x8b\x08\x00\x00\x00\x00\x00", 8); /* neither a name nor a time */
    mtm_volume_destroy(volume);
}

static void what_nrrd_cannot_state_is_refused(void **state) {
    (void)state;
    mtm_error error;
    mtm_volume *volume = NULL;
    mtm_grid grid = mtm_grid_defaults(1, 1, 1);
    const mtm_volume_write_options options = mtm_volume_write_defaults();
    assert_ok(mtm_volume_create(&grid, MTM_VOXEL_UINT8, NULL, 2.0, 0.5, &volume, &error), error);
    assert_fails(mtm_volume_write(volume, "a.nrrd", &options, &error), MTM_ARGUMENT, error,
                 "slope 2 and intercept 0.5");
    mtm_volume_destroy(volume);
    strcpy(grid.unit, "m\nm");
    volume = scratch_volume(MTM_VOXEL_UINT8, &grid);
    assert_fails(mtm_volume_write(volume, "a.nrrd", &options, &error), MTM_ARGUMENT, error, "unit");
    mtm_volume_destroy(volume);
    grid.unit[0] = '\0';
    volume = scratch_volume(MTM_VOXEL_UINT8, &grid);
    assert_fails(mtm_volume_write(volume, "a.raw", &options, &error), MTM_ARGUMENT, error,
                 "a.raw: volumes are written to names that end in .nrrd or .nhdr");
    assert_fails(mtm_volume_write(volume, "a\nb.nhdr", &options, &error), MTM_ARGUMENT, error, "control");
    mtm_volume_destroy(volume);
}

static void a_failed_write_leaves_nothing_behind(void **state) {
    (void)state;
    scratch_clear();
    mtm_error error;
    const mtm_grid grid = mtm_grid_defaults(50, 50, 50);
    mtm_volume *volume = scratch_volume(MTM_VOXEL_INT32, &grid);
    for (int n = 0; n < 4; n++) {
        const mtm_volume_write_options options = {.is_gzip = n & 1};
        assert_int_equal(symlink("/dev/full", paths[n / 2]), 0);
        assert_fails(mtm_volume_write(volume, paths[n / 2], &options, &error), MTM_IO, error,
                     "cannot be written: No space left on device");
        assert_int_equal(scratch_count(), 1); /* the link itself */
        assert_int_equal(remove(paths[n / 2]), 0);
    }
    const mtm_volume_write_options options = mtm_volume_write_defaults();
    assert_int_equal(symlink("/dev/full", "a.raw.gz"), 0);
    assert_fails(mtm_volume_write(volume, "a.nhdr", &options, &error), MTM_IO, error, "No space left");
    assert_int_equal(scratch_count(), 1);
    assert_int_equal(remove("a.raw.gz"), 0);
    assert_fails(mtm_volume_write(volume, "gone/a.nhdr", &options, &error), MTM_IO, error, "gone/a.raw.gz: ");
    assert_int_equal(mkdir("a.nhdr", 0700), 0);
    assert_fails(mtm_volume_write(volume, "a.nhdr", &options, &error), MTM_IO, error, "a.nhdr: ");
    assert_int_equal(scratch_count(), 1);
    struct stat device;
    assert_true(stat("/dev/full", &device) == 0 && S_ISCHR(device.st_mode));
    mtm_volume_destroy(volume);
}

/* The old data must not have been replaced when the new header turns out not to fit. */
static void a_failed_header_leaves_older_data_alone(void **state) {
    (void)state;
    scratch_clear();
    mtm_error error;
    const mtm_grid grid = mtm_grid_defaults(2, 2, 2);
    mtm_volume *volume = scratch_volume(MTM_VOXEL_UINT8, &grid);
    const mtm_volume_write_options options = {.is_gzip = false};
    scratch_write("a.raw", "older data", NULL, 0);
    assert_int_equal(symlink("/dev/full", "a.nhdr"), 0);
    assert_fails(mtm_volume_write(volume, "a.nhdr", &options, &error), MTM_IO, error, "No space left");
    char bytes[32];
    assert_int_equal(read_back("a.raw", bytes, sizeof bytes), 10);
    assert_memory_equal(bytes, "older data", 10);
    mtm_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_type_encoding_and_order_comes_back),
        cmocka_unit_test(every_grid_comes_back_bit_for_bit),
        cmocka_unit_test(a_volume_of_several_chunks_comes_back),
        cmocka_unit_test(the_same_volume_gives_the_same_bytes),
        cmocka_unit_test(what_nrrd_cannot_state_is_refused),
        cmocka_unit_test(a_failed_write_leaves_nothing_behind),
        cmocka_unit_test(a_failed_header_leaves_older_data_alone),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
