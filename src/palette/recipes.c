/* SPDX-License-Identifier: BSD-3-Clause
 * Recipes: several goals in one row. Each recipe is a row of one table.
 * S. Bergner, M. S. Drew, T. Möller, "A Tool to Create Illuminant and Reflectance Spectra for Light-Driven Graphics and
 * Visualization", ACM TOG 28(1), 2009, has metamers, metameric blacks, color constancy and lights that each show one
 * material. */
#include "palette/recipes.h"

#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/nearest.h"

void mtm_recipe_color(const mtm_recipe_row *row, int material, int light, mtm_xyz color) {
    mtm_goals_add(row->reader, &(mtm_goal){.kind = MTM_GOAL_COLOR,
                                           .cell = {material, light},
                                           .color = color,
                                           .weight = row->weight});
}

void mtm_recipe_black(const mtm_recipe_row *row, int material, int light) {
    mtm_recipe_color(row, material, light, (mtm_xyz){0, 0, 0});
}

void mtm_recipe_same(const mtm_recipe_row *row, mtm_cell cell, mtm_cell other) {
    mtm_goals_add(row->reader,
                  &(mtm_goal){.kind = MTM_GOAL_SAME, .cell = cell, .other = other, .weight = row->weight});
}

void mtm_recipe_different(const mtm_recipe_row *row, mtm_cell cell, mtm_cell other, double least) {
    mtm_goals_add(
        row->reader,
        &(mtm_goal){
            .kind = MTM_GOAL_DIFFERENT, .cell = cell, .other = other, .least = least, .weight = row->weight});
}

typedef struct names_context {
    mtm_goals_reader *reader;
    mtm_spectrum_kind kind;
    mtm_recipe_list *list;
} names_context;

static void read_name(mtm_json_reader *json, const json_t *element, void *context) {
    const names_context *names = context;
    mtm_recipe_list *list = names->list;
    const char *name = json_string_value(element);
    char preview[64];
    if (name == NULL) {
        mtm_json_fail(json, NULL, "is %s, must be the name of a %s", mtm_json_preview(element, preview),
                      names->kind == MTM_KIND_LIGHT ? "light" : "material");
        return;
    }
    const int found = mtm_goals_need(names->reader, names->kind, NULL, name);
    if (found < 0) return;
    for (int i = 0; i < list->count; i++)
        if (list->index[i] == found) mtm_json_fail(json, NULL, "is \"%s\" for the second time", name);
    list->index[list->count++] = found;
}

void mtm_recipe_names(const mtm_recipe_row *row, mtm_spectrum_kind kind, const char *key, int least,
                      mtm_recipe_list *list) {
    mtm_json_reader *json = row->reader->json;
    names_context context = {row->reader, kind, list};
    list->count = 0;
    if (mtm_json_required(json, row->object, key) == NULL) return;
    mtm_json_each(json, row->object, key, MTM_LIGHTS_MAX, read_name, &context);
    if (list->count < least)
        mtm_json_fail(json, key, "has %d name%s, %d or more are needed", list->count,
                      list->count == 1 ? "" : "s", least);
}

/* A light cannot be in two lists that ask for opposites. */
static void check_disjoint(const mtm_recipe_row *row, const char *key, const mtm_recipe_list *list,
                           const char *other_key, const mtm_recipe_list *other) {
    for (int i = 0; i < list->count; i++)
        for (int k = 0; k < other->count; k++)
            if (list->index[i] == other->index[k])
                mtm_json_fail(row->reader->json, key, "names \"%s\", which \"%s\" names, too",
                              row->reader->goals->palette.lights[list->index[i]].name, other_key);
}

typedef struct colors_context {
    mtm_goals_reader *reader;
    int count;
    mtm_xyz *colors;
} colors_context;

static void read_color(mtm_json_reader *json, const json_t *element, void *context) {
    colors_context *colors = context;
    (void)json;
    if (mtm_goals_read_color(colors->reader, NULL, element, &colors->colors[colors->count])) colors->count++;
}

/* "colors": as many as the list that goes with it has names. False where the row has none. */
static bool read_colors(const mtm_recipe_row *row, const char *list_key, const mtm_recipe_list *list,
                        mtm_xyz colors[MTM_LIGHTS_MAX]) {
    mtm_json_reader *json = row->reader->json;
    colors_context context = {row->reader, 0, colors};
    const json_t *array = json_object_get(row->object, "colors");
    if (json->status != MTM_OK || array == NULL) return false;
    mtm_json_each(json, row->object, "colors", MTM_LIGHTS_MAX, read_color, &context);
    if (context.count != list->count)
        mtm_json_fail(json, "colors", "has %d, \"%s\" has %d; there must be one for each", context.count,
                      list_key, list->count);
    return json->status == MTM_OK;
}

