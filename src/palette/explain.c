/* SPDX-License-Identifier: BSD-3-Clause
 * Why goals are not met. Three questions, each answered by a search of its own: could the goal be met if it were the only
 * one? Would it be met, or much nearer, without one of the others? And does only the basis fail to show it, because its
 * few numbers cannot hold what full spectra can? */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "palette/design.h"

/* What the explanation of one goal works with. */
typedef struct explanation {
    const mtm_search *search;
    const mtm_found *found;
    const mtm_color_view *full, *basis;
    const mtm_progress *progress;
    mtm_design *design;
    bool *is_left_out;
    mtm_found trial;
    int searches_left; /* searches that may still be made: they take as long as the design did */
} explanation;

static bool is_unknown(const mtm_search *search, bool is_light, int index) {
    return (is_light ? search->goals->lights : search->goals->materials)[index].is_designed;
}

/* Whether a spectrum of the kind is to be found in either cell of the goal. */
static bool moves(const mtm_search *search, const mtm_goal *goal, bool is_light) {
    return is_unknown(search, is_light, is_light ? goal->cell.light : goal->cell.material) ||
           (mtm_goal_has_other(goal) &&
            is_unknown(search, is_light, is_light ? goal->other.light : goal->other.material));
}

/* Whether two goals have a spectrum in common that is to be found. */
static bool share_spectrum(const mtm_search *search, const mtm_goal *a, const mtm_goal *b) {
    const mtm_cell cells_a[2] = {a->cell, mtm_goal_has_other(a) ? a->other : a->cell};
    const mtm_cell cells_b[2] = {b->cell, mtm_goal_has_other(b) ? b->other : b->cell};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            if ((cells_a[i].material == cells_b[j].material &&
                 is_unknown(search, false, cells_a[i].material)) ||
                (cells_a[i].light == cells_b[j].light && is_unknown(search, true, cells_a[i].light)))
                return true;
    return false;
}

static void name_cell(const mtm_design *design, mtm_cell cell, char text[192]) {
    (void)snprintf(text, 192, "%s under %s", design->palette.materials[cell.material].name,
                   design->palette.lights[cell.light].name);
}

/* --- the goal alone --- */

/* Whoever listens may stop the work between two searches. */
static mtm_status ask_to_go_on(explanation *e, mtm_error *error) {
    static const double nearly_done = 0.95;
    e->searches_left--;
    if (e->progress->report == NULL || e->progress->report(e->progress->user, nearly_done)) return MTM_OK;
    return mtm_fail(error, MTM_CANCELLED, "the design was cancelled");
}

/* What was found in a trial, if it is nearer than *lack. */
static void judge_trial(const explanation *e, int goal, double *lack, mtm_xyz *achieved) {
    const mtm_goal_result result =
        mtm_goal_judge(e->search, &e->trial, e->full, e->basis, &e->search->goals->goals[goal]);
    if (result.ciede2000 >= *lack) return;
    *lack = result.ciede2000;
    *achieved = result.achieved;
}

/* What the goal lacks, by full spectra, where it is the only one. */
static mtm_status lack_alone(explanation *e, int goal, double *lack, mtm_xyz *achieved, mtm_error *error) {
    mtm_search search = *e->search;
    search.is_left_out = e->is_left_out;
    search.views = e->full;
    search.view_count = 1;
    for (int g = 0; g < search.goals->goal_count; g++) e->is_left_out[g] = g != goal;
    const int starts = mtm_search_start_count(&search);
    mtm_status status = MTM_OK;
    *lack = INFINITY;
    for (int start = 0; start < starts && status == MTM_OK; start++) {
        if (*lack <= e->design->tolerance || (start > 0 && e->searches_left <= 0)) break;
        status = ask_to_go_on(e, error);
        if (status == MTM_OK) status = mtm_search_begin(&search, start, &e->trial, error);
        if (status == MTM_OK) status = mtm_search_finish(&search, &e->trial, true, error);
        if (status == MTM_OK) judge_trial(e, goal, lack, achieved);
    }
    return status;
}

