/* SPDX-License-Identifier: BSD-3-Clause
 * The search for spectra. A color is bilinear in light and reflectance, so with the lights given the reflectances of all
 * goals are one quadratic program, and with these given the lights are: alternating between them goes downhill from any
 * start. From where that becomes slow, all are moved together, with colors linear in the step and damping.
 *
 * What counts is Σ ½·weight·miss²/give over goals and views plus the spectra's roughness; a miss is measured by the local
 * metric of CIEDE2000 at the wanted color, so that what cannot be met is shared out as the eye would. */
#include "palette/solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/linear.h"
#include "base/memory.h"
#include "base/qp.h"
#include "palette/linearize.h"

enum { N = MTM_SPECTRUM_SAMPLES, ROWS_MAX = MTM_GOAL_ROWS };

/* Misses of about a hundredth of a CIEDE2000 cost what a rough spectrum does. */
static const double give = 1e-4;

/* Alternation needs room: with narrow valleys it would hardly move along them. */
static const double give_of_alternation = 1e-2;

/* A light's luminance is met to rounding. */
static const double give_of_luminance = 1e-10;

static int find_unknown(const mtm_search *search, bool is_light, int index) {
    for (int u = 0; u < search->unknown_count; u++)
        if (search->unknowns[u].is_light == is_light && search->unknowns[u].index == index) return u;
    return -1;
}

static const double *spectrum_of(const mtm_search *search, const mtm_spectrum *spectra, bool is_light,
                                 int index) {
    const int unknown = find_unknown(search, is_light, index);
    if (unknown >= 0) return spectra[unknown].value;
    return search->given[index + (is_light ? search->goals->palette.material_count : 0)].value;
}

const double *mtm_search_material(const mtm_search *search, const mtm_found *found, int material) {
    return spectrum_of(search, found->spectra, false, material);
}

const double *mtm_search_light(const mtm_search *search, const mtm_found *found, int light) {
    return spectrum_of(search, found->spectra, true, light);
}

/* --- planning --- */

static void plan_unknown(const mtm_spectrum_wish *wish, bool is_light, int index, bool is_bounded,
                         mtm_unknown *unknown) {
    /* Lights may be rougher than reflectances: lamps are, and what separates materials needs narrow bands. */
    static const double light_curvature = 0.05, material_curvature = 1;
    static const double slack = 1e-4, anchored = 1e-2;
    static const double light_high =
        25; /* of equal-energy light; without a limit lines take over, and starts fail */
    *unknown =
        (mtm_unknown){.is_light = is_light,
                      .index = index,
                      .is_anchored = wish->pull > 0,
                      .low = -INFINITY,
                      .high = INFINITY,
                      .curvature = wish->smoothness * (is_light ? light_curvature : material_curvature),
                      .size = wish->pull > 0 ? anchored * wish->pull : slack};
    if (is_bounded && wish->is_physical) {
        unknown->low = 0;
        unknown->high = is_light ? light_high : 1;
    }
    for (int i = 0; i < N; i++)
        unknown->reference[i] = wish->pull > 0 ? wish->anchor.value[i] : is_light ? 1 : 0.5;
    if (wish->pull > 0 && is_light) (void)!mtm_samples_of_light(&wish->anchor, unknown->reference);
}

mtm_status mtm_search_plan(const mtm_goals *goals, int view_count, const mtm_color_view *views,
                           bool is_bounded, mtm_search *search, mtm_error *error) {
    const mtm_palette *palette = &goals->palette;
    const size_t spectra = (size_t)palette->material_count + (size_t)palette->light_count;
    *search = (mtm_search){.goals = goals, .view_count = view_count, .views = views, .view_give = {1, 4}};
    search->unknowns = mtm_allocate(spectra, sizeof *search->unknowns);
    search->given = mtm_allocate(spectra, sizeof *search->given);
    if (search->unknowns == NULL || search->given == NULL) {
        mtm_search_free(search);
        return mtm_fail_memory(error, "a search for spectra", spectra * sizeof *search->unknowns);
    }
    mtm_samples_luminance(search->luminance);
    for (int i = 0; i < palette->material_count; i++) {
        if (goals->materials[i].is_designed)
            plan_unknown(&goals->materials[i], false, i, is_bounded,
                         &search->unknowns[search->unknown_count++]);
        else
            search->given[i] = palette->materials[i].reflectance;
    }
    for (int i = 0; i < palette->light_count; i++) {
        if (goals->lights[i].is_designed)
            plan_unknown(&goals->lights[i], true, i, is_bounded, &search->unknowns[search->unknown_count++]);
        else
            (void)!mtm_samples_of_light(&palette->lights[i].emission,
                                        search->given[palette->material_count + i].value);
    }
    return MTM_OK;
}

