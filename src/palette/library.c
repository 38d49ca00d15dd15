/* SPDX-License-Identifier: BSD-3-Clause
 * Measured reflectances for goals: the columns of tables are tried for every material of a search, in pairs at first,
 * because what two materials have in common or not is what such goals are about, then one at a time. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "palette/design.h"

enum { N = MTM_SPECTRUM_SAMPLES };

/* Samples this far outside 0 … 1 are an error of measurement; farther ones are no reflectance. */
static const double excess = 1e-3;

/* What a table must cover: beyond its ends nothing was measured. Krinov's ends at 650 nm. */
static const double visible_from_nm = 410, visible_to_nm = 640;

typedef struct candidate {
    mtm_spectrum reflectance;
    char origin[256];
} candidate;

typedef struct library {
    const mtm_goals *goals;
    const mtm_library_search *search;
    mtm_color_view view;
    size_t candidate_count;
    candidate *candidates;
    int light_count; /* of the palette */
    mtm_lab *labs;   /* candidate_count × light_count; of given lights only */
    mtm_lab *given;  /* of the palette's materials, in the same way; of given ones only */
    int *chosen;     /* the candidate of each material of the search; -1: none yet */
} library;

static bool is_given_light(const mtm_goals *goals, int light) {
    return !goals->lights[light].is_designed;
}

/* The place of a material in the search, -1 where it is not in it. */
static int place_of(const library *lib, int material) {
    for (int i = 0; i < lib->search->material_count; i++)
        if (lib->search->materials[i] == material) return i;
    return -1;
}

/* Whether a material's color is known: it is given, or in the search. */
static bool is_known(const library *lib, mtm_cell cell) {
    return is_given_light(lib->goals, cell.light) &&
           (place_of(lib, cell.material) >= 0 || !lib->goals->materials[cell.material].is_designed);
}

/* Whether a goal can be judged and says something of the search's materials. */
static bool concerns(const library *lib, const mtm_goal *goal) {
    if (!is_known(lib, goal->cell) || (mtm_goal_has_other(goal) && !is_known(lib, goal->other))) return false;
    return place_of(lib, goal->cell.material) >= 0 ||
           (mtm_goal_has_other(goal) && place_of(lib, goal->other.material) >= 0);
}

/* --- reading --- */

static bool is_physical(const mtm_spectrum *reflectance) {
    for (int i = 0; i < N; i++)
        if (!(reflectance->value[i] >= -excess && reflectance->value[i] <= 1 + excess)) return false;
    return true;
}

static mtm_status add_table(library *lib, const char *name, const mtm_spectrum_table *table,
                            mtm_error *error) {
    const double first = table->wavelength_nm[0];
    const double last = table->wavelength_nm[table->row_count - 1];
    if (first > visible_from_nm || last < visible_to_nm)
        return mtm_fail(error, MTM_FORMAT,
                        "%s: has %g to %g nm, measured reflectances to choose from need %g to %g nm", name,
                        first, last, visible_from_nm, visible_to_nm);
    const size_t count = lib->candidate_count + (size_t)table->column_count;
    candidate *more = realloc(lib->candidates, count * sizeof *more);
    if (more == NULL) return mtm_fail_memory(error, name, count * sizeof *more);
    lib->candidates = more;
    for (int column = 0; column < table->column_count; column++) {
        candidate *c = &lib->candidates[lib->candidate_count];
        const mtm_status status = mtm_spectrum_table_column(table, name, table->names[column],
                                                            MTM_KIND_REFLECTANCE, &c->reflectance, error);
        if (status != MTM_OK) return status;
        if (!is_physical(&c->reflectance)) continue;
        for (int i = 0; i < N; i++) c->reflectance.value[i] = fmin(fmax(c->reflectance.value[i], 0), 1);
        (void)snprintf(c->origin, sizeof c->origin, "%.150s:%.100s", name, table->names[column]);
        lib->candidate_count++;
    }
    return MTM_OK;
}

static mtm_status read_tables(library *lib, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int t = 0; t < lib->search->table_count && status == MTM_OK; t++) {
        mtm_spectrum_table table;
        char *path = mtm_path_join(lib->goals->folder, lib->search->tables[t]);
        if (path == NULL)
            return mtm_fail_memory(error, lib->search->tables[t], strlen(lib->search->tables[t]));
        status = mtm_spectrum_table_read(path, &table, error);
        if (status == MTM_OK) {
            status = add_table(lib, lib->search->tables[t], &table, error);
            mtm_spectrum_table_free(&table);
        }
        free(path);
    }
    return status;
}

