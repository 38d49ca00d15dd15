/* SPDX-License-Identifier: BSD-3-Clause
 * Random goals documents (docs/design.md). The spectra behind them are physical: series of cosines through a logistic
 * curve, reflectances of sRGB colors, standard illuminants, bands. Metamers and constant colors are made by adding metameric
 * blacks (G. Wyszecki, Farbe 2, 1953): what is orthogonal to all three sensitivities under a light. Black cells are made by
 * cutting material and light at one wavelength. */
#include "bench_goals.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N = MTM_SPECTRUM_SAMPLES, MATERIALS = 4, LIGHTS = 3, EDGE = BENCH_GRID_EDGE, SOURCE_BYTES = 16 };

static const double pi = 3.14159265358979323846;

/* Splitmix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014). */
typedef struct random_source {
    uint64_t state;
} random_source;

static double draw(random_source *random) {
    uint64_t z = random->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static double draw_between(random_source *random, double low, double high) {
    return low + (high - low) * draw(random);
}

static int draw_index(random_source *random, int count) {
    return (int)(draw(random) * count);
}

/* A spectrum behind the document. */
typedef struct hidden_spectrum {
    mtm_spectrum spectrum;
    bool is_designed;
    bool is_bound;                                  /* a goal hangs on its shape */
    char source[SOURCE_BYTES], value[SOURCE_BYTES]; /* "illuminant", "D65"; "" where only its values tell */
} hidden_spectrum;

typedef struct goals_maker {
    random_source random;
    bench_goals_kind kind;
    mtm_observer observer;
    int material_count, light_count;
    hidden_spectrum materials[EDGE], lights[EDGE];
    bool is_told[EDGE][EDGE]; /* a goal says already what the cell looks like */
    json_t *goals;
} goals_maker;

/* --- spectra --- */

/* Σ aₖ·cos(kπt + φₖ), higher terms smaller. */
static mtm_spectrum draw_series(random_source *random, int terms, double amplitude) {
    mtm_spectrum sum = mtm_spectrum_constant(amplitude * draw_between(random, -0.6, 0.6));
    for (int k = 1; k <= terms; k++) {
        const double size = amplitude * draw_between(random, -1, 1) / k;
        const double phase = draw_between(random, 0, 2 * pi);
        for (int i = 0; i < N; i++) sum.value[i] += size * cos(k * pi * i / (N - 1) + phase);
    }
    return sum;
}

/* Six decimals are what a document says; the hidden spectrum is that same one. */
static void round_spectrum(mtm_spectrum *spectrum) {
    for (int i = 0; i < N; i++) spectrum->value[i] = round(spectrum->value[i] * 1e6) / 1e6;
}

/* A light's largest value becomes 1. */
static void scale_light(mtm_spectrum *light) {
    double largest = 0;
    for (int i = 0; i < N; i++) largest = fmax(largest, light->value[i]);
    *light = mtm_spectrum_scale(light, 1 / largest);
    round_spectrum(light);
}

static mtm_spectrum draw_reflectance(random_source *random) {
    mtm_spectrum reflectance = draw_series(random, 4, 3);
    for (int i = 0; i < N; i++) reflectance.value[i] = 0.03 + 0.92 / (1 + exp(-reflectance.value[i]));
    round_spectrum(&reflectance);
    return reflectance;
}

static mtm_spectrum draw_smooth_light(random_source *random) {
    mtm_spectrum light = draw_series(random, 3, 1);
    for (int i = 0; i < N; i++) light.value[i] = exp(light.value[i]);
    scale_light(&light);
    return light;
}

/* Three bands, as of colored diodes, over a little of everything. */
static mtm_spectrum draw_bands(random_source *random) {
    static const double centers_nm[3] = {460, 540, 620};
    mtm_spectrum light = mtm_spectrum_constant(0.02);
    for (int k = 0; k < 3; k++) {
        const double center = centers_nm[k] + draw_between(random, -20, 20);
        const double width = draw_between(random, 12, 40);
        const double size = draw_between(random, 0.3, 1);
        for (int i = 0; i < N; i++) {
            const double x = (MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * i - center) / width;
            light.value[i] += size * exp(-0.5 * x * x);
        }
    }
    scale_light(&light);
    return light;
}

static mtm_status draw_srgb(random_source *random, hidden_spectrum *material, mtm_error *error) {
    mtm_rgb rgb;
    /* One statement each, so that every compiler draws them in the same order. */
    const int blue = 20 + draw_index(random, 216);
    const int green = 20 + draw_index(random, 216);
    const int red = 20 + draw_index(random, 216);
    (void)snprintf(material->source, SOURCE_BYTES, "srgb");
    (void)snprintf(material->value, SOURCE_BYTES, "#%02x%02x%02x", red, green, blue);
    const mtm_status status = mtm_rgb_parse(material->value, &rgb, error);
    return status == MTM_OK ? mtm_reflectance_of_rgb(rgb, &material->spectrum, error) : status;
}

static mtm_status set_illuminant(const char *name, hidden_spectrum *light, mtm_error *error) {
    (void)snprintf(light->source, SOURCE_BYTES, "illuminant");
    (void)snprintf(light->value, SOURCE_BYTES, "%s", name);
    return mtm_illuminant(name, &light->spectrum, error);
}

static mtm_status draw_material(random_source *random, hidden_spectrum *material, mtm_error *error) {
    *material = (hidden_spectrum){.is_designed = draw(random) < 0.65};
    if (draw(random) < 0.4) return draw_srgb(random, material, error);
    material->spectrum = draw_reflectance(random);
    return MTM_OK;
}

static mtm_status draw_light(random_source *random, hidden_spectrum *light, mtm_error *error) {
    static const char *const names[] = {"D65", "D50", "A", "E", "FL2", "FL11", "LED-B3", "LED-RGB1"};
    *light = (hidden_spectrum){.is_designed = draw(random) < 0.5};
    const double choice = draw(random);
    if (choice < 0.5) return set_illuminant(names[draw_index(random, 8)], light, error);
    light->spectrum = choice < 0.75 ? draw_smooth_light(random) : draw_bands(random);
    return MTM_OK;
}

/* What no name tells any more. */
static void change_spectrum(hidden_spectrum *hidden, const mtm_spectrum *spectrum) {
    hidden->spectrum = *spectrum;
    hidden->source[0] = '\0';
    hidden->is_bound = true;
}

/* --- metameric blacks --- */

static double dot(const mtm_spectrum *a, const mtm_spectrum *b) {
    double sum = 0;
    for (int i = 0; i < N; i++) sum += a->value[i] * b->value[i];
    return sum;
}

static void subtract(mtm_spectrum *from, double factor, const mtm_spectrum *what) {
    for (int i = 0; i < N; i++) from->value[i] -= factor * what->value[i];
}

/* A random smooth spectrum without its part that is seen through `filter`, a light or a material; a light's luminance on
 * white, to which lights are scaled, stays as it is, too. Gram, Schmidt. */
static mtm_spectrum draw_black(goals_maker *maker, const mtm_spectrum *filter, bool is_light) {
    const mtm_observer *observer = &maker->observer;
    mtm_spectrum seen[4] = {mtm_spectrum_multiply(&observer->x, filter),
                            mtm_spectrum_multiply(&observer->y, filter),
                            mtm_spectrum_multiply(&observer->z, filter), observer->y};
    mtm_spectrum black = draw_series(&maker->random, 6, 1);
    for (int c = 0; c < (is_light ? 4 : 3); c++) {
        for (int k = 0; k < c; k++) subtract(&seen[c], dot(&seen[c], &seen[k]), &seen[k]);
        seen[c] = mtm_spectrum_scale(&seen[c], 1 / sqrt(dot(&seen[c], &seen[c])));
        subtract(&black, dot(&black, &seen[c]), &seen[c]);
    }
    return black;
}

/* `from` and as much of a black that it stays physical; false where that is hardly any. */
static bool draw_metamer(goals_maker *maker, const mtm_spectrum *from, const mtm_spectrum *filter,
                         bool is_light, mtm_spectrum *metamer) {
    static const double share = 0.9; /* of the most there could be */
    static const double hardly = 0.02;
    const mtm_spectrum black = draw_black(maker, filter, is_light);
    double most = INFINITY;
    double largest = 0;
    for (int i = 0; i < N; i++) {
        const double room = black.value[i] < 0 ? from->value[i] : is_light ? INFINITY : 1 - from->value[i];
        if (black.value[i] != 0) most = fmin(most, room / fabs(black.value[i]));
        largest = fmax(largest, fabs(black.value[i]));
    }
    *metamer = *from;
    subtract(metamer, -share * most, &black);
    for (int i = 0; i < N; i++) metamer->value[i] = fmax(0, metamer->value[i]);
    return isfinite(most) && share * most * largest > hardly;
}

/* --- cells --- */

static bool is_cell_designed(const goals_maker *maker, mtm_cell cell) {
    return maker->materials[cell.material].is_designed || maker->lights[cell.light].is_designed;
}

/* The hidden palette's color of a cell. */
static mtm_status look_at(const goals_maker *maker, mtm_cell cell, mtm_xyz *color, mtm_error *error) {
    mtm_spectrum light;
    const mtm_status status =
        mtm_light_normalize(&maker->lights[cell.light].spectrum, &maker->observer, &light, error);
    if (status != MTM_OK) return status;
    const mtm_illumination illumination = mtm_illumination_of(&light, &maker->observer, 0);
    *color = mtm_xyz_from_rgb(mtm_illuminate(&illumination, &maker->materials[cell.material].spectrum));
    return MTM_OK;
}

static double difference_of(mtm_xyz a, mtm_xyz b) {
    const mtm_xyz white = mtm_white_d65();
    return mtm_ciede2000(mtm_lab_from_xyz(a, white), mtm_lab_from_xyz(b, white));
}

static json_t *name_spectrum(const char *kind, int index) {
    return json_sprintf("%s %d", kind, index + 1);
}

static json_t *name_cell(mtm_cell cell) {
    return json_pack("{s:o, s:o}", "material", name_spectrum("material", cell.material), "light",
                     name_spectrum("light", cell.light));
}

/* Adds a goal, its cell beside the one key that says what is asked. */
static json_t *add_goal(goals_maker *maker, mtm_cell cell, const char *key, json_t *value) {
    json_t *goal = name_cell(cell);
    (void)json_object_set_new(goal, key, value);
    (void)json_array_append_new(maker->goals, goal);
    return goal;
}

/* As "#rrggbb" where that is near enough, else in numbers; not at all where the numbers would be too large. */
static void add_color(goals_maker *maker, mtm_cell cell, mtm_xyz color) {
    static const double near = 0.5; /* CIEDE2000 */
    static const double largest_xyz = 2;
    static const double largest_lab = 200;
    char hex[8];
    mtm_rgb shown = {0, 0, 0};
    const mtm_lab lab = mtm_lab_from_xyz(color, mtm_white_d65());
    const bool is_lab = draw(&maker->random) < 0.5;
    const bool is_in_numbers = draw(&maker->random) < 0.3;
    mtm_rgb_format(mtm_rgb_from_xyz(color), hex);
    const bool is_parsed = mtm_rgb_parse(hex, &shown, NULL) == MTM_OK;
    if (!is_in_numbers && is_parsed && difference_of(mtm_xyz_from_rgb(shown), color) < near)
        (void)add_goal(maker, cell, "srgb", json_string(hex));
    else if (is_lab && lab.l <= 100 && fabs(lab.a) <= largest_lab && fabs(lab.b) <= largest_lab)
        (void)add_goal(maker, cell, "lab", json_pack("[f,f,f]", lab.l, lab.a, lab.b));
    else if (color.x <= largest_xyz && color.y <= largest_xyz && color.z <= largest_xyz)
        (void)add_goal(maker, cell, "xyz", json_pack("[f,f,f]", color.x, color.y, color.z));
}

static mtm_xyz draw_color(random_source *random) {
    const double red = mtm_srgb_decode(draw(random));
    const double green = mtm_srgb_decode(draw(random));
    const double blue = mtm_srgb_decode(draw(random));
    return mtm_xyz_from_rgb((mtm_rgb){red, green, blue});
}

/* --- relations, for which the hidden palette is changed --- */

static mtm_cell draw_cell(goals_maker *maker) {
    const int material = draw_index(&maker->random, maker->material_count);
    return (mtm_cell){material, draw_index(&maker->random, maker->light_count)};
}

static void tell(goals_maker *maker, mtm_cell cell) {
    maker->is_told[cell.material][cell.light] = true;
    maker->materials[cell.material].is_bound = maker->lights[cell.light].is_bound = true;
}

/* The material reflects only beyond a wavelength, the light shines only before it, or the other way round. */
static void relate_black(goals_maker *maker) {
    const mtm_cell cell = draw_cell(maker);
    hidden_spectrum *material = &maker->materials[cell.material];
    hidden_spectrum *light = &maker->lights[cell.light];
    const int cut = 24 + draw_index(&maker->random, 25); /* 500 … 620 nm */
    const bool is_low = draw(&maker->random) < 0.5;
    if (material->is_bound || light->is_bound) return;
    mtm_spectrum reflectance = material->spectrum;
    mtm_spectrum emission = light->spectrum;
    for (int i = 0; i < N; i++) ((i < cut) == is_low ? &reflectance : &emission)->value[i] = 0;
    scale_light(&emission);
    round_spectrum(&reflectance);
    change_spectrum(material, &reflectance);
    change_spectrum(light, &emission);
    if (!is_cell_designed(maker, cell)) material->is_designed = true;
    tell(maker, cell);
    (void)add_goal(maker, cell, "black", json_true());
}

/* The first cell looks like the second, whose color is still to be said. */
static void tell_same(goals_maker *maker, mtm_cell cell, mtm_cell other, const char *key, json_t *value) {
    tell(maker, cell);
    tell(maker, other);
    maker->is_told[other.material][other.light] = false;
    (void)add_goal(maker, cell, "same_as", json_pack("{s:o}", key, value));
}

/* Two materials that look alike under a light. */
static void relate_metamers(goals_maker *maker) {
    const mtm_cell other = draw_cell(maker);
    const mtm_cell cell = {draw_index(&maker->random, maker->material_count), other.light};
    hidden_spectrum *material = &maker->materials[cell.material];
    hidden_spectrum *pattern = &maker->materials[other.material];
    mtm_spectrum metamer;
    if (material == pattern || material->is_bound || pattern->is_bound) return;
    if (!draw_metamer(maker, &pattern->spectrum, &maker->lights[cell.light].spectrum, 1, &metamer)) return;
    round_spectrum(&metamer);
    change_spectrum(material, &metamer);
    if (!is_cell_designed(maker, cell)) material->is_designed = true;
    tell_same(maker, cell, other, "material", name_spectrum("material", other.material));
}

/* Two lights under which a material keeps its color. */
static void relate_constant(goals_maker *maker) {
    const mtm_cell other = draw_cell(maker);
    const mtm_cell cell = {other.material, draw_index(&maker->random, maker->light_count)};
    hidden_spectrum *light = &maker->lights[cell.light];
    hidden_spectrum *pattern = &maker->lights[other.light];
    const mtm_spectrum *filter = &maker->materials[cell.material].spectrum;
    mtm_spectrum metamer;
    if (light == pattern || light->is_bound || pattern->is_bound) return;
    if (!draw_metamer(maker, &pattern->spectrum, filter, true, &metamer)) return;
    scale_light(&metamer);
    change_spectrum(light, &metamer);
    if (!is_cell_designed(maker, cell)) light->is_designed = true;
    tell_same(maker, cell, other, "light", name_spectrum("light", other.light));
}

/* --- goals --- */

static mtm_status add_cell_color(goals_maker *maker, mtm_cell cell, mtm_error *error) {
    mtm_xyz color = {0, 0, 0};
    const mtm_status status = look_at(maker, cell, &color, error);
    if (status != MTM_OK) return status;
    if (maker->kind == BENCH_GOALS_FREE) color = draw_color(&maker->random);
    add_color(maker, cell, color);
    return MTM_OK;
}

static mtm_status add_colors(goals_maker *maker, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int k = 0; k < maker->light_count; k++) {
        for (int i = 0; i < maker->material_count && status == MTM_OK; i++) {
            const mtm_cell cell = {i, k};
            const bool is_wanted = draw(&maker->random) < 0.7;
            if (is_wanted && !maker->is_told[i][k] && is_cell_designed(maker, cell))
                status = add_cell_color(maker, cell, error);
        }
    }
    return status;
}