void mtm_search_free(mtm_search *search) {
    free(search->unknowns);
    free(search->given);
    *search = (mtm_search){0};
}

/* --- cost --- */

static bool counts(const mtm_search *search, int goal) {
    return search->is_left_out == NULL || !search->is_left_out[goal];
}

/* A curve's penalties, as the quadratic program has them. */
static double roughness(const mtm_unknown *unknown, const double *x) {
    double cost = 0;
    for (int i = 0; i < N; i++) {
        const double apart = x[i] - unknown->reference[i];
        cost += unknown->size * apart * apart;
        if (i + 2 >= N) continue;
        const double bend =
            apart - 2 * (x[i + 1] - unknown->reference[i + 1]) + x[i + 2] - unknown->reference[i + 2];
        cost += unknown->curvature * bend * bend;
    }
    return cost / 2;
}

static mtm_cell_spectra spectra_of_cell(const mtm_search *search, const mtm_spectrum *spectra, mtm_cell cell,
                                        const bool *is_moving) {
    const int material = find_unknown(search, false, cell.material);
    const int light = find_unknown(search, true, cell.light);
    return (mtm_cell_spectra){
        .material = spectrum_of(search, spectra, false, cell.material),
        .light = spectrum_of(search, spectra, true, cell.light),
        .material_curve = material >= 0 && (is_moving == NULL || is_moving[material]) ? material : -1,
        .light_curve = light >= 0 && (is_moving == NULL || is_moving[light]) ? light : -1,
    };
}

/* Both cells of a goal; the second is the first again where there is no other. */
static void spectra_of_goal(const mtm_search *search, const mtm_spectrum *spectra, const mtm_goal *goal,
                            const bool *is_moving, mtm_cell_spectra cells[2]) {
    cells[0] = spectra_of_cell(search, spectra, goal->cell, is_moving);
    cells[1] = mtm_goal_has_other(goal) ? spectra_of_cell(search, spectra, goal->other, is_moving) : cells[0];
}

static double total_cost(const mtm_search *search, const mtm_spectrum *spectra, double miss_give) {
    double cost = 0;
    for (int u = 0; u < search->unknown_count; u++) cost += roughness(&search->unknowns[u], spectra[u].value);
    for (int g = 0; g < search->goals->goal_count; g++) {
        const mtm_goal *goal = &search->goals->goals[g];
        if (!counts(search, g)) continue;
        mtm_cell_spectra cells[2];
        spectra_of_goal(search, spectra, goal, NULL, cells);
        for (int v = 0; v < search->view_count; v++) {
            const double miss = mtm_goal_miss(&search->views[v], goal, cells);
            cost += goal->weight * miss * miss / (2 * miss_give * search->view_give[v]);
        }
    }
    return cost;
}

/* Scales a light to Y = 1 on the perfect reflector, where it has any. */
static void scale_light(const mtm_search *search, mtm_samples light) {
    const double luminance = mtm_dot(N, search->luminance, light);
    for (int i = 0; i < N && luminance > 0; i++) light[i] /= luminance;
}

/* --- one quadratic program --- */

/* The rows of a step, and which unknowns hang together through them. */
typedef struct step_plan {
    int row_count;
    mtm_goal_row *rows;
    int *group; /* of each unknown: the smallest one it hangs together with */
} step_plan;

static int root_of(const int *group, int unknown) {
    while (group[unknown] != unknown) unknown = group[unknown];
    return unknown;
}

static void join(int *group, const mtm_goal_row *row) {
    for (int t = 1; t < row->term_count; t++) {
        const int a = root_of(group, row->curves[0]);
        const int b = root_of(group, row->curves[t]);
        group[a > b ? a : b] = a > b ? b : a;
    }
}

