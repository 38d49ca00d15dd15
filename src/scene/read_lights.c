/* SPDX-License-Identifier: BSD-3-Clause
 * Reading the lights of a scene document: weights, intensity, the dial's layout, stops. */
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "scene/read.h"

enum { STOPS_MAX = 4096 };

/* Index of the light a key of `weights` or `bulbs` names, or -1 after a failure. */
static int find_light(mtm_scene_reader *reader, const char *name) {
    const int light = mtm_palette_find_light(&reader->scene->palette, name);
    if (light < 0)
        mtm_json_fail(reader->json, name, "is no light of the palette; the nearest is \"%s\"",
                      mtm_palette_nearest_light(&reader->scene->palette, name));
    return light;
}

static void read_weights(mtm_scene_reader *reader, const json_t *object, mtm_light_mix *mix) {
    mtm_json_reader *json = reader->json;
    const json_t *weights = json->status == MTM_OK ? json_object_get(object, "weights") : NULL;
    const char *name = NULL;
    json_t *weight = NULL;
    if (weights == NULL) return;
    const size_t place = mtm_json_enter(json, "weights");
    if (!json_is_object(weights)) mtm_json_fail(json, NULL, "must be an object of light names and weights");
    for (int i = 0; i < reader->scene->palette.light_count; i++) mix->weights[i] = 0;
    json_object_foreach((json_t *)weights, name, weight) {
        const int light = json->status == MTM_OK ? find_light(reader, name) : -1;
        if (light >= 0) (void)mtm_json_number(json, weights, name, mtm_json_amount, &mix->weights[light]);
    }
    mtm_json_leave(json, place);
}

static void read_bulbs(mtm_scene_reader *reader, const json_t *dial, mtm_light_mix *mix) {
    static const char *const keys[] = {"at", "on"};
    mtm_json_reader *json = reader->json;
    const json_t *bulbs = json->status == MTM_OK ? json_object_get(dial, "bulbs") : NULL;
    const char *name = NULL;
    json_t *object = NULL;
    if (bulbs == NULL) return;
    const size_t place = mtm_json_enter(json, "bulbs");
    if (!json_is_object(bulbs)) mtm_json_fail(json, NULL, "must be an object of light names and bulbs");
    json_object_foreach((json_t *)bulbs, name, object) {
        mtm_bulb bulb = {.light = json->status == MTM_OK ? find_light(reader, name) : -1, .is_on = true};
        if (bulb.light < 0) break;
        const size_t element = mtm_json_enter(json, name);
        if (mtm_json_expect_object(json, object, KEYS(keys)) &&
            mtm_json_required(json, object, "at") != NULL) {
            (void)mtm_json_numbers(json, object, "at", 2, mtm_json_any, bulb.at);
            (void)mtm_json_boolean(json, object, "on", &bulb.is_on);
            mix->bulbs[mix->bulb_count++] = bulb;
        }
        mtm_json_leave(json, element);
    }
    mtm_json_leave(json, place);
}

/* The keys that the scene's lights and every stop have in common. */
static void read_mix(mtm_scene_reader *reader, const json_t *object, mtm_light_mix *mix) {
    static const char *const dial_keys[] = {"dot", "bulbs"};
    mtm_json_reader *json = reader->json;
    size_t place = 0;
    read_weights(reader, object, mix);
    (void)mtm_json_number(json, object, "intensity", mtm_json_amount, &mix->intensity);
    const json_t *dial = mtm_scene_enter_object(json, object, "dial", KEYS(dial_keys), &place);
    if (dial != NULL) {
        mix->has_dot = mtm_json_numbers(json, dial, "dot", 2, mtm_json_any, mix->dot);
        read_bulbs(reader, dial, mix);
    }
    mtm_json_leave(json, place);
}

static void read_stop(mtm_scene_reader *reader, const json_t *object, mtm_stop *stop) {
    static const char *const keys[] = {"name", "weights", "intensity", "dial"};
    mtm_json_reader *json = reader->json;
    const char *name = NULL;
    if (!mtm_json_expect_object(json, object, KEYS(keys))) return;
    if (mtm_json_required(json, object, "name") == NULL || mtm_json_required(json, object, "weights") == NULL)
        return;
    if (!mtm_json_text(json, object, "name", &name)) return;
    if (strlen(name) > MTM_NAME_MAX)
        mtm_json_fail(json, "name", "has %zu bytes, at most %d are allowed", strlen(name), MTM_NAME_MAX);
    for (const mtm_stop *other = reader->scene->stops; other < stop; other++)
        if (strcmp(other->name, name) == 0)
            mtm_json_fail(json, "name", "\"%s\" is an earlier stop's, too", name);
    (void)snprintf(stop->name, sizeof stop->name, "%s", name);
    read_mix(reader, object, &stop->mix);
}

static void read_stops(mtm_scene_reader *reader, const json_t *lights) {
    mtm_json_reader *json = reader->json;
    mtm_scene *scene = reader->scene;
    const json_t *stops = json->status == MTM_OK ? json_object_get(lights, "stops") : NULL;
    if (stops == NULL) return;
    const size_t count = json_array_size(stops);
    if (!json_is_array(stops) || count > STOPS_MAX) {
        mtm_json_fail(json, "stops", "must be an array of at most %d stops", STOPS_MAX);
        return;
    }
    scene->stops = mtm_allocate(count, sizeof *scene->stops);
    if (scene->stops == NULL)
        json->status = mtm_fail_memory(json->error, "the stops", count * sizeof *scene->stops);
    const size_t place = mtm_json_enter(json, "stops");
    for (size_t i = 0; i < count && json->status == MTM_OK; i++) {
        const size_t element = mtm_json_enter_index(json, i);
        json->status = mtm_light_mix_create(scene->palette.light_count, &scene->stops[i].mix, json->error);
        scene->stop_count = (int)i + (json->status == MTM_OK);
        if (json->status == MTM_OK) read_stop(reader, json_array_get(stops, i), &scene->stops[i]);
        mtm_json_leave(json, element);
    }
    mtm_json_leave(json, place);
}

void mtm_scene_read_lights(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"weights", "intensity", "dial", "stops"};
    mtm_json_reader *json = reader->json;
    mtm_scene *scene = reader->scene;
    size_t place = 0;
    if (json->status != MTM_OK) return;
    json->status = mtm_light_mix_create(scene->palette.light_count, &scene->lights, json->error);
    const json_t *object = mtm_scene_enter_object(json, document, "lights", KEYS(keys), &place);
    if (object != NULL) {
        read_mix(reader, object, &scene->lights);
        read_stops(reader, object);
    }
    mtm_json_leave(json, place);
}