/* "srgb", one color, or "colors"; how many there are of them: 0, 1 or as many as the list has names. */
static int read_color_or_colors(const mtm_recipe_row *row, const char *list_key, const mtm_recipe_list *list,
                                mtm_xyz colors[MTM_LIGHTS_MAX]) {
    const json_t *color = json_object_get(row->object, "srgb");
    if (color != NULL && json_object_get(row->object, "colors") != NULL)
        mtm_json_fail(row->reader->json, "colors", "stands beside \"srgb\"; only one of them can hold");
    if (color != NULL) return mtm_goals_read_color(row->reader, "srgb", color, colors) ? 1 : 0;
    return read_colors(row, list_key, list, colors) ? list->count : 0;
}

static void read_metamers(const mtm_recipe_row *row) {
    mtm_recipe_list materials;
    mtm_recipe_list under;
    mtm_recipe_list apart;
    mtm_xyz colors[MTM_LIGHTS_MAX];
    double least = 15;
    mtm_recipe_names(row, MTM_KIND_REFLECTANCE, "materials", 2, &materials);
    mtm_recipe_names(row, MTM_KIND_LIGHT, "under", 1, &under);
    mtm_recipe_names(row, MTM_KIND_LIGHT, "apart", 1, &apart);
    check_disjoint(row, "apart", &apart, "under", &under);
    (void)mtm_json_number(row->reader->json, row->object, "by", mtm_goals_difference, &least);
    const int color_count = read_color_or_colors(row, "under", &under, colors);
    for (int k = 0; k < under.count; k++) {
        const mtm_cell first = {materials.index[0], under.index[k]};
        if (k < color_count) mtm_recipe_color(row, first.material, first.light, colors[k]);
        for (int i = 1; i < materials.count; i++)
            mtm_recipe_same(row, (mtm_cell){materials.index[i], first.light}, first);
    }
    for (int k = 0; k < apart.count; k++)
        for (int i = 1; i < materials.count; i++)
            mtm_recipe_different(row, (mtm_cell){materials.index[i], apart.index[k]},
                                 (mtm_cell){materials.index[i - 1], apart.index[k]}, least);
}

static const mtm_cell black_cell = {-1, -1};

static void read_black(const mtm_recipe_row *row) {
    mtm_json_reader *json = row->reader->json;
    mtm_recipe_list materials;
    mtm_recipe_list under;
    mtm_recipe_list visible = {.count = 0};
    double least = 30;
    mtm_recipe_names(row, MTM_KIND_REFLECTANCE, "materials", 1, &materials);
    mtm_recipe_names(row, MTM_KIND_LIGHT, "under", 1, &under);
    if (json_object_get(row->object, "visible") != NULL)
        mtm_recipe_names(row, MTM_KIND_LIGHT, "visible", 1, &visible);
    check_disjoint(row, "visible", &visible, "under", &under);
    if (mtm_json_number(json, row->object, "by", mtm_goals_difference, &least) && visible.count == 0)
        mtm_json_fail(json, "by", "is for \"visible\", which this row has not");
    for (int i = 0; i < materials.count; i++) {
        for (int k = 0; k < under.count; k++) mtm_recipe_black(row, materials.index[i], under.index[k]);
        for (int k = 0; k < visible.count; k++)
            mtm_recipe_different(row, (mtm_cell){materials.index[i], visible.index[k]}, black_cell, least);
    }
}

static void read_constant(const mtm_recipe_row *row) {
    mtm_recipe_list materials;
    mtm_recipe_list under;
    mtm_xyz colors[MTM_LIGHTS_MAX];
    mtm_recipe_names(row, MTM_KIND_REFLECTANCE, "materials", 1, &materials);
    mtm_recipe_names(row, MTM_KIND_LIGHT, "under", 2, &under);
    const int color_count = read_color_or_colors(row, "materials", &materials, colors);
    for (int i = 0; i < materials.count && under.count > 0; i++) {
        const mtm_cell first = {materials.index[i], under.index[0]};
        if (color_count > 0)
            mtm_recipe_color(row, first.material, first.light, colors[color_count > 1 ? i : 0]);
        for (int k = 1; k < under.count; k++)
            mtm_recipe_same(row, (mtm_cell){first.material, under.index[k]}, first);
    }
}

