/* SPDX-License-Identifier: BSD-3-Clause
 * metamer design: from what cells of a palette are to look like to spectra that do it, or the reasons why not. */
#include <stdio.h>
#include <string.h>

#include "bench_statistics.h"
#include "design_plot.h"
#include "task.h"

static const command_option options[] = {
    {"-o", "PALETTE.json", "the palette: given and designed spectra"},
    {"--report", "REPORT.json", "what was asked and what came of it, cell by cell"},
    {"--plot", "OUT.svg", "the spectra, and swatches of what was asked and achieved"},
    {"--threads", "N", "default: all processors; the palette is the same for any"},
    {"--json", NULL, "print the report as JSON"},
    {NULL, NULL, NULL},
};

typedef struct design_request {
    const char *input, *output, *report, *plot;
    int threads;
    bool is_json;
} design_request;

static void read_option(argument_walk *walk, const command_option *option, const char *value,
                        design_request *request) {
    if (option == NULL && request->input != NULL)
        fail_usage(walk, "one goals document at a time, not \"%s\" and \"%s\"", request->input, value);
    else if (option == NULL)
        request->input = value;
    else if (is_option(option, "-o"))
        request->output = value;
    else if (is_option(option, "--report"))
        request->report = value;
    else if (is_option(option, "--plot"))
        request->plot = value;
    else if (is_option(option, "--threads"))
        (void)parse_count(walk, option, value, &request->threads);
    else
        request->is_json = true;
}

/* --- in words --- */

static void print_cell(const mtm_palette *palette, mtm_cell cell) {
    print_plainly(stdout, palette->materials[cell.material].name);
    (void)printf(" under ");
    print_plainly(stdout, palette->lights[cell.light].name);
}

static void print_wish(const mtm_palette *palette, const mtm_goal_result *result) {
    const mtm_goal *goal = &result->goal;
    char hex[8];
    mtm_rgb_format(mtm_rgb_from_xyz(result->asked), hex);
    if (goal->kind == MTM_GOAL_COLOR) {
        (void)printf("%s", hex);
    } else if (goal->kind == MTM_GOAL_SAME) {
        (void)printf("as ");
        print_cell(palette, goal->other);
    } else {
        (void)printf("at least %g from ", goal->least);
        if (goal->other.material < 0)
            (void)printf("black");
        else
            print_cell(palette, goal->other);
    }
}

/* "block under light 2: asked #6f9f6a, is #6f9f6a, off by 0.00 (factors:7: 0.01)" */
static void print_result(const mtm_design *design, const mtm_goal_result *result) {
    char hex[8];
    mtm_rgb_format(mtm_rgb_from_xyz(result->achieved), hex);
    (void)printf("  %s ", result->is_met && result->is_met_basis ? "met    "
                          : result->is_met                       ? "partly "
                                                                 : "missed ");
    print_cell(&design->palette, result->goal.cell);
    (void)printf(": asked ");
    print_wish(&design->palette, result);
    (void)printf(", is %s", hex);
    if (result->goal.kind == MTM_GOAL_DIFFERENT) (void)printf(", %.1f from it", result->difference);
    (void)printf(", off by %.2f (%s: %.2f)\n", result->ciede2000, design->basis, result->ciede2000_basis);
}

static void print_honesty(const mtm_design *design) {
    (void)printf("spectra\n");
    for (int i = 0; i < design->palette.material_count; i++) {
        (void)printf("  material ");
        print_plainly(stdout, design->palette.materials[i].name);
        (void)printf(": %s", mtm_honesty_name(design->materials[i]));
        if (design->material_origins[i][0] != '\0') {
            (void)printf(", ");
            print_plainly(stdout, design->material_origins[i]);
        }
        (void)printf("\n");
    }
    for (int i = 0; i < design->palette.light_count; i++) {
        (void)printf("  light ");
        print_plainly(stdout, design->palette.lights[i].name);
        (void)printf(": %s\n", mtm_honesty_name(design->lights[i]));
    }
}

