/* SPDX-License-Identifier: BSD-3-Clause
 * Line plots as SVG: panels with axes, curves, labels. */
#ifndef METAMER_DRAWING_SVG_H
#define METAMER_DRAWING_SVG_H

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

/* A picture with a white ground, so that it can be read on dark pages too; `title` and `description` (NULL: none) are for
 * those who cannot see it. */
void svg_begin(FILE *stream, int width, int height, const char *title, const char *description);
void svg_end(FILE *stream);

/* Any UTF-8 as text of XML; characters that XML does not have become U+FFFD. */
void svg_escape(FILE *stream, const char *text);

/* What follows belongs together, in letters of that size; `title` (NULL: none) is what pointing at it shows. */
void svg_begin_group(FILE *stream, double font_size, const char *title);
void svg_end_group(FILE *stream);

/* `anchor` is start, middle or end; a label is bold or not. */
void svg_text(FILE *stream, double x, double y, const char *anchor, const char *color, bool is_bold,
              const char *text);

/* About as wide as UTF-8 text is in most sans-serif fonts: which one there will be is not known. */
double svg_text_width(const char *text, double font_size);

/* Puts as much of the text as fits a width into `shortened` (`capacity` bytes, at least 4), whole characters, with … at
 * its end where it is not all. */
void svg_shorten(const char *text, double font_size, double width, size_t capacity, char *shortened);

void svg_draw_line(FILE *stream, double x1, double y1, double x2, double y2, const svg_stroke *stroke);

/* `outline` NULL: none. */
void svg_draw_box(FILE *stream, double left, double top, double width, double height, const char *fill,
                  const svg_stroke *outline);

void svg_draw_circle(FILE *stream, double x, double y, double radius, const char *fill,
                     const svg_stroke *outline);

/* Room for the ticks of an axis from low to high: a step of 1, 2 or 5 times a power of ten with about five of them from end
 * to end, the ends moved outward to the next tick. */
enum { SVG_TICKS_MAX = 12 };
void svg_fit_axis(double low, double high, svg_axis *axis, double ticks[SVG_TICKS_MAX]);

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
