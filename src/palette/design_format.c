/* SPDX-License-Identifier: BSD-3-Clause
 * The report of a design as JSON; docs/files.md has the keys. */
#include <string.h>

#include "base/json.h"
#include "metamer/palette.h"

static const char *const honesty_names[] = {
    [MTM_HONESTY_GIVEN] = "given",           [MTM_HONESTY_MEASURED] = "measured",
    [MTM_HONESTY_PHYSICAL] = "physical",     [MTM_HONESTY_COEFFICIENTS] = "physical coefficients",
    [MTM_HONESTY_ARTIFICIAL] = "artificial",
};

const char *mtm_honesty_name(mtm_honesty honesty) {
    return honesty_names[honesty];
}

/* A text that may have been cut within a character. */
static json_t *text_to_json(const char *text) {
    return json_stringn(text, mtm_json_prefix(text, strlen(text)));
}

static json_t *numbers(double a, double b, double c) {
    return json_pack("[f, f, f]", a, b, c);
}

static json_t *color_to_json(mtm_xyz xyz) {
    char text[8];
    const mtm_lab lab = mtm_lab_from_xyz(xyz, mtm_white_d65());
    mtm_rgb_format(mtm_rgb_from_xyz(xyz), text);
    return json_pack("{s:s, s:o, s:o}", "srgb", text, "lab", numbers(lab.l, lab.a, lab.b), "xyz",
                     numbers(xyz.x, xyz.y, xyz.z));
}

static json_t *cell_to_json(const mtm_palette *palette, mtm_cell cell) {
    return json_pack("{s:s, s:s}", "material", palette->materials[cell.material].name, "light",
                     palette->lights[cell.light].name);
}

/* The wish itself: a color, the cell it is to be like, or what it is to differ from. */
static json_t *asked_to_json(const mtm_palette *palette, const mtm_goal_result *result) {
    const mtm_goal *goal = &result->goal;
    json_t *asked = color_to_json(result->asked);
    if (goal->kind == MTM_GOAL_COLOR) return asked;
    json_t *other = goal->other.material < 0 ? json_string("black") : cell_to_json(palette, goal->other);
    (void)json_object_set_new(asked, goal->kind == MTM_GOAL_SAME ? "same_as" : "differs_from", other);
    if (goal->kind == MTM_GOAL_DIFFERENT) (void)json_object_set_new(asked, "by", json_real(goal->least));
    return asked;
}

static json_t *result_to_json(const mtm_palette *palette, const mtm_goal_result *result) {
    json_t *object = cell_to_json(palette, result->goal.cell);
    (void)json_object_set_new(object, "asked", asked_to_json(palette, result));
    (void)json_object_set_new(object, "achieved", color_to_json(result->achieved));
    (void)json_object_set_new(object, "achieved_basis", color_to_json(result->achieved_basis));
    (void)json_object_set_new(object, "ciede2000", json_real(result->ciede2000));
    (void)json_object_set_new(object, "ciede2000_basis", json_real(result->ciede2000_basis));
    (void)json_object_set_new(object, "difference", json_real(result->difference));
    (void)json_object_set_new(object, "difference_basis", json_real(result->difference_basis));
    (void)json_object_set_new(object, "met", json_boolean(result->is_met));
    (void)json_object_set_new(object, "met_basis", json_boolean(result->is_met_basis));
    return object;
}

static json_t *problem_to_json(const mtm_design *design, const mtm_design_problem *problem) {
    const mtm_goal_result *result = &design->results[problem->goal];
    json_t *object = cell_to_json(&design->palette, result->goal.cell);
    json_t *blockers = json_array();
    for (int i = 0; i < problem->blocker_count; i++) {
        json_t *blocker = cell_to_json(&design->palette, design->results[problem->blockers[i]].goal.cell);
        (void)json_object_set_new(blocker, "cell", json_integer(problem->blockers[i]));
        (void)json_array_append_new(blockers, blocker);
    }
    (void)json_object_set_new(object, "cell", json_integer(problem->goal));
    (void)json_object_set_new(object, "ciede2000", json_real(result->ciede2000));
    (void)json_object_set_new(object, "ciede2000_basis", json_real(result->ciede2000_basis));
    (void)json_object_set_new(object, "basis_only", json_boolean(problem->is_basis_only));
    (void)json_object_set_new(object, "proven", json_boolean(problem->is_proven));
    (void)json_object_set_new(object, "blocked_by", blockers);
    (void)json_object_set_new(object, "reason", text_to_json(problem->reason));
    return object;
}

static json_t *spectra_to_json(const mtm_design *design, bool is_light) {
    json_t *array = json_array();
    const int count = is_light ? design->palette.light_count : design->palette.material_count;
    for (int i = 0; i < count; i++) {
        json_t *object =
            json_pack("{s:s, s:s}", "name",
                      is_light ? design->palette.lights[i].name : design->palette.materials[i].name,
                      "honesty", mtm_honesty_name(is_light ? design->lights[i] : design->materials[i]));
        if (!is_light && design->material_origins[i][0] != '\0')
            (void)json_object_set_new(object, "origin", text_to_json(design->material_origins[i]));
        (void)json_array_append_new(array, object);
    }
    return array;
}

char *mtm_design_format(const mtm_design *design, double seconds) {
    json_t *cells = json_array();
    json_t *infeasible = json_array();
    for (int i = 0; i < design->result_count; i++)
        (void)json_array_append_new(cells, result_to_json(&design->palette, &design->results[i]));
    for (int i = 0; i < design->problem_count; i++)
        (void)json_array_append_new(infeasible, problem_to_json(design, &design->problems[i]));
    json_t *object =
        json_pack("{s:s, s:f, s:o, s:o, s:o, s:o, s:f, s:i, s:f}", "basis", design->basis, "tolerance",
                  design->tolerance, "materials", spectra_to_json(design, false), "lights",
                  spectra_to_json(design, true), "cells", cells, "infeasible", infeasible, "objective",
                  design->objective, "starts", design->start_count, "seconds", seconds);
    char *text = object == NULL ? NULL : mtm_json_format(object, true);
    json_decref(object);
    return text;
}
