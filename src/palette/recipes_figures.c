/* SPDX-License-Identifier: BSD-3-Clause
 * Recipes for the pictures of S. Bergner, T. Möller, M. Tory, M. S. Drew, "A Practical Approach to Spectral Volume
 * Rendering", IEEE TVCG 11(2), 2005, figures 2, 5, 6 and 7, each a table of goals. */
#include "palette/recipes.h"

#define COLOR(material, light)                                                                               \
    {                                                                                                        \
        MTM_FIGURE_COLOR, {material, light}, {                                                               \
            0, 0                                                                                             \
        }                                                                                                    \
    }
#define BLACK(material, light)                                                                               \
    {                                                                                                        \
        MTM_FIGURE_BLACK, {material, light}, {                                                               \
            0, 0                                                                                             \
        }                                                                                                    \
    }
#define SAME(material, light, as_material, as_light)                                                         \
    {                                                                                                        \
        MTM_FIGURE_SAME, {material, light}, {                                                                \
            as_material, as_light                                                                            \
        }                                                                                                    \
    }

/* The engine: block and inner parts look alike under light 1, light 2 tells them apart, and the smoke round them shows
 * under light 3 alone. */
const mtm_figure mtm_figure_2 = {
    .materials = {"smoke", "block", "inner"},
    .colors = {"#8a70c0", "#6f9f6a", "#d08040"},
    .lights = {"light 1", "light 2", "light 3"},
    .step_count = 7,
    .steps = {COLOR(1, 0), SAME(2, 0, 1, 0), SAME(1, 1, 1, 0), COLOR(2, 1), BLACK(0, 0), BLACK(0, 1),
              COLOR(0, 2)},
};

/* The protein: a white cloud that light 2 takes away, round cores that keep their color. */
const mtm_figure mtm_figure_5 = {
    .materials = {"cloud", "core"},
    .colors = {"#d8d8d8", "#e07a2f"},
    .lights = {"light 1", "light 2"},
    .step_count = 4,
    .steps = {COLOR(0, 0), BLACK(0, 1), COLOR(1, 0), SAME(1, 1, 1, 0)},
};

/* The head: each light shows one material. */
const mtm_figure mtm_figure_6 = {
    .materials = {"skin", "brain", "fat"},
    .colors = {"#c98f6b", "#b9b2c4", "#e6d9a8"},
    .lights = {"skin light", "brain light", "fat light"},
    .step_count = 9,
    .steps = {COLOR(0, 0), BLACK(1, 0), BLACK(2, 0), BLACK(0, 1), COLOR(1, 1), BLACK(2, 1), BLACK(0, 2),
              BLACK(1, 2), COLOR(2, 2)},
};

/* The tomato: one red fruit under light 1; under light 2 the gel parts from the flesh. */
const mtm_figure mtm_figure_7 = {
    .materials = {"flesh", "gel"},
    .colors = {"#b8584a", "#a8964c"},
    .lights = {"light 1", "light 2"},
    .step_count = 4,
    .steps = {COLOR(0, 0), SAME(1, 0, 0, 0), SAME(0, 1, 0, 0), COLOR(1, 1)},
};

static int count_of(const char *const *names) {
    int count = 0;
    while (names[count] != NULL) count++;
    return count;
}

/* The figure's own names, which a document with a list of its own may lack. */
static void take_usual(const mtm_recipe_row *row, mtm_spectrum_kind kind, const char *key,
                       const char *const *usual, mtm_recipe_list *list) {
    const bool is_light = kind == MTM_KIND_LIGHT;
    list->count = 0;
    for (int i = 0; usual[i] != NULL; i++) {
        const int found = mtm_goals_find(row->reader, kind, usual[i]);
        if (found < 0)
            mtm_json_fail(row->reader->json, key,
                          "is missing, and \"%s\", the recipe's own, is no %s of the palette", usual[i],
                          is_light ? "light" : "material");
        else
            list->index[list->count++] = found;
    }
}

static void read_names(const mtm_recipe_row *row, mtm_spectrum_kind kind, const char *key,
                       const char *const *usual, mtm_recipe_list *list) {
    if (json_object_get(row->object, key) == NULL) {
        take_usual(row, kind, key, usual, list);
        return;
    }
    mtm_recipe_names(row, kind, key, 1, list);
    if (list->count != count_of(usual))
        mtm_json_fail(row->reader->json, key, "has %d name%s, this recipe needs %d", list->count,
                      list->count == 1 ? "" : "s", count_of(usual));
}

/* "colors": by the figure's own names, whatever the palette calls its materials. */
static void read_colors(const mtm_recipe_row *row, const mtm_figure *figure,
                        mtm_xyz colors[MTM_FIGURE_NAMES_MAX]) {
    mtm_json_reader *json = row->reader->json;
    const size_t count = (size_t)count_of(figure->materials);
    const json_t *object = json_object_get(row->object, "colors");
    for (size_t i = 0; i < count; i++) {
        json_t *usual = json_string(figure->colors[i]);
        (void)mtm_goals_read_color(row->reader, NULL, usual, &colors[i]);
        json_decref(usual);
    }
    if (object == NULL) return;
    const size_t place = mtm_json_enter(json, "colors");
    (void)mtm_json_expect_object(json, object, figure->materials, count);
    for (size_t i = 0; i < count; i++) {
        const json_t *color = json_object_get(object, figure->materials[i]);
        if (color != NULL) (void)mtm_goals_read_color(row->reader, figure->materials[i], color, &colors[i]);
    }
    mtm_json_leave(json, place);
}

void mtm_figure_read(const mtm_recipe_row *row, const mtm_figure *figure) {
    mtm_recipe_list materials;
    mtm_recipe_list lights;
    mtm_xyz colors[MTM_FIGURE_NAMES_MAX];
    read_names(row, MTM_KIND_REFLECTANCE, "materials", figure->materials, &materials);
    read_names(row, MTM_KIND_LIGHT, "lights", figure->lights, &lights);
    read_colors(row, figure, colors);
    if (row->reader->json->status != MTM_OK) return;
    for (int i = 0; i < figure->step_count; i++) {
        const mtm_figure_step *step = &figure->steps[i];
        const mtm_cell cell = {materials.index[step->cell.material], lights.index[step->cell.light]};
        const mtm_cell other = {materials.index[step->other.material], lights.index[step->other.light]};
        if (step->aim == MTM_FIGURE_COLOR)
            mtm_recipe_color(row, cell.material, cell.light, colors[step->cell.material]);
        else if (step->aim == MTM_FIGURE_BLACK)
            mtm_recipe_black(row, cell.material, cell.light);
        else
            mtm_recipe_same(row, cell, other);
    }
}
