/* SPDX-License-Identifier: BSD-3-Clause
 * metamer info: what a file holds, for people or as JSON (docs/files.md has the form for every kind of file). */
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analysis.h"
#include "document.h"
#include "task.h"

static const command_option options[] = {
    {"--json", NULL, "print a JSON document"},
    {NULL, NULL, NULL},
};

static json_t *describe_volume(const mtm_volume *volume) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    double range[2];
    char sha256[65];
    double spacing[3];
    json_t *axes = json_array();
    mtm_volume_range(volume, &range[0], &range[1]);
    mtm_volume_sha256(volume, sha256);
    for (int axis = 0; axis < 3; axis++) {
        spacing[axis] = mtm_grid_spacing(grid, axis);
        (void)json_array_append_new(axes, make_numbers(3, grid->axes[axis]));
    }
    const size_t bytes = mtm_volume_voxel_count(volume) * mtm_voxel_type_bytes(mtm_volume_type(volume));
    return json_pack("{s:s, s:s, s:[i,i,i], s:o, s:o, s:o, s:o, s:b, s:o, s:f, s:f, s:I, s:s}", "kind",
                     "volume", "type", mtm_voxel_type_name(mtm_volume_type(volume)), "size", grid->size[0],
                     grid->size[1], grid->size[2], "spacing", make_numbers(3, spacing), "axes", axes,
                     "origin", make_numbers(3, grid->origin), "unit", make_text(grid->unit), "oriented",
                     (int)grid->is_oriented, "range", make_numbers(2, range), "slope",
                     mtm_volume_slope(volume), "intercept", mtm_volume_intercept(volume), "bytes",
                     (json_int_t)bytes, "sha256", sha256);
}

/* Who looks at a palette: the scene's observer, or CIE 1931 at one that stands alone. */
typedef struct onlooker {
    mtm_observer observer;
    double adapted_y;
} onlooker;

/* Colors of a picture, encoded 0..1, of every material alone under every light alone. */
static json_t *describe_colors(const mtm_palette *palette, const onlooker *who,
                               const mtm_material *material) {
    json_t *colors = json_object();
    double weights[MTM_LIGHTS_MAX] = {0};
    for (int i = 0; i < palette->light_count && i < MTM_LIGHTS_MAX; i++) {
        weights[i] = 1;
        const mtm_spectrum light = mtm_palette_mix(palette, weights, 1);
        const mtm_illumination illumination = mtm_illumination_of(&light, &who->observer, who->adapted_y);
        const mtm_rgb rgb = mtm_illuminate(&illumination, &material->reflectance);
        const double encoded[3] = {mtm_srgb_encode(rgb.r), mtm_srgb_encode(rgb.g), mtm_srgb_encode(rgb.b)};
        (void)json_object_set_new(colors, palette->lights[i].name, make_numbers(3, encoded));
        weights[i] = 0;
    }
    return colors;
}

static json_t *describe_materials(const mtm_palette *palette, const onlooker *who) {
    json_t *materials = json_array();
    for (int i = 0; i < palette->material_count; i++)
        (void)json_array_append_new(
            materials, json_pack("{s:s, s:o}", "name", palette->materials[i].name, "srgb_picture",
                                 describe_colors(palette, who, &palette->materials[i])));
    return materials;
}

static json_t *describe_palette(const mtm_palette *palette, const mtm_observer *observer) {
    const onlooker who = {.observer = *observer};
    json_t *lights = json_array();
    for (int i = 0; i < palette->light_count; i++)
        (void)json_array_append_new(lights, json_string(palette->lights[i].name));
    return json_pack("{s:s, s:o, s:o, s:o}", "kind", "palette", "materials",
                     describe_materials(palette, &who), "lights", lights, "analysis",
                     describe_analysis(palette, &who.observer, who.adapted_y));
}

static json_t *describe_weights(const mtm_scene *scene, const mtm_light_mix *mix) {
    json_t *weights = json_object();
    for (int i = 0; i < scene->palette.light_count; i++)
        (void)json_object_set_new(weights, scene->palette.lights[i].name, json_real(mix->weights[i]));
    return weights;
}

