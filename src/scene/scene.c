/* SPDX-License-Identifier: BSD-3-Clause
 * Making, changing and ending scenes. */
#include "scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/json.h"
#include "base/memory.h"

const char *const mtm_blend_names[MTM_BLEND_COUNT] = {"composite", "sum", "maximum"};

mtm_status mtm_light_mix_create(int light_count, mtm_light_mix *mix, mtm_error *error) {
    *mix = (mtm_light_mix){.intensity = 1};
    mix->weights = mtm_allocate((size_t)light_count, sizeof *mix->weights);
    mix->bulbs = mtm_allocate((size_t)light_count, sizeof *mix->bulbs);
    if (mix->weights == NULL || mix->bulbs == NULL) {
        mtm_light_mix_free(mix);
        return mtm_fail_memory(error, "the lights", (size_t)light_count * sizeof *mix->bulbs);
    }
    if (light_count > 0) mix->weights[0] = 1;
    return MTM_OK;
}

mtm_status mtm_light_mix_copy(const mtm_light_mix *mix, int light_count, mtm_light_mix *copy,
                              mtm_error *error) {
    mtm_light_mix made;
    const mtm_status status = mtm_light_mix_create(light_count, &made, error);
    if (status != MTM_OK) return status;
    memcpy(made.weights, mix->weights, (size_t)light_count * sizeof *made.weights);
    memcpy(made.bulbs, mix->bulbs, (size_t)mix->bulb_count * sizeof *made.bulbs);
    made.intensity = mix->intensity;
    made.has_dot = mix->has_dot;
    memcpy(made.dot, mix->dot, sizeof made.dot);
    made.bulb_count = mix->bulb_count;
    *copy = made;
    return MTM_OK;
}

void mtm_light_mix_free(mtm_light_mix *mix) {
    free(mix->weights);
    free(mix->bulbs);
    *mix = (mtm_light_mix){0};
}

mtm_status mtm_scene_create(const char *document, const char *folder, mtm_scene **scene, mtm_error *error) {
    mtm_scene *made = mtm_allocate(1, sizeof *made);
    if (made == NULL) return mtm_fail_memory(error, "the scene", sizeof *made);
    made->document = mtm_text_copy(document);
    made->folder = mtm_text_copy(folder);
    if (made->document == NULL || made->folder == NULL) {
        mtm_scene_destroy(made);
        return mtm_fail_memory(error, "the scene", strlen(document) + strlen(folder));
    }
    made->camera = mtm_camera_defaults();
    made->render = mtm_render_defaults();
    (void)snprintf(made->renderer, sizeof made->renderer, "raycast");
    (void)snprintf(made->basis, sizeof made->basis, "auto");
    const mtm_status status = mtm_observer_get("cie1931", &made->observer, error);
    if (status != MTM_OK)
        mtm_scene_destroy(made);
    else
        *scene = made;
    return status;
}

void mtm_scene_destroy(mtm_scene *scene) {
    if (scene == NULL) return;
    for (int i = 0; i < scene->stop_count; i++) mtm_light_mix_free(&scene->stops[i].mix);
    free(scene->stops);
    mtm_light_mix_free(&scene->lights);
    free(scene->points);
    mtm_palette_free(&scene->palette);
    free(scene->volume_file);
    free(scene->folder);
    free(scene->document);
    free(scene);
}

void mtm_scene_clear_weights(mtm_scene *scene) {
    for (int i = 0; i < scene->palette.light_count; i++) scene->lights.weights[i] = 0;
}

static mtm_status fail_unknown_light(const mtm_scene *scene, const char *name, mtm_error *error) {
    if (scene->palette.light_count == 0)
        return mtm_fail(error, MTM_ARGUMENT, "light \"%s\" is not known; the palette has no lights", name);
    return mtm_fail(error, MTM_ARGUMENT, "light \"%s\" is not in the palette; the nearest is \"%s\"", name,
                    mtm_palette_nearest_light(&scene->palette, name));
}

