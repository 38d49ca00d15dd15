/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench --suite design: how many random goals documents are solved, how well and in what time, with the whole
 * method and with a part of it left out; and the times of a few fixed problems. The methods take turns, document by
 * document, and of every design it is checked that its palette does what it reports before its numbers count. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "bench_design_check.h"
#include "bench_goals.h"

static const char *const columns[] = {"problem",
                                      "method",
                                      "threads",
                                      "documents",
                                      "goals",
                                      "failures",
                                      "solved",
                                      "everything_solved",
                                      "solved_basis",
                                      "ciede2000_median",
                                      "ciede2000_p95",
                                      "ciede2000_worst",
                                      "ciede2000_basis_median",
                                      "ciede2000_basis_p95",
                                      "ciede2000_basis_worst",
                                      "physical",
                                      "design_ms",
                                      "slowest_s",
                                      NULL};

enum {
    NAME_BYTES = 64,
    DOCUMENTS_PER_RUN = 50, /* of each kind, with everything */
    ABLATED_PER_RUN = 10,   /* the first of them, with each part left out */
};

typedef struct design_method {
    const char *name;
    unsigned without; /* of MTM_DESIGN_WITHOUT_… */
} design_method;

static const design_method methods[] = {
    {"everything", 0},
    {"without bounds", MTM_DESIGN_WITHOUT_BOUNDS},
    {"without full rows", MTM_DESIGN_WITHOUT_FULL},
    {"without basis rows", MTM_DESIGN_WITHOUT_BASIS},
    {"without starts", MTM_DESIGN_WITHOUT_STARTS},
};
enum { METHODS = sizeof methods / sizeof *methods, EVERYTHING = 0 };

/* --- what designs come to --- */

/* A growing list of numbers. */
typedef struct number_list {
    int count, capacity;
    double *values;
} number_list;

static mtm_status add_number(number_list *list, double value, mtm_error *error) {
    if (list->count == list->capacity) {
        const int capacity = 2 * list->capacity + 64;
        double *values = realloc(list->values, (size_t)capacity * sizeof *values);
        if (values == NULL) {
            (void)snprintf(error->message, sizeof error->message, "out of memory for the numbers of a row");
            return MTM_MEMORY;
        }
        list->values = values;
        list->capacity = capacity;
    }
    list->values[list->count++] = value;
    return MTM_OK;
}

/* All designs of a row. */
typedef struct design_tally {
    const char *problem, *method;
    unsigned without;
    int thread_count;
    int documents, failures; /* that are counted, and those among them that ended in MTM_NUMERIC */
    int solved, solved_basis, everything_solved;
    int designed, physical;           /* spectra */
    number_list ms, ciede2000, basis; /* of designs; of goals by full spectra and through the basis */
} design_tally;

static void free_tally(design_tally *tally) {
    free(tally->ms.values);
    free(tally->ciede2000.values);
    free(tally->basis.values);
}

static void count_spectra(int count, const mtm_honesty *honesty, design_tally *tally) {
    for (int i = 0; i < count; i++) {
        if (honesty[i] == MTM_HONESTY_GIVEN || honesty[i] == MTM_HONESTY_MEASURED) continue;
        tally->designed++;
        tally->physical += honesty[i] == MTM_HONESTY_PHYSICAL;
    }
}

static bool is_solved(const mtm_design *design) {
    for (int i = 0; i < design->result_count; i++)
        if (!design->results[i].is_met) return false;
    return true;
}

static bool is_solved_basis(const mtm_design *design) {
    for (int i = 0; i < design->result_count; i++)
        if (!design->results[i].is_met_basis) return false;
    return true;
}