static json_t *describe_scene(const mtm_scene *scene) {
    const onlooker who = {scene->observer, scene->is_white_adapted ? 1 : 0};
    json_t *stops = json_array();
    for (int i = 0; i < scene->stop_count; i++)
        (void)json_array_append_new(stops, json_string(scene->stops[i].name));
    return json_pack("{s:s, s:s?, s:o, s:o, s:f, s:o, s:s, s:s, s:[i,i], s:i, s:o}", "kind", "scene",
                     "volume", scene->volume_file, "materials", describe_materials(&scene->palette, &who),
                     "weights", describe_weights(scene, &scene->lights), "intensity", scene->lights.intensity,
                     "stops", stops, "renderer", scene->renderer, "basis", scene->basis, "size",
                     scene->render.width, scene->render.height, "points", scene->point_count, "analysis",
                     describe_analysis(&scene->palette, &who.observer, who.adapted_y));
}

/* Share of pixels that hold anything: the paper's "fill". */
static double fill_of(const mtm_image *image) {
    const size_t count = (size_t)image->width * (size_t)image->height;
    size_t filled = 0;
    for (size_t n = 0; n < count; n++) {
        const float *pixel = image->pixels + n * (size_t)image->lanes;
        bool is_filled = false;
        for (int i = 0; i <= image->dimension; i++) is_filled = is_filled || pixel[i] != 0;
        filled += is_filled;
    }
    return (double)filled / (double)count;
}

static mtm_status describe_image_file(const char *path, json_t **object, mtm_error *error) {
    mtm_image *image = NULL;
    mtm_scene *scene = NULL;
    mtm_status status = mtm_image_read(path, &image, error);
    if (status == MTM_OK && image->scene != NULL) status = mtm_scene_of_image(image, path, &scene, error);
    if (status == MTM_OK)
        *object =
            json_pack("{s:s, s:[i,i], s:s, s:i, s:f, s:o}", "kind", "spectral image", "size", image->width,
                      image->height, "basis", image->basis, "dimension", image->dimension, "fill",
                      fill_of(image), "scene", scene == NULL ? json_null() : describe_scene(scene));
    mtm_scene_destroy(scene);
    mtm_image_destroy(image);
    return status;
}

static mtm_status describe_picture_file(const char *path, json_t **object, mtm_error *error) {
    mtm_picture *picture = NULL;
    char *text = NULL;
    mtm_scene *scene = NULL;
    mtm_status status = mtm_picture_read_png(path, &picture, &text, error);
    if (status == MTM_OK && text != NULL) status = mtm_scene_parse(path, text, NULL, &scene, error);
    if (status == MTM_OK)
        *object = json_pack("{s:s, s:[i,i], s:o}", "kind", "picture", "size", picture->width, picture->height,
                            "scene", scene == NULL ? json_null() : describe_scene(scene));
    mtm_scene_destroy(scene);
    mtm_text_free(text);
    mtm_picture_destroy(picture);
    return status;
}

/* The document, to see what it is; NULL where it is none or longer than a document may be. */
static json_t *load_document(const char *path) {
    enum { DOCUMENT_BYTES_MAX = 64 << 20 };
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) return NULL;
    json_t *document = NULL;
    if (fseek(stream, 0, SEEK_END) == 0 && ftell(stream) <= DOCUMENT_BYTES_MAX) {
        rewind(stream);
        skip_utf8_mark(stream);
        document = json_loadf(stream, 0, NULL);
    }
    (void)fclose(stream);
    return document;
}

/* A scene has a volume; a document without one is a palette. */
static mtm_status describe_json_file(const char *path, json_t **object, mtm_error *error) {
    mtm_scene *scene = NULL;
    mtm_palette palette;
    json_t *document = load_document(path);
    const bool is_palette =
        json_object_get(document, "volume") == NULL &&
        (json_object_get(document, "materials") != NULL || json_object_get(document, "lights") != NULL);
    json_decref(document);
    mtm_status status =
        is_palette ? mtm_palette_read(path, &palette, error) : mtm_scene_read(path, &scene, error);
    if (status == MTM_OK && is_palette) {
        mtm_observer observer;
        status = mtm_observer_get("cie1931", &observer, error);
        if (status == MTM_OK) *object = describe_palette(&palette, &observer);
        mtm_palette_free(&palette);
    } else if (status == MTM_OK) {
        *object = describe_scene(scene);
        mtm_scene_destroy(scene);
    }
    return status;
}

