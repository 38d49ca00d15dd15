/* SPDX-License-Identifier: BSD-3-Clause
 * Writing a scene as a document that stands alone: every value stated, so that later defaults do not change it. */
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/json.h"
#include "palette/json.h"
#include "scene/scene.h"

static json_t *numbers(int count, const double *values) {
    json_t *array = json_array();
    for (int i = 0; i < count; i++) (void)json_array_append_new(array, json_real(values[i]));
    return array;
}

static void set(json_t *object, const char *key, json_t *value) {
    (void)json_object_set_new(object, key, value);
}

static json_t *format_volume(const mtm_scene *scene) {
    json_t *volume = json_object();
    if (scene->volume_file != NULL) set(volume, "file", json_string(mtm_path_name(scene->volume_file)));
    if (scene->volume_size[0] > 0)
        set(volume, "size",
            json_pack("[i, i, i]", scene->volume_size[0], scene->volume_size[1], scene->volume_size[2]));
    if (scene->volume_sha256[0] != '\0') set(volume, "sha256", json_string(scene->volume_sha256));
    return volume;
}

static json_t *format_transfer(const mtm_scene *scene) {
    json_t *transfer = json_object();
    json_t *points = json_array();
    if (scene->opacity_length > 0) set(transfer, "opacity_length", json_real(scene->opacity_length));
    for (int i = 0; i < scene->point_count; i++) {
        const mtm_transfer_point *point = &scene->points[i];
        json_t *object = json_object();
        set(object, "value", json_real(point->value));
        set(object, "opacity", json_real(point->opacity));
        if (point->has_emission) set(object, "emission", json_real(point->emission));
        set(object, "material", json_string(scene->palette.materials[point->material].name));
        (void)json_array_append_new(points, object);
    }
    set(transfer, "points", points);
    return transfer;
}

static json_t *format_camera(const mtm_camera *camera) {
    json_t *object = json_object();
    set(object, "azimuth", json_real(camera->azimuth));
    set(object, "elevation", json_real(camera->elevation));
    if (camera->distance > 0) set(object, "distance", json_real(camera->distance));
    if (camera->has_target) set(object, "target", numbers(3, camera->target));
    set(object, "up", numbers(3, camera->up));
    set(object, "fov", json_real(camera->fov));
    if (camera->height > 0) set(object, "height", json_real(camera->height));
    return object;
}

static json_t *format_shading(const mtm_shading *shading) {
    json_t *object = json_object();
    set(object, "ambient", json_real(shading->ambient));
    set(object, "diffuse", json_real(shading->diffuse));
    set(object, "specular", json_real(shading->specular));
    set(object, "shininess", json_real(shading->shininess));
    set(object, "direction",
        shading->is_headlight ? json_string("headlight") : numbers(3, shading->direction));
    set(object, "gradient_threshold", json_real(shading->gradient_threshold));
    return object;
}

static json_t *format_background(const mtm_scene *scene) {
    if (scene->background == MTM_BACKGROUND_COLOR) return json_pack("{s:s}", "srgb", scene->background_srgb);
    if (scene->background == MTM_BACKGROUND_MATERIAL)
        return json_pack("{s:s}", "material", scene->palette.materials[scene->background_material].name);
    return scene->background == MTM_BACKGROUND_NONE ? json_string("none") : json_null();
}

static json_t *format_render(const mtm_scene *scene) {
    json_t *object = json_object();
    set(object, "renderer", json_string(scene->renderer));
    set(object, "basis", json_string(scene->basis));
    set(object, "size", json_pack("[i, i]", scene->render.width, scene->render.height));
    set(object, "step", json_real(scene->render.step));
    set(object, "blend", json_string(mtm_blend_names[scene->render.blend]));
    set(object, "jitter", json_boolean(scene->render.jitter));
    set(object, "termination", json_real(scene->render.termination));
    return object;
}

static bool is_same_curve(const mtm_spectrum *a, const mtm_spectrum *b) {
    return memcmp(a, b, sizeof *a) == 0;
}

/* Whether the name alone leads to these curves; a file may have a known name and others. */
static bool is_known_observer(const mtm_observer *observer) {
    mtm_observer known;
    return mtm_observer_get(observer->name, &known, NULL) == MTM_OK && !observer->is_camera &&
           is_same_curve(&known.x, &observer->x) && is_same_curve(&known.y, &observer->y) &&
           is_same_curve(&known.z, &observer->z);
}

static json_t *format_observer(const mtm_observer *observer) {
    if (is_known_observer(observer)) return json_string(observer->name);
    json_t *object = json_pack("{s:s}", "name", observer->name);
    set(object, observer->is_camera ? "r" : "x", numbers(MTM_SPECTRUM_SAMPLES, observer->x.value));
    set(object, observer->is_camera ? "g" : "y", numbers(MTM_SPECTRUM_SAMPLES, observer->y.value));
    set(object, observer->is_camera ? "b" : "z", numbers(MTM_SPECTRUM_SAMPLES, observer->z.value));
    return object;
}

/* Adds weights, intensity and dial to an object. */
static void format_mix(const mtm_scene *scene, const mtm_light_mix *mix, json_t *object) {
    const mtm_palette *palette = &scene->palette;
    json_t *weights = json_object();
    for (int i = 0; i < palette->light_count; i++)
        set(weights, palette->lights[i].name, json_real(mix->weights[i]));
    set(object, "weights", weights);
    set(object, "intensity", json_real(mix->intensity));
    if (!mix->has_dot && mix->bulb_count == 0) return;
    json_t *dial = json_object();
    json_t *bulbs = json_object();
    if (mix->has_dot) set(dial, "dot", numbers(2, mix->dot));
    for (int i = 0; i < mix->bulb_count; i++)
        set(bulbs, palette->lights[mix->bulbs[i].light].name,
            json_pack("{s:o, s:b}", "at", numbers(2, mix->bulbs[i].at), "on", (int)mix->bulbs[i].is_on));
    set(dial, "bulbs", bulbs);
    set(object, "dial", dial);
}

static json_t *format_lights(const mtm_scene *scene) {
    json_t *lights = json_object();
    json_t *stops = json_array();
    format_mix(scene, &scene->lights, lights);
    for (int i = 0; i < scene->stop_count; i++) {
        json_t *stop = json_pack("{s:s}", "name", scene->stops[i].name);
        format_mix(scene, &scene->stops[i].mix, stop);
        (void)json_array_append_new(stops, stop);
    }
    set(lights, "stops", stops);
    return lights;
}

char *mtm_scene_format(const mtm_scene *scene) {
    json_t *document = json_object();
    json_t *clip = json_array();
    set(document, "metamer", json_integer(1));
    set(document, "volume", format_volume(scene));
    set(document, "palette", mtm_palette_to_json(&scene->palette));
    set(document, "transfer", format_transfer(scene));
    set(document, "camera", format_camera(&scene->camera));
    set(document, "shading", format_shading(&scene->render.shading));
    (void)json_array_append_new(clip, numbers(3, scene->render.clip_low));
    (void)json_array_append_new(clip, numbers(3, scene->render.clip_high));
    set(document, "clip", json_pack("{s:o}", "box", clip));
    set(document, "background", format_background(scene));
    set(document, "render", format_render(scene));
    set(document, "observer", format_observer(&scene->observer));
    set(document, "white", json_string(scene->is_white_adapted ? "light" : "none"));
    set(document, "lights", format_lights(scene));
    char *text = mtm_json_format(document, true);
    json_decref(document);
    return text;
}
