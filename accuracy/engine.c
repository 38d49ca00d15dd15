/* SPDX-License-Identifier: BSD-3-Clause
 * How far pictures of the engine scene are off in each basis. */
#include "engine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

const char *const engine_bases[ENGINE_BASES] = {"rgb",       "sharpened:7",    "factors:5", "factors:7",
                                                "factors:9", "wavelengths:31", "materials"};
const char *const engine_palettes[ENGINE_PALETTES] = {
    "the scene's own, designed", "foliage, orange, blue sky", "bluish green, moderate red, neutral 8",
    "purplish blue, yellow green, magenta", "dark skin, orange yellow, neutral 6.5"};
const char *const engine_lights[ENGINE_LIGHTS] = {"light 1", "light 2", "light 3", "FL11", "LED-B3"};

/* Patches of the ColorChecker for smoke, block and inner parts, in the order of the palettes above. */
enum { PATCHES = 3 };
static const char *const patches[ENGINE_PALETTES][PATCHES] = {
    {NULL},
    {"foliage", "orange", "blue_sky"},
    {"bluish_green", "moderate_red", "neutral_8_.23_d"},
    {"purplish_blue", "yellow_green", "magenta"},
    {"dark_skin", "orange_yellow", "neutral_6.5_.44_d"}};

static const char basis_of_truth[] = "wavelengths";

/* What measuring shares: the scene and the errors being collected. */
typedef struct engine_work {
    const char *source_folder;
    mtm_scene *scene;
    mtm_volume *volume;
    mtm_picture *truths[ENGINE_LIGHTS]; /* of the palette at hand */
    error_list measured[ENGINE_BASES];
    engine_errors *errors;
} engine_work;

mtm_status engine_read(const engine_options *options, mtm_scene **scene, mtm_volume **volume,
                       mtm_error *error) {
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/examples/engine/engine.json", options->source_folder);
    mtm_status status = mtm_scene_read(path, scene, error);
    if (status != MTM_OK) return status;
    (*scene)->render.width = (*scene)->render.height = options->edge;
    (*scene)->render.thread_count = options->thread_count;
    if (options->step > 0) (*scene)->render.step = options->step;
    (*scene)->background = MTM_BACKGROUND_NONE;
    status = mtm_scene_load_volume(*scene, NULL, volume, error);
    if (status != MTM_OK) mtm_scene_destroy(*scene);
    return status;
}

mtm_status engine_use_palette(const char *source_folder, int palette, mtm_scene *scene, mtm_error *error) {
    char folder[4096];
    mtm_status status = MTM_OK;
    (void)snprintf(folder, sizeof folder, "%s/data/spectra", source_folder);
    for (int i = 0; i < PATCHES && palette > 0 && status == MTM_OK; i++) {
        char column[128];
        (void)snprintf(column, sizeof column, "reflectance_colorchecker_ohta.csv:%s", patches[palette][i]);
        status = mtm_spectrum_read(folder, column, MTM_KIND_REFLECTANCE,
                                   &scene->palette.materials[i].reflectance, error);
    }
    return status;
}

/* A light of the scene, or an illuminant, which becomes one. */
static mtm_status use_light(mtm_scene *scene, const char *name, mtm_error *error) {
    mtm_spectrum emission;
    if (mtm_palette_find_light(&scene->palette, name) >= 0) {
        mtm_scene_clear_weights(scene);
        return mtm_scene_set_weight(scene, name, 1, error);
    }
    const mtm_status status = mtm_illuminant(name, &emission, error);
    return status == MTM_OK ? mtm_scene_use_light(scene, name, &emission, error) : status;
}

mtm_status engine_render(mtm_scene *scene, const mtm_volume *volume, const char *basis, mtm_image **image,
                         mtm_error *error) {
    (void)snprintf(scene->basis, sizeof scene->basis, "%s", basis);
    const mtm_status status = use_light(scene, "D65", error);
    return status == MTM_OK ? mtm_scene_render(scene, volume, NULL, image, error) : status;
}

/* The XYZ of white under the scene's light. */
static mtm_xyz find_white(const mtm_scene *scene) {
    const mtm_illumination illumination = mtm_scene_illumination(scene);
    return mtm_xyz_of(&illumination.light, &illumination.observer);
}

/* The matrix of a plain renderer: the image's colors under D65, channel by channel times the light's. */
static mtm_status relight_rgb(mtm_scene *scene, const mtm_image *image, const char *light,
                              mtm_picture **picture, mtm_error *error) {
    mtm_status status = use_light(scene, "D65", error);
    if (status != MTM_OK) return status;
    const mtm_rgb d65 = mtm_rgb_from_xyz(find_white(scene));
    status = use_light(scene, light, error);
    if (status != MTM_OK) return status;
    const mtm_rgb color = mtm_rgb_from_xyz(find_white(scene));
    const double matrix[9] = {color.r / d65.r, 0, 0, 0, color.g / d65.g, 0, 0, 0, color.b / d65.b};
    mtm_relight_options options = mtm_relight_defaults();
    options.thread_count = scene->render.thread_count;
    return mtm_relight(image, matrix, &options, picture, error);
}

