/* SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <zlib.h>

#include "metamer/volume.h"
#include "scratch.h"

static const char voxels_text[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789#!";

/* Reads a file of this header and the bytes above; the header's first line, type … are in `fields`. */
static mtm_volume *read_header(const char *fields) {
    scratch_write("a.nrrd", fields, voxels_text, 64);
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_ok(mtm_volume_read("a.nrrd", &volume, &error), error);
    return volume;
}

#define BASIC "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n"

static mtm_grid grid_of(const char *fields) {
    char text[1024];
    (void)snprintf(text, sizeof text, BASIC "%s\n\n", fields);
    mtm_volume *volume = read_header(text);
    const mtm_grid grid = *mtm_volume_grid(volume);
    mtm_volume_destroy(volume);
    return grid;
}

static void assert_axes(const mtm_grid *grid, const double axes[3][3], const double origin[3]) {
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < 3; i++) assert_true(grid->axes[axis][i] == axes[axis][i]);
    for (int i = 0; i < 3; i++) assert_true(grid->origin[i] == origin[i]);
}

static void assert_spacings(const mtm_grid *grid, double x, double y, double z) {
    assert_axes(grid, (const double[3][3]){{x, 0, 0}, {0, y, 0}, {0, 0, z}}, (const double[3]){0, 0, 0});
}

static void an_attached_raw_file_is_read(void **state) {
    (void)state;
    mtm_volume *volume = read_header(BASIC "\n");
    assert_int_equal(mtm_volume_type(volume), MTM_VOXEL_UINT8);
    assert_int_equal(mtm_volume_grid(volume)->size[1], 3);
    assert_memory_equal(mtm_volume_voxels(volume), voxels_text, 24);
    mtm_volume_destroy(volume);
}

static void the_header_may_be_written_in_many_ways(void **state) {
    (void)state;
    mtm_volume *volume =
        read_header("NRRD0001\r\n# a comment: with a colon\r\nTYPE:   Unsigned Char  \r\nDimension: 3\r\n"
                    "key with: colon:=value\r\ncontent: any: text := here\r\nsizes:\t2  3 4\r\n"
                    "lineskip: 0\r\nencoding:RAW\r\nEndian: LITTLE\r\nmeasurementframe: (1,0,0)\r\n"
                    "old min: 3\r\nthicknesses: 1 1 1\r\ncenters: cell cell cell\r\n\r\n");
    assert_memory_equal(mtm_volume_voxels(volume), voxels_text, 24);
    mtm_volume_destroy(volume);
}

