/* SPDX-License-Identifier: BSD-3-Clause
 * Line plots as SVG. Two decimals of a pixel are written, no less than can be seen. */
#include "svg.h"

#include <math.h>

static const char ink[] = "#222222";
static const char pale[] = "#e3e3e3";
enum { TICK_GAP = 6, TEXT_HEIGHT = 12 };

void svg_begin(FILE *stream, int width, int height, const char *title) {
    (void)fprintf(stream,
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
                  "viewBox=\"0 0 %d %d\" role=\"img\" font-family=\"Helvetica, Arial, sans-serif\" "
                  "font-size=\"%d\">\n<title>%s</title>\n"
                  "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
                  width, height, width, height, TEXT_HEIGHT, title);
}

void svg_end(FILE *stream) {
    (void)fprintf(stream, "</svg>\n");
}

void svg_text(FILE *stream, double x, double y, const char *anchor, const char *color, bool is_bold,
              const char *text) {
    (void)fprintf(stream, "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"%s\" fill=\"%s\"%s>%s</text>\n", x, y,
                  anchor, color, is_bold ? " font-weight=\"bold\"" : "", text);
}

static void draw_line(FILE *stream, double x1, double y1, double x2, double y2, const char *color) {
    (void)fprintf(stream, "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\"/>\n", x1, y1,
                  x2, y2, color);
}

/* 0 at the axis' low end, 1 at its high end. */
static double share(const svg_axis *axis, double value) {
    const double part = axis->is_logarithmic ? log(value / axis->low) / log(axis->high / axis->low)
                                             : (value - axis->low) / (axis->high - axis->low);
    return fmin(fmax(part, 0), 1);
}

double svg_place_x(const svg_panel *panel, double x) {
    return panel->left + panel->width * share(&panel->x, x);
}

double svg_place_y(const svg_panel *panel, double y) {
    return panel->top + panel->height * (1 - share(&panel->y, y));
}

static void draw_x_ticks(FILE *stream, const svg_panel *panel) {
    const double bottom = panel->top + panel->height;
    for (int i = 0; i < panel->x.tick_count; i++) {
        char text[32];
        const double x = svg_place_x(panel, panel->x.ticks[i]);
        (void)snprintf(text, sizeof text, "%g", panel->x.ticks[i]);
        draw_line(stream, x, panel->top, x, bottom, pale);
        svg_text(stream, x, bottom + TICK_GAP + TEXT_HEIGHT, "middle", ink, false, text);
    }
    svg_text(stream, panel->left + panel->width / 2, bottom + 2 * TICK_GAP + 2 * TEXT_HEIGHT, "middle", ink,
             false, panel->x.title);
}

static void draw_y_ticks(FILE *stream, const svg_panel *panel) {
    for (int i = 0; i < panel->y.tick_count; i++) {
        char text[32];
        const double y = svg_place_y(panel, panel->y.ticks[i]);
        (void)snprintf(text, sizeof text, "%g", panel->y.ticks[i]);
        draw_line(stream, panel->left, y, panel->left + panel->width, y, pale);
        svg_text(stream, panel->left - TICK_GAP, y + 4, "end", ink, false, text);
    }
    const double x = panel->left - 40;
    const double y = panel->top + panel->height / 2;
    (void)fprintf(stream,
                  "<text transform=\"translate(%.2f %.2f) rotate(-90)\" text-anchor=\"middle\" "
                  "fill=\"%s\">%s</text>\n",
                  x, y, ink, panel->y.title);
}

void svg_draw_panel(FILE *stream, const svg_panel *panel) {
    draw_x_ticks(stream, panel);
    draw_y_ticks(stream, panel);
    (void)fprintf(
        stream, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"none\" stroke=\"%s\"/>\n",
        panel->left, panel->top, panel->width, panel->height, ink);
    svg_text(stream, panel->left + panel->width / 2, panel->top - 10, "middle", ink, true, panel->title);
}

void svg_draw_curve(FILE *stream, const svg_panel *panel, int count, const double *x, const double *y,
                    const svg_stroke *stroke) {
    (void)fprintf(stream,
                  "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%.2f\" stroke-linejoin=\"round\"",
                  stroke->color, stroke->width);
    if (stroke->dashes != NULL) (void)fprintf(stream, " stroke-dasharray=\"%s\"", stroke->dashes);
    (void)fprintf(stream, " points=\"");
    for (int i = 0; i < count; i++)
        (void)fprintf(stream, "%s%.2f,%.2f", i == 0 ? "" : " ", svg_place_x(panel, x[i]),
                      svg_place_y(panel, y[i]));
    (void)fprintf(stream, "\"/>\n");
}

void svg_draw_dots(FILE *stream, const svg_panel *panel, int count, const double *x, const double *y,
                   const char *color) {
    for (int i = 0; i < count; i++)
        (void)fprintf(stream, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"3\" fill=\"%s\"/>\n",
                      svg_place_x(panel, x[i]), svg_place_y(panel, y[i]), color);
}

/* Passes from the top and from the bottom; neighbors in height share what they lack. */
void svg_spread(int count, double *heights, double distance, double top, double bottom) {
    int order[SVG_LABELS_MAX];
    for (int i = 0; i < count; i++) {
        int place = i;
        for (; place > 0 && heights[order[place - 1]] > heights[i]; place--) order[place] = order[place - 1];
        order[place] = i;
    }
    for (int pass = 0; pass < 100; pass++) {
        for (int i = 0; i + 1 < count; i++) {
            const double lack = distance - (heights[order[i + 1]] - heights[order[i]]);
            if (lack <= 0) continue;
            heights[order[i]] -= lack / 2;
            heights[order[i + 1]] += lack / 2;
        }
        for (int i = 0; i < count; i++) heights[i] = fmin(fmax(heights[i], top), bottom);
    }
}