mtm_status engine_relight(mtm_scene *scene, const mtm_image *image, int light, mtm_picture **picture,
                          mtm_error *error) {
    if (strcmp(image->basis, "rgb") == 0)
        return relight_rgb(scene, image, engine_lights[light], picture, error);
    const mtm_status status = use_light(scene, engine_lights[light], error);
    return status == MTM_OK ? mtm_scene_relight(scene, image, scene->render.thread_count, picture, error)
                            : status;
}

static mtm_xyz pixel_xyz(const float *rgba) {
    return mtm_xyz_from_rgb((mtm_rgb){rgba[0], rgba[1], rgba[2]});
}

/* Appends an error for every pixel of the truth with alpha. */
static mtm_status append_errors(const mtm_picture *made, const mtm_picture *truth, mtm_xyz white,
                                error_list *list, mtm_error *error) {
    const size_t count = (size_t)truth->width * (size_t)truth->height;
    const mtm_status status = error_list_reserve(list, count, error);
    if (status != MTM_OK) return status;
    for (size_t i = 0; i < count; i++)
        if (truth->rgba[4 * i + 3] > 0)
            list->values[list->count++] =
                color_error(pixel_xyz(&made->rgba[4 * i]), pixel_xyz(&truth->rgba[4 * i]), white, 1);
    return MTM_OK;
}

/* One picture in one basis; its errors go to the list of its palette and to that of all measured ones. */
static mtm_status compare_light(engine_work *work, const mtm_image *image, int basis, int palette, int light,
                                error_list *of_palette, mtm_error *error) {
    mtm_picture *picture = NULL;
    error_list of_light = {0};
    mtm_status status = engine_relight(work->scene, image, light, &picture, error);
    const mtm_xyz white = find_white(work->scene);
    if (status == MTM_OK) status = append_errors(picture, work->truths[light], white, &of_light, error);
    if (status == MTM_OK) status = append_errors(picture, work->truths[light], white, of_palette, error);
    if (status == MTM_OK && palette > 0)
        status = append_errors(picture, work->truths[light], white, &work->measured[basis], error);
    if (status == MTM_OK) {
        work->errors->pixel_count = (int)of_light.count;
        work->errors->each[basis][palette][light] = error_summarize(of_light.count, of_light.values);
    }
    free(of_light.values);
    mtm_picture_destroy(picture);
    return status;
}

static mtm_status compare_basis(engine_work *work, int basis, int palette, mtm_error *error) {
    mtm_image *image = NULL;
    error_list of_palette = {0};
    mtm_status status = engine_render(work->scene, work->volume, engine_bases[basis], &image, error);
    for (int light = 0; light < ENGINE_LIGHTS && status == MTM_OK; light++)
        status = compare_light(work, image, basis, palette, light, &of_palette, error);
    if (status == MTM_OK)
        work->errors->palette[basis][palette] = error_summarize(of_palette.count, of_palette.values);
    free(of_palette.values);
    mtm_image_destroy(image);
    return status;
}

static mtm_status compare_palette(engine_work *work, int palette, mtm_error *error) {
    mtm_image *image = NULL;
    mtm_status status = engine_use_palette(work->source_folder, palette, work->scene, error);
    if (status == MTM_OK) status = engine_render(work->scene, work->volume, basis_of_truth, &image, error);
    for (int light = 0; light < ENGINE_LIGHTS && status == MTM_OK; light++)
        status = engine_relight(work->scene, image, light, &work->truths[light], error);
    mtm_image_destroy(image);
    for (int basis = 0; basis < ENGINE_BASES && status == MTM_OK; basis++)
        status = compare_basis(work, basis, palette, error);
    for (int light = 0; light < ENGINE_LIGHTS; light++) {
        mtm_picture_destroy(work->truths[light]);
        work->truths[light] = NULL;
    }
    return status;
}

mtm_status engine_measure(const engine_options *options, engine_errors *errors, mtm_error *error) {
    engine_work work = {.source_folder = options->source_folder, .errors = errors};
    mtm_status status = engine_read(options, &work.scene, &work.volume, error);
    if (status != MTM_OK) return status;
    errors->edge = options->edge;
    for (int palette = 0; palette < ENGINE_PALETTES && status == MTM_OK; palette++)
        status = compare_palette(&work, palette, error);
    for (int basis = 0; basis < ENGINE_BASES; basis++) {
        if (status == MTM_OK)
            errors->measured[basis] =
                error_summarize(work.measured[basis].count, work.measured[basis].values);
        free(work.measured[basis].values);
    }
    mtm_volume_destroy(work.volume);
    mtm_scene_destroy(work.scene);
    return status;
}
