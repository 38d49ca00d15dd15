/* SPDX-License-Identifier: BSD-3-Clause */
#include <sys/stat.h>
#include <zlib.h>

#include "metamer/volume.h"
#include "scratch.h"

static const unsigned char zeros[64];

static void assert_bad_text(const char *text, mtm_status status, const char *message) {
    scratch_write("a.nrrd", text, zeros, sizeof zeros);
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_fails(mtm_volume_read("a.nrrd", &volume, &error), status, error, message);
    if (status != MTM_IO)
        assert_non_null(strstr(error.message, "a.nrrd: ")); /* else the data file is named */
    assert_null(volume);
}

/* A good header but for one field, which is replaced, added or (NULL) left out. */
static void assert_bad(const char *field, const char *value, mtm_status status, const char *message) {
    const char *const good[][2] = {
        {"type", "short"}, {"dimension", "3"}, {"sizes", "2 2 2"}, {"encoding", "raw"}, {"endian", "little"}};
    char text[1024] = "NRRD0004\n";
    bool is_replaced = false;
    for (size_t n = 0; n < sizeof good / sizeof *good; n++) {
        const bool is_it = strcmp(good[n][0], field) == 0;
        const char *shown = is_it ? value : good[n][1];
        is_replaced = is_replaced || is_it;
        if (shown != NULL)
            (void)snprintf(text + strlen(text), sizeof text - strlen(text), "%s: %s\n", good[n][0], shown);
    }
    if (!is_replaced)
        (void)snprintf(text + strlen(text), sizeof text - strlen(text), "%s: %s\n", field, value);
    strcat(text, "\n");
    assert_bad_text(text, status, message);
}

static void missing_fields_are_named(void **state) {
    (void)state;
    const char *const fields[] = {"type", "dimension", "sizes", "encoding", "endian"};
    for (size_t n = 0; n < 5; n++) {
        char message[64];
        (void)snprintf(message, sizeof message, "field '%s' is missing", fields[n]);
        assert_bad(fields[n], NULL, MTM_FORMAT, message);
    }
}

static void wrong_values_are_named_with_their_field(void **state) {
    (void)state;
    assert_bad("type", "block", MTM_FORMAT, "field 'type' is 'block'");
    assert_bad("type", "char", MTM_FORMAT, "field 'type' is 'char'");
    assert_bad("dimension", "2", MTM_FORMAT, "field 'dimension' is 2, volumes have 3 axes");
    assert_bad("dimension", "17", MTM_FORMAT, "the format ends at 16");
    assert_bad("dimension", "three", MTM_FORMAT, "field 'dimension' is 'three'");
    assert_bad("sizes", "103 94", MTM_FORMAT,
               "field 'sizes' has 2 numbers (\"103 94\"), dimension 3 needs 3");
    assert_bad("sizes", "2 -2 2", MTM_FORMAT, "field 'sizes' has '-2'");
    assert_bad("sizes", "2 0 2", MTM_FORMAT, "field 'sizes' has '0'");
    assert_bad("sizes", "2 2.5 2", MTM_FORMAT, "field 'sizes' has '2.5'");
    assert_bad("encoding", "ascii", MTM_FORMAT, "encoding 'ascii' is not supported; raw and gzip are");
    assert_bad("encoding", "bzip2", MTM_FORMAT, "encoding 'bzip2' is not supported");
    assert_bad("endian", "middle", MTM_FORMAT, "field 'endian' is 'middle'");
    assert_bad("line skip", "-1", MTM_FORMAT, "field 'line skip' is '-1'");
    assert_bad("line skip", "99", MTM_FORMAT, "field 'line skip' is 99");
    assert_bad("byte skip", "-2", MTM_FORMAT, "field 'byte skip' is '-2'");
    assert_bad("byte skip", "99999999999999999999", MTM_FORMAT, "field 'byte skip' is '9999");
    assert_bad("byte skip", "9223372036854775807", MTM_FORMAT,
               "has 0 bytes of voxels, its header asks for 16");
}

static void wrong_lines_are_named_with_their_number(void **state) {
    (void)state;
    assert_bad("spacing", "1 1 1", MTM_FORMAT, "line 7: unknown field 'spacing'; did you mean 'spacings'?");
    assert_bad("content", "one\nCONTENT: two", MTM_FORMAT, "line 8: field 'content' stands there a second");
    assert_bad("content", "one\nno colon", MTM_FORMAT, "line 8: 'no colon' is no 'field: value'");
    assert_bad_text("NRRD0009\n\n", MTM_FORMAT, "begins with 'NRRD0009'");
    assert_bad_text("P5 2 2 255\n", MTM_FORMAT, "known format (NRRD)");
}

