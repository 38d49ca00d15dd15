/* SPDX-License-Identifier: BSD-3-Clause
 * Memory, names, files and threads. */
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "base/nearest.h"
#include "base/parallel.h"
#include "test.h"

static void sizes_that_overflow_are_refused(void **state) {
    (void)state;
    size_t product = 7;
    assert_false(mtm_size_multiply(SIZE_MAX / 2, 3, &product));
    assert_true(mtm_size_multiply(SIZE_MAX, 1, &product));
    assert_null(mtm_allocate(SIZE_MAX / 2, 3));
    assert_null(mtm_allocate(SIZE_MAX, 1));
    double *zeros = mtm_allocate(100, sizeof *zeros);
    assert_non_null(zeros);
    assert_int_equal((uintptr_t)zeros % 64, 0);
    for (int i = 0; i < 100; i++) assert_true(zeros[i] == 0);
    free(zeros);
}

static void the_nearest_name_has_the_fewest_edits(void **state) {
    (void)state;
    static const char *const names[] = {"ambient", "diffuse", "specular", "shininess"};
    assert_int_equal(mtm_edit_distance("kitten", "sitting"), 3);
    assert_int_equal(mtm_edit_distance("", "abc"), 3);
    assert_int_equal(mtm_edit_distance("D65", "d65"), 0);
    assert_string_equal(mtm_nearest_name("diffus", names, 4), "diffuse");
    assert_string_equal(mtm_nearest_name("shinyness", names, 4), "shininess");
    static const char *const patches[] = {"blue", "dark_skin"};
    assert_string_equal(mtm_nearest_name("dark", patches, 2), "dark_skin"); /* cut short */
}

static void paths_are_taken_apart_and_joined(void **state) {
    (void)state;
    static const char *const cases[][3] = {{"a/b.c", "a", "b.c"}, {"b.c", ".", "b.c"}, {"/b.c", "/", "b.c"}};
    for (int i = 0; i < 3; i++) {
        char *folder = mtm_path_folder(cases[i][0]);
        assert_string_equal(folder, cases[i][1]);
        assert_string_equal(mtm_path_name(cases[i][0]), cases[i][2]);
        free(folder);
    }
    char *joined = mtm_path_join("a", "b.c");
    char *absolute = mtm_path_join("a", "/b.c");
    assert_string_equal(joined, "a/b.c");
    assert_string_equal(absolute, "/b.c");
    free(joined);
    free(absolute);
    assert_true(mtm_path_has_extension("x.PNG", ".png"));
    assert_false(mtm_path_has_extension(".png", ".png"));
}

static void a_file_is_read_whole_or_refused(void **state) {
    (void)state;
    mtm_error error;
    char *bytes = NULL;
    size_t count = 0;
    char *long_text = malloc(200000);
    assert_non_null(long_text);
    memset(long_text, 'x', 200000);
    assert_ok(mtm_file_write("base_file.tmp", long_text, 200000, &error), error);
    assert_ok(mtm_file_read("base_file.tmp", 200000, &bytes, &count, &error), error);
    assert_int_equal(count, 200000);
    assert_memory_equal(bytes, long_text, count);
    free(bytes);
    assert_fails(mtm_file_read("base_file.tmp", 199999, &bytes, &count, &error), MTM_LIMIT, error, "199999");
    assert_fails(mtm_file_read("no_such_file", 10, &bytes, &count, &error), MTM_IO, error, "no_such_file");
    assert_fails(mtm_file_read(".", 10, &bytes, &count, &error), MTM_IO, error, "directory");
    free(long_text);
    (void)unlink("base_file.tmp");
}

