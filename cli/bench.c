/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench: how long the steps of a picture and the design of a palette take. The rules are the same for every
 * suite: what is timed is checked first; what is compared takes turns, run by run, so that a busy machine slows all of it;
 * medians, and how far the runs scatter. docs/files.md has the columns. */
#include "bench.h"

#include <stdio.h>
#include <string.h>

static const bench_suite *const suites[] = {&frames_suite,  &table1_suite,   &kernels_suite,
                                            &scaling_suite, &ablation_suite, &design_suite};
enum { SUITES = sizeof suites / sizeof *suites };

#define SUITE_NAMES "frames, table1, kernels, scaling, ablation or design"

static const command_option options[] = {
    {"--suite", "NAME", SUITE_NAMES "; default: all of them"},
    {"--only", "TEXT", "only the rows whose name contains this"},
    {"--runs", "N", "timed runs, default 10; run k looks from view k mod 8"},
    {"--threads", "N", "default: all processors"},
    {"--size", "WxH", "pictures of the suite frames, default 512x512"},
    {"--post-classified", NULL, "the suite frames without pre-integration, as other renderers do"},
    {"--json", NULL, "print a JSON document"},
    {NULL, NULL, NULL},
};

typedef struct bench_request {
    bench_settings settings;
    const bench_suite *suite; /* NULL: all */
    const char *argument;     /* one that is no option, of which there must be none */
    bool is_json;
} bench_request;

bool is_row_wanted(const bench_settings *settings, const char *name) {
    return settings->only == NULL || strstr(name, settings->only) != NULL;
}

static const bench_suite *find_suite(const char *name) {
    for (int i = 0; i < SUITES; i++)
        if (strcmp(suites[i]->name, name) == 0) return suites[i];
    return NULL;
}

static json_t *describe_suite(const bench_suite *suite, const bench_settings *settings,
                              const bench_rows *rows) {
    const bool is_frames = suite == &frames_suite; /* the only one whose pictures have a choice */
    return json_pack("{s:s, s:[i,i], s:i, s:s, s:i, s:O}", "suite", suite->name, "size",
                     is_frames ? settings->width : BENCH_PICTURE_EDGE,
                     is_frames ? settings->height : BENCH_PICTURE_EDGE, "threads", settings->thread_count,
                     "isa", mtm_isa_name(), "runs", settings->run_count, "rows", rows->array);
}

static void print_suite(const bench_suite *suite, const bench_settings *settings, const bench_rows *rows) {
    if (json_array_size(rows->array) == 0) return;
    (void)printf("%s (where a row says nothing else: %d x %d pixels, %d thread%s, %s), medians of %d run%s\n",
                 suite->name, BENCH_PICTURE_EDGE, BENCH_PICTURE_EDGE, settings->thread_count,
                 settings->thread_count == 1 ? "" : "s", mtm_isa_name(), settings->run_count,
                 settings->run_count == 1 ? "" : "s");
    print_rows(rows);
    (void)printf("\n");
    (void)fflush(stdout); /* whoever watches sees the suites as they come */
}

/* Runs a suite, prints it where people read, and adds its document to the array. */
static mtm_status run_suite(const bench_suite *suite, const bench_request *request, json_t *documents,
                            mtm_error *error) {
    const bench_settings *settings = &request->settings;
    bench_rows rows = make_rows(suite->columns);
    mtm_status status = suite->run(settings, &rows, error);
    if (status == MTM_OK && json_array_append_new(documents, describe_suite(suite, settings, &rows)) != 0) {
        (void)snprintf(error->message, sizeof error->message, "out of memory for the rows");
        status = MTM_MEMORY;
    }
    if (status == MTM_OK && !request->is_json) print_suite(suite, settings, &rows);
    json_decref(rows.array);
    return status;
}

/* Six digits are more than any clock here can tell. */
static void print_json(const json_t *document) {
    (void)json_dumpf(document, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
    (void)printf("\n");
}

static size_t count_rows(const json_t *documents) {
    size_t count = 0;
    for (size_t i = 0; i < json_array_size(documents); i++)
        count += json_array_size(json_object_get(json_array_get(documents, i), "rows"));
    return count;
}

static int bench(const subcommand *command, const bench_request *request) {
    mtm_error error = {""};
    mtm_status status = MTM_OK;
    json_t *documents = json_array();
    for (int i = 0; i < SUITES && status == MTM_OK; i++)
        if (request->suite == NULL || request->suite == suites[i])
            status = run_suite(suites[i], request, documents, &error);
    if (status == MTM_OK && count_rows(documents) == 0) {
        (void)snprintf(error.message, sizeof error.message, "no row has a name that contains \"%.200s\"",
                       request->settings.only);
        status = MTM_ARGUMENT;
    }
    if (status == MTM_OK && request->is_json)
        print_json(request->suite == NULL ? documents : json_array_get(documents, 0));
    json_decref(documents);
    return status == MTM_OK ? EXIT_DONE : fail_command(command, &error);
}

static void read_option(argument_walk *walk, const command_option *option, const char *value,
                        bench_request *request) {
    if (option == NULL)
        request->argument = value;
    else if (is_option(option, "--suite")) {
        request->suite = find_suite(value);
        if (request->suite == NULL) fail_usage(walk, "--suite is \"%s\", must be " SUITE_NAMES, value);
    } else if (is_option(option, "--only"))
        request->settings.only = value;
    else if (is_option(option, "--runs"))
        (void)parse_count(walk, option, value, &request->settings.run_count);
    else if (is_option(option, "--threads"))
        (void)parse_count(walk, option, value, &request->settings.thread_count);
    else if (is_option(option, "--size"))
        (void)parse_size(walk, option, value, &request->settings.width, &request->settings.height);
    else if (is_option(option, "--post-classified"))
        request->settings.is_post_classified = true;
    else
        request->is_json = true;
}

static int run(const subcommand *command, int argc, char **argv) {
    progress_bar bar;
    bench_request request = {.settings = {.thread_count = mtm_default_thread_count(),
                                          .run_count = 10,
                                          .width = BENCH_PICTURE_EDGE,
                                          .height = BENCH_PICTURE_EDGE,
                                          .bar = &bar}};
    argument_walk walk = walk_arguments(command, argc, argv);
    const command_option *option = NULL;
    const char *value = NULL;
    while (next_argument(&walk, &option, &value)) read_option(&walk, option, value, &request);
    if (!walk.is_over && request.argument != NULL)
        fail_usage(&walk, "takes options only, not \"%s\"", request.argument);
    return walk.is_over ? walk.exit_status : bench(command, &request);
}

const subcommand bench_command = {
    .name = "bench",
    .arguments = "[options]",
    .summary =
        "Time the steps of pictures (projecting, relighting, changing the transfer function) and the design "
        "of "
        "palettes.\n"
        "Volumes are looked for in the folders of METAMER_DATA, then in examples/*/ below the working "
        "folder;\n"
        "rows of others stay empty. Everything is checked against plain code before it is timed, and what "
        "is\n"
        "compared takes turns, run by run. X_ms is a median in milliseconds; with --json X_p95_ms, the 95th\n"
        "percentile, and X_spread_ms, the interquartile range, stand beside it, both by nearest rank and "
        "over\n"
        "all runs, so also over the views. A ratio a_per_b is a's median divided by b's.",
    .options = options,
    .run = run,
};