/* Two cells, or a cell and black, that are to differ: by less than they do in the hidden palette, or by anything. */
static mtm_status add_difference(goals_maker *maker, bool is_from_black, mtm_error *error) {
    static const double least = 5;
    static const double most = 20;
    static const double share = 0.8; /* of the difference that the hidden palette has */
    const mtm_cell cell = draw_cell(maker);
    const mtm_cell other = draw_cell(maker);
    const double asked = draw_between(&maker->random, least, most);
    mtm_xyz own = {0, 0, 0};
    mtm_xyz from = {0, 0, 0};
    mtm_status status = look_at(maker, cell, &own, error);
    if (status == MTM_OK && !is_from_black) status = look_at(maker, other, &from, error);
    const double room = share * difference_of(own, from);
    if (status != MTM_OK || room < least) return status;
    if (!is_cell_designed(maker, cell) && (is_from_black || !is_cell_designed(maker, other))) return status;
    json_t *goal =
        add_goal(maker, cell, "differs_from", is_from_black ? json_string("black") : name_cell(other));
    const double by = maker->kind == BENCH_GOALS_FREE ? asked : fmin(asked, room);
    (void)json_object_set_new(goal, "by", json_real(floor(by * 10) / 10));
    return MTM_OK;
}

static mtm_status add_goals(goals_maker *maker, mtm_error *error) {
    if (draw(&maker->random) < 0.25) relate_black(maker);
    if (draw(&maker->random) < 0.5) relate_metamers(maker);
    if (draw(&maker->random) < 0.4) relate_constant(maker);
    mtm_status status = add_colors(maker, error);
    for (int i = 0; i < 2 && status == MTM_OK; i++)
        if (draw(&maker->random) < 0.4) status = add_difference(maker, false, error);
    if (status == MTM_OK && draw(&maker->random) < 0.2) status = add_difference(maker, true, error);
    return status;
}

