/* SPDX-License-Identifier: BSD-3-Clause
 * Reading scene documents, version 1: one function per object of the document. docs/scene.md is the specification. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/json.h"
#include "base/memory.h"
#include "palette/json.h"
#include "scene/read.h"

enum { POINTS_MAX = 4096 };

const json_t *mtm_scene_enter_object(mtm_json_reader *json, const json_t *parent, const char *key,
                                     const char *const *keys, size_t key_count, size_t *place) {
    const json_t *object = json->status == MTM_OK ? json_object_get(parent, key) : NULL;
    *place = json->path_length;
    if (object == NULL) return NULL;
    *place = mtm_json_enter(json, key);
    return mtm_json_expect_object(json, object, keys, key_count) ? object : NULL;
}

static void copy_text(mtm_json_reader *json, const char *text, char **copy) {
    *copy = mtm_text_copy(text);
    if (*copy == NULL) json->status = mtm_fail_memory(json->error, "the scene", strlen(text));
}

static void read_volume(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"file", "size", "sha256"};
    mtm_json_reader *json = reader->json;
    const char *file = NULL;
    const char *hash = NULL;
    size_t place = 0;
    if (mtm_json_required(json, document, "volume") == NULL) return;
    const json_t *object = mtm_scene_enter_object(json, document, "volume", KEYS(keys), &place);
    if (object != NULL && mtm_json_required(json, object, "file") != NULL &&
        mtm_json_text(json, object, "file", &file))
        copy_text(json, file, &reader->scene->volume_file);
    if (object != NULL)
        (void)mtm_json_integers(json, object, "size", 3, 1, INT_MAX, reader->scene->volume_size);
    if (object != NULL && mtm_json_text(json, object, "sha256", &hash)) {
        if (strlen(hash) != 64 || strspn(hash, "0123456789abcdef") != 64)
            mtm_json_fail(json, "sha256", "is \"%.70s\", must be 64 lower-case hexadecimal digits", hash);
        else
            (void)snprintf(reader->scene->volume_sha256, sizeof reader->scene->volume_sha256, "%s", hash);
    }
    mtm_json_leave(json, place);
}

static void read_palette_file(mtm_scene_reader *reader, const char *file) {
    mtm_error reason;
    if (reader->is_embedded) {
        mtm_json_fail(reader->json, "file", "names a file, but an embedded document stands alone");
        return;
    }
    char *path = mtm_path_join(reader->scene->folder, file);
    if (path == NULL) {
        reader->json->status = mtm_fail_memory(reader->json->error, "the scene", strlen(file));
        return;
    }
    const mtm_status status = mtm_palette_read(path, &reader->scene->palette, &reason);
    if (status != MTM_OK) {
        mtm_json_fail(reader->json, "file", "is not usable: %s", reason.message);
        reader->json->status = status;
    }
    free(path);
}

static void read_palette(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"file", "materials", "lights"};
    mtm_json_reader *json = reader->json;
    const char *file = NULL;
    size_t place = 0;
    const json_t *object = mtm_scene_enter_object(json, document, "palette", KEYS(keys), &place);
    if (object != NULL && json_object_get(object, "file") == NULL)
        mtm_palette_from_json(json, object, reader->is_embedded ? NULL : reader->scene->folder,
                              &reader->scene->palette);
    else if (object != NULL && json_object_size(object) > 1)
        mtm_json_fail(json, "file",
                      "stands beside inline materials or lights; a palette is one or the other");
    else if (object != NULL && mtm_json_text(json, object, "file", &file))
        read_palette_file(reader, file);
    else if (object == NULL && json->status == MTM_OK)
        json->status = mtm_palette_defaults(&reader->scene->palette, json->error);
    mtm_json_leave(json, place);
    if (json->status == MTM_OK && reader->scene->palette.light_count == 0)
        mtm_json_fail(json, "palette", "has no lights; at least one is needed");
}

/* Index of the material a key names, or -1 after a failure. */
static int read_material(mtm_scene_reader *reader, const json_t *object, const char *key) {
    const char *name = NULL;
    if (mtm_json_required(reader->json, object, key) == NULL) return -1;
    if (!mtm_json_text(reader->json, object, key, &name)) return -1;
    const int material = mtm_palette_find_material(&reader->scene->palette, name);
    if (material < 0)
        mtm_json_fail_name(reader->json, key, name, "material",
                           mtm_palette_nearest_material(&reader->scene->palette, name));
    return material;
}

/* Any voxel type's values; differences stay finite. */
static const mtm_json_range value_range = {-1e300, 1e300};

