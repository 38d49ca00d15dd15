/* SPDX-License-Identifier: BSD-3-Clause
 * What the parts of a design's picture share: colors, and how curves and names are drawn. */
#include "design_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char picture_ink[] = "#222222";
const char picture_pale_ink[] = "#5c5c5c"; /* 6.7:1 on white */

enum { CURVES_OF_PANEL = 6 };

/* --- colors --- */

mtm_rgb picture_cell(const design_picture *picture, mtm_cell cell) {
    return picture
        ->cells[(size_t)cell.material * (size_t)picture->design->palette.light_count + (size_t)cell.light];
}

static mtm_rgb brightest_as_one(mtm_rgb rgb) {
    const double most = fmax(fmax(rgb.r, rgb.g), fmax(rgb.b, 1e-9));
    return (mtm_rgb){rgb.r / most, rgb.g / most, rgb.b / most};
}

static void illuminate_all(design_picture *picture, double *weights, const mtm_observer *observer) {
    const mtm_palette *palette = &picture->design->palette;
    const mtm_spectrum white = mtm_spectrum_constant(1);
    for (int light = 0; light < palette->light_count; light++) {
        weights[light] = 1;
        const mtm_spectrum alone = mtm_palette_mix(palette, weights, 1);
        const mtm_illumination illumination = mtm_illumination_of(&alone, observer, 0);
        weights[light] = 0;
        picture->whites[light] = brightest_as_one(mtm_illuminate(&illumination, &white));
        for (int i = 0; i < palette->material_count; i++)
            picture->cells[(size_t)i * (size_t)palette->light_count + (size_t)light] =
                mtm_illuminate(&illumination, &palette->materials[i].reflectance);
    }
}

static mtm_lab lab_of(mtm_rgb rgb) {
    const mtm_rgb shown = {fmin(fmax(rgb.r, 0), 1), fmin(fmax(rgb.g, 0), 1), fmin(fmax(rgb.b, 0), 1)};
    return mtm_lab_from_xyz(mtm_xyz_from_rgb(shown), mtm_white_d65());
}

static bool is_asked(const design_picture *picture, mtm_cell cell) {
    bool is_found = false;
    for (int i = 0; i < picture->design->result_count; i++) {
        const mtm_cell asked = picture->design->results[i].goal.cell;
        is_found |= asked.material == cell.material && asked.light == cell.light;
    }
    return is_found;
}

/* A material's color under its brightest light, of those under which something was asked if there are any. */
static mtm_lab brightest_color(const design_picture *picture, int material) {
    mtm_lab best = {-1, 0, 0};
    bool is_best_asked = false;
    for (int i = 0; i < picture->design->palette.light_count; i++) {
        const mtm_cell cell = {material, i};
        const mtm_lab other = lab_of(picture_cell(picture, cell));
        const bool is_other_asked = is_asked(picture, cell);
        if (is_other_asked < is_best_asked || (is_other_asked == is_best_asked && other.l <= best.l))
            continue;
        best = other;
        is_best_asked = is_other_asked;
    }
    return best;
}

/* The color of a material's curve by the light that lends its colors, -1: its brightest; no lighter than what has a contrast
 * of 3:1 to white. */
static mtm_lab curve_color(const design_picture *picture, int material, int light) {
    static const double lightest = 60;
    mtm_lab color = light < 0 ? brightest_color(picture, material)
                              : lab_of(picture_cell(picture, (mtm_cell){material, light}));
    color.l = fmin(color.l, lightest);
    return color;
}

/* How well curves in the colors of a light can be told apart: the least difference of two, the lightness of a single one. */
static double separation(const design_picture *picture, int light) {
    const int count = picture->design->palette.material_count;
    double least = count == 1 ? curve_color(picture, 0, light).l : INFINITY;
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++)
            least =
                fmin(least, mtm_ciede2000(curve_color(picture, i, light), curve_color(picture, j, light)));
    return least;
}

/* Metamers look the same under some light, so the curves take the colors of the first light that tells them apart well; else
 * of what does it best. */
static void choose_colors(design_picture *picture) {
    static const double well = 20;
    const mtm_palette *palette = &picture->design->palette;
    double best = -1;
    for (int light = 0; light <= palette->light_count && best < well; light++) {
        const int candidate = light < palette->light_count ? light : -1;
        const double found = separation(picture, candidate);
        if (found <= best) continue;
        best = found;
        picture->curves_light = candidate;
    }
    for (int i = 0; i < palette->material_count; i++) {
        const mtm_lab color = curve_color(picture, i, picture->curves_light);
        mtm_rgb_format(mtm_rgb_from_xyz(mtm_xyz_from_lab(color, mtm_white_d65())),
                       picture->material_colors[i]);
    }
}