static void grids_without_a_meaning_are_refused(void **state) {
    (void)state;
    assert_bad("spacings", "1 nan 1", MTM_FORMAT, "field 'spacings' gives axis 1 a spacing of nan");
    assert_bad("spacings", "1 1 0", MTM_FORMAT, "field 'spacings' gives axis 2 a spacing of 0");
    assert_bad("spacings", "inf 1 1", MTM_FORMAT, "a spacing of inf");
    assert_bad("spacings", "1 1", MTM_FORMAT, "field 'spacings' has 2 numbers");
    assert_bad("spacings", "1 1 mm", MTM_FORMAT, "field 'spacings' has 'mm' where a number");
    assert_bad("space", "somewhere", MTM_FORMAT, "field 'space' is 'somewhere'");
    assert_bad("space dimension", "2", MTM_FORMAT, "field 'space dimension' is '2', volumes need 3");
    assert_bad("space directions", "(1,0,0) (0,1,0) (0,0,1)", MTM_FORMAT, "needs a field 'space'");
    assert_bad("space", "LPS\nspace directions: (1,0,0) (0,1,0) (1,1,0)", MTM_FORMAT, "dependent axes");
    assert_bad("space", "LPS\nspace directions: (1,0,0) (0,1,0) (0,0,0)", MTM_FORMAT, "axis of length 0");
    assert_bad("space", "LPS\nspace directions: (1,0,0) (0,1,0)", MTM_FORMAT, "expected 3 times");
    assert_bad("space", "LPS\nspace directions: (1,0,0) (0,1,nan) (0,0,1)", MTM_FORMAT, "expected 3 times");
    assert_bad("space", "LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1) x", MTM_FORMAT, "expected 3 times");
    assert_bad("space", "LPS\nspace directions: (1,0,0) (0,1,0) none", MTM_FORMAT,
               "axis 2 holds 2 components");
    assert_bad("space", "LPS\nspace origin: (1,2)", MTM_FORMAT, "field 'space origin' is '(1,2)'");
    assert_bad("units", "mm mm mm", MTM_FORMAT, "expected 3 texts in double quotes");
    assert_bad("kinds", "domain domain", MTM_FORMAT, "field 'kinds' has 2 kinds");
}

static void several_values_per_voxel_are_refused(void **state) {
    (void)state;
    assert_bad_text("NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 2 2\nkinds: vector space space space\n"
                    "encoding: raw\n\n",
                    MTM_FORMAT,
                    "axis 0 holds 3 components per voxel (kind vector); volumes have one value per voxel");
    assert_bad_text("NRRD0004\ntype: uchar\ndimension: 4\nsizes: 3 2 2 2\nspacings: nan 1 1 1\n"
                    "encoding: raw\n\n",
                    MTM_FORMAT, "axis 0 holds 3 components per voxel (kind not given)");
    assert_bad_text("NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 2\nencoding: raw\n\n", MTM_FORMAT,
                    "field 'sizes' (\"2 2 2 2\") has 4 axes in space, volumes have 3");
}

static void a_header_that_promises_too_much_is_caught_before_memory_is(void **state) {
    (void)state;
    assert_bad("sizes", "4 3 3", MTM_FORMAT, "a.nrrd: has 64 bytes of voxels, its header asks for 72");
    assert_bad("sizes", "100000 100000 50", MTM_FORMAT, "its header asks for 1000000000000");
    assert_bad("sizes", "4294967296 4294967296 4", MTM_LIMIT, "field 'sizes' has 4294967296");
    assert_bad("sizes", "99999999999999999999 1 1", MTM_LIMIT, "field 'sizes' has 99999999999999999999");
    assert_bad("sizes", "2147483647 2147483647 2147483647", MTM_LIMIT, "more than 2^40 bytes");
    assert_bad("encoding", "gzip\nbyte skip: -1", MTM_FORMAT, "which only encoding raw allows");
    assert_bad_text("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 100000 100000 50\nencoding: gzip\n\n",
                    MTM_FORMAT, "has at most 66048 bytes of voxels, its header asks for 500000000000");
}

static void data_files_that_are_not_there_are_named(void **state) {
    (void)state;
    assert_bad("data file", "gone.raw", MTM_IO, "gone.raw: cannot be opened: No such file");
    assert_bad("data file", "/dev/zero", MTM_IO, "/dev/zero: cannot be opened: it is a device");
    assert_bad("data file", "gone.%d 1 2 1", MTM_IO, "gone.1: cannot be opened");
    assert_bad("data file", "gone.%d 1 9 1", MTM_FORMAT, "names 9 files, sizes \"2 2 2\" need 2");
    assert_bad("data file", "gone.%d 2 1 1", MTM_FORMAT, "whose step does not lead");
    assert_bad("data file", "gone.%d 1 2 0", MTM_FORMAT, "whose step does not lead");
    assert_bad("data file", "gone.%d 1 2 1 7", MTM_FORMAT, "files of 7 axes");
    assert_bad("data file", "%s%n 1 2 1", MTM_IO, "%s%n 1 2 1: cannot be opened");
    assert_bad("data file", "%99999999999d 1 2 1", MTM_IO, "1 2 1: cannot be opened");
    assert_bad("data file", "", MTM_FORMAT, "field 'data file' is empty");
    scratch_write("a.nrrd",
                  "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: raw\ndata file: LIST\n", NULL,
                  0);
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_fails(mtm_volume_read("a.nrrd", &volume, &error), MTM_FORMAT, error, "but no file name follows");
}