static mtm_lab lab_of(const library *lib, const mtm_samples light, const mtm_spectrum *reflectance) {
    mtm_color color;
    mtm_color_view_cell(&lib->view, light, reflectance->value, color);
    return mtm_lab_from_xyz(mtm_xyz_of_color(color), mtm_white_d65());
}

/* The colors of all candidates and of the given materials under the given lights. */
static mtm_status fill_labs(library *lib, mtm_error *error) {
    const mtm_palette *palette = &lib->goals->palette;
    const size_t lights = (size_t)lib->light_count;
    const size_t materials = (size_t)palette->material_count;
    lib->labs = mtm_allocate(lib->candidate_count * lights, sizeof *lib->labs);
    lib->given = mtm_allocate(materials * lights, sizeof *lib->given);
    if (lib->labs == NULL || lib->given == NULL)
        return mtm_fail_memory(error, "the colors of measured reflectances",
                               (lib->candidate_count + materials) * lights * sizeof *lib->labs);
    for (size_t light = 0; light < lights; light++) {
        mtm_samples samples;
        if (!is_given_light(lib->goals, (int)light) ||
            !mtm_samples_of_light(&palette->lights[light].emission, samples))
            continue;
        for (size_t c = 0; c < lib->candidate_count; c++)
            lib->labs[c * lights + light] = lab_of(lib, samples, &lib->candidates[c].reflectance);
        for (size_t m = 0; m < materials; m++)
            lib->given[m * lights + light] = lab_of(lib, samples, &palette->materials[m].reflectance);
    }
    return MTM_OK;
}

/* --- judging --- */

/* The color of a cell with the candidates that are chosen; false where one is not chosen yet. */
static bool lab_of_cell(const library *lib, mtm_cell cell, mtm_lab *lab) {
    const int place = place_of(lib, cell.material);
    if (place >= 0 && lib->chosen[place] < 0) return false;
    const mtm_lab *labs = place >= 0 ? lib->labs : lib->given;
    const size_t row = (size_t)(place >= 0 ? lib->chosen[place] : cell.material);
    *lab = labs[row * (size_t)lib->light_count + (size_t)cell.light];
    return true;
}

/* What a goal lacks; 0 where it cannot be judged yet. */
static double lack_of(const library *lib, const mtm_goal *goal) {
    mtm_lab own;
    mtm_lab other;
    if (!concerns(lib, goal) || !lab_of_cell(lib, goal->cell, &own)) return 0;
    if (mtm_goal_has_other(goal)) {
        if (!lab_of_cell(lib, goal->other, &other)) return 0;
    } else {
        const mtm_xyz xyz = goal->kind == MTM_GOAL_COLOR ? goal->color : (mtm_xyz){0, 0, 0};
        other = mtm_lab_from_xyz(xyz, mtm_white_d65());
    }
    return mtm_goal_lack(goal, mtm_ciede2000(own, other));
}

/* What all goals lack, squared and weighted; may end early where it is above `enough`. */
static double cost_of(const library *lib, double enough) {
    double cost = 0;
    for (int g = 0; g < lib->goals->goal_count && cost < enough; g++) {
        const double lack = lack_of(lib, &lib->goals->goals[g]);
        cost += lib->goals->goals[g].weight * lack * lack;
    }
    return cost;
}

/* Two materials are never the same sample, also where two tables or columns have it. */
static bool is_taken(const library *lib, int place, int c) {
    const mtm_spectrum *sample = &lib->candidates[c].reflectance;
    for (int i = 0; i < lib->search->material_count; i++)
        if (i != place && lib->chosen[i] >= 0 &&
            memcmp(&lib->candidates[lib->chosen[i]].reflectance, sample, sizeof *sample) == 0)
            return true;
    return false;
}

