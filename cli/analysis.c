/* SPDX-License-Identifier: BSD-3-Clause
 * The analysis of a palette as JSON. Lists that grow with the square of the palette are cut at a size and say so. */
#include "analysis.h"

#include <math.h>

#include "document.h"

enum { ENTRIES_MAX = 4096 /* of a list */ };

/* A list and what does not go on it. */
typedef struct bounded_list {
    json_t *entries;
    json_int_t left_out;
} bounded_list;

static bounded_list begin_list(void) {
    return (bounded_list){json_array(), 0};
}

static bool has_room(const bounded_list *list) {
    return json_array_size(list->entries) < ENTRIES_MAX;
}

static void add_entry(bounded_list *list, json_t *entry) {
    (void)json_array_append_new(list->entries, entry);
}

static const char *material_name(const mtm_palette *palette, int material) {
    return palette->materials[material].name;
}

static const char *light_name(const mtm_palette *palette, int light) {
    return palette->lights[light].name;
}

/* How a pair looks to all eyes under a light. */
typedef struct pair_look {
    double difference[MTM_VISION_COUNT];
    bool is_confused; /* normal eyes tell the two apart, others do not */
} pair_look;

static pair_look look_at_pair(const mtm_analysis *analysis, int light, int a, int b) {
    pair_look look = {.is_confused = false};
    for (int n = 0; n < MTM_VISION_COUNT; n++) {
        look.difference[n] = mtm_analysis_difference(analysis, (mtm_vision)n, a, light, b, light);
        if (mtm_verdict_of(look.difference[n]) != MTM_VERDICT_DIFFER &&
            mtm_verdict_of(look.difference[MTM_VISION_NORMAL]) == MTM_VERDICT_DIFFER)
            look.is_confused = true;
    }
    return look;
}

static json_t *describe_pair(const mtm_palette *palette, int light, int a, int b, const pair_look *look) {
    static const char *const verdicts[] = {"match", "similar", "differ"};
    json_t *differences = json_object();
    for (int n = 0; n < MTM_VISION_COUNT; n++)
        (void)json_object_set_new(differences, mtm_vision_name((mtm_vision)n),
                                  json_real(look->difference[n]));
    return json_pack("{s:s, s:[s,s], s:o, s:s}", "light", light_name(palette, light), "materials",
                     material_name(palette, a), material_name(palette, b), "ciede2000", differences,
                     "verdict", verdicts[mtm_verdict_of(look->difference[MTM_VISION_NORMAL])]);
}

/* All pairs, or of a large palette those that some eyes do not tell apart. */
static bounded_list list_pairs(const mtm_palette *palette, const mtm_analysis *analysis) {
    bounded_list list = begin_list();
    const int count = palette->material_count;
    const bool is_small = palette->light_count * (count * (count - 1) / 2) <= ENTRIES_MAX;
    for (int light = 0; light < palette->light_count; light++)
        for (int a = 0; a < count; a++)
            for (int b = a + 1; b < count; b++) {
                const pair_look look = look_at_pair(analysis, light, a, b);
                const bool is_notable =
                    is_small || look.is_confused ||
                    mtm_verdict_of(look.difference[MTM_VISION_NORMAL]) != MTM_VERDICT_DIFFER;
                if (is_notable && has_room(&list))
                    add_entry(&list, describe_pair(palette, light, a, b, &look));
                else
                    list.left_out++;
            }
    return list;
}

static bounded_list list_invisible(const mtm_palette *palette, const mtm_analysis *analysis) {
    bounded_list list = begin_list();
    for (int light = 0; light < palette->light_count; light++)
        for (int i = 0; i < palette->material_count; i++) {
            const double difference = mtm_analysis_from_black(analysis, MTM_VISION_NORMAL, i, light);
            if (difference > MTM_DIFFERENCE_INVISIBLE) continue;
            if (has_room(&list))
                add_entry(&list, json_pack("{s:s, s:s, s:f}", "light", light_name(palette, light), "material",
                                           material_name(palette, i), "ciede2000", difference));
            else
                list.left_out++;
        }
    return list;
}

/* Materials that two lights show alike; one that both leave black has no color to keep. */
static bounded_list list_constant(const mtm_palette *palette, const mtm_analysis *analysis) {
    bounded_list list = begin_list();
    for (int i = 0; i < palette->material_count; i++)
        for (int a = 0; a < palette->light_count; a++) {
            if (mtm_analysis_from_black(analysis, MTM_VISION_NORMAL, i, a) <= MTM_DIFFERENCE_INVISIBLE)
                continue;
            for (int b = a + 1; b < palette->light_count; b++) {
                const double difference = mtm_analysis_difference(analysis, MTM_VISION_NORMAL, i, a, i, b);
                if (mtm_verdict_of(difference) != MTM_VERDICT_MATCH) continue;
                if (has_room(&list))
                    add_entry(&list, json_pack("{s:s, s:[s,s], s:f}", "material", material_name(palette, i),
                                               "lights", light_name(palette, a), light_name(palette, b),
                                               "ciede2000", difference));
                else
                    list.left_out++;
            }
        }
    return list;
}

static json_t *number_or_null(double value) {
    return isfinite(value) ? json_real(value) : json_null();
}

static bounded_list list_metamers(const mtm_palette *palette, const mtm_analysis *analysis) {
    bounded_list list = begin_list();
    list.left_out = analysis->metamers_left_out;
    for (int n = 0; n < analysis->metamer_count; n++) {
        const mtm_metamers *found = &analysis->metamers[n];
        add_entry(&list, json_pack("{s:[s,s], s:s, s:s, s:f, s:o, s:o}", "materials",
                                   material_name(palette, found->materials[0]),
                                   material_name(palette, found->materials[1]), "match",
                                   light_name(palette, found->match_light), "other",
                                   light_name(palette, found->other_light), "ciede2000", found->difference,
                                   "largest", number_or_null(found->largest), "largest_smooth",
                                   number_or_null(found->largest_smooth)));
    }
    return list;
}

json_t *describe_analysis(const mtm_palette *palette, const mtm_observer *observer, double adapted_y) {
    mtm_analysis analysis;
    if (mtm_palette_analyze(palette, observer, adapted_y, &analysis, NULL) != MTM_OK) return NULL;
    const bounded_list pairs = list_pairs(palette, &analysis);
    const bounded_list invisible = list_invisible(palette, &analysis);
    const bounded_list constant = list_constant(palette, &analysis);
    const bounded_list metamers = list_metamers(palette, &analysis);
    mtm_analysis_free(&analysis);
    return json_pack("{s:{s:f, s:f, s:f}, s:o, s:o, s:o, s:o, s:{s:I, s:I, s:I, s:I}}", "thresholds", "match",
                     MTM_DIFFERENCE_MATCH, "similar", MTM_DIFFERENCE_SIMILAR, "invisible",
                     MTM_DIFFERENCE_INVISIBLE, "pairs", pairs.entries, "invisible", invisible.entries,
                     "constant", constant.entries, "metamers", metamers.entries, "left_out", "pairs",
                     pairs.left_out, "invisible", invisible.left_out, "constant", constant.left_out,
                     "metamers", metamers.left_out);
}