static mtm_status count_design(const mtm_design *design, design_tally *tally, mtm_error *error) {
    mtm_status status = MTM_OK;
    tally->documents++;
    tally->solved += is_solved(design);
    tally->solved_basis += is_solved_basis(design);
    count_spectra(design->palette.material_count, design->materials, tally);
    count_spectra(design->palette.light_count, design->lights, tally);
    for (int i = 0; i < design->result_count && status == MTM_OK; i++) {
        status = add_number(&tally->ciede2000, design->results[i].ciede2000, error);
        if (status == MTM_OK) status = add_number(&tally->basis, design->results[i].ciede2000_basis, error);
    }
    return status;
}

static void set_differences(json_t *row, const char *column, number_list *list) {
    char name[NAME_BYTES];
    if (list->count == 0) return;
    const bench_summary summary = summarize_values(list->count, list->values);
    (void)snprintf(name, sizeof name, "%s_median", column);
    set_number(row, name, summary.median);
    (void)snprintf(name, sizeof name, "%s_p95", column);
    set_number(row, name, summary.p95);
    (void)snprintf(name, sizeof name, "%s_worst", column);
    set_number(row, name, list->values[list->count - 1]);
}

static double share_of(int part, int whole) {
    return (double)part / whole;
}

static void set_design_times(json_t *row, number_list *ms) {
    if (ms->count == 0) return;
    const bench_summary summary = summarize_values(ms->count, ms->values);
    set_summary(row, "design_ms", &summary);
    set_number(row, "slowest_s", 1e-3 * ms->values[ms->count - 1]);
}

/* `is_compared`: the same documents were also solved with everything. */
static void add_tally_row(design_tally *tally, bool is_compared, bench_rows *rows) {
    json_t *row = add_row(rows);
    set_text(row, "problem", tally->problem);
    set_text(row, "method", tally->method);
    set_count(row, "threads", tally->thread_count);
    set_count(row, "documents", tally->documents);
    set_count(row, "goals", tally->ciede2000.count);
    set_count(row, "failures", tally->failures);
    set_number(row, "solved", share_of(tally->solved, tally->documents));
    if (is_compared)
        set_number(row, "everything_solved", share_of(tally->everything_solved, tally->documents));
    set_number(row, "solved_basis", share_of(tally->solved_basis, tally->documents));
    set_differences(row, "ciede2000", &tally->ciede2000);
    set_differences(row, "ciede2000_basis", &tally->basis);
    set_number(row, "physical", share_of(tally->physical, tally->designed));
    set_design_times(row, &tally->ms);
}

/* --- designs --- */

/* Designs, takes the time, and checks. MTM_NUMERIC of the design itself is a failure that the row counts: *design stays
 * NULL. */
static mtm_status time_design(const mtm_goals *goals, design_tally *tally, mtm_design **design,
                              mtm_error *error) {
    mtm_design_options options = mtm_design_defaults();
    options.without = tally->without;
    options.thread_count = tally->thread_count;
    const double begin = now_ms();
    mtm_status status = mtm_design_find(goals, &options, design, error);
    const double ms = now_ms() - begin;
    if (status == MTM_NUMERIC) {
        tally->documents++;
        tally->failures++;
        return MTM_OK;
    }
    if (status == MTM_OK) status = check_design(tally->problem, *design, error);
    return status == MTM_OK ? add_number(&tally->ms, ms, error) : status;
}

/* --- random documents --- */

typedef struct random_kind {
    const char *name;
    bench_goals_kind kind;
} random_kind;

static const random_kind random_kinds[] = {{"reachable", BENCH_GOALS_REACHABLE}, {"free", BENCH_GOALS_FREE}};
enum { RANDOM_KINDS = sizeof random_kinds / sizeof *random_kinds };

/* The methods that are wanted, which take turns. */
typedef struct design_race {
    const random_kind *kind;
    int count;
    design_tally tallies[METHODS];
} design_race;

static void list_methods(const bench_settings *settings, design_race *race) {
    for (int i = 0; i < METHODS; i++) {
        char name[NAME_BYTES];
        (void)snprintf(name, sizeof name, "%s %s", race->kind->name, methods[i].name);
        if (!is_row_wanted(settings, name)) continue;
        race->tallies[race->count++] = (design_tally){.problem = race->kind->name,
                                                      .method = methods[i].name,
                                                      .without = methods[i].without,
                                                      .thread_count = settings->thread_count};
    }
}

