/* SPDX-License-Identifier: BSD-3-Clause
 * What a palette shows: the colors of all its materials under all its lights to normal and color-blind eyes, and what its
 * metamers could be. */
#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "base/memory.h"
#include "metamer/palette.h"

static mtm_lab *color_at(const mtm_analysis *analysis, mtm_vision vision, int material, int light) {
    const size_t row = (size_t)vision * (size_t)analysis->light_count + (size_t)light;
    return &analysis->colors[row * (size_t)analysis->material_count + (size_t)material];
}

static void find_colors(const mtm_palette *palette, const mtm_illumination *lights, mtm_analysis *analysis) {
    for (int light = 0; light < palette->light_count; light++)
        for (int i = 0; i < palette->material_count; i++) {
            const mtm_rgb shown =
                mtm_rgb_clip(mtm_illuminate(&lights[light], &palette->materials[i].reflectance));
            for (int n = 0; n < MTM_VISION_COUNT; n++) {
                const mtm_vision vision = (mtm_vision)n;
                *color_at(analysis, vision, i, light) = mtm_lab_shown(mtm_vision_see(vision, 1, shown));
            }
        }
}

static mtm_status find_largest(const mtm_illumination *match, const mtm_illumination *other, mtm_rgb color,
                               double bend, double *largest, mtm_error *error) {
    mtm_mismatch mismatch;
    const mtm_status status = mtm_mismatch_find(match, other, color, bend, &mismatch, error);
    *largest = status == MTM_OK ? mismatch.separation : NAN;
    return status == MTM_NUMERIC ? MTM_OK : status;
}

/* How far two that match part under another light, and what others of their color, that of their mean, could do. */
static mtm_status add_metamers(const mtm_palette *palette, const mtm_illumination *lights, mtm_metamers found,
                               mtm_analysis *analysis, mtm_error *error) {
    const mtm_illumination *match = &lights[found.match_light];
    const mtm_illumination *other = &lights[found.other_light];
    const int a = found.materials[0];
    const int b = found.materials[1];
    const mtm_rgb rgb_a = mtm_illuminate(match, &palette->materials[a].reflectance);
    const mtm_rgb rgb_b = mtm_illuminate(match, &palette->materials[b].reflectance);
    const mtm_rgb color = {(rgb_a.r + rgb_b.r) / 2, (rgb_a.g + rgb_b.g) / 2, (rgb_a.b + rgb_b.b) / 2};
    found.difference =
        mtm_analysis_difference(analysis, MTM_VISION_NORMAL, a, found.other_light, b, found.other_light);
    mtm_status status = find_largest(match, other, color, 0, &found.largest, error);
    if (status == MTM_OK)
        status = find_largest(match, other, color, MTM_MISMATCH_BEND_SMOOTH, &found.largest_smooth, error);
    if (status == MTM_OK) analysis->metamers[analysis->metamer_count++] = found;
    return status;
}

/* Two that are both black have no color in which to match. */
static bool do_match(const mtm_analysis *analysis, int a, int b, int light) {
    if (mtm_analysis_from_black(analysis, MTM_VISION_NORMAL, a, light) <= MTM_DIFFERENCE_INVISIBLE &&
        mtm_analysis_from_black(analysis, MTM_VISION_NORMAL, b, light) <= MTM_DIFFERENCE_INVISIBLE)
        return false;
    return mtm_verdict_of(mtm_analysis_difference(analysis, MTM_VISION_NORMAL, a, light, b, light)) ==
           MTM_VERDICT_MATCH;
}

/* A pair that matches, under all other lights. Those there is no room for are counted without a look, since there may be 200
 * million. */
static mtm_status follow_pair(const mtm_palette *palette, const mtm_illumination *lights, int a, int b,
                              int match, mtm_analysis *analysis, mtm_error *error) {
    mtm_status status = MTM_OK;
    const int room = MTM_METAMERS_MAX - analysis->metamer_count;
    const int other_count = palette->light_count - 1;
    for (int n = 0; n < other_count && n < room && status == MTM_OK; n++) {
        const mtm_metamers found = {
            .materials = {a, b}, .match_light = match, .other_light = n < match ? n : n + 1};
        status = add_metamers(palette, lights, found, analysis, error);
    }
    if (other_count > room) analysis->metamers_left_out += other_count - room;
    return status;
}

static mtm_status find_metamers(const mtm_palette *palette, const mtm_illumination *lights,
                                mtm_analysis *analysis, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int light = 0; light < palette->light_count; light++)
        for (int a = 0; a < palette->material_count; a++)
            for (int b = a + 1; b < palette->material_count && status == MTM_OK; b++)
                if (do_match(analysis, a, b, light))
                    status = follow_pair(palette, lights, a, b, light, analysis, error);
    return status;
}

static void illuminate(const mtm_palette *palette, const mtm_observer *observer, double adapted_y,
                       mtm_illumination *lights) {
    double weights[MTM_LIGHTS_MAX] = {0};
    for (int i = 0; i < palette->light_count; i++) {
        weights[i] = 1;
        const mtm_spectrum light = mtm_palette_mix(palette, weights, 1);
        lights[i] = mtm_illumination_of(&light, observer, adapted_y);
        weights[i] = 0;
    }
}

mtm_status mtm_palette_analyze(const mtm_palette *palette, const mtm_observer *observer, double adapted_y,
                               mtm_analysis *analysis, mtm_error *error) {
    const size_t light_count = (size_t)palette->light_count;
    const size_t cell_count = light_count * (size_t)palette->material_count;
    mtm_illumination *lights = mtm_allocate_unset(light_count, sizeof *lights);
    mtm_status status = MTM_OK;
    *analysis = (mtm_analysis){.material_count = palette->material_count,
                               .light_count = palette->light_count,
                               .colors = mtm_allocate(MTM_VISION_COUNT * cell_count, sizeof(mtm_lab))};
    if (lights == NULL || analysis->colors == NULL) {
        status = mtm_fail_memory(error, "the colors of a palette", cell_count * sizeof(mtm_lab));
    } else {
        illuminate(palette, observer, adapted_y, lights);
        find_colors(palette, lights, analysis);
        status = find_metamers(palette, lights, analysis, error);
    }
    free(lights);
    if (status != MTM_OK) mtm_analysis_free(analysis);
    return status;
}

void mtm_analysis_free(mtm_analysis *analysis) {
    free(analysis->colors);
    *analysis = (mtm_analysis){0};
}

mtm_verdict mtm_verdict_of(double ciede2000) {
    if (ciede2000 <= MTM_DIFFERENCE_MATCH) return MTM_VERDICT_MATCH;
    return ciede2000 <= MTM_DIFFERENCE_SIMILAR ? MTM_VERDICT_SIMILAR : MTM_VERDICT_DIFFER;
}

double mtm_analysis_difference(const mtm_analysis *analysis, mtm_vision vision, int material, int light,
                               int other_material, int other_light) {
    return mtm_ciede2000(*color_at(analysis, vision, material, light),
                         *color_at(analysis, vision, other_material, other_light));
}

double mtm_analysis_from_black(const mtm_analysis *analysis, mtm_vision vision, int material, int light) {
    return mtm_ciede2000(*color_at(analysis, vision, material, light), (mtm_lab){0, 0, 0});
}