/* The rows of the step's moving unknowns: the goals in every view, then the luminances of lights. */
static void plan_rows(const mtm_search *search, const mtm_spectrum *spectra, const bool *is_moving,
                      double miss_give, int turn, step_plan *plan) {
    plan->row_count = 0;
    for (int u = 0; u < search->unknown_count; u++) plan->group[u] = u;
    for (int g = 0; g < search->goals->goal_count; g++) {
        const mtm_goal *goal = &search->goals->goals[g];
        if (!counts(search, g)) continue;
        mtm_cell_spectra cells[2];
        spectra_of_goal(search, spectra, goal, is_moving, cells);
        for (int v = 0; v < search->view_count; v++) {
            mtm_goal_row *rows = plan->rows + plan->row_count;
            const int count = mtm_goal_linearize(&search->views[v], goal, cells, spectra, turn + g, rows);
            for (int r = 0; r < count; r++) {
                rows[r].give = miss_give * search->view_give[v] / goal->weight;
                join(plan->group, &rows[r]);
            }
            plan->row_count += count;
        }
    }
    for (int u = 0; u < search->unknown_count; u++) {
        if (!is_moving[u] || !search->unknowns[u].is_light) continue;
        mtm_goal_row *row = &plan->rows[plan->row_count++];
        *row = (mtm_goal_row){.term_count = 1, .curves = {u}, .low = 1, .high = 1, .give = give_of_luminance};
        memcpy(row->weights[0], search->luminance, sizeof row->weights[0]);
    }
}

/* The program's curves are the moving unknowns of the group, in order; `place` says which. */
static void add_curves(const mtm_search *search, mtm_spectrum *spectra, const bool *is_moving,
                       const step_plan *plan, int group, double damping, mtm_spectrum *pulls, mtm_qp *program,
                       int *place) {
    for (int u = 0; u < search->unknown_count; u++) {
        const mtm_unknown *unknown = &search->unknowns[u];
        if (!is_moving[u] || root_of(plan->group, u) != group) continue;
        place[u] = program->curve_count;
        for (int i = 0; i < N; i++)
            pulls[u].value[i] = damping * (unknown->reference[i] - spectra[u].value[i]);
        program->curves[program->curve_count++] = (mtm_qp_curve){.curvature = unknown->curvature,
                                                                 .size = unknown->size + damping,
                                                                 .reference = unknown->reference,
                                                                 .linear = pulls[u].value,
                                                                 .low = unknown->low,
                                                                 .high = unknown->high,
                                                                 .x = spectra[u].value};
    }
}

static void add_sums(const step_plan *plan, int group, const int *place, mtm_qp *program) {
    for (int r = 0; r < plan->row_count; r++) {
        const mtm_goal_row *row = &plan->rows[r];
        if (row->term_count == 0 || root_of(plan->group, row->curves[0]) != group) continue;
        mtm_qp_sum *sum = &program->sums[program->sum_count++];
        *sum = (mtm_qp_sum){
            .term_count = row->term_count, .low = row->low, .high = row->high, .give = row->give};
        for (int t = 0; t < row->term_count; t++) {
            sum->terms[t].curve = place[row->curves[t]];
            sum->terms[t].weights = row->weights[t];
        }
    }
}

/* Solves for one group of unknowns that hang together. Where that does not settle, because goals pull with too different
 * strengths, they stay where they are. */
static mtm_status solve_group(const mtm_search *search, mtm_spectrum *spectra, mtm_qp *program,
                              double *contradiction, mtm_error *error) {
    mtm_spectrum before[MTM_DESIGNED_MAX];
    memcpy(before, spectra, (size_t)search->unknown_count * sizeof *before);
    const mtm_status status = mtm_qp_minimize(program, error);
    if (status == MTM_OK) *contradiction = fmax(*contradiction, mtm_qp_contradiction(program));
    if (status != MTM_NUMERIC) return status;
    memcpy(spectra, before, (size_t)search->unknown_count * sizeof *before);
    return MTM_OK;
}

/* Moves the unknowns that may move to the minimum of the problem with colors linear in the step. `turn` varies the
 * direction in which equal colors are parted. *contradiction becomes at least how far the rows are from being kept. */