static void every_spelling_of_every_type_is_known(void **state) {
    (void)state;
    const char *const names[MTM_VOXEL_TYPE_COUNT][7] = {
        {"signed char", "int8", "int8_t"},
        {"uchar", "unsigned char", "uint8", "uint8_t"},
        {"short", "short int", "signed short", "signed short int", "int16", "int16_t"},
        {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"},
        {"int", "signed int", "int32", "int32_t"},
        {"uint", "unsigned int", "uint32", "uint32_t"},
        {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64",
         "int64_t"},
        {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"},
        {"float"},
        {"double"},
    };
    for (int type = 0; type < MTM_VOXEL_TYPE_COUNT; type++) {
        for (int n = 0; n < 7 && names[type][n] != NULL; n++) {
            char text[256];
            (void)snprintf(text, sizeof text,
                           "NRRD0005\ntype: %s\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: big\n\n",
                           names[type][n]);
            mtm_volume *volume = read_header(text);
            assert_int_equal(mtm_volume_type(volume), type);
            mtm_volume_destroy(volume);
        }
    }
}

static void both_byte_orders_give_the_same_values(void **state) {
    (void)state;
    const struct {
        const char *type, *order;
        char bytes[9];
        double value;
    } cases[] = {
        {"short", "little", "\x02\x01", 258},
        {"short", "big", "\xff\xfe", -2},
        {"uint", "little", "\x04\x03\x02\x01", 0x01020304},
        {"uint", "big", "\x01\x02\x03\x04", 0x01020304},
        {"float", "big", "\x3f\xc0\x00\x00", 1.5},
        {"int64", "little", "\x08\x07\x06\x05\x04\x00\x00\x00", 0x0405060708},
        {"int64", "big", "\x00\x00\x00\x04\x05\x06\x07\x08", 0x0405060708},
        {"double", "little", "\x00\x00\x00\x00\x00\x00\xf8\xbf", -1.5},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        char text[128];
        (void)snprintf(text, sizeof text,
                       "NRRD0004\ntype: %s\ndimension: 3\nsizes: 1 1 1\nencoding: raw\nendian: %s\n\n",
                       cases[n].type, cases[n].order);
        scratch_write("a.nrrd", text, cases[n].bytes, 8);
        mtm_volume *volume = NULL;
        mtm_error error;
        assert_ok(mtm_volume_read("a.nrrd", &volume, &error), error);
        assert_true(mtm_volume_value(volume, 0, 0, 0) == cases[n].value);
        mtm_volume_destroy(volume);
    }
}

static void spacings_become_axes_and_default_to_one(void **state) {
    (void)state;
    mtm_grid grid = grid_of("content: nothing else");
    assert_spacings(&grid, 1, 1, 1);
    assert_false(grid.is_oriented);
    assert_string_equal(grid.unit, "");
    grid = grid_of("spacings: 0.5 1e-3 -2\nunits: \"mm\" \"mm\" \"mm\"");
    assert_spacings(&grid, 0.5, 1e-3, -2);
    assert_string_equal(grid.unit, "mm");
    grid = grid_of("spacings: nan NaN nan\nunits: \"mm\" \"mm\" \"s\"");
    assert_spacings(&grid, 1, 1, 1);
    assert_string_equal(grid.unit, "");
    grid = grid_of("space: 3D-left-handed\nspacings: 3.2 3.2 1.5\nspace directions: none none none");
    assert_spacings(&grid, 3.2, 3.2, 1.5);
}

/* Nodes sit on the ends, n − 1 steps apart; cells fill n steps, their centers half a step inside. */
static void axis_ends_give_spacing_and_origin(void **state) {
    (void)state;
    const mtm_grid grid = grid_of("axis mins: 0 10 -4\naxis maxs: 1 16 12\ncenterings: node cell cell");
    assert_axes(&grid, (const double[3][3]){{1, 0, 0}, {0, 2, 0}, {0, 0, 4}}, (const double[3]){0, 11, -2});
}

static void anatomical_spaces_are_turned_to_lps(void **state) {
    (void)state;
    const char *const directions = "space directions: (1,2,3) (-4,5,6) (7,8,-9)\nspace origin: ( 10 , 20,30)";
    const struct {
        const char *space;
        double x, y;
        bool is_oriented;
    } cases[] = {
        {"space: left-posterior-superior", 1, 1, true},
        {"space: LPS", 1, 1, true},
        {"space: right-anterior-superior", -1, -1, true},
        {"space: RAS", -1, -1, true},
        {"space: Left-Anterior-Superior", 1, -1, true},
        {"space: 3D-right-handed", 1, 1, false},
        {"space: scanner-xyz", 1, 1, false},
        {"space dimension: 3", 1, 1, false},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        char text[256];
        (void)snprintf(text, sizeof text, "%s\n%s\nspace units: \"mm\" \"mm\" \"mm\"", cases[n].space,
                       directions);
        const mtm_grid grid = grid_of(text);
        const double x = cases[n].x;
        const double y = cases[n].y;
        assert_axes(&grid, (const double[3][3]){{x, 2 * y, 3}, {-4 * x, 5 * y, 6}, {7 * x, 8 * y, -9}},
                    (const double[3]){10 * x, 20 * y, 30});
        assert_int_equal(grid.is_oriented, cases[n].is_oriented);
        assert_string_equal(grid.unit, "mm");
    }
}

static void a_space_with_time_uses_its_first_three_axes(void **state) {
    (void)state;
    mtm_volume *volume = read_header("NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 3 4 1\nencoding: raw\n"
                                     "space: RAST\nspace directions: (1,0,0,0) (0,2,0,0) (0,0,3,0) none\n\n");
    assert_axes(mtm_volume_grid(volume), (const double[3][3]){{-1, 0, 0}, {0, -2, 0}, {0, 0, 3}},
                (const double[3]){0, 0, 0});
    mtm_volume_destroy(volume);
}

static void further_axes_of_size_one_are_dropped(void **state) {
    (void)state;
    const char *const cases[] = {
        "dimension: 4\nsizes: 1 2 3 4\nkinds: scalar domain domain domain\nspacings: nan 5 6 7",
        "dimension: 4\nsizes: 2 3 4 1\nspacings: 5 6 7 nan",
        "dimension: 5\nsizes: 2 3 1 4 1\nspacings: 5 6 9 7 nan",
        "dimension: 4\nsizes: 1 2 3 4\nspace: LPS\nspace directions: none (5,0,0) (0,6,0) (0,0,7)",
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        char text[256];
        (void)snprintf(text, sizeof text, "NRRD0004\ntype: uint8\n%s\nencoding: raw\n\n", cases[n]);
        mtm_volume *volume = read_header(text);
        const mtm_grid *grid = mtm_volume_grid(volume);
        assert_true(grid->size[0] == 2 && grid->size[1] == 3 && grid->size[2] == 4);
        assert_spacings(grid, 5, 6, 7);
        mtm_volume_destroy(volume);
    }
}

static void assert_reads(const char *path, const void *voxels, size_t byte_count) {
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_ok(mtm_volume_read(path, &volume, &error), error);
    assert_memory_equal(mtm_volume_voxels(volume), voxels, byte_count);
    mtm_volume_destroy(volume);
}

static void lines_and_bytes_are_skipped(void **state) {
    (void)state;
    scratch_write("a.nrrd", BASIC "line skip: 2\nbyte skip: 3\n\nfirst\nsecond\n123", voxels_text, 24);
    assert_reads("a.nrrd", voxels_text, 24);
    scratch_write("a.nrrd", BASIC "byte skip: -1\n\nanything at all", voxels_text, 24);
    assert_reads("a.nrrd", voxels_text, 24);
}

static void detached_data_are_found_beside_the_header(void **state) {
    (void)state;
    scratch_write("a b.raw", "", voxels_text, 24);
    scratch_write("a.nhdr", BASIC "datafile: a b.raw\n", NULL, 0);
    assert_reads("a.nhdr", voxels_text, 24);
    assert_reads("./a.nhdr", voxels_text, 24);
    scratch_write("a.nhdr", BASIC "data file: ./a b.raw\n\n", NULL, 0);
    assert_reads("a.nhdr", voxels_text, 24);
}

static void voxels_may_lie_in_a_list_of_files(void **state) {
    (void)state;
    for (int n = 0; n < 12; n++) {
        char name[16];
        (void)snprintf(name, sizeof name, "s%03d.raw", n);
        scratch_write(name, "skipped\n", voxels_text + 2 * n, n < 4 ? 6 : 2);
    }
    scratch_write("a.nhdr", BASIC "line skip: 1\ndata file: LIST 1\n", "s000.raw\ns001.raw\n", 18);
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_fails(mtm_volume_read("a.nhdr", &volume, &error), MTM_FORMAT, error, "2 files");

    char names[12 * 9 + 1] = "";
    for (int n = 0; n < 12; n++) (void)snprintf(names + 9 * n, 10, "s%03d.raw\n", n);
    scratch_write("a.nhdr", BASIC "line skip: 1\ndata file: LIST 1\n", names, sizeof names - 1);
    assert_reads("a.nhdr", voxels_text, 24);
    scratch_write("a.nhdr", BASIC "line skip: 1\ndata file: s%03d.raw 0 11 1 1\n", NULL, 0);
    assert_reads("a.nhdr", voxels_text, 24);
    scratch_write("a.nhdr", BASIC "line skip: 1\ndata file: s%03d.raw 3 0 -1\n", NULL, 0);
    assert_reads("a.nhdr", "ghijklefghijcdefghabcdef", 24);
    scratch_write("t1.raw", "", voxels_text, 12);
    scratch_write("t2.raw", "", voxels_text + 12, 12);
    scratch_write("a.nhdr", BASIC "data file: t%d.raw 1 2 1 3\n", NULL, 0); /* slabs along the slowest axis */
    assert_reads("a.nhdr", voxels_text, 24);
}

/* The two members of a gzip file, which count as one. */
static void write_members(const char *name, const char *header, const char *first, const char *second) {
    scratch_write(name, header, NULL, 0);
    const char *const members[] = {first, second};
    for (int n = 0; n < 2; n++) {
        gzFile file = gzopen(name, "ab");
        assert_non_null(file);
        assert_int_equal(gzwrite(file, members[n], (unsigned int)strlen(members[n])), strlen(members[n]));
        assert_int_equal(gzclose(file), Z_OK);
    }
}

#define GZIPPED "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 4\nencoding: gz\n"

static void gzip_members_follow_each_other(void **state) {
    (void)state;
    write_members("a.nrrd", GZIPPED "\n", "abcdefg", "hijklmnopqrstuvwx");
    assert_reads("a.nrrd", voxels_text, 24);
    write_members("a.nrrd", GZIPPED "line skip: 1\nbyte skip: 9\n\nplain line\n", "12345678",
                  "9abcdefghijklmnopqrstuvwxyz");
    assert_reads("a.nrrd", voxels_text, 24);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_attached_raw_file_is_read),
        cmocka_unit_test(the_header_may_be_written_in_many_ways),
        cmocka_unit_test(every_spelling_of_every_type_is_known),
        cmocka_unit_test(both_byte_orders_give_the_same_values),
        cmocka_unit_test(spacings_become_axes_and_default_to_one),
        cmocka_unit_test(axis_ends_give_spacing_and_origin),
        cmocka_unit_test(anatomical_spaces_are_turned_to_lps),
        cmocka_unit_test(a_space_with_time_uses_its_first_three_axes),
        cmocka_unit_test(further_axes_of_size_one_are_dropped),
        cmocka_unit_test(lines_and_bytes_are_skipped),
        cmocka_unit_test(detached_data_are_found_beside_the_header),
        cmocka_unit_test(voxels_may_lie_in_a_list_of_files),
        cmocka_unit_test(gzip_members_follow_each_other),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