static void print_report(const mtm_design *design, double seconds) {
    int met = 0;
    (void)printf("goals (CIEDE2000 by full spectra, and as the basis %s shows it)\n", design->basis);
    for (int i = 0; i < design->result_count; i++) {
        print_result(design, &design->results[i]);
        met += design->results[i].is_met;
    }
    print_honesty(design);
    if (design->problem_count > 0) (void)printf("not as asked\n");
    for (int i = 0; i < design->problem_count; i++) {
        (void)printf("  ");
        print_plainly(stdout, design->problems[i].reason);
        (void)printf("\n");
    }
    (void)printf("%d of %d goals met within %g, %d start%s, %.2f s\n", met, design->result_count,
                 design->tolerance, design->start_count, design->start_count == 1 ? "" : "s", seconds);
}

/* --- files --- */

/* Writes a text the library made, or to standard output where `path` is NULL, and frees it. */
static mtm_status write_text(const char *path, char *text, mtm_error *error) {
    mtm_status status = MTM_OK;
    if (text == NULL) {
        (void)snprintf(error->message, sizeof error->message, "%s: out of memory",
                       path == NULL ? "the report" : path);
        return MTM_MEMORY;
    }
    if (path == NULL)
        (void)fputs(text, stdout);
    else
        status = mtm_text_write(path, text, error);
    mtm_text_free(text);
    return status;
}

static mtm_status write_files(const design_request *request, const mtm_design *design, double seconds,
                              mtm_error *error) {
    mtm_status status = write_text(request->output, mtm_palette_format(&design->palette), error);
    if (status == MTM_OK && request->report != NULL)
        status = write_text(request->report, mtm_design_format(design, seconds), error);
    if (status == MTM_OK && request->plot != NULL) status = write_design_plot(design, request->plot, error);
    return status;
}

static mtm_status check_outputs(const design_request *request, mtm_error *error) {
    mtm_status status = check_output(request->output, error);
    if (status == MTM_OK && request->report != NULL) status = check_output(request->report, error);
    if (status == MTM_OK && request->plot != NULL) status = check_output(request->plot, error);
    return status;
}

static int design(const subcommand *command, const design_request *request) {
    mtm_error error = {""};
    mtm_goals *goals = NULL;
    mtm_design *found = NULL;
    progress_bar bar;
    mtm_design_options how = mtm_design_defaults();
    how.thread_count = request->threads;
    mtm_status status = check_outputs(request, &error);
    if (status == MTM_OK) status = mtm_goals_read(request->input, &goals, &error);
    const double start_ms = now_ms();
    if (status == MTM_OK) {
        how.progress = start_progress(&bar, "designing");
        status = mtm_design_find(goals, &how, &found, &error);
        end_progress(&bar);
    }
    const double seconds = (now_ms() - start_ms) / 1000;
    if (status == MTM_OK) status = write_files(request, found, seconds, &error);
    if (status == MTM_OK && request->is_json)
        status = write_text(NULL, mtm_design_format(found, seconds), &error);
    if (status == MTM_OK && !request->is_json) print_report(found, seconds);
    mtm_design_destroy(found);
    mtm_goals_destroy(goals);
    return status == MTM_OK ? EXIT_DONE : fail_command(command, &error);
}

static int run(const subcommand *command, int argc, char **argv) {
    design_request request = {0};
    argument_walk walk = walk_arguments(command, argc, argv);
    const command_option *option = NULL;
    const char *value = NULL;
    while (next_argument(&walk, &option, &value)) read_option(&walk, option, value, &request);
    if (walk.is_over) return walk.exit_status;
    if (request.input == NULL)
        fail_usage(&walk, "a goals document is needed");
    else if (request.output == NULL)
        fail_usage(&walk, "-o PALETTE.json is needed");
    return walk.is_over ? walk.exit_status : design(command, &request);
}

const subcommand design_command = {
    .name = "design",
    .arguments = "GOALS.json -o PALETTE.json [options]",
    .summary = "Find spectra for the colors that materials are to have under lights.\n"
               "The goals say which cells of the palette are to have a color, be the same, differ or be "
               "black; which\n"
               "spectra are given and which are to be found. What cannot be had together is met as nearly as "
               "possible,\n"
               "and the report says why. docs/design.md is the manual.",
    .options = options,
    .run = run,
};
