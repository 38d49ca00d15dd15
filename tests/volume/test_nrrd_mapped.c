/* SPDX-License-Identifier: BSD-3-Clause
 * Volumes whose voxels are mapped are the same as those read into memory, and cost none. */
#include <sys/resource.h>
#include <zlib.h>

#include "scratch.h"
#include "volume/volume.h"
#include "volume/voxel_type.h"

enum { HISTOGRAM_BINS = 7, VOXELS = 3 * 5 * 2, VOXEL_BYTES_LIMIT = 8 };

/* One way to lay the voxels down: the header's fields, and what stands before the voxels. */
typedef struct layout {
    const char *fields;
    const char *before;
    bool is_detached, is_gzip, is_swapped;
    bool maps_bytes, maps_words; /* whether voxels of one byte, and of more, are mapped */
} layout;

static const layout layouts[] = {
    {.fields = "content: aligned\n", .before = "", .maps_bytes = true, .maps_words = true},
    {.fields = "byte skip: 1\n", .before = "#", .maps_bytes = true},
    {.fields = "content: swapped\n", .before = "", .is_swapped = true, .maps_bytes = true},
    {.fields = "content: gzip\n", .before = "", .is_gzip = true},
    {.fields = "byte skip: -1\n", .before = "any 16 bytes or ", .maps_bytes = true, .maps_words = true},
    {.fields = "data file: a.raw\n",
     .before = "",
     .is_detached = true,
     .maps_bytes = true,
     .maps_words = true},
    {.fields = "line skip: 1\nbyte skip: 5\ndata file: a.raw\n",
     .before = "one line \n5 byt",
     .is_detached = true,
     .maps_bytes = true},
    {.fields = "line skip: 1\nbyte skip: 6\ndata file: a.raw\n",
     .before = "one line \nsix by",
     .is_detached = true,
     .maps_bytes = true,
     .maps_words = true},
    {.fields = "data file: LIST 3\na.raw\n",
     .before = "",
     .is_detached = true,
     .maps_bytes = true,
     .maps_words = true},
};

static void append(const char *name, const void *bytes, size_t byte_count, bool is_gzip) {
    gzFile file = gzopen(name, is_gzip ? "ab" : "abT"); /* T: as it is */
    assert_non_null(file);
    assert_int_equal(gzwrite(file, bytes, (unsigned int)byte_count), byte_count);
    assert_int_equal(gzclose(file), Z_OK);
}

/* Writes a header as long as a multiple of 16, which a comment in its second line makes it, and the voxels. */
static void write_layout(const layout *way, const mtm_volume *volume) {
    const mtm_voxel_type type = mtm_volume_type(volume);
    const char *name = type == MTM_VOXEL_FLOAT32   ? "float"
                       : type == MTM_VOXEL_FLOAT64 ? "double"
                                                   : mtm_voxel_type_name(type);
    char header[512];
    int comment = 0;
    int length = 0;
    do {
        length =
            snprintf(header, sizeof header,
                     "NRRD0004\n#%0*d\ntype: %s\ndimension: 3\nsizes: 3 5 2\nencoding: %s\nendian: %s\n%s%s",
                     ++comment, 0, name, way->is_gzip ? "gzip" : "raw",
                     mtm_is_big_endian() == way->is_swapped ? "little" : "big", way->fields,
                     way->is_detached ? "" : "\n");
    } while (length % 16 != 0);
    unsigned char voxels[VOXELS * VOXEL_BYTES_LIMIT];
    const size_t bytes = VOXELS * mtm_voxel_type_bytes(type);
    memcpy(voxels, mtm_volume_voxels(volume), bytes);
    if (way->is_swapped) mtm_voxels_swap_bytes(type, voxels, VOXELS);
    scratch_write("a.nhdr", header, NULL, 0);
    const char *data = way->is_detached ? "a.raw" : "a.nhdr";
    (void)remove("a.raw");
    if (way->before[0] != '\0') append(data, way->before, strlen(way->before), false);
    append(data, voxels, bytes, way->is_gzip);
}

static void assert_same_numbers(const mtm_volume *a, const mtm_volume *b) {
    double ranges[2][2];
    char hashes[2][65];
    uint64_t counts[2][HISTOGRAM_BINS];
    const mtm_volume *const volumes[] = {a, b};
    for (int n = 0; n < 2; n++) {
        mtm_volume_range(volumes[n], &ranges[n][0], &ranges[n][1]);
        mtm_volume_sha256(volumes[n], hashes[n]);
        mtm_volume_histogram(volumes[n], HISTOGRAM_BINS, counts[n]);
    }
    assert_memory_equal(ranges[0], ranges[1], sizeof ranges[0]);
    assert_string_equal(hashes[0], hashes[1]);
    assert_memory_equal(counts[0], counts[1], sizeof counts[0]);
}

static mtm_volume *read_volume(const char *path) {
    mtm_volume *volume = NULL;
    mtm_error error;
    assert_ok(mtm_volume_read(path, &volume, &error), error);
    return volume;
}

