/* SPDX-License-Identifier: BSD-3-Clause
 * Palette design: spectra for the colors that cells are to have (paper section 4.1; S. Bergner, M. S. Drew, T. Möller, A
 * Tool to Create Illuminant and Reflectance Spectra for Light-Driven Graphics and Visualization, ACM TOG 28(1), 2009).
 * Measured reflectances are tried first, then the search is run from several starts; the cheapest result is kept. */
#include "palette/design.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"

enum { N = MTM_SPECTRUM_SAMPLES };

/* Through a basis of some numbers a goal counts as met at twice the tolerance. */
static const double basis_tolerance = 2;

mtm_design_options mtm_design_defaults(void) {
    return (mtm_design_options){0};
}

/* Both ways to see the colors of a design. */
typedef struct both_views {
    mtm_color_view full, basis;
    bool has_basis; /* false: the basis is exact */
} both_views;

static mtm_status make_views(const char *basis, both_views *views, mtm_error *error) {
    *views = (both_views){.has_basis = strcmp(basis, "materials") != 0 && strcmp(basis, "wavelengths") != 0};
    mtm_status status = mtm_color_view_full(&views->full, error);
    if (status == MTM_OK && views->has_basis) status = mtm_color_view_basis(basis, &views->basis, error);
    return status;
}

static void free_views(both_views *views) {
    mtm_color_view_free(&views->full);
    mtm_color_view_free(&views->basis);
}

/* The views that count in the search; at least one is left. */
static int choose_views(const both_views *views, unsigned without, mtm_color_view chosen[2]) {
    int count = 0;
    if (!(without & MTM_DESIGN_WITHOUT_FULL) || !views->has_basis) chosen[count++] = views->full;
    if (!(without & MTM_DESIGN_WITHOUT_BASIS) && views->has_basis) chosen[count++] = views->basis;
    if (count == 0) chosen[count++] = views->full;
    return count;
}

/* --- results --- */

static mtm_xyz color_of_cell(const mtm_search *search, const mtm_found *found, const mtm_color_view *view,
                             mtm_cell cell, mtm_color color) {
    mtm_color_view_cell(view, mtm_search_light(search, found, cell.light),
                        mtm_search_material(search, found, cell.material), color);
    return mtm_xyz_of_color(color);
}

/* The color that a goal's cell is compared with. */
static mtm_xyz color_asked(const mtm_search *search, const mtm_found *found, const mtm_color_view *view,
                           const mtm_goal *goal, mtm_color color) {
    memset(color, 0, sizeof(mtm_color));
    if (mtm_goal_has_other(goal)) return color_of_cell(search, found, view, goal->other, color);
    if (goal->kind != MTM_GOAL_COLOR) return (mtm_xyz){0, 0, 0};
    const mtm_rgb rgb = mtm_rgb_from_xyz(goal->color);
    color[0] = rgb.r;
    color[1] = rgb.g;
    color[2] = rgb.b;
    return goal->color;
}

mtm_goal_result mtm_goal_judge(const mtm_search *search, const mtm_found *found, const mtm_color_view *full,
                               const mtm_color_view *basis, const mtm_goal *goal) {
    mtm_goal_result result = {.goal = *goal};
    mtm_color own;
    mtm_color other;
    result.asked = color_asked(search, found, full, goal, other);
    result.achieved = color_of_cell(search, found, full, goal->cell, own);
    result.difference = mtm_color_difference(own, other);
    if (basis != NULL) {
        (void)color_asked(search, found, basis, goal, other);
        result.achieved_basis = color_of_cell(search, found, basis, goal->cell, own);
        result.difference_basis = mtm_color_difference(own, other);
    } else {
        result.achieved_basis = result.achieved;
        result.difference_basis = result.difference;
    }
    result.ciede2000 = mtm_goal_lack(goal, result.difference);
    result.ciede2000_basis = mtm_goal_lack(goal, result.difference_basis);
    return result;
}

static const mtm_color_view *basis_of(const both_views *views) {
    return views->has_basis ? &views->basis : NULL;
}

/* How many goals are not met, by full spectra and through the basis. */
typedef struct unmet_goals {
    int full, basis;
} unmet_goals;