static void things_that_are_no_files_are_refused(void **state) {
    (void)state;
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_fails(mtm_volume_read("gone.nrrd", &volume, &error), MTM_IO, error, "gone.nrrd: cannot be opened");
    assert_fails(mtm_volume_read(".", &volume, &error), MTM_IO, error, "it is a folder");
    scratch_write("empty.nrrd", "", NULL, 0);
    assert_fails(mtm_volume_read("empty.nrrd", &volume, &error), MTM_FORMAT, error, "empty.nrrd: is empty");
    assert_int_equal(mkfifo("pipe.nrrd", 0600), 0); /* which would make a reader wait for ever */
    assert_fails(mtm_volume_read("pipe.nrrd", &volume, &error), MTM_IO, error, "no regular file");
}

/* Cuts a good file at every byte; it must never be read, and never without a message. */
static void assert_no_beginning_is_read(const char *bytes, size_t count) {
    for (size_t length = 0; length < count; length++) {
        scratch_write("cut.nrrd", "", bytes, length);
        mtm_volume *volume = NULL;
        mtm_error error = {""};
        assert_int_not_equal(mtm_volume_read("cut.nrrd", &volume, &error), MTM_OK);
        assert_non_null(strstr(error.message, "cut.nrrd: "));
        assert_null(volume);
    }
}

static size_t read_back(const char *name, char *bytes, size_t capacity) {
    FILE *stream = fopen(name, "rb");
    assert_non_null(stream);
    const size_t count = fread(bytes, 1, capacity, stream);
    (void)fclose(stream);
    return count;
}

static void no_beginning_of_a_file_passes_for_the_whole(void **state) {
    (void)state;
    char bytes[1024];
    mtm_grid grid = mtm_grid_defaults(2, 3, 4);
    grid.is_oriented = true;
    mtm_volume *volume = scratch_volume(MTM_VOXEL_INT16, &grid);
    mtm_volume_write_options options = mtm_volume_write_defaults();
    for (int is_gzip = 0; is_gzip < 2; is_gzip++) {
        mtm_error error;
        options.is_gzip = is_gzip == 1;
        assert_ok(mtm_volume_write(volume, "whole.nrrd", &options, &error), error);
        const size_t count = read_back("whole.nrrd", bytes, sizeof bytes);
        assert_true(count < sizeof bytes);
        assert_no_beginning_is_read(bytes, count);
    }
    mtm_volume_destroy(volume);
}

static void damaged_gzip_data_are_refused(void **state) {
    (void)state;
    const char *const header = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: gzip\n\n";
    assert_bad_text(header, MTM_FORMAT, "gzip data are damaged: incorrect header check");
    scratch_write("b.nrrd", header, NULL, 0);
    gzFile file = gzopen("b.nrrd", "ab");
    assert_int_equal(gzwrite(file, zeros, 63), 63);
    assert_int_equal(gzclose(file), Z_OK);
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_fails(mtm_volume_read("b.nrrd", &volume, &error), MTM_FORMAT, error,
                 "b.nrrd: has 63 bytes of voxels, its header asks for 64");

    scratch_write("b.nrrd", header, NULL, 0);
    file = gzopen("b.nrrd", "ab");
    assert_int_equal(gzwrite(file, zeros, 64), 64);
    assert_int_equal(gzclose(file), Z_OK);
    char bytes[512];
    const size_t count = read_back("b.nrrd", bytes, sizeof bytes);
    bytes[count - 8] ^= 1; /* the first byte of the checksum */
    scratch_write("b.nrrd", "", bytes, count);
    assert_fails(mtm_volume_read("b.nrrd", &volume, &error), MTM_FORMAT, error, "incorrect data check");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(missing_fields_are_named),
        cmocka_unit_test(wrong_values_are_named_with_their_field),
        cmocka_unit_test(wrong_lines_are_named_with_their_number),
        cmocka_unit_test(grids_without_a_meaning_are_refused),
        cmocka_unit_test(several_values_per_voxel_are_refused),
        cmocka_unit_test(a_header_that_promises_too_much_is_caught_before_memory_is),
        cmocka_unit_test(data_files_that_are_not_there_are_named),
        cmocka_unit_test(things_that_are_no_files_are_refused),
        cmocka_unit_test(no_beginning_of_a_file_passes_for_the_whole),
        cmocka_unit_test(damaged_gzip_data_are_refused),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