/* --- documents --- */

static json_t *describe_spectrum(const char *kind, int index, const hidden_spectrum *hidden) {
    json_t *described = json_pack("{s:o}", "name", name_spectrum(kind, index));
    json_t *values = json_array();
    for (int i = 0; i < N; i++) (void)json_array_append_new(values, json_real(hidden->spectrum.value[i]));
    if (hidden->is_designed)
        (void)json_object_set_new(described, "design", json_string("physical"));
    else if (hidden->source[0] != '\0')
        (void)json_object_set_new(described, hidden->source, json_string(hidden->value));
    else
        (void)json_object_set(described, "values", values);
    json_decref(values);
    return described;
}

static mtm_status format_document(const goals_maker *maker, char **text, mtm_error *error) {
    json_t *materials = json_array();
    json_t *lights = json_array();
    for (int i = 0; i < maker->material_count; i++)
        (void)json_array_append_new(materials, describe_spectrum("material", i, &maker->materials[i]));
    for (int k = 0; k < maker->light_count; k++)
        (void)json_array_append_new(lights, describe_spectrum("light", k, &maker->lights[k]));
    json_t *document = json_pack("{s:i, s:o, s:o, s:O}", "metamer", 1, "materials", materials, "lights",
                                 lights, "goals", maker->goals);
    *text = document == NULL ? NULL : json_dumps(document, JSON_COMPACT | JSON_REAL_PRECISION(9));
    json_decref(document);
    if (*text != NULL) return MTM_OK;
    (void)snprintf(error->message, sizeof error->message, "out of memory for a goals document");
    return MTM_MEMORY;
}

