/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/mapping.h"

#include <unistd.h>

#include "test.h"

static unsigned char pattern(size_t n) {
    return (unsigned char)(n * 37 + n / 251);
}

static FILE *patterned_file(size_t byte_count) {
    FILE *stream = tmpfile();
    assert_non_null(stream);
    for (size_t n = 0; n < byte_count; n++) (void)putc(pattern(n), stream);
    assert_int_equal(fflush(stream), 0);
    return stream;
}

static void a_part_from_any_offset_outlives_its_stream(void **state) {
    (void)state;
    const long long page = sysconf(_SC_PAGESIZE);
    const size_t size = 3 * (size_t)page + 5;
    const long long offsets[] = {0, 1, page - 1, page, 2 * page + 7, (long long)size - 1};
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
        const size_t count = size - (size_t)offsets[i];
        FILE *stream = patterned_file(size);
        mtm_mapping mapping;
        assert_true(mtm_mapping_open(stream, offsets[i], count, &mapping));
        (void)fclose(stream);
        const unsigned char *bytes = mapping.bytes;
        for (size_t n = 0; n < count; n++) assert_int_equal(bytes[n], pattern((size_t)offsets[i] + n));
        mtm_mapping_close(&mapping);
        assert_null(mapping.bytes);
    }
}

/* Without it the first byte behind a file of whole pages is SIGBUS or SIGSEGV. */
static void the_padding_behind_whole_pages_can_be_read(void **state) {
    (void)state;
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    FILE *stream = patterned_file(2 * page);
    mtm_mapping mapping;
    assert_true(mtm_mapping_open(stream, 0, 2 * page, &mapping));
    const volatile unsigned char *behind = (const unsigned char *)mapping.bytes + 2 * page;
    for (int n = 0; n < MTM_MAPPING_PADDING; n++) assert_int_equal(behind[n], 0);
    mtm_mapping_close(&mapping);
    (void)fclose(stream);
}

static void assert_refuses(FILE *stream, long long offset, size_t byte_count) {
    assert_non_null(stream);
    mtm_mapping mapping;
    assert_false(mtm_mapping_open(stream, offset, byte_count, &mapping));
    assert_null(mapping.bytes);
    mtm_mapping_close(&mapping);
}

static void what_is_not_all_in_a_file_is_refused(void **state) {
    (void)state;
    FILE *stream = patterned_file(100);
    assert_refuses(stream, 0, 101);
    assert_refuses(stream, 99, 2);
    assert_refuses(stream, 101, 1);
    assert_refuses(stream, 4, SIZE_MAX);
    (void)fclose(stream);

    char memory[16] = "";
    stream = fmemopen(memory, sizeof memory, "rb");
    assert_refuses(stream, 0, 1);
    (void)fclose(stream);

    int ends[2];
    assert_int_equal(pipe(ends), 0);
    stream = fdopen(ends[0], "rb");
    assert_refuses(stream, 0, 1);
    (void)fclose(stream);
    (void)close(ends[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_part_from_any_offset_outlives_its_stream),
        cmocka_unit_test(the_padding_behind_whole_pages_can_be_read),
        cmocka_unit_test(what_is_not_all_in_a_file_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