static void read_one_light_per_material(const mtm_recipe_row *row) {
    mtm_json_reader *json = row->reader->json;
    mtm_recipe_list materials;
    mtm_recipe_list lights;
    mtm_xyz colors[MTM_LIGHTS_MAX];
    double least = 40;
    mtm_recipe_names(row, MTM_KIND_REFLECTANCE, "materials", 2, &materials);
    mtm_recipe_names(row, MTM_KIND_LIGHT, "lights", 2, &lights);
    if (materials.count != lights.count)
        mtm_json_fail(json, "lights", "has %d names, must have one for each of the %d materials",
                      lights.count, materials.count);
    const bool has_colors = read_colors(row, "materials", &materials, colors);
    if (mtm_json_number(json, row->object, "by", mtm_goals_difference, &least) && has_colors)
        mtm_json_fail(json, "by", "stands beside \"colors\", which say how far from black the materials are");
    if (json->status != MTM_OK) return;
    for (int k = 0; k < lights.count; k++) {
        for (int i = 0; i < materials.count; i++) {
            const mtm_cell cell = {materials.index[i], lights.index[k]};
            if (i != k)
                mtm_recipe_black(row, cell.material, cell.light);
            else if (has_colors)
                mtm_recipe_color(row, cell.material, cell.light, colors[i]);
            else
                mtm_recipe_different(row, cell, black_cell, least);
        }
    }
}

/* A table must be there and readable now, so that the search later finds what the document promised. */
static void check_table(mtm_goals_reader *reader, const char *file) {
    mtm_json_reader *json = reader->json;
    mtm_spectrum_table table;
    mtm_error reason;
    char *path = mtm_path_join(reader->goals->folder, file);
    const mtm_status status = path == NULL ? mtm_fail_memory(&reason, file, strlen(file))
                                           : mtm_spectrum_table_read(path, &table, &reason);
    free(path);
    if (status == MTM_OK) {
        mtm_spectrum_table_free(&table);
        return;
    }
    mtm_json_fail(json, NULL, "is not usable: %s", reason.message);
    json->status = status;
}

typedef struct tables_context {
    mtm_goals_reader *reader;
    mtm_library_search *search;
} tables_context;

static void read_table(mtm_json_reader *json, const json_t *element, void *context) {
    const tables_context *tables = context;
    const char *file = json_string_value(element);
    char preview[64];
    if (file == NULL || file[0] == '\0') {
        mtm_json_fail(json, NULL, "is %s, must be the name of a CSV file",
                      mtm_json_preview(element, preview));
        return;
    }
    if (tables->reader->goals->folder == NULL) {
        mtm_json_fail(json, NULL, "names a file, but an embedded document stands alone");
        return;
    }
    check_table(tables->reader, file);
    if (json->status != MTM_OK) return;
    char *copy = mtm_text_copy(file);
    if (copy == NULL)
        json->status = mtm_fail_memory(json->error, "the goals", strlen(file));
    else
        tables->search->tables[tables->search->table_count++] = copy;
}

/* A search more, with nothing in it; NULL after a failure. */
static mtm_library_search *add_search(mtm_goals_reader *reader) {
    mtm_goals *goals = reader->goals;
    const size_t count = (size_t)goals->search_count + 1;
    mtm_library_search *searches = realloc(goals->searches, count * sizeof *searches);
    if (searches == NULL) {
        reader->json->status = mtm_fail_memory(reader->json->error, "the goals", count * sizeof *searches);
        return NULL;
    }
    goals->searches = searches;
    searches[goals->search_count] = (mtm_library_search){.material_count = 0};
    return &searches[goals->search_count++];
}

static void read_from_library(const mtm_recipe_row *row) {
    mtm_goals_reader *reader = row->reader;
    mtm_recipe_list materials;
    mtm_recipe_names(row, MTM_KIND_REFLECTANCE, "materials", 1, &materials);
    for (int i = 0; i < materials.count; i++)
        if (!reader->goals->materials[materials.index[i]].is_designed)
            mtm_json_fail(reader->json, "materials", "names \"%s\", whose spectrum is given",
                          reader->goals->palette.materials[materials.index[i]].name);
    if (mtm_json_required(reader->json, row->object, "tables") == NULL) return;
    mtm_library_search *search = add_search(reader);
    if (search == NULL) return;
    search->material_count = materials.count;
    memcpy(search->materials, materials.index, (size_t)materials.count * sizeof *search->materials);
    tables_context context = {reader, search};
    mtm_json_each(reader->json, row->object, "tables", MTM_LIBRARY_TABLES_MAX, read_table, &context);
    if (search->table_count == 0)
        mtm_json_fail(reader->json, "tables", "is empty, at least one file is needed");
}

typedef struct recipe {
    const char *name;
    void (*read)(const mtm_recipe_row *row);
    const mtm_figure *figure; /* instead of `read` */
    const char *keys[9];      /* ended by NULL */
} recipe;

