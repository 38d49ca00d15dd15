/* SPDX-License-Identifier: BSD-3-Clause
 * Reading goals documents: the document, its materials and its lights. docs/design.md is the specification. */
#include "palette/goals_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "metamer/basis.h"
#include "palette/json.h"

const mtm_json_range mtm_goals_factor = {0.001, 1000};
const mtm_json_range mtm_goals_difference = {0.001, 100};

int mtm_goals_find(const mtm_goals_reader *reader, mtm_spectrum_kind kind, const char *name) {
    const mtm_palette *palette = &reader->goals->palette;
    return kind == MTM_KIND_LIGHT ? mtm_palette_find_light(palette, name)
                                  : mtm_palette_find_material(palette, name);
}

int mtm_goals_need(mtm_goals_reader *reader, mtm_spectrum_kind kind, const char *key, const char *name) {
    const mtm_palette *palette = &reader->goals->palette;
    const int found = mtm_goals_find(reader, kind, name);
    if (found >= 0) return found;
    if (kind == MTM_KIND_LIGHT)
        mtm_json_fail_name(reader->json, key, name, "light", mtm_palette_nearest_light(palette, name));
    else
        mtm_json_fail_name(reader->json, key, name, "material", mtm_palette_nearest_material(palette, name));
    return -1;
}

bool mtm_goals_read_color(mtm_goals_reader *reader, const char *key, const json_t *value, mtm_xyz *color) {
    mtm_rgb rgb;
    mtm_error reason;
    char preview[64];
    if (reader->json->status != MTM_OK) return false;
    if (!json_is_string(value)) {
        mtm_json_fail(reader->json, key, "is %s, must be a color, \"#rrggbb\"",
                      mtm_json_preview(value, preview));
        return false;
    }
    if (mtm_rgb_parse(json_string_value(value), &rgb, &reason) != MTM_OK) {
        mtm_json_fail(reader->json, key, "is no color: %s", reason.message);
        return false;
    }
    *color = mtm_xyz_from_rgb(rgb);
    return true;
}

void mtm_goals_add(mtm_goals_reader *reader, const mtm_goal *goal) {
    mtm_goals *goals = reader->goals;
    int alike = 0; /* earlier goals that fix the color of the same cell */
    if (reader->json->status != MTM_OK) return;
    for (int g = 0; g < goals->goal_count && goal->kind != MTM_GOAL_DIFFERENT; g++)
        alike += goals->goals[g].kind != MTM_GOAL_DIFFERENT &&
                 goals->goals[g].cell.material == goal->cell.material &&
                 goals->goals[g].cell.light == goal->cell.light;
    if (alike == MTM_WISHES_MAX)
        mtm_json_fail(reader->json, NULL, "fixes the color of a cell that %d goals fix already",
                      MTM_WISHES_MAX);
    else if (goals->goal_count == MTM_GOALS_MAX)
        mtm_json_fail(reader->json, NULL, "makes more goals than the %d that a document may have",
                      MTM_GOALS_MAX);
    else
        goals->goals[goals->goal_count++] = *goal;
}

/* A spectrum of zeros in the palette, and how it is to come about. */
static void add_designed(mtm_goals_reader *reader, mtm_spectrum_kind kind, const char *name,
                         const mtm_spectrum_wish *wish) {
    mtm_goals *goals = reader->goals;
    mtm_material material = {0};
    mtm_light light = {0};
    if (reader->json->status != MTM_OK) return;
    if (reader->designed_count == MTM_DESIGNED_MAX) {
        mtm_json_fail(reader->json, NULL, "makes one designed spectrum more than the %d that are allowed",
                      MTM_DESIGNED_MAX);
        return;
    }
    (void)snprintf(material.name, sizeof material.name, "%s", name);
    (void)snprintf(light.name, sizeof light.name, "%s", name);
    if (kind == MTM_KIND_LIGHT)
        mtm_palette_add_light(reader->json, &light, &goals->palette);
    else
        mtm_palette_add_material(reader->json, &material, &goals->palette);
    if (reader->json->status != MTM_OK) return;
    if (kind == MTM_KIND_LIGHT)
        goals->lights[goals->palette.light_count - 1] = *wish;
    else
        goals->materials[goals->palette.material_count - 1] = *wish;
    reader->designed_count++;
}