static bool has_everything(const design_race *race) {
    return race->tallies[0].without == methods[EVERYTHING].without;
}

static mtm_status read_random(const design_race *race, int index, mtm_goals **goals, mtm_error *error) {
    char name[NAME_BYTES];
    char *text = NULL;
    (void)snprintf(name, sizeof name, "%s document %d", race->kind->name, index);
    mtm_status status = make_random_goals(race->kind->kind, index, &text, error);
    if (status == MTM_OK) status = mtm_goals_parse(name, text, NULL, goals, error);
    free(text);
    return status;
}

static mtm_status run_document(design_race *race, int index, int method_count, mtm_error *error) {
    mtm_goals *goals = NULL;
    bool is_done_with_everything = false;
    mtm_status status = read_random(race, index, &goals, error);
    for (int i = 0; i < method_count && status == MTM_OK; i++) {
        design_tally *tally = &race->tallies[i];
        mtm_design *design = NULL;
        status = time_design(goals, tally, &design, error);
        if (status == MTM_OK && design != NULL) status = count_design(design, tally, error);
        if (status == MTM_OK && i == 0 && design != NULL) is_done_with_everything = is_solved(design);
        tally->everything_solved += is_done_with_everything;
        mtm_design_destroy(design);
    }
    mtm_goals_destroy(goals);
    return status;
}

static mtm_status report_progress(const mtm_progress *progress, double fraction) {
    return progress->report(progress->user, fraction) ? MTM_OK : MTM_CANCELLED;
}

static mtm_status run_race(const bench_settings *settings, design_race *race, mtm_error *error) {
    const int ablated = settings->run_count * ABLATED_PER_RUN;
    const int all = has_everything(race) ? settings->run_count * DOCUMENTS_PER_RUN : ablated;
    const double designs = (double)ablated * race->count + (all - ablated);
    const mtm_progress progress = start_progress(settings->bar, race->kind->name);
    mtm_status status = MTM_OK;
    double done = 0;
    for (int index = 0; index < all && status == MTM_OK; index++) {
        const int method_count = index < ablated ? race->count : 1;
        status = run_document(race, index, method_count, error);
        done += method_count;
        if (status == MTM_OK) status = report_progress(&progress, done / designs);
    }
    end_progress(settings->bar);
    return status;
}

static mtm_status run_random(const bench_settings *settings, const random_kind *kind, bench_rows *rows,
                             mtm_error *error) {
    design_race race = {.kind = kind};
    list_methods(settings, &race);
    const mtm_status status = race.count == 0 ? MTM_OK : run_race(settings, &race, error);
    for (int i = 0; i < race.count; i++) {
        if (status == MTM_OK) add_tally_row(&race.tallies[i], i > 0 && has_everything(&race), rows);
        free_tally(&race.tallies[i]);
    }
    return status;
}

/* --- fixed problems --- */

#define FIGURE(number) "{\"metamer\":1,\"goals\":[{\"recipe\":\"figure " number "\"}]}"

static const char metamers_text[] =
    "{\"metamer\":1,\"materials\":[{\"name\":\"a\",\"design\":\"physical\"},"
    "{\"name\":\"b\",\"design\":\"physical\"}],\"lights\":[{\"name\":\"D65\",\"illuminant\":\"D65\"},"
    "{\"name\":\"A\",\"illuminant\":\"A\"}],\"goals\":[{\"recipe\":\"metamers\",\"materials\":[\"a\",\"b\"],"
    "\"under\":[\"D65\"],\"apart\":[\"A\"],\"by\":10,\"srgb\":\"#999999\"}]}";