static unmet_goals count_unmet(const mtm_search *search, const mtm_found *found, const both_views *views) {
    const double tolerance = search->goals->tolerance;
    unmet_goals unmet = {0, 0};
    for (int g = 0; g < search->goals->goal_count; g++) {
        const mtm_goal_result result =
            mtm_goal_judge(search, found, &views->full, basis_of(views), &search->goals->goals[g]);
        unmet.full += result.ciede2000 > tolerance;
        unmet.basis += result.ciede2000_basis > basis_tolerance * tolerance;
    }
    return unmet;
}

static bool is_large(const mtm_search *search) {
    enum { LARGE = 8 /* spectra to be found */ };
    return search->unknown_count > LARGE;
}

/* Whether more starts are not worth their time. */
static bool is_good(const mtm_search *search, const mtm_found *found, const both_views *views) {
    const unmet_goals unmet = count_unmet(search, found, views);
    return unmet.full == 0 && (!search->is_basis_vital || unmet.basis == 0);
}

/* --- starts --- */

/* A round has as many starts as are cheap: few of the large problems, whose goals leave so much freedom that most succeed. */
enum { STARTS_OF_ROUND = 8, STARTS_OF_LARGE_ROUND = 2, ALL_STARTS = 24, ROUNDS_FULL_FIRST = 2 };

/* A round of starts, each a task that writes to its own place. */
typedef struct start_round {
    const mtm_search *search;
    const both_views *views;
    double begun, share; /* of the whole progress: before these rounds, and of them */
    int first, tried;
    mtm_found *found;
    mtm_status *statuses;
    mtm_error *errors;
} start_round;

/* A large problem's start is done once its goals are met; of a small one the smoothest spectra near by are worth the time. */
static mtm_status finish_start(const start_round *r, mtm_found *found, mtm_error *error) {
    const bool is_hasty = is_large(r->search);
    mtm_status status = mtm_search_finish(r->search, found, !is_hasty, error);
    if (status == MTM_OK && is_hasty && !is_good(r->search, found, r->views))
        status = mtm_search_finish(r->search, found, true, error);
    return status;
}

static void run_start(void *context, int task) {
    start_round *r = context;
    mtm_found *found = &r->found[task];
    r->statuses[task] = mtm_search_begin(r->search, r->first + task, found, &r->errors[task]);
    if (r->statuses[task] == MTM_OK) r->statuses[task] = finish_start(r, found, &r->errors[task]);
}

/* Keeps the cheapest of a round and what there was before; of costs that are the same to 1e-6 the first. */
static void keep_best(const mtm_search *search, const start_round *r, int count, mtm_found *best) {
    static const double same = 1e-6;
    for (int i = 0; i < count; i++) {
        if (r->statuses[i] != MTM_OK || !(r->found[i].cost < best->cost * (1 - same))) continue;
        memcpy(best->spectra, r->found[i].spectra, (size_t)search->unknown_count * sizeof *best->spectra);
        best->cost = r->found[i].cost;
    }
}

static mtm_status run_round(start_round *r, int count, int thread_count, const mtm_progress *progress,
                            mtm_found *best, mtm_error *error) {
    if (mtm_parallel_for(thread_count, count, run_start, r, progress) != MTM_OK)
        return mtm_fail(error, MTM_CANCELLED, "the design was cancelled");
    keep_best(r->search, r, count, best);
    for (int i = 0; i < count; i++) /* a start that fails is no matter as long as another one does not */
        if (r->statuses[i] == MTM_MEMORY || best->cost == INFINITY)
            return mtm_fail(error, r->statuses[i] == MTM_OK ? MTM_NUMERIC : r->statuses[i], "%s",
                            r->statuses[i] == MTM_OK ? "no start of the design leads anywhere"
                                                     : r->errors[i].message);
    return MTM_OK;
}

/* The share of all rounds that is done, for whoever listens to one of them. */
typedef struct round_progress {
    mtm_progress all;
    double done, share;
} round_progress;

static bool report_round(void *user, double fraction) {
    const round_progress *p = user;
    return p->all.report == NULL || p->all.report(p->all.user, p->done + p->share * fraction);
}

