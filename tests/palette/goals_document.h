/* SPDX-License-Identifier: BSD-3-Clause
 * Goals documents for tests: reading them, and what their goals are to be. */
#ifndef METAMER_TEST_GOALS_DOCUMENT_H
#define METAMER_TEST_GOALS_DOCUMENT_H

#include "fixture.h"
#include "palette/goals.h"

static inline mtm_goals *goals_parse(const char *text) {
    mtm_error error;
    mtm_goals *goals = NULL;
    assert_ok(mtm_goals_parse("test.json", text, METAMER_SOURCE_DIR "/data/spectra", &goals, &error), error);
    return goals;
}

/* The whole message but the document's name, so that key and value are where they belong. */
static inline void goals_assert_refused(const char *text, const char *message) {
    mtm_error error = {""};
    mtm_goals *goals = NULL;
    const mtm_status status =
        mtm_goals_parse("test.json", text, METAMER_SOURCE_DIR "/data/spectra", &goals, &error);
    if (status != MTM_FORMAT) fail_msg("status %d, '%s' for %s", status, error.message, text);
    if (strncmp(error.message, "test.json: ", 11) != 0 || strcmp(error.message + 11, message) != 0)
        fail_msg("'%s' instead of '%s' for %s", error.message, message, text);
    assert_null(goals);
}

typedef struct goals_refusal {
    const char *text, *message;
} goals_refusal;

/* A goal as tests write it: cells by index, a color as "#rrggbb". */
typedef struct expected_goal {
    mtm_goal_kind kind;
    mtm_cell cell, other;
    const char *color;
    double least;
} expected_goal;

#define COLOR(material, light, color)                                                                        \
    { MTM_GOAL_COLOR, {material, light}, {0, 0}, color, 0 }
#define BLACK(material, light) COLOR(material, light, "#000000")
#define SAME(material, light, as_material, as_light)                                                         \
    { MTM_GOAL_SAME, {material, light}, {as_material, as_light}, NULL, 0 }
#define DIFFERENT(material, light, from_material, from_light, least)                                         \
    { MTM_GOAL_DIFFERENT, {material, light}, {from_material, from_light}, NULL, least }
#define VISIBLE(material, light, least) DIFFERENT(material, light, -1, -1, least)

static inline void assert_cell(mtm_cell cell, mtm_cell expected, int goal) {
    if (cell.material != expected.material || cell.light != expected.light)
        fail_msg("goal %d has cell (%d, %d), not (%d, %d)", goal, cell.material, cell.light,
                 expected.material, expected.light);
}

static inline void assert_goal(const mtm_goal *goal, const expected_goal *expected, double weight,
                               int index) {
    if (goal->kind != expected->kind)
        fail_msg("goal %d is of kind %d, not %d", index, goal->kind, expected->kind);
    assert_cell(goal->cell, expected->cell, index);
    assert_near(goal->weight, weight, 0);
    if (goal->kind == MTM_GOAL_COLOR) {
        mtm_rgb rgb;
        assert_ok(mtm_rgb_parse(expected->color, &rgb, NULL), (mtm_error){"no color"});
        const mtm_xyz xyz = mtm_xyz_from_rgb(rgb);
        assert_near(goal->color.x, xyz.x, 1e-15);
        assert_near(goal->color.y, xyz.y, 1e-15);
        assert_near(goal->color.z, xyz.z, 1e-15);
    } else {
        assert_cell(goal->other, expected->other, index);
        assert_near(goal->least, expected->least, 0);
    }
}

static inline void assert_goals(const mtm_goals *goals, int count, const expected_goal *expected,
                                double weight) {
    assert_int_equal(goals->goal_count, count);
    for (int i = 0; i < count; i++) assert_goal(&goals->goals[i], &expected[i], weight, i);
}

/* The document's goals are exactly the `expected` array. */
#define ASSERT_GOALS(text, weight, ...)                                                                      \
    do {                                                                                                     \
        static const expected_goal expected_goals[] = {__VA_ARGS__};                                         \
        mtm_goals *parsed_goals = goals_parse(text);                                                         \
        assert_goals(parsed_goals, sizeof expected_goals / sizeof *expected_goals, expected_goals, weight);  \
        mtm_goals_destroy(parsed_goals);                                                                     \
    } while (0)

#endif