void mtm_goals_bring(mtm_goals_reader *reader, mtm_spectrum_kind kind, const char *key, const char *name) {
    const mtm_spectrum_wish wish = {
        .is_designed = true, .is_physical = true, .smoothness = reader->smoothness};
    char checked[MTM_NAME_MAX + 1] = "";
    mtm_palette_check_name(reader->json, key, name, checked);
    add_designed(reader, kind, checked, &wish);
}

/* "near": the spectrum that a designed one is drawn to. */
static void read_anchor(mtm_goals_reader *reader, const json_t *object, mtm_spectrum_kind kind,
                        mtm_spectrum_wish *wish) {
    static const char *const keys[] = {"pull",     "spectrum", "illuminant", "blackbody",
                                       "daylight", "srgb",     "values"};
    mtm_json_reader *json = reader->json;
    const json_t *near = json->status == MTM_OK ? json_object_get(object, "near") : NULL;
    if (near == NULL) return;
    const size_t place = mtm_json_enter(json, "near");
    if (mtm_json_expect_object(json, near, KEYS(keys))) {
        wish->pull = 1;
        (void)mtm_json_number(json, near, "pull", mtm_goals_factor, &wish->pull);
        mtm_palette_read_source(json, near, reader->goals->folder, kind, &wish->anchor);
    }
    mtm_json_leave(json, place);
}

static void read_designed(mtm_goals_reader *reader, const json_t *object, mtm_spectrum_kind kind) {
    static const char *const names[] = {"physical", "artificial"};
    mtm_json_reader *json = reader->json;
    mtm_spectrum_wish wish = {.is_designed = true, .smoothness = reader->smoothness};
    char name[MTM_NAME_MAX + 1] = "";
    int choice = 0;
    const char *source = mtm_palette_source_of(object);
    if (source != NULL)
        mtm_json_fail(json, source,
                      "stands beside \"design\"; a spectrum is given or designed, and \"near\" says what a "
                      "designed one is to be like");
    if (json_object_get(object, "through") != NULL)
        mtm_json_fail(json, "through", "is for lights that are given, this one is designed");
    mtm_palette_read_name(json, object, name);
    if (mtm_json_choice(json, object, "design", KEYS(names), &choice)) wish.is_physical = choice == 0;
    (void)mtm_json_number(json, object, "smoothness", mtm_goals_factor, &wish.smoothness);
    read_anchor(reader, object, kind, &wish);
    add_designed(reader, kind, name, &wish);
}

/* A designed filter has no spectrum yet that a light could pass. */
static void check_filters(mtm_goals_reader *reader, const json_t *object) {
    const json_t *filters = json_object_get(object, "through");
    for (size_t i = 0; i < json_array_size(filters); i++) {
        const char *name = json_string_value(json_array_get(filters, i));
        const int material = name == NULL ? -1 : mtm_goals_find(reader, MTM_KIND_REFLECTANCE, name);
        if (material >= 0 && reader->goals->materials[material].is_designed)
            mtm_json_fail(reader->json, "through", "holds \"%s\", which is designed; filters must be given",
                          name);
    }
}