static void mapped_and_read_volumes_are_the_same(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 5, 2);
    for (int type = 0; type < MTM_VOXEL_TYPE_COUNT; type++) {
        mtm_volume *volume = scratch_volume((mtm_voxel_type)type, &grid);
        const bool is_byte = mtm_voxel_type_bytes((mtm_voxel_type)type) == 1;
        for (size_t n = 0; n < sizeof layouts / sizeof *layouts; n++) {
            write_layout(&layouts[n], volume);
            mtm_volume *back = read_volume("a.nhdr");
            assert_int_equal(mtm_volume_is_mapped(back),
                             is_byte ? layouts[n].maps_bytes : layouts[n].maps_words);
            assert_same_voxels(volume, back);
            assert_same_numbers(volume, back);
            mtm_volume_destroy(back);
        }
        mtm_volume_destroy(volume);
    }
}

static void several_files_are_read(void **state) {
    (void)state;
    scratch_write("1.raw", "abcdef", NULL, 0);
    scratch_write("2.raw", "ghijkl", NULL, 0);
    scratch_write(
        "a.nhdr",
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 2\nencoding: raw\ndata file: %d.raw 1 2 1\n", NULL,
        0);
    mtm_volume *volume = read_volume("a.nhdr");
    assert_false(mtm_volume_is_mapped(volume));
    assert_memory_equal(mtm_volume_voxels(volume), "abcdefghijkl", 12);
    mtm_volume_destroy(volume);
}

static void a_mapped_volume_may_be_written_over_its_own_file(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(31, 29, 23);
    mtm_volume *volume = scratch_volume(MTM_VOXEL_UINT16, &grid);
    mtm_volume_write_options options = {.is_gzip = false, .is_big_endian = mtm_is_big_endian()};
    mtm_error error;
    assert_ok(mtm_volume_write(volume, "a.nhdr", &options, &error), error);
    mtm_volume *mapped = read_volume("a.nhdr");
    assert_true(mtm_volume_is_mapped(mapped));
    options.is_big_endian = !options.is_big_endian;
    assert_ok(mtm_volume_write(mapped, "a.nhdr", &options, &error), error);
    assert_same_voxels(volume, mapped);
    mtm_volume *back = read_volume("a.nhdr");
    assert_same_voxels(volume, back);
    mtm_volume_destroy(back);
    mtm_volume_destroy(mapped);
    mtm_volume_destroy(volume);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { HAS_SANITIZER = 1 };
#elif defined(__has_feature)
enum { HAS_SANITIZER = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) };
#else
enum { HAS_SANITIZER = 0 };
#endif

/* What a process may allocate; 0 takes the limit away again. Mapped files do not count. */
static void limit_memory(rlim_t bytes) {
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_DATA, &limit), 0);
    limit.rlim_cur = bytes > 0 ? bytes : limit.rlim_max;
    assert_int_equal(setrlimit(RLIMIT_DATA, &limit), 0);
}

static bool is_limit_kept(size_t bytes) {
    void *memory = malloc(bytes);
    const bool is_kept = memory == NULL;
    free(memory);
    return is_kept;
}

/* 256 MiB that a file system stores in no space, under a limit of 64 MiB: mapped they open, and what must be read,
 * the same bytes in the other order, does not. */
static void a_volume_larger_than_memory_opens(void **state) {
    (void)state;
    enum { BYTES = 1 << 28, LIMIT = 1 << 26 };
    scratch_write("a.raw", "a", NULL, 0);
    assert_int_equal(truncate("a.raw", BYTES), 0);
    scratch_write(
        "mapped.nhdr",
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1024 512 512\nencoding: raw\ndata file: a.raw\n", NULL,
        0);
    char header[256];
    (void)snprintf(header, sizeof header,
                   "NRRD0004\ntype: uint16\nendian: %s\ndimension: 3\nsizes: 512 512 512\nencoding: raw\n"
                   "data file: a.raw\n",
                   mtm_is_big_endian() ? "little" : "big");
    scratch_write("read.nhdr", header, NULL, 0);

    limit_memory(LIMIT);
    const bool is_kept = !HAS_SANITIZER && is_limit_kept(BYTES);
    mtm_volume *mapped = NULL;
    mtm_volume *read = NULL;
    mtm_error errors[2] = {{""}, {""}};
    const mtm_status mapped_status =
        is_kept ? mtm_volume_read("mapped.nhdr", &mapped, &errors[0]) : MTM_CANCELLED;
    const mtm_status read_status = is_kept ? mtm_volume_read("read.nhdr", &read, &errors[1]) : MTM_CANCELLED;
    limit_memory(0);
    if (!is_kept) {
        print_message("skipped: the memory of this process cannot be limited\n");
        skip();
    }
    assert_ok(mapped_status, errors[0]);
    double range[2];
    mtm_volume_range(mapped, &range[0], &range[1]);
    assert_true(range[0] == 0.0 && range[1] == 'a');
    mtm_volume_destroy(mapped);
    assert_int_equal(read_status, MTM_MEMORY);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mapped_and_read_volumes_are_the_same),
        cmocka_unit_test(several_files_are_read),
        cmocka_unit_test(a_mapped_volume_may_be_written_over_its_own_file),
        cmocka_unit_test(a_volume_larger_than_memory_opens),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
