/* SPDX-License-Identifier: BSD-3-Clause
 * Palettes as JSON: every way to name a spectrum is a row of one table. */
#include "palette/json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"

/* What a material's or a light's spectrum is made from. */
typedef struct spectrum_request {
    mtm_json_reader *reader;
    const json_t *object;
    const char *key;
    const char *folder;
    mtm_spectrum_kind kind;
} spectrum_request;

/* Fails at the key with the status of what went wrong behind it. */
static void fail_with(const spectrum_request *request, mtm_status status, const mtm_error *reason) {
    mtm_json_fail(request->reader, request->key, "is not usable: %s", reason->message);
    if (status != MTM_ARGUMENT) request->reader->status = status; /* a bad name is a fault of the document */
}

static void from_file(const spectrum_request *request, mtm_spectrum *spectrum) {
    const char *file = NULL;
    mtm_error reason;
    if (!mtm_json_text(request->reader, request->object, request->key, &file)) return;
    if (request->folder == NULL) {
        mtm_json_fail(request->reader, request->key, "names a file, but an embedded document stands alone");
        return;
    }
    const mtm_status status = mtm_spectrum_read(request->folder, file, request->kind, spectrum, &reason);
    if (status != MTM_OK) fail_with(request, status, &reason);
}

static void from_illuminant(const spectrum_request *request, mtm_spectrum *spectrum) {
    const char *name = NULL;
    mtm_error reason;
    if (!mtm_json_text(request->reader, request->object, request->key, &name)) return;
    const mtm_status status = mtm_illuminant(name, spectrum, &reason);
    if (status != MTM_OK) fail_with(request, status, &reason);
}

static void from_temperature(const spectrum_request *request, mtm_spectrum *spectrum) {
    double kelvin = 0;
    mtm_error reason;
    if (!mtm_json_number(request->reader, request->object, request->key, mtm_json_any, &kelvin)) return;
    const bool is_daylight = strcmp(request->key, "daylight") == 0;
    const mtm_status status =
        is_daylight ? mtm_daylight(kelvin, spectrum, &reason) : mtm_blackbody(kelvin, spectrum, &reason);
    if (status != MTM_OK) fail_with(request, status, &reason);
}

/* A material gets the smoothest reflectance of the color; a light gets daylight D65 through that filter, which
 * shows the color on white. */
static void from_color(const spectrum_request *request, mtm_spectrum *spectrum) {
    const char *text = NULL;
    mtm_rgb color;
    mtm_error reason;
    if (!mtm_json_text(request->reader, request->object, request->key, &text)) return;
    mtm_status status = mtm_rgb_parse(text, &color, &reason);
    if (status == MTM_OK) status = mtm_reflectance_of_rgb(color, spectrum, &reason);
    if (status == MTM_OK && request->kind == MTM_KIND_LIGHT) {
        mtm_spectrum daylight;
        status = mtm_illuminant("D65", &daylight, &reason);
        if (status == MTM_OK) *spectrum = mtm_spectrum_multiply(&daylight, spectrum);
    }
    if (status != MTM_OK) fail_with(request, status, &reason);
}

static void from_values(const spectrum_request *request, mtm_spectrum *spectrum) {
    (void)mtm_json_numbers(request->reader, request->object, request->key, MTM_SPECTRUM_SAMPLES, mtm_json_any,
                           spectrum->value);
}

static const struct {
    const char *key;
    void (*make)(const spectrum_request *request, mtm_spectrum *spectrum);
    bool is_for_materials;
} sources[] = {
    {"spectrum", from_file, true},
    {"illuminant", from_illuminant, false},
    {"blackbody", from_temperature, false},
    {"daylight", from_temperature, false},
    {"srgb", from_color, true},
    {"values", from_values, true},
};
enum { SOURCE_COUNT = sizeof sources / sizeof *sources };

/* The one key that says where the spectrum comes from. */
static int find_source(mtm_json_reader *reader, const json_t *object) {
    int found = -1;
    for (int i = 0; i < SOURCE_COUNT; i++) {
        if (json_object_get(object, sources[i].key) == NULL) continue;
        if (found >= 0) {
            mtm_json_fail(reader, sources[i].key, "stands beside \"%s\"; a spectrum has exactly one source",
                          sources[found].key);
            return -1;
        }
        found = i;
    }
    if (found < 0)
        mtm_json_fail(
            reader, NULL,
            "names no spectrum: one of \"spectrum\", \"illuminant\", \"blackbody\", \"daylight\", \"srgb\", "
            "\"values\" is needed");
    return found;
}

/* Artificial reflectances may leave 0..1, but not what a float pixel can hold. */
static void check_reflectance(mtm_json_reader *reader, const mtm_spectrum *reflectance) {
    static const double largest = 1e6;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        if (!(fabs(reflectance->value[i]) <= largest))
            mtm_json_fail(reader, NULL, "has a reflectance of %g at %d nm, at most %g either way is allowed",
                          reflectance->value[i], MTM_WAVELENGTH_FIRST_NM + i * MTM_WAVELENGTH_STEP_NM,
                          largest);
}