static void read_given(mtm_goals_reader *reader, const json_t *object, mtm_spectrum_kind kind) {
    static const char *const designed_keys[] = {"smoothness", "near"};
    mtm_json_reader *json = reader->json;
    mtm_goals *goals = reader->goals;
    if (mtm_palette_source_of(object) == NULL)
        mtm_json_fail(json, NULL,
                      "has no spectrum: \"design\", or one of \"spectrum\", \"illuminant\", \"blackbody\", "
                      "\"daylight\", \"srgb\", \"values\" is needed");
    for (int i = 0; i < 2; i++)
        if (json_object_get(object, designed_keys[i]) != NULL)
            mtm_json_fail(json, designed_keys[i], "is for spectra with \"design\", this one is given");
    check_filters(reader, object);
    if (json->status != MTM_OK) return;
    if (kind == MTM_KIND_LIGHT)
        mtm_palette_read_light(json, object, goals->folder, &goals->palette);
    else
        mtm_palette_read_material(json, object, goals->folder, &goals->palette);
}

static void read_material(mtm_json_reader *json, const json_t *object, void *context) {
    static const char *const keys[] = {"name", "design", "smoothness", "near",      "spectrum",
                                       "srgb", "values", "illuminant", "blackbody", "daylight"};
    if (!mtm_json_expect_object(json, object, KEYS(keys))) return;
    (json_object_get(object, "design") == NULL ? read_given : read_designed)(context, object,
                                                                             MTM_KIND_REFLECTANCE);
}

static void read_light(mtm_json_reader *json, const json_t *object, void *context) {
    static const char *const keys[] = {"name",     "design",     "smoothness", "near",
                                       "spectrum", "illuminant", "blackbody",  "daylight",
                                       "srgb",     "values",     "through"};
    if (!mtm_json_expect_object(json, object, KEYS(keys))) return;
    (json_object_get(object, "design") == NULL ? read_given : read_designed)(context, object, MTM_KIND_LIGHT);
}

/* Bases whose coefficients are those of one light, or that a later change of the palette would exchange. */
static const char *reason_against(const char *basis) {
    if (strcmp(basis, "rgb") == 0)
        return "holds colors under one light and cannot be relit, so that there is no cell to design";
    if (strcmp(basis, "auto") == 0)
        return "depends on how many materials there are; name the one that the picture will have";
    return NULL;
}

static void read_basis(mtm_goals_reader *reader, const json_t *document) {
    const char *name = "factors:7";
    mtm_basis *basis = NULL;
    mtm_error reason;
    (void)mtm_json_text(reader->json, document, "basis", &name);
    if (reason_against(name) != NULL)
        mtm_json_fail(reader->json, "basis", "\"%s\" %s", name, reason_against(name));
    if (reader->json->status != MTM_OK) return;
    const mtm_status status = mtm_basis_create(name, 0, NULL, NULL, &basis, &reason);
    if (status == MTM_OK) {
        (void)snprintf(reader->goals->basis, sizeof reader->goals->basis, "%s", mtm_basis_name(basis));
    } else {
        mtm_json_fail(reader->json, "basis", "is not usable: %s", reason.message);
        if (status != MTM_ARGUMENT) reader->json->status = status; /* a bad name is a fault of the document */
    }
    mtm_basis_destroy(basis);
}

static void bring_row(mtm_json_reader *json, const json_t *row, void *context) {
    (void)json;
    if (json_object_get(row, "recipe") != NULL) mtm_recipe_bring(context, row);
}

static void read_row(mtm_json_reader *json, const json_t *row, void *context) {
    (void)json;
    if (json_object_get(row, "recipe") != NULL)
        mtm_recipe_read(context, row);
    else
        mtm_goals_read_cell(context, row);
}

static void read_goals(mtm_goals_reader *reader, const json_t *document) {
    mtm_json_reader *json = reader->json;
    if (mtm_json_required(json, document, "goals") == NULL) return;
    mtm_json_each(json, document, "goals", MTM_GOALS_MAX, bring_row, reader);
    mtm_json_each(json, document, "goals", MTM_GOALS_MAX, read_row, reader);
    if (reader->designed_count == 0)
        mtm_json_fail(json, NULL, "designs nothing: no material and no light has the key \"design\"");
    if (reader->goals->goal_count == 0)
        mtm_json_fail(json, "goals", "asks for nothing: at least one goal is needed");
}