mtm_status mtm_scene_set_weight(mtm_scene *scene, const char *light, double weight, mtm_error *error) {
    const int index = mtm_palette_find_light(&scene->palette, light);
    if (index < 0) return fail_unknown_light(scene, light, error);
    scene->lights.weights[index] = weight;
    return MTM_OK;
}

static mtm_status fail_unknown_stop(const mtm_scene *scene, const char *name, mtm_error *error) {
    char known[512] = "";
    for (int i = 0; i < scene->stop_count; i++) {
        const size_t length = strlen(known);
        (void)snprintf(known + length, sizeof known - length, "%s\"%s\"", i > 0 ? ", " : "",
                       scene->stops[i].name);
    }
    if (scene->stop_count == 0)
        return mtm_fail(error, MTM_ARGUMENT, "stop \"%s\": the scene has no stops", name);
    return mtm_fail(error, MTM_ARGUMENT, "stop \"%s\" is not in the scene; it has %s", name, known);
}

mtm_status mtm_scene_use_stop(mtm_scene *scene, const char *stop, mtm_error *error) {
    for (int i = 0; i < scene->stop_count; i++) {
        if (strcmp(scene->stops[i].name, stop) != 0) continue;
        mtm_light_mix mix;
        const mtm_status status =
            mtm_light_mix_copy(&scene->stops[i].mix, scene->palette.light_count, &mix, error);
        if (status != MTM_OK) return status;
        mtm_light_mix_free(&scene->lights);
        scene->lights = mix;
        return MTM_OK;
    }
    return fail_unknown_stop(scene, stop, error);
}

/* Gives a mix room for more lights, which do not shine. */
static mtm_status extend_mix(mtm_light_mix *mix, int old_count, int new_count, mtm_error *error) {
    mtm_light_mix wider;
    const mtm_status status = mtm_light_mix_create(new_count, &wider, error);
    if (status != MTM_OK) return status;
    if (new_count > 0) wider.weights[0] = 0;
    memcpy(wider.weights, mix->weights, (size_t)old_count * sizeof *wider.weights);
    memcpy(wider.bulbs, mix->bulbs, (size_t)mix->bulb_count * sizeof *wider.bulbs);
    free(mix->weights);
    free(mix->bulbs);
    mix->weights = wider.weights;
    mix->bulbs = wider.bulbs;
    return MTM_OK;
}

mtm_status mtm_scene_override_palette(mtm_scene *scene, const mtm_palette *palette, mtm_error *error) {
    const int old_count = scene->palette.light_count;
    mtm_palette combined;
    mtm_status status = mtm_palette_copy(&scene->palette, &combined, error);
    if (status == MTM_OK) status = mtm_palette_override(&combined, palette, error);
    if (status == MTM_OK) status = extend_mix(&scene->lights, old_count, combined.light_count, error);
    for (int i = 0; i < scene->stop_count && status == MTM_OK; i++)
        status = extend_mix(&scene->stops[i].mix, old_count, combined.light_count, error);
    if (status != MTM_OK) {
        mtm_palette_free(&combined);
        return status;
    }
    mtm_palette_free(&scene->palette);
    scene->palette = combined;
    return MTM_OK;
}

/* As much of the name as a palette and its document can hold. */
static void set_light_name(const char *name, mtm_light *light) {
    const size_t length = mtm_json_prefix(name, MTM_NAME_MAX);
    (void)snprintf(light->name, sizeof light->name, "%.*s", length > 0 ? (int)length : 10,
                   length > 0 ? name : "illuminant");
}

mtm_status mtm_scene_use_light(mtm_scene *scene, const char *name, const mtm_spectrum *emission,
                               mtm_error *error) {
    mtm_light light = {.emission = *emission};
    set_light_name(name, &light);
    const mtm_palette palette = {.light_count = 1, .lights = &light};
    const mtm_status status = mtm_scene_override_palette(scene, &palette, error);
    if (status != MTM_OK) return status;
    mtm_scene_clear_weights(scene);
    return mtm_scene_set_weight(scene, light.name, 1, error);
}