static void read_point(mtm_scene_reader *reader, const json_t *object, mtm_transfer_point *point) {
    static const char *const keys[] = {"value", "opacity", "emission", "material"};
    mtm_json_reader *json = reader->json;
    if (!mtm_json_expect_object(json, object, KEYS(keys))) return;
    if (mtm_json_required(json, object, "value") == NULL ||
        mtm_json_required(json, object, "opacity") == NULL)
        return;
    (void)mtm_json_number(json, object, "value", value_range, &point->value);
    (void)mtm_json_number(json, object, "opacity", mtm_json_unit, &point->opacity);
    point->has_emission = mtm_json_number(json, object, "emission", mtm_json_amount, &point->emission);
    point->material = read_material(reader, object, "material");
}

static void read_points(mtm_scene_reader *reader, const json_t *transfer) {
    mtm_json_reader *json = reader->json;
    mtm_scene *scene = reader->scene;
    const json_t *points = mtm_json_required(json, transfer, "points");
    if (points == NULL) return;
    const size_t count = json_array_size(points);
    if (!json_is_array(points) || count < 1 || count > POINTS_MAX) {
        mtm_json_fail(json, "points", "has %zu points, must be an array of 1 to %d", count, POINTS_MAX);
        return;
    }
    scene->points = mtm_allocate(count, sizeof *scene->points);
    if (scene->points == NULL) {
        json->status = mtm_fail_memory(json->error, "the scene", count * sizeof *scene->points);
        return;
    }
    scene->point_count = (int)count;
    const size_t place = mtm_json_enter(json, "points");
    for (size_t i = 0; i < count && json->status == MTM_OK; i++) {
        const size_t element = mtm_json_enter_index(json, i);
        read_point(reader, json_array_get(points, i), &scene->points[i]);
        if (json->status == MTM_OK && i > 0 && scene->points[i].value < scene->points[i - 1].value)
            mtm_json_fail(json, "value", "is %g, below the point before it (%g); points rise in value",
                          scene->points[i].value, scene->points[i - 1].value);
        mtm_json_leave(json, element);
    }
    mtm_json_leave(json, place);
}

/* Lengths and places in world units, far from where their squares leave what numbers hold. */
static const mtm_json_range length_range = {1e-30, 1e30};
static const mtm_json_range place_range = {-1e30, 1e30};

static void read_transfer(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"opacity_length", "points"};
    mtm_json_reader *json = reader->json;
    size_t place = 0;
    if (mtm_json_required(json, document, "transfer") == NULL) return;
    const json_t *object = mtm_scene_enter_object(json, document, "transfer", KEYS(keys), &place);
    if (object != NULL) {
        (void)mtm_json_number(json, object, "opacity_length", length_range, &reader->scene->opacity_length);
        read_points(reader, object);
    }
    mtm_json_leave(json, place);
}

/* Three numbers, not all zero. */
static bool read_direction(mtm_json_reader *json, const json_t *object, const char *key,
                           double direction[3]) {
    double read[3];
    if (!mtm_json_numbers(json, object, key, 3, mtm_json_any, read)) return false;
    const double length = sqrt(read[0] * read[0] + read[1] * read[1] + read[2] * read[2]);
    if (!(length > 0) || !isfinite(length)) {
        mtm_json_fail(json, key, "is [%g, %g, %g], which points nowhere", read[0], read[1], read[2]);
        return false;
    }
    memcpy(direction, read, sizeof read);
    return true;
}

static void read_camera(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"azimuth", "elevation", "distance", "target", "up", "fov", "height"};
    mtm_json_reader *json = reader->json;
    mtm_camera *camera = &reader->scene->camera;
    size_t place = 0;
    const json_t *object = mtm_scene_enter_object(json, document, "camera", KEYS(keys), &place);
    if (object != NULL) {
        (void)mtm_json_number(json, object, "azimuth", mtm_json_any, &camera->azimuth);
        (void)mtm_json_number(json, object, "elevation", mtm_json_any, &camera->elevation);
        (void)mtm_json_number(json, object, "distance", length_range, &camera->distance);
        camera->has_target = mtm_json_numbers(json, object, "target", 3, place_range, camera->target);
        (void)read_direction(json, object, "up", camera->up);
        (void)mtm_json_number(json, object, "fov", (mtm_json_range){0, 175}, &camera->fov);
        (void)mtm_json_number(json, object, "height", (mtm_json_range){0, 1e30}, &camera->height);
    }
    mtm_json_leave(json, place);
}