static mtm_status take_step(const mtm_search *search, mtm_spectrum *spectra, const bool *is_moving,
                            double miss_give, double damping, int turn, double *contradiction,
                            mtm_error *error) {
    const size_t unknowns = (size_t)search->unknown_count;
    const size_t rows_max =
        (size_t)search->goals->goal_count * (size_t)search->view_count * ROWS_MAX + unknowns;
    step_plan plan = {.rows = mtm_allocate_unset(rows_max, sizeof *plan.rows),
                      .group = mtm_allocate(unknowns, sizeof *plan.group)};
    mtm_qp program = {.length = N,
                      .curves = mtm_allocate(unknowns, sizeof *program.curves),
                      .sums = mtm_allocate(rows_max, sizeof *program.sums)};
    mtm_spectrum *pulls = mtm_allocate(unknowns, sizeof *pulls);
    int *place = mtm_allocate(unknowns, sizeof *place);
    mtm_status status = MTM_OK;
    *contradiction = 0;
    if (plan.rows == NULL || plan.group == NULL || program.curves == NULL || program.sums == NULL ||
        pulls == NULL || place == NULL)
        status = mtm_fail_memory(error, "a step of a design", rows_max * sizeof *plan.rows);
    else
        plan_rows(search, spectra, is_moving, miss_give, turn, &plan);
    for (int u = 0; u < search->unknown_count && status == MTM_OK; u++) {
        if (!is_moving[u] || root_of(plan.group, u) != u) continue;
        program.curve_count = program.sum_count = 0;
        add_curves(search, spectra, is_moving, &plan, u, damping, pulls, &program, place);
        add_sums(&plan, u, place, &program);
        status = solve_group(search, spectra, &program, contradiction, error);
    }
    for (int u = 0; u < search->unknown_count; u++) /* the rounding of goals that pull hard */
        if (is_moving[u] && search->unknowns[u].is_light) scale_light(search, spectra[u].value);
    free(plan.rows);
    free(plan.group);
    free(program.curves);
    free(program.sums);
    free(pulls);
    free(place);
    return status;
}

/* --- starts --- */

static bool has_goal_of(const mtm_search *search, mtm_goal_kind kind) {
    for (int g = 0; g < search->goals->goal_count; g++)
        if (counts(search, g) && search->goals->goals[g].kind == kind) return true;
    return false;
}

static bool has_unknown(const mtm_search *search, bool is_light) {
    for (int u = 0; u < search->unknown_count; u++)
        if (search->unknowns[u].is_light == is_light) return true;
    return false;
}

static bool is_bilinear(const mtm_search *search) {
    return has_unknown(search, false) && has_unknown(search, true);
}

/* One quadratic program is then the whole problem. */
static bool is_convex(const mtm_search *search) {
    return !is_bilinear(search) && !has_goal_of(search, MTM_GOAL_DIFFERENT);
}

int mtm_search_start_count(const mtm_search *search) {
    enum { STARTS = 8 };
    return is_convex(search) ? 1 : STARTS;
}