static void an_abandoned_output_leaves_the_old_file(void **state) {
    (void)state;
    mtm_error error;
    mtm_output output;
    char *bytes = NULL;
    size_t count = 0;
    assert_ok(mtm_file_write("base_output.tmp", "old", 3, &error), error);
    assert_ok(mtm_output_open("base_output.tmp", &output, &error), error);
    assert_true(fputs("new, but never finished", output.stream) >= 0);
    char *temporary = mtm_text_copy(output.temporary);
    mtm_output_abandon(&output);
    assert_false(mtm_file_exists(temporary));
    assert_ok(mtm_file_read("base_output.tmp", 100, &bytes, &count, &error), error);
    assert_string_equal(bytes, "old");
    free(bytes);
    free(temporary);
    (void)unlink("base_output.tmp");
}

static void outputs_that_cannot_be_written_are_told(void **state) {
    (void)state;
    mtm_error error;
    struct stat device;
    assert_fails(mtm_file_write("no_such_folder/x", "1", 1, &error), MTM_IO, error, "no_such_folder/x");
    if (stat("/dev/full", &device) != 0) skip();
    assert_fails(mtm_file_write("/dev/full", "1", 1, &error), MTM_IO, error, "No space");
    assert_int_equal(stat("/dev/full", &device), 0);
    assert_true(S_ISCHR(device.st_mode));
}

static void a_link_is_followed_not_replaced(void **state) {
    (void)state;
    mtm_error error;
    struct stat link;
    (void)unlink("base_link.tmp");
    assert_ok(mtm_file_write("base_target.tmp", "old", 3, &error), error);
    assert_int_equal(symlink("base_target.tmp", "base_link.tmp"), 0);
    assert_ok(mtm_file_write("base_link.tmp", "new!", 4, &error), error);
    assert_int_equal(lstat("base_link.tmp", &link), 0);
    assert_true(S_ISLNK(link.st_mode));
    assert_int_equal(lstat("base_target.tmp", &link), 0);
    assert_int_equal(link.st_size, 4);
    (void)unlink("base_link.tmp");
    (void)unlink("base_target.tmp");
}

typedef struct count_job {
    atomic_int runs[1000];
} count_job;

static void count_run(void *context, int task) {
    count_job *job = context;
    atomic_fetch_add(&job->runs[task], 1);
}

static void every_task_runs_once_on_any_number_of_threads(void **state) {
    (void)state;
    for (int threads = 0; threads <= 9; threads++) {
        count_job job;
        for (int i = 0; i < 1000; i++) atomic_init(&job.runs[i], 0);
        assert_int_equal(mtm_parallel_for(threads, 1000, count_run, &job, NULL), MTM_OK);
        for (int i = 0; i < 1000; i++) assert_int_equal(atomic_load(&job.runs[i]), 1);
    }
    assert_int_equal(mtm_parallel_for(4, 0, count_run, NULL, NULL), MTM_OK);
    assert_true(mtm_default_thread_count() >= 1);
}

static bool stop_after_three(void *user, double fraction) {
    double *last = user;
    assert_true(fraction >= last[0] && fraction <= 1);
    last[0] = fraction;
    last[1] += 1;
    return last[1] < 3;
}

static void progress_rises_and_can_cancel(void **state) {
    (void)state;
    count_job job;
    for (int i = 0; i < 1000; i++) atomic_init(&job.runs[i], 0);
    double last[2] = {0, 0};
    const mtm_progress progress = {stop_after_three, last};
    assert_int_equal(mtm_parallel_for(1, 1000, count_run, &job, &progress), MTM_CANCELLED);
    assert_int_equal(atomic_load(&job.runs[2]), 1);
    assert_int_equal(atomic_load(&job.runs[3]), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_that_overflow_are_refused),
        cmocka_unit_test(the_nearest_name_has_the_fewest_edits),
        cmocka_unit_test(paths_are_taken_apart_and_joined),
        cmocka_unit_test(a_file_is_read_whole_or_refused),
        cmocka_unit_test(an_abandoned_output_leaves_the_old_file),
        cmocka_unit_test(outputs_that_cannot_be_written_are_told),
        cmocka_unit_test(a_link_is_followed_not_replaced),
        cmocka_unit_test(every_task_runs_once_on_any_number_of_threads),
        cmocka_unit_test(progress_rises_and_can_cancel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