static void read_shading(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"ambient",   "diffuse",   "specular",
                                       "shininess", "direction", "gradient_threshold"};
    mtm_json_reader *json = reader->json;
    mtm_shading *shading = &reader->scene->render.shading;
    size_t place = 0;
    const json_t *object = mtm_scene_enter_object(json, document, "shading", KEYS(keys), &place);
    if (object != NULL) {
        (void)mtm_json_number(json, object, "ambient", mtm_json_amount, &shading->ambient);
        (void)mtm_json_number(json, object, "diffuse", mtm_json_amount, &shading->diffuse);
        (void)mtm_json_number(json, object, "specular", mtm_json_amount, &shading->specular);
        (void)mtm_json_number(json, object, "shininess", mtm_json_amount, &shading->shininess);
        (void)mtm_json_number(json, object, "gradient_threshold", mtm_json_not_negative,
                              &shading->gradient_threshold);
        static const char *const names[] = {"headlight"};
        int choice = 0;
        if (json_is_array(json_object_get(object, "direction")))
            shading->is_headlight = !read_direction(json, object, "direction", shading->direction);
        else
            (void)mtm_json_choice(json, object, "direction", KEYS(names), &choice);
    }
    mtm_json_leave(json, place);
}

static void read_clip(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"box"};
    mtm_json_reader *json = reader->json;
    mtm_render_options *render = &reader->scene->render;
    size_t place = 0;
    const json_t *object = mtm_scene_enter_object(json, document, "clip", KEYS(keys), &place);
    const json_t *box = object == NULL ? NULL : mtm_json_required(json, object, "box");
    if (box != NULL && (!json_is_array(box) || json_array_size(box) != 2)) {
        mtm_json_fail(json, "box", "must be two corners, [[x,y,z],[x,y,z]]");
    } else if (box != NULL) {
        /* The reader's functions take keys, so the corners are given some. */
        json_t *corners =
            json_pack("{s:O, s:O}", "box[0]", json_array_get(box, 0), "box[1]", json_array_get(box, 1));
        (void)mtm_json_numbers(json, corners, "box[0]", 3, mtm_json_unit, render->clip_low);
        (void)mtm_json_numbers(json, corners, "box[1]", 3, mtm_json_unit, render->clip_high);
        json_decref(corners);
        for (int axis = 0; axis < 3; axis++)
            if (json->status == MTM_OK && !(render->clip_low[axis] < render->clip_high[axis]))
                mtm_json_fail(json, "box",
                              "has a first corner that is not below the second along axis %d (%g, %g)", axis,
                              render->clip_low[axis], render->clip_high[axis]);
    }
    mtm_json_leave(json, place);
}

static void read_background(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"srgb", "material"};
    mtm_json_reader *json = reader->json;
    mtm_scene *scene = reader->scene;
    const char *color = NULL;
    mtm_rgb parsed;
    mtm_error reason;
    size_t place = 0;
    const json_t *background = json_object_get(document, "background");
    if (json_is_null(background)) return;
    if (json->status == MTM_OK && json_is_string(background) &&
        strcmp(json_string_value(background), "none") == 0) {
        scene->background = MTM_BACKGROUND_NONE;
        return;
    }
    const json_t *object = mtm_scene_enter_object(json, document, "background", KEYS(keys), &place);
    if (object != NULL && json_object_size(object) != 1) {
        mtm_json_fail(json, NULL, "must have either \"srgb\" or \"material\"");
    } else if (object != NULL && mtm_json_text(json, object, "srgb", &color)) {
        scene->background = MTM_BACKGROUND_COLOR;
        if (mtm_rgb_parse(color, &parsed, &reason) != MTM_OK)
            mtm_json_fail(json, "srgb", "is no color: %s", reason.message);
        (void)snprintf(scene->background_srgb, sizeof scene->background_srgb, "%s", color);
    } else if (object != NULL && json->status == MTM_OK) {
        scene->background = MTM_BACKGROUND_MATERIAL;
        scene->background_material = read_material(reader, object, "material");
    }
    mtm_json_leave(json, place);
}

static bool is_renderer_known(const char *name) {
    for (int i = 0; mtm_renderer_name(i) != NULL; i++)
        if (strcmp(name, mtm_renderer_name(i)) == 0) return true;
    return false;
}

