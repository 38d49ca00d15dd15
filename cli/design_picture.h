/* SPDX-License-Identifier: BSD-3-Clause
 * The parts of a design's picture: what they share, the panels of curves, the table of swatches. Lengths are in pixels. */
#ifndef METAMER_CLI_DESIGN_PICTURE_H
#define METAMER_CLI_DESIGN_PICTURE_H

#include <stdio.h>

#include "drawing/svg.h"
#include "metamer/metamer.h"

enum {
    PICTURE_WIDTH = 900,
    PICTURE_MARGIN = 24,
    PICTURE_NAME_SIZE = 12, /* of letters: names, axes */
    PICTURE_NOTE_SIZE = 10, /* of letters: numbers in cells, notes */
};

extern const char picture_ink[], picture_pale_ink[];

/* Colors are linear sRGB at weight 1. */
typedef struct design_picture {
    FILE *stream;
    const mtm_design *design;
    mtm_rgb *cells;   /* by full spectra, a row of lights for each material */
    mtm_rgb *whites;  /* the perfect reflector under each light, its largest channel 1 */
    int curves_light; /* the light whose colors the materials' curves have; -1: each its brightest */
    char (*material_colors)[8]; /* of curves, dark enough for a white ground */
} design_picture;

/* Fills in the colors of a picture of `design`. MTM_MEMORY. Release with picture_free, also after a failure. */
mtm_status picture_prepare(const mtm_design *design, design_picture *picture, mtm_error *error);
void picture_free(design_picture *picture);

mtm_rgb picture_cell(const design_picture *picture, mtm_cell cell);

/* Panels of a kind hold few curves, so that dashes tell them apart: how many panels, and where one begins. */
int picture_panel_count(int curve_count);
int picture_panel_first(int curve_count, int panel);

/* How the curve of a material or a light is drawn, in panels and beside names. */
svg_stroke picture_stroke(const design_picture *picture, bool is_light, int index);
void picture_draw_sample(const design_picture *picture, bool is_light, int index, double x, double y,
                         double width);
void picture_draw_ring(const design_picture *picture, bool is_light, int index, double x, double y);

const char *picture_name(const design_picture *picture, bool is_light, int index);
mtm_honesty picture_honesty(const design_picture *picture, bool is_light, int index);

/* "physical", "measured: column" and so on. */
enum { PICTURE_NOTE_BYTES = 320 };
void picture_honesty_note(const design_picture *picture, bool is_light, int index,
                          char note[PICTURE_NOTE_BYTES]);

/* Text shortened to a width. */
void picture_text(const design_picture *picture, double x, double y, const char *anchor, double font_size,
                  double width, const char *color, bool is_bold, const char *text);

/* The parts, each below `top`; they return where they end. Those that measure draw nothing. */
double picture_draw_curves(const design_picture *picture, double top);
double picture_curves_height(const design_picture *picture);
double picture_draw_table(const design_picture *picture, double top);
double picture_table_height(const design_picture *picture);
double picture_draw_problems(const design_picture *picture, double top);
double picture_problems_height(const design_picture *picture);

#endif
