/* SPDX-License-Identifier: BSD-3-Clause
 * Panels of a design's picture: reflectances at the left, lights at the right. A curve's name stands where it ends. */
#include <math.h>

#include "design_picture.h"

enum {
    AXIS_WIDTH = 46, /* of the numbers and the title at the left of a panel */
    LABEL_MIN = 104, /* width of the names at its right */
    LABEL_MAX = 164,
    LEADER_WIDTH = 12, /* from a curve's end to its name */
    SAMPLE_WIDTH = 25, /* of the piece of curve before a name */
    NAME_GAP = 8,
    LABEL_DISTANCE = 27, /* between names */
    TITLE_HEIGHT = 30,
    PANEL_HEIGHT = 190,
    SCALE_HEIGHT = 50, /* of the numbers and the title below a panel */
    CAPTION_HEIGHT = 18,
    RING_SAMPLES = 5, /* a ring every 25 nm */
};

/* All panels of reflectances have one scale, and so have those of lights. */
typedef struct curve_kind {
    const design_picture *picture;
    bool is_light;
    int count;
    double left, label_width;
    double low, high;
} curve_kind;

/* What is drawn of a curve: a light relative to the largest of its values, which may be negative. */
static void take_values(const curve_kind *kind, int index, double values[MTM_SPECTRUM_SAMPLES]) {
    const mtm_palette *palette = &kind->picture->design->palette;
    const mtm_spectrum *spectrum =
        kind->is_light ? &palette->lights[index].emission : &palette->materials[index].reflectance;
    double largest = 0;
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) largest = fmax(largest, fabs(spectrum->value[k]));
    const double scale = kind->is_light && largest > 0 ? 1 / largest : 1;
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) values[k] = spectrum->value[k] * scale;
}

/* From 0 to 1, or as far as artificial spectra go. */
static void find_range(curve_kind *kind) {
    static const double rounding = 2e-3;
    kind->low = 0;
    kind->high = 1;
    for (int i = 0; i < kind->count; i++) {
        double values[MTM_SPECTRUM_SAMPLES];
        take_values(kind, i, values);
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
            if (values[k] < -rounding) kind->low = fmin(kind->low, values[k]);
            if (values[k] > 1 + rounding) kind->high = fmax(kind->high, values[k]);
        }
    }
}

/* As the longest name needs, within limits. */
static void find_label_width(curve_kind *kind) {
    double longest = 0;
    for (int i = 0; i < kind->count; i++) {
        char note[PICTURE_NOTE_BYTES];
        picture_honesty_note(kind->picture, kind->is_light, i, note);
        longest =
            fmax(longest, svg_text_width(picture_name(kind->picture, kind->is_light, i), PICTURE_NAME_SIZE));
        longest = fmax(longest, svg_text_width(note, PICTURE_NOTE_SIZE));
    }
    kind->label_width = fmin(fmax(longest + LEADER_WIDTH + SAMPLE_WIDTH + NAME_GAP, LABEL_MIN), LABEL_MAX);
}

static void draw_curve(const curve_kind *kind, const svg_panel *panel, int index) {
    double wavelengths[MTM_SPECTRUM_SAMPLES];
    double values[MTM_SPECTRUM_SAMPLES];
    const svg_stroke stroke = picture_stroke(kind->picture, kind->is_light, index);
    take_values(kind, index, values);
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
        wavelengths[k] = MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * k;
    svg_draw_curve(kind->picture->stream, panel, MTM_SPECTRUM_SAMPLES, wavelengths, values, &stroke);
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k += RING_SAMPLES)
        picture_draw_ring(kind->picture, kind->is_light, index, svg_place_x(panel, wavelengths[k]),
                          svg_place_y(panel, values[k]));
}

static void draw_label(const curve_kind *kind, const svg_panel *panel, int index, double end, double height) {
    const design_picture *picture = kind->picture;
    const svg_stroke leader = {picture_stroke(picture, kind->is_light, index).color, 0.8, NULL};
    const double right = panel->left + panel->width;
    const double x = right + LEADER_WIDTH + SAMPLE_WIDTH + NAME_GAP;
    const double width = kind->label_width - LEADER_WIDTH - SAMPLE_WIDTH - NAME_GAP;
    char note[PICTURE_NOTE_BYTES];
    picture_honesty_note(picture, kind->is_light, index, note);
    svg_draw_line(picture->stream, right, end, right + LEADER_WIDTH, height, &leader);
    picture_draw_sample(picture, kind->is_light, index, right + LEADER_WIDTH, height, SAMPLE_WIDTH);
    svg_begin_group(picture->stream, PICTURE_NAME_SIZE, picture_name(picture, kind->is_light, index));
    picture_text(picture, x, height + 4, "start", PICTURE_NAME_SIZE, width, picture_ink, false,
                 picture_name(picture, kind->is_light, index));
    svg_end_group(picture->stream);
    svg_begin_group(picture->stream, PICTURE_NOTE_SIZE, note);
    picture_text(picture, x, height + 15, "start", PICTURE_NOTE_SIZE, width, picture_pale_ink, false, note);
    svg_end_group(picture->stream);
}