static void read_names(mtm_json_reader *json, const json_t *object, mtm_scene *scene) {
    const char *renderer = NULL;
    const char *basis = NULL;
    if (mtm_json_text(json, object, "renderer", &renderer)) {
        if (!is_renderer_known(renderer))
            mtm_json_fail(json, "renderer", "is \"%.64s\", known is \"%s\"", renderer, mtm_renderer_name(0));
        (void)snprintf(scene->renderer, sizeof scene->renderer, "%s", renderer);
    }
    if (!mtm_json_text(json, object, "basis", &basis)) return;
    mtm_error reason;
    mtm_basis *probe = NULL;
    const mtm_illumination dark = {.light = mtm_spectrum_constant(0)};
    if (mtm_basis_create(basis, 0, NULL, &dark, &probe, &reason) != MTM_OK)
        mtm_json_fail(json, "basis", "is not usable: %s", reason.message);
    mtm_basis_destroy(probe);
    (void)snprintf(scene->basis, sizeof scene->basis, "%s", basis);
}

static void read_render(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"renderer", "basis", "size", "step", "blend", "jitter", "termination"};
    mtm_json_reader *json = reader->json;
    mtm_render_options *render = &reader->scene->render;
    int size[2];
    int blend = 0;
    size_t place = 0;
    const json_t *object = mtm_scene_enter_object(json, document, "render", KEYS(keys), &place);
    if (object != NULL) {
        read_names(json, object, reader->scene);
        if (mtm_json_integers(json, object, "size", 2, 1, MTM_IMAGE_EDGE_MAX, size)) {
            render->width = size[0];
            render->height = size[1];
        }
        (void)mtm_json_number(json, object, "step", (mtm_json_range){1e-6, 1e6}, &render->step);
        if (mtm_json_choice(json, object, "blend", mtm_blend_names, MTM_BLEND_COUNT, &blend))
            render->blend = (mtm_blend)blend;
        (void)mtm_json_boolean(json, object, "jitter", &render->jitter);
        (void)mtm_json_number(json, object, "termination", mtm_json_unit, &render->termination);
    }
    mtm_json_leave(json, place);
}

static void read_display(mtm_scene_reader *reader, const json_t *document) {
    static const char *const whites[] = {"none", "light"};
    mtm_json_reader *json = reader->json;
    int white = 0;
    mtm_scene_read_observer(reader, document);
    if (mtm_json_choice(json, document, "white", KEYS(whites), &white))
        reader->scene->is_white_adapted = white == 1;
}

/* Words that later versions of the document will use. */
static void refuse_reserved(mtm_json_reader *json, const json_t *document) {
    static const char *const reserved[] = {"labels", "channels", "animation", "positions"};
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++)
        if (json_object_get(document, reserved[i]) != NULL)
            mtm_json_fail(json, reserved[i], "is not supported yet");
}

static void read_document(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"metamer", "volume",     "palette", "transfer", "camera", "shading",
                                       "clip",    "background", "render",  "observer", "white",  "lights"};
    mtm_json_reader *json = reader->json;
    refuse_reserved(json, document);
    if (!mtm_json_expect_object(json, document, KEYS(keys))) return;
    mtm_json_expect_version(json, document);
    read_volume(reader, document);
    read_palette(reader, document);
    read_transfer(reader, document);
    read_camera(reader, document);
    read_shading(reader, document);
    read_clip(reader, document);
    read_background(reader, document);
    read_render(reader, document);
    read_display(reader, document);
    mtm_scene_read_lights(reader, document);
}

mtm_status mtm_scene_parse(const char *document, const char *text, const char *folder, mtm_scene **scene,
                           mtm_error *error) {
    json_t *object = NULL;
    mtm_scene *made = NULL;
    mtm_status status = mtm_json_parse(document, text, strlen(text), &object, error);
    if (status == MTM_OK) status = mtm_scene_create(document, folder == NULL ? "." : folder, &made, error);
    if (status == MTM_OK) {
        mtm_json_reader json = mtm_json_begin(document, error);
        read_document(&(mtm_scene_reader){&json, made, folder == NULL}, object);
        status = json.status;
    }
    json_decref(object);
    if (status != MTM_OK) {
        mtm_scene_destroy(made);
        return status;
    }
    *scene = made;
    return MTM_OK;
}

mtm_status mtm_scene_read(const char *path, mtm_scene **scene, mtm_error *error) {
    char *text = NULL;
    mtm_status status = mtm_json_read_text(path, &text, error);
    if (status != MTM_OK) return status;
    char *folder = mtm_path_folder(path);
    status = folder == NULL ? mtm_fail_memory(error, path, strlen(path))
                            : mtm_scene_parse(path, text, folder, scene, error);
    free(folder);
    free(text);
    return status;
}