static void check_light(mtm_json_reader *reader, const mtm_spectrum *emission) {
    mtm_observer observer;
    mtm_spectrum normalized;
    mtm_error reason;
    if (reader->status != MTM_OK) return;
    if (mtm_observer_get("cie1931", &observer, &reason) != MTM_OK ||
        mtm_light_normalize(emission, &observer, &normalized, &reason) != MTM_OK)
        mtm_json_fail(reader, NULL, "is no usable light: %s", reason.message);
}

const char *mtm_palette_source_of(const json_t *object) {
    for (int i = 0; i < SOURCE_COUNT; i++)
        if (json_object_get(object, sources[i].key) != NULL) return sources[i].key;
    return NULL;
}

void mtm_palette_read_source(mtm_json_reader *reader, const json_t *object, const char *folder,
                             mtm_spectrum_kind kind, mtm_spectrum *spectrum) {
    const int source = reader->status == MTM_OK ? find_source(reader, object) : -1;
    if (source < 0) return;
    if (kind == MTM_KIND_REFLECTANCE && !sources[source].is_for_materials) {
        mtm_json_fail(reader, sources[source].key, "is a light's spectrum, a material needs a reflectance");
        return;
    }
    const spectrum_request request = {reader, object, sources[source].key, folder, kind};
    sources[source].make(&request, spectrum);
    if (kind == MTM_KIND_REFLECTANCE)
        check_reflectance(reader, spectrum);
    else
        check_light(reader, spectrum);
}

void mtm_palette_check_name(mtm_json_reader *reader, const char *key, const char *text,
                            char name[MTM_NAME_MAX + 1]) {
    if (strlen(text) > MTM_NAME_MAX)
        mtm_json_fail(reader, key, "has %zu bytes, at most %d are allowed", strlen(text), MTM_NAME_MAX);
    else
        (void)snprintf(name, MTM_NAME_MAX + 1, "%s", text);
}

void mtm_palette_read_name(mtm_json_reader *reader, const json_t *object, char name[MTM_NAME_MAX + 1]) {
    const char *text = NULL;
    if (mtm_json_required(reader, object, "name") == NULL) return;
    if (mtm_json_text(reader, object, "name", &text)) mtm_palette_check_name(reader, "name", text, name);
}

void mtm_palette_add_material(mtm_json_reader *reader, const mtm_material *material, mtm_palette *palette) {
    if (reader->status != MTM_OK) return;
    if (mtm_palette_find_material(palette, material->name) >= 0)
        mtm_json_fail(reader, "name", "\"%s\" is the name of an earlier material, too", material->name);
    else
        palette->materials[palette->material_count++] = *material;
}

void mtm_palette_add_light(mtm_json_reader *reader, const mtm_light *light, mtm_palette *palette) {
    if (reader->status != MTM_OK) return;
    if (mtm_palette_find_light(palette, light->name) >= 0)
        mtm_json_fail(reader, "name", "\"%s\" is the name of an earlier light, too", light->name);
    else
        palette->lights[palette->light_count++] = *light;
}

void mtm_palette_read_material(mtm_json_reader *reader, const json_t *object, const char *folder,
                               mtm_palette *palette) {
    static const char *const keys[] = {"name",       "spectrum",  "srgb",    "values",
                                       "illuminant", "blackbody", "daylight"};
    mtm_material material = {0};
    if (!mtm_json_expect_object(reader, object, keys, sizeof keys / sizeof *keys)) return;
    mtm_palette_read_name(reader, object, material.name);
    mtm_palette_read_source(reader, object, folder, MTM_KIND_REFLECTANCE, &material.reflectance);
    mtm_palette_add_material(reader, &material, palette);
}

/* "through": the light passes materials as filters, wavelength by wavelength. */
static void apply_filters(mtm_json_reader *reader, const json_t *object, const mtm_palette *palette,
                          mtm_spectrum *emission) {
    const json_t *filters = json_object_get(object, "through");
    if (filters == NULL || reader->status != MTM_OK) return;
    if (!json_is_array(filters)) {
        mtm_json_fail(reader, "through", "must be an array of material names");
        return;
    }
    for (size_t i = 0; i < json_array_size(filters); i++) {
        const char *name = json_string_value(json_array_get(filters, i));
        const int material = name == NULL ? -1 : mtm_palette_find_material(palette, name);
        if (name == NULL) {
            char preview[64];
            mtm_json_fail(reader, "through", "holds %s, must hold names of materials",
                          mtm_json_preview(json_array_get(filters, i), preview));
            return;
        }
        if (material < 0) {
            mtm_json_fail_name(reader, "through", name, "material",
                               mtm_palette_nearest_material(palette, name));
            return;
        }
        *emission = mtm_spectrum_multiply(emission, &palette->materials[material].reflectance);
    }
}