/* Whether the multipliers prove that the goals that are not left out cannot all be met within the tolerance: what their rows
 * lack together would have to be less than it is. The metric of the rows is right for small steps only, hence `sure`. */
static bool is_contradiction(const explanation *e, int goal_count) {
    static const double sure = 1.2;
    for (int u = 0; u < e->search->unknown_count; u++) /* lights have a limit that is not the world's */
        if (e->search->unknowns[u].is_light) return false;
    return e->trial.contradiction > sure * e->design->tolerance * sqrt(goal_count);
}

static const char *kind_of_limit(const mtm_goal *goal, bool is_proven) {
    if (!is_proven)
        return "nothing of the kind asked for was found (smoothness, an anchor or a small weight may keep it "
               "away)";
    return goal->kind == MTM_GOAL_COLOR
               ? "the color is outside the object-color solid of the light: no reflectance of the kind asked "
                 "for has it"
               : "no reflectance of the kind asked for does it under the lights that are given";
}

static void describe_given(const explanation *e, int goal, mtm_design_problem *problem) {
    char cell[192];
    char color[8];
    const mtm_goal_result *result = &e->design->results[goal];
    name_cell(e->design, result->goal.cell, cell);
    mtm_rgb_format(mtm_rgb_from_xyz(result->achieved), color);
    problem->is_proven = true;
    (void)snprintf(problem->reason, sizeof problem->reason,
                   "%s: all its spectra are given and show %s, CIEDE2000 %.3g off; nothing is left to design",
                   cell, color, result->ciede2000);
}

/* True where the goal cannot be met even alone; the problem then says so. */
static mtm_status explain_alone(explanation *e, int goal, mtm_design_problem *problem, bool *is_alone,
                                mtm_error *error) {
    const mtm_goal *wanted = &e->search->goals->goals[goal];
    double lack = 0;
    mtm_xyz achieved = {0};
    char cell[192];
    char color[8];
    *is_alone = true;
    if (!moves(e->search, wanted, false) && !moves(e->search, wanted, true)) {
        describe_given(e, goal, problem);
        return MTM_OK;
    }
    const mtm_status status = lack_alone(e, goal, &lack, &achieved, error);
    *is_alone = status == MTM_OK && lack > e->design->tolerance;
    if (!*is_alone) return status;
    problem->is_proven = is_contradiction(e, 1);
    name_cell(e->design, wanted->cell, cell);
    mtm_rgb_format(mtm_rgb_from_xyz(achieved), color);
    (void)snprintf(problem->reason, sizeof problem->reason,
                   "%s: not possible even alone, %s; the nearest is %s, CIEDE2000 %.3g off", cell,
                   kind_of_limit(wanted, problem->is_proven), color, lack);
    return MTM_OK;
}

/* --- what blocks it --- */

/* How strongly a goal pulls at its spectra: where goals block each other all of them lack something, so one that lacks next
 * to nothing blocks none. */
static double pressure_of(const explanation *e, int goal) {
    const mtm_goal_result *result = &e->design->results[goal];
    return result->goal.weight * fmax(result->ciede2000, result->ciede2000_basis);
}

/* Whether two goals ask for the same; how strongly does not matter. */
static bool is_same_wish(const mtm_goal *a, const mtm_goal *b) {
    return a->kind == b->kind && a->cell.material == b->cell.material && a->cell.light == b->cell.light &&
           (!mtm_goal_has_other(a) ||
            (a->other.material == b->other.material && a->other.light == b->other.light)) &&
           a->color.x == b->color.x && a->color.y == b->color.y && a->color.z == b->color.z &&
           a->least == b->least;
}

/* Whether a goal could be in the way of another one: it has a spectrum in common, pulls at it, and no earlier goal asks for
 * the same. */
static bool is_suspect(const explanation *e, int goal, int other) {
    static const double light_pressure = 0.02;
    const mtm_goal *goals = e->search->goals->goals;
    if (is_same_wish(&goals[goal], &goals[other]) || !share_spectrum(e->search, &goals[goal], &goals[other]))
        return false;
    for (int earlier = 0; earlier < other; earlier++)
        if (is_same_wish(&goals[earlier], &goals[other])) return false;
    return pressure_of(e, other) >= light_pressure * pressure_of(e, goal);
}

