/* SPDX-License-Identifier: BSD-3-Clause
 * Fuzz target: the bytes are a goals document that stands alone, so that it opens no file. What is read keeps what a
 * solver relies on. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "palette/goals.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void demand(bool holds) {
    if (!holds) abort();
}

static bool is_cell(const mtm_goals *goals, mtm_cell cell) {
    return cell.material >= 0 && cell.material < goals->palette.material_count && cell.light >= 0 &&
           cell.light < goals->palette.light_count;
}

static void check_goal(const mtm_goals *goals, const mtm_goal *goal) {
    demand(is_cell(goals, goal->cell) && goal->weight > 0 && isfinite(goal->weight));
    if (goal->kind == MTM_GOAL_COLOR) {
        demand(goal->color.x >= 0 && goal->color.y >= 0 && goal->color.z >= 0);
        return;
    }
    const bool is_black = goal->kind == MTM_GOAL_DIFFERENT && goal->other.material == -1;
    demand(is_black || is_cell(goals, goal->other));
    demand(goal->other.material != goal->cell.material || goal->other.light != goal->cell.light);
    demand(goal->kind == MTM_GOAL_SAME || (goal->least > 0 && goal->least <= 100));
}

static int count_designed(const mtm_spectrum_wish *wishes, int count) {
    int designed = 0;
    for (int i = 0; i < count; i++) {
        if (!wishes[i].is_designed) continue;
        demand(wishes[i].smoothness > 0 && wishes[i].pull >= 0);
        designed++;
    }
    return designed;
}

static void check_goals(const mtm_goals *goals) {
    const int designed = count_designed(goals->materials, goals->palette.material_count) +
                         count_designed(goals->lights, goals->palette.light_count);
    demand(designed >= 1 && designed <= MTM_DESIGNED_MAX);
    demand(goals->goal_count >= 1 && goals->goal_count <= MTM_GOALS_MAX);
    demand(goals->folder == NULL && goals->search_count == 0 && goals->tolerance > 0);
    for (int i = 0; i < goals->goal_count; i++) check_goal(goals, &goals->goals[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    if (text == NULL) return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    mtm_error error;
    mtm_goals *goals = NULL;
    if (mtm_goals_parse("fuzz.json", text, NULL, &goals, &error) == MTM_OK) check_goals(goals);
    mtm_goals_destroy(goals);
    free(text);
    return 0;
}
