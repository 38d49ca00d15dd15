/* SPDX-License-Identifier: BSD-3-Clause
 * Goals for one cell: every way to say what it is to look like is a row of one table. */
#include <math.h>
#include <string.h>

#include "palette/goals_read.h"

static const char *const cell_keys[] = {"material", "light"};

/* The cell that the keys name; where one is left out it stays what it was. */
static void read_cell(mtm_goals_reader *reader, const json_t *object, mtm_cell *cell) {
    const char *name = NULL;
    if (mtm_json_text(reader->json, object, "material", &name))
        cell->material = mtm_goals_need(reader, MTM_KIND_REFLECTANCE, "material", name);
    if (mtm_json_text(reader->json, object, "light", &name))
        cell->light = mtm_goals_need(reader, MTM_KIND_LIGHT, "light", name);
}

static void from_srgb(mtm_goals_reader *reader, const json_t *row, mtm_goal *goal) {
    (void)mtm_goals_read_color(reader, "srgb", json_object_get(row, "srgb"), &goal->color);
}

static void from_lab(mtm_goals_reader *reader, const json_t *row, mtm_goal *goal) {
    static const mtm_json_range component = {-200, 200};
    double lab[3];
    if (!mtm_json_numbers(reader->json, row, "lab", 3, component, lab)) return;
    goal->color = mtm_xyz_from_lab((mtm_lab){lab[0], lab[1], lab[2]}, mtm_white_d65());
    if (lab[0] < 0 || lab[0] > 100)
        mtm_json_fail(reader->json, "lab", "has a lightness of %g, must be 0 to 100", lab[0]);
    else if (goal->color.x < 0 || goal->color.z < 0)
        mtm_json_fail(reader->json, "lab",
                      "is [%g, %g, %g], more colorful than any light: its X is %.3g, its Z %.3g", lab[0],
                      lab[1], lab[2], goal->color.x, goal->color.z);
}

static void from_xyz(mtm_goals_reader *reader, const json_t *row, mtm_goal *goal) {
    static const double largest = 2; /* twice white: no picture shows more */
    double xyz[3];
    if (!mtm_json_numbers(reader->json, row, "xyz", 3, mtm_json_not_negative, xyz)) return;
    for (int i = 0; i < 3; i++)
        if (xyz[i] > largest)
            mtm_json_fail(reader->json, "xyz",
                          "has %g; white has Y = 1 here, values to 100 must be divided by 100", xyz[i]);
    goal->color = (mtm_xyz){xyz[0], xyz[1], xyz[2]};
}

static void from_black(mtm_goals_reader *reader, const json_t *row, mtm_goal *goal) {
    bool is_black = true;
    if (mtm_json_boolean(reader->json, row, "black", &is_black) && !is_black)
        mtm_json_fail(reader->json, "black",
                      "is false; \"differs_from\": \"black\" asks for what is not black");
    goal->color = (mtm_xyz){0, 0, 0};
}

/* The other cell of a goal, in a key whose own material and light are the row's. */
static void read_other(mtm_goals_reader *reader, const json_t *row, const char *key, mtm_goal *goal) {
    mtm_json_reader *json = reader->json;
    const size_t place = mtm_json_enter(json, key);
    const json_t *object = json_object_get(row, key);
    goal->other = goal->cell;
    if (mtm_json_expect_object(json, object, KEYS(cell_keys))) {
        read_cell(reader, object, &goal->other);
        if (goal->other.material == goal->cell.material && goal->other.light == goal->cell.light)
            mtm_json_fail(json, NULL, "is the cell itself; it must name another material or light");
    }
    mtm_json_leave(json, place);
}

static void from_same(mtm_goals_reader *reader, const json_t *row, mtm_goal *goal) {
    goal->kind = MTM_GOAL_SAME;
    read_other(reader, row, "same_as", goal);
}

static void from_different(mtm_goals_reader *reader, const json_t *row, mtm_goal *goal) {
    const json_t *other = json_object_get(row, "differs_from");
    goal->kind = MTM_GOAL_DIFFERENT;
    if (json_is_object(other))
        read_other(reader, row, "differs_from", goal);
    else if (json_is_string(other) && strcmp(json_string_value(other), "black") == 0)
        goal->other = (mtm_cell){-1, -1};
    else {
        char preview[64];
        mtm_json_fail(reader->json, "differs_from",
                      "is %s, must be \"black\" or an object with a material or a light",
                      mtm_json_preview(other, preview));
    }
    if (mtm_json_required(reader->json, row, "by") != NULL)
        (void)mtm_json_number(reader->json, row, "by", mtm_goals_difference, &goal->least);
}

static const struct {
    const char *key;
    void (*read)(mtm_goals_reader *reader, const json_t *row, mtm_goal *goal);
} aims[] = {
    {"srgb", from_srgb},   {"lab", from_lab},      {"xyz", from_xyz},
    {"black", from_black}, {"same_as", from_same}, {"differs_from", from_different},
};
enum { AIM_COUNT = sizeof aims / sizeof *aims };

/* The one key that says what the cell is to look like, or -1 after a failure. */
static int find_aim(mtm_json_reader *json, const json_t *row) {
    int found = -1;
    for (int i = 0; i < AIM_COUNT; i++) {
        if (json_object_get(row, aims[i].key) == NULL) continue;
        if (found >= 0) {
            mtm_json_fail(json, aims[i].key, "stands beside \"%s\"; a row has exactly one goal",
                          aims[found].key);
            return -1;
        }
        found = i;
    }
    if (found < 0)
        mtm_json_fail(json, NULL,
                      "has no goal: one of \"srgb\", \"lab\", \"xyz\", \"black\", \"same_as\", "
                      "\"differs_from\" is needed");
    return found;
}

void mtm_goals_read_cell(mtm_goals_reader *reader, const json_t *row) {
    static const char *const keys[] = {"material", "light",        "srgb", "lab",    "xyz",   "black",
                                       "same_as",  "differs_from", "by",   "weight", "recipe"};
    mtm_json_reader *json = reader->json;
    mtm_goal goal = {.kind = MTM_GOAL_COLOR, .weight = 1};
    if (!mtm_json_expect_object(json, row, KEYS(keys))) return;
    if (mtm_json_required(json, row, "material") == NULL || mtm_json_required(json, row, "light") == NULL)
        return;
    read_cell(reader, row, &goal.cell);
    const int aim = json->status == MTM_OK ? find_aim(json, row) : -1;
    if (aim < 0) return;
    aims[aim].read(reader, row, &goal);
    if (goal.kind != MTM_GOAL_DIFFERENT && json_object_get(row, "by") != NULL)
        mtm_json_fail(json, "by", "is for \"differs_from\", this row has \"%s\"", aims[aim].key);
    (void)mtm_json_number(json, row, "weight", mtm_goals_factor, &goal.weight);
    mtm_goals_add(reader, &goal);
}