/* A number in 0 … 1 (G. Steele, D. Lea, C. Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014). */
static double next_number(uint64_t *seed) {
    uint64_t z = (*seed += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

/* Three bands on a little white. */
static void random_light(const mtm_search *search, uint64_t *seed, mtm_samples light) {
    for (int i = 0; i < N; i++) light[i] = 0.02;
    for (int band = 0; band < 3; band++) {
        const double center = MTM_WAVELENGTH_FIRST_NM + 40 + 260 * next_number(seed);
        const double width = 15 + 45 * next_number(seed);
        for (int i = 0; i < N; i++) {
            const double away = (MTM_WAVELENGTH_FIRST_NM + i * MTM_WAVELENGTH_STEP_NM - center) / width;
            light[i] += exp(-away * away / 2);
        }
    }
    scale_light(search, light);
}

/* Gives each light teeth of its own of one comb, so that materials that keep to the teeth of a light are black under the
 * others and, with three teeth, of any color under it; fewer teeth leave more of a basis' numbers to each. */
static void comb_light(const mtm_search *search, int teeth, int tooth, int light_count, mtm_samples light) {
    enum { FIRST = 6, LAST = 60 /* 410 … 680 nm, where there is color */ };
    const double width = (double)(LAST - FIRST) / (teeth * light_count);
    for (int i = 0; i < N; i++) {
        const int here = (int)floor((i - FIRST) / width);
        light[i] = here >= 0 && here < teeth * light_count && here % light_count == tooth ? 1 : 0.01;
    }
    scale_light(search, light);
}

/* Every other start is a comb, with two, three and one teeth for each light, the lights in turn; the others are random. The
 * first begins lights that have an anchor there. */
static void begin_at(const mtm_search *search, int start, mtm_spectrum *spectra) {
    static const int teeth[] = {2, 3, 1};
    uint64_t seed = (uint64_t)start;
    int lights = 0;
    int tooth = start / 6;
    for (int u = 0; u < search->unknown_count; u++) lights += search->unknowns[u].is_light;
    for (int u = 0; u < search->unknown_count; u++) {
        const mtm_unknown *unknown = &search->unknowns[u];
        if (!unknown->is_light || (unknown->is_anchored && start == 0))
            memcpy(spectra[u].value, unknown->reference, sizeof spectra[u].value);
        else if (start % 2 == 0)
            comb_light(search, teeth[start / 2 % 3], tooth++ % lights, lights, spectra[u].value);
        else
            random_light(search, &seed, spectra[u].value);
    }
}

/* Half a sweep: all materials under the lights there are, or all lights on the materials. */
static mtm_status move_half(const mtm_search *search, mtm_spectrum *spectra, bool lights, double miss_give,
                            int turn, mtm_error *error) {
    bool is_moving[MTM_DESIGNED_MAX];
    double contradiction = 0; /* of these lights or materials only, so it proves nothing */
    for (int u = 0; u < search->unknown_count; u++) is_moving[u] = search->unknowns[u].is_light == lights;
    return take_step(search, spectra, is_moving, miss_give, 0, turn, &contradiction, error);
}

mtm_status mtm_search_begin(const mtm_search *search, int start, mtm_found *found, mtm_error *error) {
    enum { SWEEPS = 30 };
    static const double enough = 1e-2;
    mtm_status status = MTM_OK;
    begin_at(search, start, found->spectra);
    found->cost = INFINITY;
    found->contradiction = 0;
    for (int sweep = 0; sweep < SWEEPS && !is_convex(search) && status == MTM_OK; sweep++) {
        const double before = found->cost;
        for (int half = 0; half < 2 && status == MTM_OK; half++)
            if (has_unknown(search, half == 1))
                status = move_half(search, found->spectra, half == 1, give_of_alternation, start, error);
        found->cost = total_cost(search, found->spectra, give_of_alternation);
        if (!is_bilinear(search) || before - found->cost < enough * found->cost) break;
    }
    return status;
}

/* Goes downhill with one `give`, all unknowns together. */
static mtm_status descend(const mtm_search *search, mtm_found *found, double miss_give, mtm_spectrum *trial,
                          mtm_error *error) {
    enum { STEPS = 20, STEPS_LARGE = 6, LARGE = 8 /* unknowns, of which a step costs the cube */ };
    static const double still = 1e-3, damping_first = 0.1, damping_most = 1e4;
    const size_t bytes = (size_t)search->unknown_count * sizeof *trial;
    const int steps = search->unknown_count > LARGE ? STEPS_LARGE : STEPS;
    bool is_moving[MTM_DESIGNED_MAX];
    double damping = is_bilinear(search) ? damping_first : 0;
    mtm_status status = MTM_OK;
    for (int u = 0; u < search->unknown_count; u++) is_moving[u] = true;
    found->cost = total_cost(search, found->spectra, miss_give);
    for (int step = 0; step < steps && damping < damping_most && status == MTM_OK; step++) {
        memcpy(trial, found->spectra, bytes);
        double contradiction = 0;
        status = take_step(search, trial, is_moving, miss_give, damping, 0, &contradiction, error);
        if (status != MTM_OK) break;
        const double cost = total_cost(search, trial, miss_give);
        if (!(cost < found->cost)) {
            if (is_convex(search)) break;
            damping = fmax(damping_first, damping * 5);
            continue;
        }
        const bool is_still = found->cost - cost < still * cost;
        memcpy(found->spectra, trial, bytes);
        found->cost = cost;
        found->contradiction = is_convex(search) ? contradiction : 0;
        damping /= 2;
        if (is_still) break;
    }
    return status;
}

/* Meets the goals as closely as can be: half a sweep at a time is exact, so nothing has to be damped. */
static mtm_status polish(const mtm_search *search, mtm_found *found, mtm_spectrum *trial, mtm_error *error) {
    enum { SWEEPS = 4 };
    const size_t bytes = (size_t)search->unknown_count * sizeof *trial;
    mtm_status status = MTM_OK;
    found->cost = total_cost(search, found->spectra, give);
    for (int half = 0; half < 2 * SWEEPS && status == MTM_OK; half++) {
        memcpy(trial, found->spectra, bytes);
        status = move_half(search, trial, half % 2 == 1, give, 0, error);
        const double cost = total_cost(search, trial, give);
        if (status != MTM_OK || !(cost < found->cost)) continue;
        memcpy(found->spectra, trial, bytes);
        found->cost = cost;
    }
    return status;
}

mtm_status mtm_search_finish(const mtm_search *search, mtm_found *found, bool is_thorough, mtm_error *error) {
    mtm_spectrum *trial = mtm_allocate((size_t)search->unknown_count, sizeof *trial);
    if (trial == NULL) return mtm_fail_memory(error, "a design", sizeof *trial);
    mtm_status status = MTM_OK;
    if (is_thorough && !is_convex(search)) status = descend(search, found, give_of_alternation, trial, error);
    if (status == MTM_OK)
        status = is_bilinear(search) ? polish(search, found, trial, error)
                                     : descend(search, found, give, trial, error);
    free(trial);
    return status;
}