/* Goes on with the best as long as that brings something: cheaper than another round. */
static mtm_status improve_best(const mtm_search *search, const both_views *views, mtm_found *best,
                               mtm_error *error) {
    enum { TIMES = 6 };
    static const double something = 0.8;
    for (int i = 0; i < TIMES && !is_good(search, best, views); i++) {
        const double before = best->cost;
        const mtm_status status = mtm_search_finish(search, best, true, error);
        if (status != MTM_OK) return status;
        if (best->cost > something * before) break;
    }
    return MTM_OK;
}

/* Tries starts in rounds until all goals are met. */
static mtm_status run_rounds(const mtm_search *search, const both_views *views,
                             const mtm_design_options *options, start_round *r, int count, int rounds,
                             mtm_found *best, mtm_error *error) {
    mtm_status status = MTM_OK;
    best->cost = INFINITY;
    for (int k = 0; k < rounds && status == MTM_OK; k++) {
        round_progress share = {options->progress, r->begun + r->share * k / rounds, r->share / rounds};
        const mtm_progress progress = {report_round, &share};
        r->first = k * count;
        status = run_round(r, count, options->thread_count, &progress, best, error);
        r->tried += count;
        if (status == MTM_OK) status = improve_best(search, views, best, error);
        if (status == MTM_OK && is_good(search, best, views)) break;
    }
    return status;
}

/* Where full spectra and the basis together are too much to ask, full spectra come first: some more rounds in which the
 * basis hardly counts, kept where the full spectra then meet more goals. */
static mtm_status put_full_first(const mtm_search *search, const both_views *views,
                                 const mtm_design_options *options, start_round *r, int count,
                                 mtm_found *best, mtm_error *error) {
    static const double hardly = 1e4;
    const int before = count_unmet(search, best, views).full;
    if (search->view_count < 2 || before == 0) return MTM_OK;
    const size_t bytes = (size_t)search->unknown_count * sizeof *best->spectra;
    mtm_search full_first = *search;
    mtm_found other = {.spectra = mtm_allocate(1, bytes)};
    if (other.spectra == NULL) return mtm_fail_memory(error, "a design", bytes);
    full_first.view_give[1] *= hardly;
    full_first.is_basis_vital = false;
    r->search = &full_first;
    r->begun += r->share;
    r->share = 0.2;
    const mtm_status status =
        run_rounds(&full_first, views, options, r, count, ROUNDS_FULL_FIRST, &other, error);
    if (status == MTM_OK && count_unmet(search, &other, views).full < before) {
        memcpy(best->spectra, other.spectra, bytes);
        best->cost = other.cost;
    }
    free(other.spectra);
    return status;
}

static mtm_status run_starts(const mtm_search *search, const both_views *views,
                             const mtm_design_options *options, mtm_found *best, int *start_count,
                             mtm_error *error) {
    const bool is_one = (options->without & MTM_DESIGN_WITHOUT_STARTS) != 0;
    const int wanted = is_one ? 1 : mtm_search_start_count(search);
    const int most = is_large(search) ? STARTS_OF_LARGE_ROUND : STARTS_OF_ROUND;
    const int count = wanted < most ? wanted : most;
    const int rounds = wanted < most ? 1 : ALL_STARTS / count;
    const size_t spectra = (size_t)search->unknown_count;
    mtm_spectrum *storage = mtm_allocate((size_t)count * spectra, sizeof *storage);
    mtm_found found[STARTS_OF_ROUND];
    mtm_status statuses[STARTS_OF_ROUND];
    mtm_error errors[STARTS_OF_ROUND];
    if (storage == NULL)
        return mtm_fail_memory(error, "the starts of a design", (size_t)count * spectra * sizeof *storage);
    for (int i = 0; i < count; i++) found[i] = (mtm_found){.spectra = storage + (size_t)i * spectra};
    start_round r = {.search = search,
                     .views = views,
                     .share = 0.7,
                     .found = found,
                     .statuses = statuses,
                     .errors = errors};
    mtm_status status = run_rounds(search, views, options, &r, count, rounds, best, error);
    if (status == MTM_OK) status = put_full_first(search, views, options, &r, count, best, error);
    *start_count = r.tried;
    free(storage);
    return status;
}

