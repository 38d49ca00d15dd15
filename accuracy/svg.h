/* SPDX-License-Identifier: BSD-3-Clause
 * Line plots as SVG: panels with axes, curves, labels. */
#ifndef METAMER_ACCURACY_SVG_H
#define METAMER_ACCURACY_SVG_H

#include <stdbool.h>
#include <stdio.h>

typedef struct svg_axis {
    const char *title;
    double low, high;
    bool is_logarithmic;
    int tick_count;
    const double *ticks; /* values that are marked and named */
} svg_axis;

/* A rectangle of the picture, in pixels, that shows x and y. */
typedef struct svg_panel {
    const char *title;
    double left, top, width, height;
    svg_axis x, y;
} svg_panel;

typedef struct svg_stroke {
    const char *color;
    double width;
    const char *dashes; /* as in SVG; NULL: none */
} svg_stroke;

/* A picture with a white ground, so that it can be read on dark pages too; `title` is for those who cannot see it. */
void svg_begin(FILE *stream, int width, int height, const char *title);
void svg_end(FILE *stream);

/* `anchor` is start, middle or end; a label is bold or not. The text must not hold what XML reserves. */
void svg_text(FILE *stream, double x, double y, const char *anchor, const char *color, bool is_bold,
              const char *text);

/* Frame, grid, ticks with their values, titles. */
void svg_draw_panel(FILE *stream, const svg_panel *panel);

/* Where a value is in the picture. Values outside the axis are put on its end. */
double svg_place_x(const svg_panel *panel, double x);
double svg_place_y(const svg_panel *panel, double y);

void svg_draw_curve(FILE *stream, const svg_panel *panel, int count, const double *x, const double *y,
                    const svg_stroke *stroke);
void svg_draw_dots(FILE *stream, const svg_panel *panel, int count, const double *x, const double *y,
                   const char *color);

/* Moves the `count` ≤ SVG_LABELS_MAX heights apart until two are at least `distance` pixels from each other, in their
 * order, none above `top` or below `bottom`. */
enum { SVG_LABELS_MAX = 16 };
void svg_spread(int count, double *heights, double distance, double top, double bottom);

#endif
