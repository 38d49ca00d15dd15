/* SPDX-License-Identifier: BSD-3-Clause
 * What a design reports, against its palette seen as pictures are: nothing here knows the search or its matrices. */
#include "bench_design_check.h"

#include <math.h>
#include <stdio.h>

/* Everything that a color comes from. */
typedef struct onlooker {
    const char *name;
    const mtm_design *design;
    mtm_observer observer;
    mtm_basis *basis;
} onlooker;

static mtm_illumination illumination_of(const onlooker *o, int light) {
    double weights[MTM_LIGHTS_MAX] = {0};
    weights[light] = 1;
    const mtm_spectrum mixed = mtm_palette_mix(&o->design->palette, weights, 1);
    return mtm_illumination_of(&mixed, &o->observer, 0);
}

static mtm_xyz see_full(const onlooker *o, mtm_cell cell) {
    const mtm_illumination illumination = illumination_of(o, cell.light);
    return mtm_xyz_from_rgb(
        mtm_illuminate(&illumination, &o->design->palette.materials[cell.material].reflectance));
}

static mtm_status see_basis(const onlooker *o, mtm_cell cell, mtm_xyz *color, mtm_error *error) {
    double coefficients[MTM_DIMENSION_MAX];
    double matrix[3 * MTM_DIMENSION_MAX];
    const mtm_illumination illumination = illumination_of(o, cell.light);
    const mtm_spectrum *reflectance = &o->design->palette.materials[cell.material].reflectance;
    mtm_status status = mtm_basis_encode(o->basis, reflectance, coefficients, error);
    if (status == MTM_OK) status = mtm_basis_matrix(o->basis, &illumination, matrix, error);
    if (status == MTM_OK)
        *color = mtm_xyz_from_rgb(mtm_basis_color(mtm_basis_dimension(o->basis), matrix, coefficients));
    return status;
}

static double difference_of(mtm_xyz a, mtm_xyz b) {
    const mtm_xyz white = mtm_white_d65();
    return mtm_ciede2000(mtm_lab_from_xyz(a, white), mtm_lab_from_xyz(b, white));
}

/* Artificial spectra have large values of both signs, whose sums are as exact as they are large. */
static bool is_same(double reported, double seen, double tolerance) {
    return fabs(reported - seen) <= tolerance * (1 + fabs(seen));
}

static bool is_same_color(mtm_xyz reported, mtm_xyz seen) {
    static const double tolerance = 1e-9;
    return is_same(reported.x, seen.x, tolerance) && is_same(reported.y, seen.y, tolerance) &&
           is_same(reported.z, seen.z, tolerance);
}

/* CIEDE2000 near black multiplies the rounding of a color by thousands. */
static bool is_same_difference(double reported, mtm_xyz a, mtm_xyz b) {
    static const double tolerance = 1e-5;
    return is_same(reported, difference_of(a, b), tolerance);
}

static double lack_of(const mtm_goal *goal, double difference) {
    return goal->kind == MTM_GOAL_DIFFERENT ? fmax(0, goal->least - difference) : difference;
}

static bool has_other_cell(const mtm_goal *goal) {
    return goal->kind != MTM_GOAL_COLOR && goal->other.material >= 0;
}

static mtm_status fail_result(const onlooker *o, const mtm_goal_result *result, const char *what,
                              mtm_error *error) {
    const mtm_palette *palette = &o->design->palette;
    (void)snprintf(error->message, sizeof error->message,
                   "%s: the report on %s under %s is wrong by %s, nothing is reported", o->name,
                   palette->materials[result->goal.cell.material].name,
                   palette->lights[result->goal.cell.light].name, what);
    return MTM_NUMERIC;
}

/* What a goal's cell is compared with: COLOR's own color, black, or the other cell. */
static mtm_status check_result(const onlooker *o, const mtm_goal_result *result, mtm_error *error) {
    const mtm_goal *goal = &result->goal;
    const mtm_xyz full = see_full(o, goal->cell);
    mtm_xyz asked = goal->kind == MTM_GOAL_COLOR ? goal->color : (mtm_xyz){0, 0, 0};
    mtm_xyz asked_basis = asked;
    mtm_xyz basis = {0, 0, 0};
    mtm_status status = see_basis(o, goal->cell, &basis, error);
    if (status == MTM_OK && has_other_cell(goal)) {
        asked = see_full(o, goal->other);
        status = see_basis(o, goal->other, &asked_basis, error);
    }
    if (status != MTM_OK) return status;
    if (!is_same_color(result->achieved, full) || !is_same_color(result->asked, asked) ||
        !is_same_difference(result->difference, full, asked))
        return fail_result(o, result, "full spectra", error);
    if (!is_same_color(result->achieved_basis, basis) ||
        !is_same_difference(result->difference_basis, basis, asked_basis))
        return fail_result(o, result, o->design->basis, error);
    if (result->ciede2000 != lack_of(goal, result->difference) ||
        result->is_met != (result->ciede2000 <= o->design->tolerance))
        return fail_result(o, result, "what it says of being met", error);
    return MTM_OK;
}

mtm_status check_design(const char *name, const mtm_design *design, mtm_error *error) {
    onlooker o = {.name = name, .design = design};
    mtm_status status = mtm_observer_get("cie1931", &o.observer, error);
    if (status == MTM_OK) status = mtm_basis_create(design->basis, 0, NULL, NULL, &o.basis, error);
    for (int i = 0; i < design->result_count && status == MTM_OK; i++)
        status = check_result(&o, &design->results[i], error);
    mtm_basis_destroy(o.basis);
    return status;
}
