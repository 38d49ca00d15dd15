/* SPDX-License-Identifier: BSD-3-Clause
 * Materials and lights. */
#include "metamer/palette.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/nearest.h"
#include "metamer/basis.h"

_Static_assert(MTM_MATERIALS_MAX + 1 == MTM_DIMENSION_MAX, "a palette and white fill the largest basis");

void mtm_palette_free(mtm_palette *palette) {
    free(palette->materials);
    free(palette->lights);
    *palette = (mtm_palette){0};
}

static mtm_status allocate(int material_count, int light_count, mtm_palette *palette, mtm_error *error) {
    *palette = (mtm_palette){.material_count = material_count,
                             .materials = mtm_allocate((size_t)material_count, sizeof *palette->materials),
                             .light_count = light_count,
                             .lights = mtm_allocate((size_t)light_count, sizeof *palette->lights)};
    if (palette->materials != NULL && palette->lights != NULL) return MTM_OK;
    mtm_palette_free(palette);
    return mtm_fail_memory(error, "the palette",
                           (size_t)material_count * sizeof *palette->materials +
                               (size_t)light_count * sizeof *palette->lights);
}

mtm_status mtm_palette_copy(const mtm_palette *palette, mtm_palette *copy, mtm_error *error) {
    const mtm_status status = allocate(palette->material_count, palette->light_count, copy, error);
    if (status != MTM_OK) return status;
    memcpy(copy->materials, palette->materials, (size_t)palette->material_count * sizeof *copy->materials);
    memcpy(copy->lights, palette->lights, (size_t)palette->light_count * sizeof *copy->lights);
    return MTM_OK;
}

/* A cool haze, warm flesh and a bright core stay apart under all three lights, and the tube's narrow bands move
 * them differently than the lamp does. */
static const struct {
    const char *name, *color;
} default_materials[] = {{"soft", "#5b8fc7"}, {"middle", "#d99a4e"}, {"dense", "#f1ead9"}};

static const struct {
    const char *name, *illuminant;
} default_lights[] = {{"daylight", "D65"}, {"lamp", "A"}, {"tube", "FL11"}};

mtm_status mtm_palette_defaults(mtm_palette *palette, mtm_error *error) {
    mtm_status status = allocate(3, 3, palette, error);
    for (int i = 0; i < 3 && status == MTM_OK; i++) {
        mtm_material *material = &palette->materials[i];
        mtm_light *light = &palette->lights[i];
        mtm_rgb color = {0};
        (void)snprintf(material->name, sizeof material->name, "%s", default_materials[i].name);
        (void)snprintf(light->name, sizeof light->name, "%s", default_lights[i].name);
        status = mtm_rgb_parse(default_materials[i].color, &color, error);
        if (status == MTM_OK) status = mtm_reflectance_of_rgb(color, &material->reflectance, error);
        if (status == MTM_OK) status = mtm_illuminant(default_lights[i].illuminant, &light->emission, error);
    }
    if (status != MTM_OK) mtm_palette_free(palette);
    return status;
}

int mtm_palette_find_material(const mtm_palette *palette, const char *name) {
    for (int i = 0; i < palette->material_count; i++)
        if (strcmp(palette->materials[i].name, name) == 0) return i;
    return -1;
}

int mtm_palette_find_light(const mtm_palette *palette, const char *name) {
    for (int i = 0; i < palette->light_count; i++)
        if (strcmp(palette->lights[i].name, name) == 0) return i;
    return -1;
}

const char *mtm_palette_nearest_material(const mtm_palette *palette, const char *name) {
    const char *names[MTM_MATERIALS_MAX];
    const int count =
        palette->material_count < MTM_MATERIALS_MAX ? palette->material_count : MTM_MATERIALS_MAX;
    for (int i = 0; i < count; i++) names[i] = palette->materials[i].name;
    return count > 0 ? mtm_nearest_name(name, names, (size_t)count) : "";
}

const char *mtm_palette_nearest_light(const mtm_palette *palette, const char *name) {
    const char *names[MTM_LIGHTS_MAX];
    const int count = palette->light_count < MTM_LIGHTS_MAX ? palette->light_count : MTM_LIGHTS_MAX;
    for (int i = 0; i < count; i++) names[i] = palette->lights[i].name;
    return count > 0 ? mtm_nearest_name(name, names, (size_t)count) : "";
}

mtm_spectrum mtm_palette_mix(const mtm_palette *palette, const double *weights, double intensity) {
    mtm_observer observer;
    mtm_spectrum mixed = mtm_spectrum_constant(0);
    if (mtm_observer_get("cie1931", &observer, NULL) != MTM_OK) return mixed; /* built in, always there */
    for (int i = 0; i < palette->light_count; i++) {
        mtm_spectrum light;
        if (weights[i] == 0) continue;
        if (mtm_light_normalize(&palette->lights[i].emission, &observer, &light, NULL) != MTM_OK) continue;
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
            mixed.value[k] += intensity * weights[i] * light.value[k];
    }
    return mixed;
}

static int take_reflectances(mtm_palette *palette, const mtm_palette *other) {
    int taken = 0;
    for (int i = 0; i < palette->material_count; i++) {
        const int match = mtm_palette_find_material(other, palette->materials[i].name);
        if (match < 0) continue;
        palette->materials[i] = other->materials[match];
        taken++;
    }
    return taken;
}

mtm_status mtm_palette_override(mtm_palette *palette, const mtm_palette *other, mtm_error *error) {
    mtm_palette result;
    const int light_limit = palette->light_count + other->light_count;
    if (light_limit > MTM_LIGHTS_MAX)
        return mtm_fail(error, MTM_LIMIT, "%d lights are more than the %d a palette can hold", light_limit,
                        MTM_LIGHTS_MAX);
    mtm_status status = allocate(palette->material_count, light_limit, &result, error);
    if (status != MTM_OK) return status;
    memcpy(result.materials, palette->materials, (size_t)palette->material_count * sizeof *result.materials);
    memcpy(result.lights, palette->lights, (size_t)palette->light_count * sizeof *result.lights);
    result.light_count = palette->light_count;

    const int taken = take_reflectances(&result, other);
    for (int i = 0; i < other->light_count; i++) {
        const int match = mtm_palette_find_light(&result, other->lights[i].name);
        result.lights[match >= 0 ? match : result.light_count++] = other->lights[i];
    }
    if (taken == 0 && other->light_count == 0) {
        mtm_palette_free(&result);
        return mtm_fail(error, MTM_ARGUMENT,
                        "the new palette has no material that the old one knows, and no light");
    }
    mtm_palette_free(palette);
    *palette = result;
    return MTM_OK;
}
