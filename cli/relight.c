/* SPDX-License-Identifier: BSD-3-Clause
 * metamer relight: a finished spectral image under another light, or with other reflectances. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "task.h"

static const command_option options[] = {
    {"-o", "OUT.png", "the picture"},
    {"--light", "NAME=WEIGHT", "this light of the palette, all that are not named off; repeatable"},
    {"--illuminant", "NAME|FILE.csv:COLUMN",
     "a light that the palette need not know: D65, FL11, a measured one"},
    {"--stop", "NAME", "a mix that the scene keeps under this name"},
    {"--palette", "NEW.json", "new reflectances (basis materials) and lights, by name"},
    {"--observer", "NAME|FILE.csv",
     "cie1931, cie1964, cie2015, cie2015_10deg, or curves of an eye or a camera"},
    {"--intensity", "X", "brightness of the light, default as in the scene"},
    {"--background", "HEX|none", "a color such as 202020 behind the picture; none keeps transparency"},
    {"--threads", "N", "default: all processors"},
    {NULL, NULL, NULL},
};

typedef struct light_weight {
    char name[MTM_NAME_MAX + 1];
    double weight;
} light_weight;

typedef struct relight_request {
    const char *input, *output, *illuminant, *stop, *palette, *observer, *background;
    light_weight lights[MTM_LIGHTS_MAX];
    int light_count, threads;
    double intensity; /* -1: as in the scene */
} relight_request;

/* NAME=WEIGHT, split at the last "=". */
static void add_light(argument_walk *walk, const command_option *option, const char *value,
                      relight_request *request) {
    const char *equals = strrchr(value, '=');
    light_weight *light = &request->lights[request->light_count];
    if (request->light_count == MTM_LIGHTS_MAX) {
        fail_usage(walk, "more than %d times --light", MTM_LIGHTS_MAX);
        return;
    }
    if (equals == NULL || equals == value || equals - value > MTM_NAME_MAX) {
        fail_usage(walk, "--light is \"%s\", must be NAME=WEIGHT", value);
        return;
    }
    (void)snprintf(light->name, sizeof light->name, "%.*s", (int)(equals - value), value);
    if (parse_amount(walk, option, equals + 1, &light->weight)) request->light_count++;
}

/* A shell takes an unquoted # for a comment, so it may be left out here. */
static void set_background(argument_walk *walk, const char *value, relight_request *request) {
    const char *digits = value[0] == '#' ? value + 1 : value;
    const bool is_color = strlen(digits) == 6 && strspn(digits, "0123456789abcdefABCDEF") == 6;
    if (!is_color && strcmp(value, "none") != 0)
        fail_usage(walk, "--background is \"%s\", must be six hexadecimal digits or none", value);
    request->background = value;
}

static void read_option(argument_walk *walk, const command_option *option, const char *value,
                        relight_request *request) {
    if (option == NULL && request->input != NULL)
        fail_usage(walk, "one image at a time, not \"%s\" and \"%s\"", request->input, value);
    else if (option == NULL)
        request->input = value;
    else if (is_option(option, "-o"))
        request->output = value;
    else if (is_option(option, "--light"))
        add_light(walk, option, value, request);
    else if (is_option(option, "--illuminant"))
        request->illuminant = value;
    else if (is_option(option, "--stop"))
        request->stop = value;
    else if (is_option(option, "--palette"))
        request->palette = value;
    else if (is_option(option, "--observer"))
        request->observer = value;
    else if (is_option(option, "--intensity"))
        (void)parse_amount(walk, option, value, &request->intensity);
    else if (is_option(option, "--background"))
        set_background(walk, value, request);
    else
        (void)parse_count(walk, option, value, &request->threads);
}

static mtm_status take_palette(const char *path, mtm_scene *scene, mtm_error *error) {
    mtm_palette palette;
    mtm_status status = mtm_palette_read(path, &palette, error);
    if (status != MTM_OK) return status;
    status = mtm_scene_override_palette(scene, &palette, error);
    mtm_palette_free(&palette);
    return status;
}

static mtm_status take_illuminant(const char *text, mtm_scene *scene, mtm_error *error) {
    mtm_spectrum light;
    const mtm_status status = open_illuminant(text, &light, error);
    return status == MTM_OK ? mtm_scene_use_light(scene, text, &light, error) : status;
}

static mtm_status take_stop(const char *name, mtm_scene *scene, mtm_error *error) {
    return mtm_scene_use_stop(scene, name, error);
}