static const recipe recipes[] = {
    {"metamers",
     read_metamers,
     NULL,
     {"recipe", "materials", "under", "apart", "by", "srgb", "colors", "weight"}},
    {"black", read_black, NULL, {"recipe", "materials", "under", "visible", "by", "weight"}},
    {"constant", read_constant, NULL, {"recipe", "materials", "under", "srgb", "colors", "weight"}},
    {"one_light_per_material",
     read_one_light_per_material,
     NULL,
     {"recipe", "materials", "lights", "colors", "by", "weight"}},
    {"from_library", read_from_library, NULL, {"recipe", "materials", "tables"}},
    {"figure 2", NULL, &mtm_figure_2, {"recipe", "materials", "lights", "colors", "weight"}},
    {"figure 5", NULL, &mtm_figure_5, {"recipe", "materials", "lights", "colors", "weight"}},
    {"figure 6", NULL, &mtm_figure_6, {"recipe", "materials", "lights", "colors", "weight"}},
    {"figure 7", NULL, &mtm_figure_7, {"recipe", "materials", "lights", "colors", "weight"}},
};
enum { RECIPE_COUNT = sizeof recipes / sizeof *recipes };

static const recipe *find_recipe(const char *name) {
    for (int i = 0; i < RECIPE_COUNT; i++)
        if (strcmp(recipes[i].name, name) == 0) return &recipes[i];
    return NULL;
}

static void fail_recipe(mtm_json_reader *json, const char *name) {
    const char *names[RECIPE_COUNT];
    for (int i = 0; i < RECIPE_COUNT; i++) names[i] = recipes[i].name;
    mtm_json_fail(json, "recipe", "is \"%.64s\", which is no recipe; the nearest is \"%s\"", name,
                  mtm_nearest_name(name, names, RECIPE_COUNT));
}

static size_t key_count(const recipe *known) {
    size_t count = 0;
    while (known->keys[count] != NULL) count++;
    return count;
}

static void bring_name(mtm_goals_reader *reader, mtm_spectrum_kind kind, const char *name) {
    if (mtm_goals_find(reader, kind, name) < 0) mtm_goals_bring(reader, kind, NULL, name);
}

/* What is no text is left to the recipe, which says so. */
static void bring_element(mtm_json_reader *json, const json_t *element, void *context) {
    const names_context *names = context;
    (void)json;
    if (json_string_length(element) > 0) bring_name(names->reader, names->kind, json_string_value(element));
}

static void bring_list(mtm_goals_reader *reader, const json_t *row, const char *key, mtm_spectrum_kind kind,
                       const char *const *usual) {
    names_context context = {reader, kind, NULL};
    if (kind == MTM_KIND_LIGHT ? reader->lists_lights : reader->lists_materials) return;
    mtm_json_each(reader->json, row, key, MTM_LIGHTS_MAX, bring_element, &context);
    if (usual == NULL || json_object_get(row, key) != NULL) return;
    for (int i = 0; usual[i] != NULL; i++) bring_name(reader, kind, usual[i]);
}

void mtm_recipe_bring(mtm_goals_reader *reader, const json_t *row) {
    static const char *const light_lists[] = {"under", "apart", "visible"};
    const char *name = json_string_value(json_object_get(row, "recipe"));
    const recipe *known = name == NULL ? NULL : find_recipe(name);
    if (known == NULL) return; /* mtm_recipe_read says so */
    const mtm_figure *figure = known->figure;
    bring_list(reader, row, "materials", MTM_KIND_REFLECTANCE, figure == NULL ? NULL : figure->materials);
    bring_list(reader, row, "lights", MTM_KIND_LIGHT, figure == NULL ? NULL : figure->lights);
    for (int i = 0; i < 3; i++) bring_list(reader, row, light_lists[i], MTM_KIND_LIGHT, NULL);
}

void mtm_recipe_read(mtm_goals_reader *reader, const json_t *row) {
    mtm_json_reader *json = reader->json;
    mtm_recipe_row read = {reader, row, 1};
    const char *name = NULL;
    if (!mtm_json_text(json, row, "recipe", &name)) return;
    const recipe *known = find_recipe(name);
    if (known == NULL) {
        fail_recipe(json, name);
        return;
    }
    if (!mtm_json_expect_object(json, row, known->keys, key_count(known))) return;
    (void)mtm_json_number(json, row, "weight", mtm_goals_factor, &read.weight);
    if (known->figure != NULL)
        mtm_figure_read(&read, known->figure);
    else
        known->read(&read);
}