mtm_status picture_prepare(const mtm_design *design, design_picture *picture, mtm_error *error) {
    const size_t materials = (size_t)design->palette.material_count;
    const size_t lights = (size_t)design->palette.light_count;
    mtm_observer observer;
    const mtm_status status = mtm_observer_get("cie1931", &observer, error);
    if (status != MTM_OK) return status;
    double *weights = calloc(lights + 1, sizeof *weights); /* + 1: a size of 0 may give NULL */
    picture->design = design;
    picture->cells = calloc(materials * lights + 1, sizeof *picture->cells);
    picture->whites = calloc(lights + 1, sizeof *picture->whites);
    picture->material_colors = calloc(materials + 1, sizeof *picture->material_colors);
    const bool is_there = weights != NULL && picture->cells != NULL && picture->whites != NULL &&
                          picture->material_colors != NULL;
    if (is_there) {
        illuminate_all(picture, weights, &observer);
        choose_colors(picture);
    } else {
        (void)snprintf(error->message, sizeof error->message, "the picture of the design: out of memory");
    }
    free(weights);
    return is_there ? MTM_OK : MTM_MEMORY;
}

void picture_free(design_picture *picture) {
    free(picture->cells);
    free(picture->whites);
    free(picture->material_colors);
}

/* --- curves --- */

int picture_panel_count(int curve_count) {
    return (curve_count + CURVES_OF_PANEL - 1) / CURVES_OF_PANEL;
}

int picture_panel_first(int curve_count, int panel) {
    return panel * curve_count / picture_panel_count(curve_count);
}

static int place_in_panel(int curve_count, int index) {
    int place = index;
    for (int panel = 0; panel < picture_panel_count(curve_count); panel++) {
        const int first = picture_panel_first(curve_count, panel);
        if (first <= index) place = index - first;
    }
    return place;
}

/* What is not designed is thinner, and has rings or dots. */
static bool is_designed(mtm_honesty honesty) {
    return honesty != MTM_HONESTY_GIVEN && honesty != MTM_HONESTY_MEASURED;
}

svg_stroke picture_stroke(const design_picture *picture, bool is_light, int index) {
    static const char *const dashes[CURVES_OF_PANEL] = {NULL,          "7 3",  "2 2.4",
                                                        "9 2.5 2 2.5", "14 3", "7 2 2 2 2 2"};
    static const char *const light_colors[CURVES_OF_PANEL] = {"#0b61a4", "#c2480f", "#1b7837",
                                                              "#8a3a8c", "#8a6d00", "#3c3c3c"};
    const mtm_palette *palette = &picture->design->palette;
    const int place = place_in_panel(is_light ? palette->light_count : palette->material_count, index);
    return (svg_stroke){is_light ? light_colors[place] : picture->material_colors[index],
                        is_designed(picture_honesty(picture, is_light, index)) ? 2 : 1.2, dashes[place]};
}

void picture_draw_ring(const design_picture *picture, bool is_light, int index, double x, double y) {
    const mtm_honesty honesty = picture_honesty(picture, is_light, index);
    const char *color = picture_stroke(picture, is_light, index).color;
    if (!is_designed(honesty))
        svg_draw_circle(picture->stream, x, y, 2.4, honesty == MTM_HONESTY_GIVEN ? "#ffffff" : color,
                        &(svg_stroke){color, 1.1, NULL});
}

void picture_draw_sample(const design_picture *picture, bool is_light, int index, double x, double y,
                         double width) {
    const svg_stroke stroke = picture_stroke(picture, is_light, index);
    svg_draw_line(picture->stream, x, y, x + width, y, &stroke);
    picture_draw_ring(picture, is_light, index, x + width, y); /* clear of the dashes */
}

/* --- names --- */

const char *picture_name(const design_picture *picture, bool is_light, int index) {
    const mtm_palette *palette = &picture->design->palette;
    return is_light ? palette->lights[index].name : palette->materials[index].name;
}

mtm_honesty picture_honesty(const design_picture *picture, bool is_light, int index) {
    return is_light ? picture->design->lights[index] : picture->design->materials[index];
}

void picture_honesty_note(const design_picture *picture, bool is_light, int index,
                          char note[PICTURE_NOTE_BYTES]) {
    const char *origin = is_light ? "" : picture->design->material_origins[index];
    const char *column = strrchr(origin, ':');
    (void)snprintf(note, PICTURE_NOTE_BYTES, "%s%s%s",
                   mtm_honesty_name(picture_honesty(picture, is_light, index)), column == NULL ? "" : ": ",
                   column == NULL ? "" : column + 1);
}

void picture_text(const design_picture *picture, double x, double y, const char *anchor, double font_size,
                  double width, const char *color, bool is_bold, const char *text) {
    char shortened[PICTURE_NOTE_BYTES];
    svg_shorten(text, is_bold ? font_size * 1.06 : font_size, width, sizeof shortened, shortened);
    svg_text(picture->stream, x, y, anchor, color, is_bold, shortened);
}