/* Gives one material the best candidate beside the others'; true where that is another one than before. */
static bool choose_one(library *lib, int place, double *cost) {
    const int before = lib->chosen[place];
    int best = before;
    double least = before >= 0 ? *cost : INFINITY;
    for (int c = 0; c < (int)lib->candidate_count; c++) {
        if (is_taken(lib, place, c)) continue;
        lib->chosen[place] = c;
        const double here = cost_of(lib, least);
        if (here >= least) continue;
        least = here;
        best = c;
    }
    lib->chosen[place] = best;
    *cost = least;
    return best != before;
}

/* The best pair for the first two. */
static void choose_pair(library *lib, double *cost) {
    int best[2] = {-1, -1};
    double least = INFINITY;
    for (int a = 0; a < (int)lib->candidate_count; a++) {
        double here = INFINITY;
        lib->chosen[0] = a;
        lib->chosen[1] = -1;
        if (cost_of(lib, least) >= least) continue; /* what the first alone lacks is enough already */
        (void)choose_one(lib, 1, &here);
        if (here >= least) continue;
        least = here;
        best[0] = a;
        best[1] = lib->chosen[1];
    }
    lib->chosen[0] = best[0];
    lib->chosen[1] = best[1];
    *cost = least;
}

static void choose_all(library *lib) {
    enum { SWEEPS = 10 };
    const int count = lib->search->material_count;
    double cost = INFINITY;
    for (int i = 0; i < count; i++) lib->chosen[i] = -1;
    if (count >= 2) choose_pair(lib, &cost);
    for (int i = count >= 2 ? 2 : 0; i < count; i++) {
        cost = INFINITY;
        (void)choose_one(lib, i, &cost);
    }
    bool has_changed = count > 2;
    for (int sweep = 0; sweep < SWEEPS && has_changed; sweep++) {
        has_changed = false;
        for (int i = 0; i < count; i++) has_changed = choose_one(lib, i, &cost) || has_changed;
    }
}

/* --- the result --- */

static bool meets_all(const library *lib) {
    for (int g = 0; g < lib->goals->goal_count; g++)
        if (lack_of(lib, &lib->goals->goals[g]) > lib->goals->tolerance) return false;
    return true;
}

static bool has_goals(const library *lib) {
    for (int g = 0; g < lib->goals->goal_count; g++)
        if (concerns(lib, &lib->goals->goals[g])) return true;
    return false;
}

static void take_chosen(const library *lib, mtm_goals *goals, bool may_measure, char (*origins)[256]) {
    const bool is_met = may_measure && meets_all(lib);
    for (int i = 0; i < lib->search->material_count; i++) {
        const int material = lib->search->materials[i];
        const candidate *c = &lib->candidates[lib->chosen[i]];
        mtm_spectrum_wish *wish = &goals->materials[material];
        if (is_met) {
            goals->palette.materials[material].reflectance = c->reflectance;
            wish->is_designed = false;
            (void)snprintf(origins[material], sizeof origins[material], "%s", c->origin);
        } else if (wish->pull == 0) {
            wish->pull = 1;
            wish->anchor = c->reflectance;
        }
    }
}

static mtm_status run_search(mtm_goals *goals, const mtm_library_search *search, bool may_measure,
                             char (*origins)[256], mtm_error *error) {
    library lib = {.goals = goals, .search = search, .light_count = goals->palette.light_count};
    lib.chosen = mtm_allocate((size_t)search->material_count, sizeof *lib.chosen);
    mtm_status status = lib.chosen == NULL ? mtm_fail_memory(error, "a search", sizeof *lib.chosen) : MTM_OK;
    if (status == MTM_OK) status = mtm_color_view_full(&lib.view, error);
    if (status == MTM_OK && has_goals(&lib)) {
        status = read_tables(&lib, error);
        if (status == MTM_OK) status = fill_labs(&lib, error);
        if (status == MTM_OK && (int)lib.candidate_count >= search->material_count) {
            choose_all(&lib);
            take_chosen(&lib, goals, may_measure, origins);
        }
    }
    mtm_color_view_free(&lib.view);
    free(lib.candidates);
    free(lib.labs);
    free(lib.given);
    free(lib.chosen);
    return status;
}

mtm_status mtm_library_find(mtm_goals *goals, bool may_measure, char (*origins)[256], mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int s = 0; s < goals->search_count && status == MTM_OK; s++)
        status = run_search(goals, &goals->searches[s], may_measure, origins, error);
    return status;
}
