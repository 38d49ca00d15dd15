/* SPDX-License-Identifier: BSD-3-Clause
 * Measures how far the bases are off and prints docs/accuracy.md with its pictures. Usage: report [--quick]
 * [--more FOLDER] [--threads N] [--json FILE] SOURCE_FOLDER OUT_FOLDER writes OUT_FOLDER/accuracy.md and
 * OUT_FOLDER/pictures/. --quick: fewer draws, small and coarse pictures; --more: also with spectra that are not in the repository;
 * --json: the errors as JSON. Everything but the times of the last section is the same for any number of threads. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "document.h"
#include "fail.h"
#include "json.h"
#include "plots.h"

enum { EXIT_FAILED = 1, EXIT_USAGE = 2, THREADS_MAX = 256, PATH_BYTES = 4096 };

typedef struct report_request {
    measure_options measure;
    cost_setting cost;
    const char *json_path;
    const char *out_folder;
} report_request;

static mtm_status make_path(const char *folder, const char *name, char path[PATH_BYTES], mtm_error *error) {
    const int length = snprintf(path, PATH_BYTES, "%s/%s", folder, name);
    if (length > 0 && length < PATH_BYTES) return MTM_OK;
    return fail(error, MTM_LIMIT, "%s: its path is longer than %d bytes", name, PATH_BYTES - 1);
}

static mtm_status write_pictures(const measurements *made, const char *out_folder, mtm_error *error) {
    char folder[PATH_BYTES];
    const mtm_status status = make_path(out_folder, "pictures", folder, error);
    if (status != MTM_OK) return status;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return fail(error, MTM_IO, "%s: cannot be made: %s", folder, strerror(errno));
    return plots_write(made, folder, error);
}

static mtm_status run(const report_request *request, mtm_error *error) {
    char path[PATH_BYTES];
    basis_cost costs[COST_BASES];
    measurements *made = NULL;
    mtm_status status = make_path(request->out_folder, "accuracy.md", path, error);
    if (status == MTM_OK) status = measure_all(&request->measure, &made, error);
    if (status == MTM_OK && request->json_path != NULL) status = json_write(made, request->json_path, error);
    if (status == MTM_OK)
        status =
            cost_measure(&request->cost.engine, request->out_folder, request->cost.run_count, costs, error);
    if (status == MTM_OK) status = write_pictures(made, request->out_folder, error);
    if (status == MTM_OK) status = document_write(made, &request->cost, costs, path, error);
    free(made);
    return status;
}

static int fail_usage(void) {
    (void)fprintf(
        stderr,
        "usage: report [--quick] [--more FOLDER] [--threads N] [--json FILE] SOURCE_FOLDER OUT_FOLDER, "
        "N from 1 to %d\n",
        THREADS_MAX);
    return EXIT_USAGE;
}

/* 0 for what is no number of threads. */
static int parse_threads(const char *text) {
    char *end = NULL;
    const long count = strtol(text, &end, 10);
    return end != text && *end == '\0' && count >= 1 && count <= THREADS_MAX ? (int)count : 0;
}

static void set_quick(report_request *request) {
    request->measure.draw_count = 3000;
    request->measure.engine.edge = request->cost.engine.edge = 128;
    request->measure.engine.step = request->cost.engine.step = 1;
    request->cost.run_count = 1;
}

/* The options before the folders; their number, or -1. */
static int read_options(int argc, char **argv, report_request *request, int *thread_count) {
    int i = 1;
    for (; i < argc && argv[i][0] == '-'; i++) {
        if (strcmp(argv[i], "--quick") == 0) {
            set_quick(request);
            continue;
        }
        if (i + 1 == argc) return -1;
        const char *option = argv[i++];
        if (strcmp(option, "--more") == 0)
            request->measure.more_folder = argv[i];
        else if (strcmp(option, "--json") == 0)
            request->json_path = argv[i];
        else if (strcmp(option, "--threads") == 0)
            *thread_count = parse_threads(argv[i]);
        else
            return -1;
    }
    return *thread_count == 0 ? -1 : i - 1;
}

static void set_folders(const char *source_folder, const char *out_folder, int thread_count,
                        report_request *request) {
    request->measure.source_folder = source_folder;
    request->measure.engine.source_folder = request->cost.engine.source_folder = source_folder;
    request->measure.engine.thread_count = request->cost.engine.thread_count = thread_count;
    request->out_folder = out_folder;
}

int main(int argc, char **argv) {
    report_request request = {.measure = {.draw_count = 9000, .engine = {.edge = 256}},
                              .cost = {.engine = {.edge = 512}, .run_count = 9}};
    int thread_count = mtm_default_thread_count();
    mtm_error error = {""};
    const int options = read_options(argc, argv, &request, &thread_count);
    if (options < 0 || argc - options != 3) return fail_usage();
    set_folders(argv[options + 1], argv[options + 2], thread_count, &request);
    if (run(&request, &error) == MTM_OK) return 0;
    (void)fprintf(stderr, "report: %s\n", error.message);
    return EXIT_FAILED;
}