void mtm_palette_read_light(mtm_json_reader *reader, const json_t *object, const char *folder,
                            mtm_palette *palette) {
    static const char *const keys[] = {"name",     "spectrum", "illuminant", "blackbody",
                                       "daylight", "srgb",     "values",     "through"};
    mtm_light light = {0};
    if (!mtm_json_expect_object(reader, object, keys, sizeof keys / sizeof *keys)) return;
    mtm_palette_read_name(reader, object, light.name);
    mtm_palette_read_source(reader, object, folder, MTM_KIND_LIGHT, &light.emission);
    apply_filters(reader, object, palette, &light.emission);
    check_light(reader, &light.emission); /* the filters may have left nothing */
    mtm_palette_add_light(reader, &light, palette);
}

typedef struct list_context {
    const char *folder;
    mtm_palette *palette;
} list_context;

static void read_material(mtm_json_reader *reader, const json_t *object, void *context) {
    const list_context *list = context;
    mtm_palette_read_material(reader, object, list->folder, list->palette);
}

static void read_light(mtm_json_reader *reader, const json_t *object, void *context) {
    const list_context *list = context;
    mtm_palette_read_light(reader, object, list->folder, list->palette);
}

bool mtm_palette_reserve(mtm_json_reader *reader, mtm_palette *palette) {
    *palette = (mtm_palette){.materials = mtm_allocate(MTM_MATERIALS_MAX, sizeof *palette->materials),
                             .lights = mtm_allocate(MTM_LIGHTS_MAX, sizeof *palette->lights)};
    if (palette->materials != NULL && palette->lights != NULL) return true;
    mtm_palette_free(palette);
    reader->status = mtm_fail_memory(reader->error, "a palette", MTM_LIGHTS_MAX * sizeof *palette->lights);
    return false;
}

void mtm_palette_from_json(mtm_json_reader *reader, const json_t *object, const char *folder,
                           mtm_palette *palette) {
    list_context context = {folder, palette};
    if (!mtm_palette_reserve(reader, palette)) return;
    mtm_json_each(reader, object, "materials", MTM_MATERIALS_MAX, read_material, &context);
    mtm_json_each(reader, object, "lights", MTM_LIGHTS_MAX, read_light, &context);
    if (reader->status != MTM_OK) mtm_palette_free(palette);
}

mtm_status mtm_palette_parse(const char *document, const char *text, const char *folder, mtm_palette *palette,
                             mtm_error *error) {
    static const char *const keys[] = {"metamer", "materials", "lights"};
    json_t *object = NULL;
    *palette = (mtm_palette){0};
    const mtm_status status = mtm_json_parse(document, text, strlen(text), &object, error);
    if (status != MTM_OK) return status;
    mtm_json_reader reader = mtm_json_begin(document, error);
    if (mtm_json_expect_object(&reader, object, keys, sizeof keys / sizeof *keys))
        mtm_json_expect_version(&reader, object);
    if (reader.status == MTM_OK) mtm_palette_from_json(&reader, object, folder, palette);
    json_decref(object);
    return reader.status;
}

mtm_status mtm_palette_read(const char *path, mtm_palette *palette, mtm_error *error) {
    char *text = NULL;
    mtm_status status = mtm_json_read_text(path, &text, error);
    if (status != MTM_OK) return status;
    char *folder = mtm_path_folder(path);
    if (folder == NULL)
        status = mtm_fail_memory(error, path, strlen(path));
    else
        status = mtm_palette_parse(path, text, folder, palette, error);
    free(folder);
    free(text);
    return status;
}

static json_t *spectrum_to_json(const char *name, const mtm_spectrum *spectrum) {
    json_t *values = json_array();
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        (void)json_array_append_new(values, json_real(spectrum->value[i]));
    return json_pack("{s:s, s:o}", "name", name, "values", values);
}

json_t *mtm_palette_to_json(const mtm_palette *palette) {
    json_t *materials = json_array();
    json_t *lights = json_array();
    for (int i = 0; i < palette->material_count; i++)
        (void)json_array_append_new(
            materials, spectrum_to_json(palette->materials[i].name, &palette->materials[i].reflectance));
    for (int i = 0; i < palette->light_count; i++)
        (void)json_array_append_new(lights,
                                    spectrum_to_json(palette->lights[i].name, &palette->lights[i].emission));
    return json_pack("{s:o, s:o}", "materials", materials, "lights", lights);
}

char *mtm_palette_format(const mtm_palette *palette) {
    json_t *object = mtm_palette_to_json(palette);
    char *text = object == NULL ? NULL : mtm_json_format(object, true);
    json_decref(object);
    return text;
}