/* --- the design --- */

static bool is_within(const double *values, int count, double low, double high) {
    static const double rounding = 1e-9;
    for (int i = 0; i < count; i++)
        if (!(values[i] >= low - rounding && values[i] <= high + rounding)) return false;
    return true;
}

/* What a designed spectrum is, by its samples and, where they leave the physical range, by its coefficients. */
static mtm_honesty honesty_of(const double *samples, bool is_light, const mtm_color_view *basis) {
    double coefficients[N];
    const double high = is_light ? INFINITY : 1;
    if (is_within(samples, N, 0, high)) return MTM_HONESTY_PHYSICAL;
    if (basis == NULL) return MTM_HONESTY_ARTIFICIAL;
    mtm_color_view_encode(basis, samples, coefficients);
    return is_within(coefficients, basis->dimension, 0, high) ? MTM_HONESTY_COEFFICIENTS
                                                              : MTM_HONESTY_ARTIFICIAL;
}

static void take_spectra(const mtm_search *search, const mtm_found *found, const mtm_color_view *basis,
                         mtm_design *design) {
    for (int u = 0; u < search->unknown_count; u++) {
        const mtm_unknown *unknown = &search->unknowns[u];
        double *values = unknown->is_light ? design->palette.lights[unknown->index].emission.value
                                           : design->palette.materials[unknown->index].reflectance.value;
        memcpy(values, found->spectra[u].value, sizeof found->spectra[u].value);
        *(unknown->is_light ? &design->lights[unknown->index] : &design->materials[unknown->index]) =
            honesty_of(found->spectra[u].value, unknown->is_light, basis);
    }
}

static void judge_all(const mtm_search *search, const mtm_found *found, const both_views *views,
                      mtm_design *design) {
    for (int g = 0; g < design->result_count; g++) {
        mtm_goal_result *result = &design->results[g];
        *result = mtm_goal_judge(search, found, &views->full, basis_of(views), &search->goals->goals[g]);
        result->is_met = result->ciede2000 <= design->tolerance;
        result->is_met_basis = result->ciede2000_basis <= basis_tolerance * design->tolerance;
    }
}

void mtm_design_destroy(mtm_design *design) {
    if (design == NULL) return;
    mtm_palette_free(&design->palette);
    free(design->materials);
    free(design->lights);
    free(design->material_origins);
    free(design->results);
    free(design->problems);
    free(design);
}

/* A design with room for everything and the goals' own palette. */
static mtm_status begin_design(const mtm_goals *goals, mtm_design **design, mtm_error *error) {
    const size_t materials = (size_t)goals->palette.material_count;
    const size_t lights = (size_t)goals->palette.light_count;
    const size_t count = (size_t)goals->goal_count;
    mtm_design *made = mtm_allocate(1, sizeof *made);
    if (made == NULL) return mtm_fail_memory(error, "a design", sizeof *made);
    *made = (mtm_design){.materials = mtm_allocate(materials, sizeof *made->materials),
                         .lights = mtm_allocate(lights, sizeof *made->lights),
                         .material_origins = mtm_allocate(materials, sizeof *made->material_origins),
                         .tolerance = goals->tolerance,
                         .result_count = goals->goal_count,
                         .results = mtm_allocate(count, sizeof *made->results),
                         .problems = mtm_allocate(count, sizeof *made->problems)};
    (void)snprintf(made->basis, sizeof made->basis, "%s", goals->basis);
    mtm_status status = MTM_OK;
    if (made->materials == NULL || made->lights == NULL || made->material_origins == NULL ||
        made->results == NULL || made->problems == NULL)
        status = mtm_fail_memory(error, "a design", count * sizeof *made->problems);
    if (status == MTM_OK) status = mtm_palette_copy(&goals->palette, &made->palette, error);
    if (status == MTM_OK)
        *design = made;
    else
        mtm_design_destroy(made);
    return status;
}