static mtm_status describe_table_file(const char *path, json_t **object, mtm_error *error) {
    mtm_spectrum_table table;
    const mtm_status status = mtm_spectrum_table_read(path, &table, error);
    if (status != MTM_OK) return status;
    json_t *names = json_array();
    for (int i = 0; i < table.column_count; i++)
        (void)json_array_append_new(names, make_text(table.names[i]));
    const double range[2] = {table.wavelength_nm[0], table.wavelength_nm[table.row_count - 1]};
    *object = json_pack("{s:s, s:o, s:i, s:o}", "kind", "spectra", "wavelength_nm", make_numbers(2, range),
                        "rows", table.row_count, "columns", names);
    mtm_spectrum_table_free(&table);
    return MTM_OK;
}

static mtm_status describe_volume_file(const char *path, json_t **object, mtm_error *error) {
    mtm_volume *volume = NULL;
    const mtm_status status = mtm_volume_read(path, &volume, error);
    if (status == MTM_OK) *object = describe_volume(volume);
    mtm_volume_destroy(volume);
    return status;
}

static mtm_status describe_file(const char *path, json_t **object, mtm_error *error) {
    switch (kind_of_file(path)) {
    case FILE_PNG: return describe_picture_file(path, object, error);
    case FILE_EXR: return describe_image_file(path, object, error);
    case FILE_JSON: return describe_json_file(path, object, error);
    default: break;
    }
    return has_extension(path, ".csv") ? describe_table_file(path, object, error)
                                       : describe_volume_file(path, object, error);
}

/* The same facts for people: a line per key, nested keys indented. */
static void print_plain(const json_t *object, int indent) {
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach((json_t *)object, key, value) {
        (void)printf("%*s%-*s ", indent, "", 14 - indent, key);
        if (strcmp(key, "analysis") == 0) {
            (void)printf("\n");
            print_analysis(value, indent + 2);
        } else if (json_is_object(value)) {
            (void)printf("\n");
            print_plain(value, indent + 2);
        } else if (json_is_array(value) && json_is_object(json_array_get(value, 0))) {
            (void)printf("\n");
            for (size_t i = 0; i < json_array_size(value); i++)
                print_plain(json_array_get(value, i), indent + 2);
        } else if (json_is_string(value)) {
            print_plainly(stdout, json_string_value(value));
            (void)printf("\n");
        } else {
            (void)json_dumpf(value, stdout, JSON_ENCODE_ANY | JSON_REAL_PRECISION(6));
            (void)printf("\n");
        }
    }
}

static int run(const subcommand *command, int argc, char **argv) {
    const char *path = NULL;
    bool is_json = false;
    argument_walk walk = walk_arguments(command, argc, argv);
    const command_option *option = NULL;
    const char *value = NULL;
    while (next_argument(&walk, &option, &value)) {
        if (option != NULL)
            is_json = true;
        else if (path != NULL)
            fail_usage(&walk, "one file at a time, not \"%s\" and \"%s\"", path, value);
        else
            path = value;
    }
    if (!walk.is_over && path == NULL) fail_usage(&walk, "a file is needed");
    if (walk.is_over) return walk.exit_status;

    mtm_error error = {""};
    json_t *object = NULL;
    if (describe_file(path, &object, &error) != MTM_OK) return fail_command(command, &error);
    if (object == NULL) {
        (void)snprintf(error.message, sizeof error.message,
                       "%s: cannot be described: out of memory, or a text that is not UTF-8", path);
        return fail_command(command, &error);
    }
    (void)json_object_set_new(object, "file", make_text(path));
    if (is_json)
        print_document(object);
    else
        print_plain(object, 0);
    json_decref(object);
    return EXIT_DONE;
}

const subcommand info_command = {
    .name = "info",
    .arguments = "FILE [--json]",
    .summary = "Tell what a volume, spectral image, picture, scene, palette or table of spectra holds.",
    .options = options,
    .run = run,
};
