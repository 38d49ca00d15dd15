/* SPDX-License-Identifier: BSD-3-Clause
 * Against teem's own program: unu reads what we write, and we read what unu writes. */
#include "metamer/volume.h"
#include "scratch.h"

/* Runs unu with these arguments; its chatter is dropped. False where it fails. */
static bool run_unu(const char *arguments) {
    char command[512];
    (void)snprintf(command, sizeof command,
                   "unu=$(command -v teem-unu || command -v unu) && $unu %s >unu.log 2>&1", arguments);
    return system(command) == 0;
}

static void skip_without_unu(void) {
    if (system("command -v teem-unu >unu.log || command -v unu >unu.log") == 0) return;
    print_message("skipped: teem's unu is not installed\n");
    skip();
}

static mtm_grid oblique_grid(void) {
    mtm_grid grid = mtm_grid_defaults(5, 4, 3);
    const double axes[3][3] = {{0.5, 0.25, 0}, {-0.125, 0.75, 0}, {0, 0.1, 2.5}};
    memcpy(grid.axes, axes, sizeof axes);
    grid.origin[0] = -12.75;
    grid.is_oriented = true;
    strcpy(grid.unit, "mm");
    return grid;
}

/* Small positive numbers in every type, so that no conversion of unu's changes them. */
static mtm_volume *counting_volume(mtm_voxel_type type) {
    const mtm_grid grid = oblique_grid();
    union {
        int8_t int8[60];
        int16_t int16[60];
        int32_t int32[60];
        int64_t int64[60];
        float float32[60];
        double float64[60];
    } voxels;
    for (int n = 0; n < 60; n++) {
        switch (mtm_voxel_type_bytes(type)) {
        case 1: voxels.int8[n] = (int8_t)(n + 1); break;
        case 2: voxels.int16[n] = (int16_t)(259 * n); break;
        case 4: voxels.int32[n] = 70000 * n; break;
        default: voxels.int64[n] = INT64_C(5000000000) * n; break;
        }
        if (type == MTM_VOXEL_FLOAT32) voxels.float32[n] = 0.5f * (float)n;
        if (type == MTM_VOXEL_FLOAT64) voxels.float64[n] = 0.1 * n;
    }
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_ok(mtm_volume_create(&grid, type, &voxels, 1.0, 0.0, &volume, &error), error);
    return volume;
}

static void assert_same_volume(const mtm_volume *volume, const char *path) {
    mtm_volume *back = NULL;
    mtm_error error;
    assert_ok(mtm_volume_read(path, &back, &error), error);
    assert_same_voxels(volume, back);
    const mtm_grid *a = mtm_volume_grid(volume);
    const mtm_grid *b = mtm_volume_grid(back);
    assert_memory_equal(a->axes, b->axes, sizeof a->axes);
    assert_memory_equal(a->origin, b->origin, sizeof a->origin);
    assert_int_equal(a->is_oriented, b->is_oriented);
    assert_string_equal(a->unit, b->unit);
    mtm_volume_destroy(back);
}

/* One program writes, the other reads and writes in another form, the first reads again. */
static void unu_and_we_read_each_other(void **state) {
    (void)state;
    skip_without_unu();
    const char *const encodings[] = {"raw", "gzip"};
    const char *const orders[] = {"little", "big"};
    const char *const extensions[] = {"nrrd", "nhdr"};
    for (int type = 0; type < MTM_VOXEL_TYPE_COUNT; type++) {
        mtm_volume *volume = counting_volume((mtm_voxel_type)type);
        for (int n = 0; n < 8; n++) {
            char ours[16];
            char arguments[128];
            (void)snprintf(ours, sizeof ours, "ours.%s", extensions[n / 4]);
            const mtm_volume_write_options options = {.is_gzip = n & 1, .is_big_endian = n & 2};
            mtm_error error;
            assert_ok(mtm_volume_write(volume, ours, &options, &error), error);
            (void)snprintf(arguments, sizeof arguments, "save -f nrrd -e %s -en %s -i %s -o theirs.%s",
                           encodings[~n & 1], orders[n / 2 % 2 == 0], ours, extensions[n / 4]);
            assert_true(run_unu(arguments));
            (void)snprintf(arguments, sizeof arguments, "theirs.%s", extensions[n / 4]);
            assert_same_volume(volume, arguments);
        }
        mtm_volume_destroy(volume);
    }
}

/* The program's own idea of the values, past anything our reader and writer could agree on by mistake. */
static void unu_sees_the_values_we_wrote(void **state) {
    (void)state;
    skip_without_unu();
    mtm_volume *volume = counting_volume(MTM_VOXEL_INT16);
    const mtm_volume_write_options options = {.is_gzip = true, .is_big_endian = true};
    mtm_error error;
    assert_ok(mtm_volume_write(volume, "ours.nhdr", &options, &error), error);
    assert_true(run_unu("slice -a 2 -p 2 -i ours.nhdr -o plane.nrrd"));
    assert_true(run_unu("slice -a 1 -p 3 -i plane.nrrd -o row.nrrd"));
    assert_true(run_unu("save -f text -i row.nrrd -o row.txt"));
    FILE *stream = fopen("row.txt", "r");
    assert_non_null(stream);
    for (int i = 0; i < 5; i++) {
        int value = 0;
        assert_int_equal(fscanf(stream, "%d", &value), 1);
        assert_true(value == mtm_volume_value(volume, i, 3, 2));
    }
    (void)fclose(stream);
    mtm_volume_destroy(volume);
}

static void both_skip_bytes_after_decompressing(void **state) {
    (void)state;
    skip_without_unu();
    assert_int_equal(system("printf 'xyz12345678' | gzip >skip.gz"), 0);
    scratch_write("skip.nhdr",
                  "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: gzip\nbyte skip: 3\n"
                  "data file: skip.gz\n",
                  NULL, 0);
    assert_true(run_unu("save -f nrrd -e raw -i skip.nhdr -o theirs.nrrd"));
    const char *const names[] = {"skip.nhdr", "theirs.nrrd"};
    for (int n = 0; n < 2; n++) {
        mtm_volume *volume = NULL;
        mtm_error error;
        assert_ok(mtm_volume_read(names[n], &volume, &error), error);
        assert_memory_equal(mtm_volume_voxels(volume), "12345678", 8);
        mtm_volume_destroy(volume);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unu_and_we_read_each_other),
        cmocka_unit_test(unu_sees_the_values_we_wrote),
        cmocka_unit_test(both_skip_bytes_after_decompressing),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