static void draw_labels(const curve_kind *kind, const svg_panel *panel, int first, int count) {
    double ends[SVG_LABELS_MAX];
    double heights[SVG_LABELS_MAX];
    for (int i = 0; i < count; i++) {
        double values[MTM_SPECTRUM_SAMPLES];
        take_values(kind, first + i, values);
        ends[i] = heights[i] = svg_place_y(panel, values[MTM_SPECTRUM_SAMPLES - 1]);
    }
    svg_spread(count, heights, LABEL_DISTANCE, panel->top + 8, panel->top + panel->height - 8);
    for (int i = 0; i < count; i++) draw_label(kind, panel, first + i, ends[i], heights[i]);
}

/* Where no real reflectance and no real light gets to. */
static void draw_bounds(const curve_kind *kind, const svg_panel *panel) {
    const svg_stroke stroke = {picture_pale_ink, 1, "1 2"};
    for (int bound = 0; bound <= (kind->is_light ? 0 : 1); bound++) {
        const double y = svg_place_y(panel, bound);
        if (bound > panel->y.low && bound < panel->y.high)
            svg_draw_line(kind->picture->stream, panel->left, y, panel->left + panel->width, y, &stroke);
    }
}

static void draw_panel(const curve_kind *kind, int number, double top) {
    static const double wavelength_ticks[] = {400, 500, 600, 700};
    double ticks[SVG_TICKS_MAX];
    char title[64];
    const int panels = picture_panel_count(kind->count);
    const int first = picture_panel_first(kind->count, number);
    const int end = picture_panel_first(kind->count, number + 1);
    svg_panel panel = {.title = title,
                       .left = kind->left + AXIS_WIDTH,
                       .top = top + TITLE_HEIGHT,
                       .width = PICTURE_WIDTH / 2. - AXIS_WIDTH - kind->label_width - PICTURE_MARGIN,
                       .height = PANEL_HEIGHT,
                       .x = {"wavelength (nm)", 380, 780, false,
                             sizeof wavelength_ticks / sizeof *wavelength_ticks, wavelength_ticks},
                       .y = {.title = kind->is_light ? "relative power (largest 1)" : "reflectance"}};
    const int length = snprintf(title, sizeof title, "%s", kind->is_light ? "Lights" : "Materials");
    if (panels > 1)
        (void)snprintf(title + length, sizeof title - (size_t)length, " %d–%d of %d", first + 1, end,
                       kind->count);
    svg_fit_axis(kind->low, kind->high, &panel.y, ticks);
    svg_draw_panel(kind->picture->stream, &panel);
    draw_bounds(kind, &panel);
    for (int i = first; i < end; i++) draw_curve(kind, &panel, i);
    draw_labels(kind, &panel, first, end - first);
}

static bool has_honesty(const design_picture *picture, mtm_honesty honesty) {
    const mtm_design *design = picture->design;
    bool is_found = false;
    for (int i = 0; i < design->palette.material_count; i++) is_found |= design->materials[i] == honesty;
    for (int i = 0; i < design->palette.light_count; i++) is_found |= design->lights[i] == honesty;
    return is_found;
}

static void draw_caption(const design_picture *picture, double top) {
    char caption[512];
    const int light = picture->curves_light;
    const int length = snprintf(caption, sizeof caption,
                                "Curves of materials in their colors under %s, darkened where pale.",
                                light < 0 ? "their brightest lights" : picture_name(picture, true, light));
    (void)snprintf(caption + length, sizeof caption - (size_t)length, "%s%s",
                   has_honesty(picture, MTM_HONESTY_GIVEN) ? " Thin with rings: given." : "",
                   has_honesty(picture, MTM_HONESTY_MEASURED) ? " Thin with dots: measured." : "");
    svg_begin_group(picture->stream, PICTURE_NOTE_SIZE, NULL);
    picture_text(picture, PICTURE_MARGIN, top + 8, "start", PICTURE_NOTE_SIZE,
                 PICTURE_WIDTH - 2 * PICTURE_MARGIN, picture_pale_ink, false, caption);
    svg_end_group(picture->stream);
}

static int row_count(const design_picture *picture) {
    const int materials = picture_panel_count(picture->design->palette.material_count);
    const int lights = picture_panel_count(picture->design->palette.light_count);
    return materials > lights ? materials : lights;
}

double picture_curves_height(const design_picture *picture) {
    return row_count(picture) * (double)(TITLE_HEIGHT + PANEL_HEIGHT + SCALE_HEIGHT) + CAPTION_HEIGHT;
}

double picture_draw_curves(const design_picture *picture, double top) {
    const mtm_palette *palette = &picture->design->palette;
    curve_kind kinds[] = {
        {.picture = picture, .is_light = false, .count = palette->material_count, .left = PICTURE_MARGIN},
        {.picture = picture, .is_light = true, .count = palette->light_count, .left = PICTURE_WIDTH / 2.},
    };
    for (int i = 0; i < 2; i++) {
        find_range(&kinds[i]);
        find_label_width(&kinds[i]);
        for (int panel = 0; panel < picture_panel_count(kinds[i].count); panel++)
            draw_panel(&kinds[i], panel, top + panel * (double)(TITLE_HEIGHT + PANEL_HEIGHT + SCALE_HEIGHT));
    }
    draw_caption(picture, top + picture_curves_height(picture) - CAPTION_HEIGHT);
    return top + picture_curves_height(picture);
}