static void read_document(mtm_goals_reader *reader, const json_t *document) {
    static const char *const keys[] = {"metamer",   "basis",  "tolerance", "smoothness",
                                       "materials", "lights", "goals"};
    mtm_json_reader *json = reader->json;
    if (!mtm_json_expect_object(json, document, KEYS(keys))) return;
    if (!mtm_palette_reserve(json, &reader->goals->palette)) return;
    mtm_json_expect_version(json, document);
    read_basis(reader, document);
    (void)mtm_json_number(json, document, "tolerance", mtm_goals_difference, &reader->goals->tolerance);
    (void)mtm_json_number(json, document, "smoothness", mtm_goals_factor, &reader->smoothness);
    reader->lists_materials = json_object_get(document, "materials") != NULL;
    reader->lists_lights = json_object_get(document, "lights") != NULL;
    mtm_json_each(json, document, "materials", MTM_MATERIALS_MAX, read_material, reader);
    mtm_json_each(json, document, "lights", MTM_LIGHTS_MAX, read_light, reader);
    read_goals(reader, document);
}

static mtm_status create(const char *folder, mtm_goals **goals, mtm_error *error) {
    mtm_goals *made = mtm_allocate(1, sizeof *made);
    if (made != NULL) {
        *made = (mtm_goals){.tolerance = 1,
                            .folder = folder == NULL ? NULL : mtm_text_copy(folder),
                            .materials = mtm_allocate(MTM_MATERIALS_MAX, sizeof *made->materials),
                            .lights = mtm_allocate(MTM_LIGHTS_MAX, sizeof *made->lights),
                            .goals = mtm_allocate(MTM_GOALS_MAX, sizeof *made->goals)};
        if ((folder == NULL || made->folder != NULL) && made->materials != NULL && made->lights != NULL &&
            made->goals != NULL) {
            *goals = made;
            return MTM_OK;
        }
    }
    mtm_goals_destroy(made);
    return mtm_fail_memory(error, "the goals", sizeof *made + MTM_LIGHTS_MAX * sizeof *made->lights);
}

void mtm_goals_destroy(mtm_goals *goals) {
    if (goals == NULL) return;
    for (int i = 0; i < goals->search_count; i++)
        for (int k = 0; k < goals->searches[i].table_count; k++) free(goals->searches[i].tables[k]);
    free(goals->searches);
    free(goals->goals);
    free(goals->lights);
    free(goals->materials);
    mtm_palette_free(&goals->palette);
    free(goals->folder);
    free(goals);
}

mtm_status mtm_goals_parse(const char *document, const char *text, const char *folder, mtm_goals **goals,
                           mtm_error *error) {
    json_t *object = NULL;
    mtm_goals *made = NULL;
    mtm_status status = mtm_json_parse(document, text, strlen(text), &object, error);
    if (status == MTM_OK) status = create(folder, &made, error);
    if (status == MTM_OK) {
        mtm_json_reader json = mtm_json_begin(document, error);
        mtm_goals_reader reader = {.json = &json, .goals = made, .smoothness = 1};
        read_document(&reader, object);
        status = json.status;
    }
    json_decref(object);
    if (status != MTM_OK) {
        mtm_goals_destroy(made);
        return status;
    }
    *goals = made;
    return MTM_OK;
}

mtm_status mtm_goals_read(const char *path, mtm_goals **goals, mtm_error *error) {
    char *text = NULL;
    mtm_status status = mtm_json_read_text(path, &text, error);
    if (status != MTM_OK) return status;
    char *folder = mtm_path_folder(path);
    status = folder == NULL ? mtm_fail_memory(error, path, strlen(path))
                            : mtm_goals_parse(path, text, folder, goals, error);
    free(folder);
    free(text);
    return status;
}