/* What the goal lacks, by full spectra, without another one and those that ask for the same. */
static mtm_status lack_without(explanation *e, int goal, int other, double *lack, mtm_error *error) {
    const mtm_goal *goals = e->search->goals->goals;
    mtm_search search = *e->search;
    mtm_xyz achieved;
    search.is_left_out = e->is_left_out;
    for (int g = 0; g < search.goals->goal_count; g++)
        e->is_left_out[g] = is_same_wish(&goals[g], &goals[other]);
    memcpy(e->trial.spectra, e->found->spectra, (size_t)search.unknown_count * sizeof *e->trial.spectra);
    mtm_status status = ask_to_go_on(e, error);
    if (status == MTM_OK) status = mtm_search_finish(&search, &e->trial, false, error);
    *lack = INFINITY;
    if (status == MTM_OK) judge_trial(e, goal, lack, &achieved);
    return status;
}

static mtm_status find_blockers(explanation *e, int goal, mtm_design_problem *problem, mtm_error *error) {
    static const double much = 0.5; /* of what lacks is enough to call a goal a blocker */
    const double before = e->design->results[goal].ciede2000;
    for (int other = 0; other < e->search->goals->goal_count; other++) {
        if (problem->blocker_count == MTM_BLOCKERS_MAX || e->searches_left <= 0) break;
        if (!is_suspect(e, goal, other)) continue;
        double lack = 0;
        const mtm_status status = lack_without(e, goal, other, &lack, error);
        if (status != MTM_OK) return status;
        if (lack <= e->design->tolerance || lack < much * before)
            problem->blockers[problem->blocker_count++] = other;
    }
    return MTM_OK;
}

/* Whether the goal and its blockers contradict each other for sure. */
static mtm_status prove(explanation *e, int goal, mtm_design_problem *problem, mtm_error *error) {
    mtm_search search = *e->search;
    search.is_left_out = e->is_left_out;
    search.views = e->full;
    search.view_count = 1;
    for (int g = 0; g < search.goals->goal_count; g++) e->is_left_out[g] = g != goal;
    for (int b = 0; b < problem->blocker_count; b++) e->is_left_out[problem->blockers[b]] = false;
    memcpy(e->trial.spectra, e->found->spectra, (size_t)search.unknown_count * sizeof *e->trial.spectra);
    e->trial.contradiction = 0;
    mtm_status status = ask_to_go_on(e, error);
    if (status == MTM_OK) status = mtm_search_finish(&search, &e->trial, false, error);
    problem->is_proven = status == MTM_OK && is_contradiction(e, 1 + problem->blocker_count);
    return status;
}

/* Appends to the reason as far as there is room. */
__attribute__((format(printf, 2, 3))) static void add_reason(mtm_design_problem *problem, const char *format,
                                                             ...) {
    const size_t length = strlen(problem->reason);
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(problem->reason + length, sizeof problem->reason - length, format, arguments);
    va_end(arguments);
}

static void describe_blockers(const explanation *e, int goal, mtm_design_problem *problem) {
    const mtm_goal *goals = e->search->goals->goals;
    char cell[192];
    name_cell(e->design, goals[goal].cell, cell);
    add_reason(problem, "%s: possible alone, but blocked by ", cell);
    for (int b = 0; b < problem->blocker_count; b++) {
        const mtm_cell other = goals[problem->blockers[b]].cell;
        const bool is_own =
            other.material == goals[goal].cell.material && other.light == goals[goal].cell.light;
        name_cell(e->design, other, cell);
        add_reason(problem, "%s%s%s",
                   b == 0                            ? ""
                   : b + 1 == problem->blocker_count ? " or by "
                                                     : ", ",
                   is_own ? "another wish for " : "", cell);
    }
    if (problem->blocker_count == 0)
        add_reason(problem, "%s",
                   e->searches_left > 0 ? "the other goals of its spectra together"
                                        : "others (which was not looked into: too many goals)");
}