static mtm_status take_observer(const char *name_or_file, mtm_scene *scene, mtm_error *error) {
    return open_observer(name_or_file, &scene->observer, error);
}

static mtm_status take_lights(const relight_request *request, mtm_scene *scene, mtm_error *error) {
    mtm_status status = MTM_OK;
    if (request->light_count > 0) mtm_scene_clear_weights(scene);
    for (int i = 0; i < request->light_count && status == MTM_OK; i++)
        status = mtm_scene_set_weight(scene, request->lights[i].name, request->lights[i].weight, error);
    return status;
}

static mtm_status take_background(const char *background, mtm_scene *scene, mtm_error *error) {
    if (scene->background == MTM_BACKGROUND_MATERIAL) {
        (void)snprintf(error->message, sizeof error->message,
                       "the image has the material \"%s\" behind it already",
                       scene->palette.materials[scene->background_material].name);
        return MTM_ARGUMENT;
    }
    const bool is_none = strcmp(background, "none") == 0;
    scene->background = is_none ? MTM_BACKGROUND_NONE : MTM_BACKGROUND_COLOR;
    if (!is_none)
        (void)snprintf(scene->background_srgb, sizeof scene->background_srgb, "#%.6s",
                       background + (background[0] == '#'));
    return MTM_OK;
}

/* Everything the options change is a change of the scene, so the picture can carry the scene it shows. */
static mtm_status apply_request(const relight_request *request, mtm_scene *scene, mtm_error *error) {
    const struct {
        const char *option, *value;
        mtm_status (*take)(const char *value, mtm_scene *scene, mtm_error *error);
    } changes[] = {
        {"--palette", request->palette, take_palette}, /* first: it may bring the lights that are named */
        {"--stop", request->stop, take_stop},
        {"--illuminant", request->illuminant, take_illuminant},
        {"--background", request->background, take_background},
        {"--observer", request->observer, take_observer},
    };
    mtm_status status = MTM_OK;
    for (size_t i = 0; i < sizeof changes / sizeof *changes && status == MTM_OK; i++)
        if (changes[i].value != NULL)
            status = name_failure(changes[i].take(changes[i].value, scene, error), request->input,
                                  changes[i].option, error);
    if (status == MTM_OK)
        status = name_failure(take_lights(request, scene, error), request->input, "--light", error);
    if (request->intensity >= 0) scene->lights.intensity = request->intensity;
    return status;
}

static int relight(const subcommand *command, const relight_request *request) {
    mtm_error error = {""};
    mtm_image *image = NULL;
    mtm_scene *scene = NULL;
    mtm_picture *picture = NULL;
    mtm_status status = check_picture_output(request->output, false, &error);
    if (status == MTM_OK) status = mtm_image_read(request->input, &image, &error);
    if (status == MTM_OK) status = mtm_scene_of_image(image, request->input, &scene, &error);
    if (status == MTM_OK) status = apply_request(request, scene, &error);
    if (status == MTM_OK)
        status = name_failure(mtm_scene_relight(scene, image, request->threads, &picture, &error),
                              request->input, NULL, &error);
    if (status == MTM_OK) status = write_picture(picture, scene, request->output, &error);
    mtm_picture_destroy(picture);
    mtm_scene_destroy(scene);
    mtm_image_destroy(image);
    return status == MTM_OK ? EXIT_DONE : fail_command(command, &error);
}

static int run(const subcommand *command, int argc, char **argv) {
    relight_request request = {.intensity = -1};
    argument_walk walk = walk_arguments(command, argc, argv);
    const command_option *option = NULL;
    const char *value = NULL;
    while (next_argument(&walk, &option, &value)) read_option(&walk, option, value, &request);
    if (walk.is_over) return walk.exit_status;
    const int light_sources =
        (request.light_count > 0) + (request.illuminant != NULL) + (request.stop != NULL);
    if (request.input == NULL)
        fail_usage(&walk, "a spectral image is needed");
    else if (request.output == NULL)
        fail_usage(&walk, "-o OUT.png is needed");
    else if (light_sources > 1)
        fail_usage(&walk, "--light, --illuminant and --stop exclude each other");
    return walk.is_over ? walk.exit_status : relight(command, &request);
}

const subcommand relight_command = {
    .name = "relight",
    .arguments = "IMAGE.exr -o OUT.png [options]",
    .summary = "Light a finished spectral image anew, without rendering.\n"
               "Without options the picture is the one of the scene's own light.",
    .options = options,
    .run = run,
};