static mtm_status draw_palette(goals_maker *maker, mtm_error *error) {
    mtm_status status = mtm_observer_get("cie1931", &maker->observer, error);
    for (int i = 0; i < maker->material_count && status == MTM_OK; i++)
        status = draw_material(&maker->random, &maker->materials[i], error);
    for (int k = 0; k < maker->light_count && status == MTM_OK; k++)
        status = draw_light(&maker->random, &maker->lights[k], error);
    return status;
}

/* A palette whose goals may turn out to be none. */
static mtm_status draw_document(goals_maker *maker, mtm_error *error) {
    const int first_designed = draw_index(&maker->random, MATERIALS);
    maker->material_count = 1 + draw_index(&maker->random, MATERIALS);
    maker->light_count = 1 + draw_index(&maker->random, LIGHTS);
    mtm_status status = draw_palette(maker, error);
    maker->materials[first_designed % maker->material_count].is_designed = true;
    if (status == MTM_OK) status = add_goals(maker, error);
    return status;
}

mtm_status make_random_goals(bench_goals_kind kind, int index, char **text, mtm_error *error) {
    goals_maker maker = {.kind = kind, .random = {(uint64_t)kind << 32 | (uint64_t)index}};
    mtm_status status = MTM_OK;
    do {
        json_decref(maker.goals);
        maker = (goals_maker){.kind = kind, .random = maker.random, .goals = json_array()};
        status = draw_document(&maker, error);
    } while (status == MTM_OK && json_array_size(maker.goals) == 0);
    if (status == MTM_OK) status = format_document(&maker, text, error);
    json_decref(maker.goals);
    return status;
}

mtm_status make_grid_goals(int material_count, int light_count, const char *const *illuminants,
                           int goal_count, char **text, mtm_error *error) {
    goals_maker maker = {.material_count = material_count, .light_count = light_count, .goals = json_array()};
    mtm_status status = draw_palette(&maker, error);
    for (int i = 0; i < material_count; i++) maker.materials[i].is_designed = true;
    for (int k = 0; k < light_count && status == MTM_OK; k++) {
        maker.lights[k].is_designed = illuminants == NULL;
        if (illuminants != NULL) status = set_illuminant(illuminants[k], &maker.lights[k], error);
    }
    for (int i = 0; i < goal_count && status == MTM_OK; i++)
        status = add_cell_color(&maker, (mtm_cell){i % material_count, i / material_count}, error);
    if (status == MTM_OK) status = format_document(&maker, text, error);
    json_decref(maker.goals);
    return status;
}