/* The search, its result and what is to be said of it. */
static mtm_status find(const mtm_goals *goals, const mtm_design_options *options, const both_views *views,
                       mtm_design *design, mtm_error *error) {
    mtm_search search;
    mtm_color_view chosen[2];
    const int view_count = choose_views(views, options->without, chosen);
    mtm_status status = mtm_search_plan(goals, view_count, chosen,
                                        !(options->without & MTM_DESIGN_WITHOUT_BOUNDS), &search, error);
    if (status != MTM_OK) return status;
    search.is_basis_vital = !is_large(&search);
    mtm_found best = {.spectra = mtm_allocate((size_t)search.unknown_count, sizeof *best.spectra)};
    if (best.spectra == NULL)
        status = mtm_fail_memory(error, "a design", (size_t)search.unknown_count * sizeof *best.spectra);
    else if (search.unknown_count > 0)
        status = run_starts(&search, views, options, &best, &design->start_count, error);
    if (status == MTM_OK) {
        take_spectra(&search, &best, basis_of(views), design);
        judge_all(&search, &best, views, design);
        design->objective = best.cost;
        status = mtm_design_explain(&search, &best, &views->full, basis_of(views), &options->progress, design,
                                    error);
    }
    free(best.spectra);
    mtm_search_free(&search);
    return status;
}

/* The goals with wishes of their own, which the search of a library changes. */
static mtm_status copy_wishes(const mtm_goals *goals, mtm_goals *copy, mtm_error *error) {
    const size_t bytes = (size_t)goals->palette.material_count * sizeof *goals->materials;
    *copy = *goals;
    copy->materials = mtm_allocate((size_t)goals->palette.material_count, sizeof *copy->materials);
    if (copy->materials == NULL) return mtm_fail_memory(error, "a design", bytes);
    memcpy(copy->materials, goals->materials, bytes);
    return MTM_OK;
}

/* One design; `may_measure` lets materials that a library has for their goals be measured ones. */
static mtm_status attempt(const mtm_goals *goals, const mtm_design_options *options, bool may_measure,
                          mtm_design **design, mtm_error *error) {
    both_views views = {0};
    mtm_goals own;
    mtm_design *made = NULL;
    mtm_status status = copy_wishes(goals, &own, error);
    if (status != MTM_OK) return status;
    status = begin_design(goals, &made, error);
    if (status == MTM_OK) {
        own.palette = made->palette; /* the same spectra: what the library finds is the design's at once */
        status = mtm_library_find(&own, may_measure, made->material_origins, error);
    }
    for (int i = 0; i < goals->palette.material_count && status == MTM_OK; i++)
        made->materials[i] = made->material_origins[i][0] == '\0' ? MTM_HONESTY_GIVEN : MTM_HONESTY_MEASURED;
    if (status == MTM_OK) status = make_views(goals->basis, &views, error);
    if (status == MTM_OK) status = find(&own, options, &views, made, error);
    free_views(&views);
    free(own.materials);
    if (status == MTM_OK)
        *design = made;
    else
        mtm_design_destroy(made);
    return status;
}

static int count_missed(const mtm_design *design) {
    int count = 0;
    for (int i = 0; i < design->result_count; i++) count += !design->results[i].is_met;
    return count;
}

static bool has_measured(const mtm_design *design) {
    for (int i = 0; i < design->palette.material_count; i++)
        if (design->materials[i] == MTM_HONESTY_MEASURED) return true;
    return false;
}

/* A library judges its materials under given lights alone. Where they then stand in the way of other goals, designed ones
 * near them may do better. */
mtm_status mtm_design_find(const mtm_goals *goals, const mtm_design_options *options, mtm_design **design,
                           mtm_error *error) {
    const mtm_design_options plain = mtm_design_defaults();
    const mtm_design_options *how = options == NULL ? &plain : options;
    mtm_design *first = NULL;
    mtm_design *second = NULL;
    mtm_status status = attempt(goals, how, true, &first, error);
    if (status == MTM_OK && has_measured(first) && count_missed(first) > 0)
        status = attempt(goals, how, false, &second, error);
    if (status == MTM_OK) {
        const bool is_second = second != NULL && count_missed(second) < count_missed(first);
        *design = is_second ? second : first;
        mtm_design_destroy(is_second ? first : second);
    } else {
        mtm_design_destroy(first);
    }
    return status;
}