static const char exclusive_text[] = "{\"metamer\":1,\"goals\":[{\"recipe\":\"one_light_per_material\","
                                     "\"materials\":[\"m1\",\"m2\",\"m3\",\"m4\",\"m5\",\"m6\"],"
                                     "\"lights\":[\"l1\",\"l2\",\"l3\",\"l4\",\"l5\",\"l6\"]}]}";

static const char *const two_lights[] = {"D65", "A"};

typedef struct fixed_problem {
    const char *name;
    const char *text; /* NULL: a grid */
    int materials, lights, goals;
    const char *const *illuminants;
    int method;
    bool is_on_one_thread;
} fixed_problem;

enum { WITHOUT_BASIS = 3 };

static const fixed_problem fixed_problems[] = {
    {.name = "figure 2", .text = FIGURE("2")},
    {.name = "figure 5", .text = FIGURE("5")},
    {.name = "figure 6", .text = FIGURE("6")},
    {.name = "figure 7", .text = FIGURE("7")},
    {.name = "metamers D65/A", .text = metamers_text},
    {.name = "6 x 6", .materials = 6, .lights = 6, .goals = 36},
    {.name = "6 x 6 exclusive", .text = exclusive_text},
    {.name = "5 materials, 21 equalities",
     .materials = 5,
     .lights = 2,
     .goals = 7,
     .illuminants = two_lights,
     .method = WITHOUT_BASIS,
     .is_on_one_thread = true},
};
enum { FIXED_PROBLEMS = sizeof fixed_problems / sizeof *fixed_problems };

static mtm_status read_fixed(const fixed_problem *problem, mtm_goals **goals, mtm_error *error) {
    char *text = NULL;
    if (problem->text != NULL) return mtm_goals_parse(problem->name, problem->text, NULL, goals, error);
    mtm_status status = make_grid_goals(problem->materials, problem->lights, problem->illuminants,
                                        problem->goals, &text, error);
    if (status == MTM_OK) status = mtm_goals_parse(problem->name, text, NULL, goals, error);
    free(text);
    return status;
}

/* The design is the same every time; the first one is counted. */
static mtm_status time_fixed(const bench_settings *settings, const mtm_goals *goals, design_tally *tally,
                             mtm_error *error) {
    const mtm_progress progress = start_progress(settings->bar, tally->problem);
    mtm_status status = MTM_OK;
    for (int run = 0; run < settings->run_count && tally->failures == 0 && status == MTM_OK; run++) {
        mtm_design *design = NULL;
        status = time_design(goals, tally, &design, error);
        if (status == MTM_OK && design != NULL && run == 0) status = count_design(design, tally, error);
        mtm_design_destroy(design);
        if (status == MTM_OK) status = report_progress(&progress, (run + 1.0) / settings->run_count);
    }
    end_progress(settings->bar);
    return status;
}

static mtm_status run_fixed(const bench_settings *settings, const fixed_problem *problem, bench_rows *rows,
                            mtm_error *error) {
    const design_method *method = &methods[problem->method];
    design_tally tally = {.problem = problem->name,
                          .method = method->name,
                          .without = method->without,
                          .thread_count = problem->is_on_one_thread ? 1 : settings->thread_count};
    char name[NAME_BYTES];
    mtm_goals *goals = NULL;
    (void)snprintf(name, sizeof name, "%s %s", problem->name, method->name);
    if (!is_row_wanted(settings, name)) return MTM_OK;
    mtm_status status = read_fixed(problem, &goals, error);
    if (status == MTM_OK) status = time_fixed(settings, goals, &tally, error);
    if (status == MTM_OK) add_tally_row(&tally, false, rows);
    free_tally(&tally);
    mtm_goals_destroy(goals);
    return status;
}

static mtm_status run(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < RANDOM_KINDS && status == MTM_OK; i++)
        status = run_random(settings, &random_kinds[i], rows, error);
    for (int i = 0; i < FIXED_PROBLEMS && status == MTM_OK; i++)
        status = run_fixed(settings, &fixed_problems[i], rows, error);
    return status;
}

const bench_suite design_suite = {.name = "design", .columns = columns, .run = run};