/* --- the basis --- */

/* How many numbers of the basis the goals on a material's color fix. */
static int numbers_fixed(const mtm_goals *goals, int material) {
    int count = 0;
    for (int g = 0; g < goals->goal_count; g++) {
        const mtm_goal *goal = &goals->goals[g];
        count += goal->kind != MTM_GOAL_DIFFERENT &&
                 (goal->cell.material == material ||
                  (mtm_goal_has_other(goal) && goal->other.material == material));
    }
    return MTM_COLOR_CHANNELS * count;
}

static void explain_basis(const explanation *e, int goal, mtm_design_problem *problem) {
    const mtm_goal_result *result = &e->design->results[goal];
    const int material = result->goal.cell.material;
    const int fixed = numbers_fixed(e->search->goals, material);
    char cell[192];
    name_cell(e->design, result->goal.cell, cell);
    problem->is_basis_only = true;
    if (fixed > e->basis->dimension)
        (void)snprintf(problem->reason, sizeof problem->reason,
                       "%s: full spectra do it, but %s is CIEDE2000 %.2f off: it has %d numbers for a "
                       "reflectance, and the goals "
                       "on %s fix %d; the basis \"materials\" shows it",
                       cell, e->design->basis, result->ciede2000_basis, e->basis->dimension,
                       e->design->palette.materials[material].name, fixed);
    else
        (void)snprintf(
            problem->reason, sizeof problem->reason,
            "%s: full spectra do it, but %s is CIEDE2000 %.2f off: its few smooth curves do not follow these "
            "spectra; the basis \"materials\" shows it",
            cell, e->design->basis, result->ciede2000_basis);
}

/* --- all --- */

static mtm_status explain_goal(explanation *e, int goal, mtm_error *error) {
    const mtm_goal_result *result = &e->design->results[goal];
    if (result->is_met && result->is_met_basis) return MTM_OK;
    mtm_design_problem *problem = &e->design->problems[e->design->problem_count++];
    bool is_alone = false;
    problem->goal = goal;
    if (result->is_met) {
        explain_basis(e, goal, problem);
        return MTM_OK;
    }
    mtm_status status = explain_alone(e, goal, problem, &is_alone, error);
    if (status != MTM_OK || is_alone) return status;
    if (e->searches_left > 0) status = find_blockers(e, goal, problem, error);
    if (status == MTM_OK && problem->blocker_count > 0) status = prove(e, goal, problem, error);
    if (status == MTM_OK) describe_blockers(e, goal, problem);
    return status;
}

/* Searches that are worth their time: fewer of larger problems. */
static int count_searches(const mtm_search *search) {
    enum { LEAST = 4, ROWS = 4000 };
    const int rows = search->goals->goal_count * search->view_count * MTM_COLOR_CHANNELS;
    return rows * LEAST > ROWS ? LEAST : ROWS / rows;
}

mtm_status mtm_design_explain(const mtm_search *search, const mtm_found *found, const mtm_color_view *full,
                              const mtm_color_view *basis, const mtm_progress *progress, mtm_design *design,
                              mtm_error *error) {
    const size_t goals = (size_t)design->result_count;
    explanation e = {.search = search,
                     .found = found,
                     .full = full,
                     .basis = basis,
                     .progress = progress,
                     .searches_left = count_searches(search),
                     .design = design,
                     .is_left_out = mtm_allocate(goals, sizeof *e.is_left_out),
                     .trial.spectra = mtm_allocate((size_t)search->unknown_count, sizeof *e.trial.spectra)};
    mtm_status status = MTM_OK;
    if (e.is_left_out == NULL || e.trial.spectra == NULL)
        status = mtm_fail_memory(error, "the reasons of a design", goals + sizeof *e.trial.spectra);
    for (int goal = 0; goal < design->result_count && status == MTM_OK; goal++)
        status = explain_goal(&e, goal, error);
    free(e.is_left_out);
    free(e.trial.spectra);
    return status;
}
