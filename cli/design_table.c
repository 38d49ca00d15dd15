/* SPDX-License-Identifier: BSD-3-Clause
 * The table of a design's picture: a row for each material, a column for each light, in blocks of some columns. The left
 * half of a cell is what was asked, the right half what was achieved, by full spectra. */
#include <math.h>
#include <string.h>

#include "design_picture.h"

enum {
    LIGHTS_OF_BLOCK = 8,
    NAMES_WIDTH = 162,
    COLUMN_MAX = 128, /* from one cell to the next */
    CELL_GAP = 10,
    TITLE_HEIGHT = 44,
    NAME_HEIGHT = 44, /* of the lights' names */
    SWATCH_HEIGHT = 34,
    LINE_HEIGHT = 12,
    ROW_GAP = 18,
    SAMPLE_WIDTH = 25,
    MARK_SIZE = 9, /* of the triangle of a missed goal */
};

static const svg_stroke hairline = {"#a8a8a8", 0.75, NULL};

typedef struct table_block {
    const design_picture *picture;
    int first, end; /* lights */
    double left, column_width, cell_width;
} table_block;

/* --- what a cell says --- */

typedef enum mark_kind { MARK_NONE, MARK_MISSED, MARK_BASIS } mark_kind;

static void draw_mark(const design_picture *picture, double x, double bottom, mark_kind mark) {
    const bool is_missed = mark == MARK_MISSED;
    if (mark == MARK_NONE) return;
    (void)fprintf(picture->stream,
                  "<path class=\"%s\" d=\"M%.2f %.2fh%dl-%g -%dz\" fill=\"%s\" stroke=\"%s\" "
                  "stroke-linejoin=\"round\"/>\n",
                  is_missed ? "missed" : "missed-basis", x, bottom, MARK_SIZE, MARK_SIZE / 2., MARK_SIZE - 1,
                  is_missed ? picture_ink : "#ffffff", picture_ink);
}

/* The other cell of a goal by what tells it from the cell itself. */
static void name_other(const design_picture *picture, const mtm_goal *goal, size_t capacity, char *text) {
    const char *sign = goal->kind == MTM_GOAL_SAME ? "=" : "≠";
    const char *material =
        goal->other.material < 0 ? "black" : picture_name(picture, false, goal->other.material);
    const char *light = goal->other.material < 0 ? "" : picture_name(picture, true, goal->other.light);
    if (goal->other.material < 0 || goal->other.light == goal->cell.light)
        (void)snprintf(text, capacity, "%s %s", sign, material);
    else if (goal->other.material == goal->cell.material)
        (void)snprintf(text, capacity, "%s %s", sign, light);
    else
        (void)snprintf(text, capacity, "%s %s, %s", sign, material, light);
}

static const char *format_difference(double difference, char text[16]) {
    (void)snprintf(text, 16, difference < 9.995 ? "%.2f" : "%.1f", difference);
    return text;
}

/* Where the basis shows something else than full spectra do. */
static bool is_basis_worth_telling(const mtm_goal_result *result) {
    static const double noticeable = 0.05;
    return result->is_met != result->is_met_basis ||
           fabs(result->difference - result->difference_basis) >= noticeable;
}

typedef struct cell_line {
    mark_kind mark;
    bool is_pale;
    char text[2 * MTM_NAME_MAX + 64];
} cell_line;

enum { LINES_OF_GOAL = 3 };

/* Difference; the cell it is compared with; difference by the basis. Returns how many lines that are. */
static int tell_goal(const design_picture *picture, const mtm_goal_result *result,
                     cell_line lines[LINES_OF_GOAL]) {
    char number[16];
    int count = 0;
    cell_line *line = &lines[count++];
    *line = (cell_line){.mark = result->is_met ? MARK_NONE : MARK_MISSED};
    (void)snprintf(line->text, sizeof line->text, "%s", format_difference(result->difference, number));
    if (result->goal.kind == MTM_GOAL_DIFFERENT)
        (void)snprintf(line->text, sizeof line->text, "%s (≥ %g)", number, result->goal.least);
    if (result->goal.kind != MTM_GOAL_COLOR) {
        line = &lines[count++];
        *line = (cell_line){.is_pale = true};
        name_other(picture, &result->goal, sizeof line->text, line->text);
    }
    if (is_basis_worth_telling(result)) {
        line = &lines[count++];
        *line = (cell_line){.mark = result->is_met && !result->is_met_basis ? MARK_BASIS : MARK_NONE,
                            .is_pale = true};
        (void)snprintf(line->text, sizeof line->text, "%s %s", picture->design->basis,
                       format_difference(result->difference_basis, number));
    }
    return count;
}

static bool is_goal_of(const mtm_goal_result *result, mtm_cell cell) {
    return result->goal.cell.material == cell.material && result->goal.cell.light == cell.light;
}

static int count_lines(const design_picture *picture, mtm_cell cell) {
    cell_line lines[LINES_OF_GOAL];
    int count = 0;
    for (int i = 0; i < picture->design->result_count; i++)
        if (is_goal_of(&picture->design->results[i], cell))
            count += tell_goal(picture, &picture->design->results[i], lines);
    return count > 0 ? count : 1;
}

/* The goal whose color is the left half of the cell: a color asked for says more than another cell's. */
static const mtm_goal_result *main_goal(const design_picture *picture, mtm_cell cell) {
    const mtm_goal_result *found = NULL;
    for (int i = 0; i < picture->design->result_count; i++) {
        const mtm_goal_result *result = &picture->design->results[i];
        if (is_goal_of(result, cell) && (found == NULL || result->goal.kind < found->goal.kind))
            found = result;
    }
    return found;
}

/* The worst mark of a cell's goals. */
static mark_kind mark_of_cell(const design_picture *picture, mtm_cell cell) {
    mark_kind mark = MARK_NONE;
    for (int i = 0; i < picture->design->result_count; i++) {
        const mtm_goal_result *result = &picture->design->results[i];
        if (!is_goal_of(result, cell)) continue;
        if (!result->is_met)
            mark = MARK_MISSED;
        else if (!result->is_met_basis && mark == MARK_NONE)
            mark = MARK_BASIS;
    }
    return mark;
}

/* --- cells --- */

static void format_xyz(mtm_xyz xyz, char hex[8]) {
    mtm_rgb_format(mtm_rgb_from_xyz(xyz), hex);
}

/* What pointing at a cell shows: names in full, and the colors. */
static void title_cell(const design_picture *picture, mtm_cell cell, const mtm_goal_result *goal,
                       size_t capacity, char *title) {
    char achieved[8];
    char asked[8] = "";
    mtm_rgb_format(picture_cell(picture, cell), achieved);
    if (goal != NULL) format_xyz(goal->asked, asked);
    (void)snprintf(title, capacity, "%s under %s: %s%s%s%s", picture_name(picture, false, cell.material),
                   picture_name(picture, true, cell.light), achieved,
                   goal == NULL ? ", nothing asked" : ", asked ",
                   goal == NULL                            ? ""
                   : goal->goal.kind == MTM_GOAL_SAME      ? "the same as "
                   : goal->goal.kind == MTM_GOAL_DIFFERENT ? "to differ from "
                                                           : "",
                   asked);
}

/* Where the halves meet, which cannot be seen in a cell that is as asked. */
static void draw_seam(const table_block *block, double x, double top) {
    const svg_stroke stroke = {picture_pale_ink, 1, NULL};
    FILE *stream = block->picture->stream;
    svg_draw_line(stream, x, top - 4, x, top, &stroke);
    svg_draw_line(stream, x, top + SWATCH_HEIGHT, x, top + SWATCH_HEIGHT + 4, &stroke);
}

/* The sign of a goal on the color of the other cell. */
static void draw_sign(const design_picture *picture, const mtm_goal_result *goal, double x, double y) {
    const bool is_dark = mtm_lab_from_xyz(goal->asked, mtm_white_d65()).l < 55;
    if (goal->goal.kind == MTM_GOAL_COLOR) return;
    svg_begin_group(picture->stream, 15, NULL);
    svg_text(picture->stream, x, y, "middle", is_dark ? "#ffffff" : "#000000", false,
             goal->goal.kind == MTM_GOAL_SAME ? "=" : "≠");
    svg_end_group(picture->stream);
}

static void draw_swatch(const table_block *block, mtm_cell cell, const mtm_goal_result *goal, double x,
                        double top) {
    const design_picture *picture = block->picture;
    const double width = block->cell_width;
    const mark_kind mark = mark_of_cell(picture, cell);
    const svg_stroke outline = {picture_ink, mark == MARK_MISSED ? 2.4 : 1.4,
                                mark == MARK_MISSED ? NULL : "4 2.5"};
    char hex[8];
    mtm_rgb_format(picture_cell(picture, cell), hex);
    svg_draw_box(picture->stream, x, top, width, SWATCH_HEIGHT, hex, NULL);
    if (goal != NULL) {
        format_xyz(goal->asked, hex);
        svg_draw_box(picture->stream, x, top, width / 2, SWATCH_HEIGHT, hex, NULL);
        draw_seam(block, x + width / 2, top);
        draw_sign(picture, goal, x + width / 4, top + SWATCH_HEIGHT / 2. + 5);
    }
    svg_draw_box(picture->stream, x, top, width, SWATCH_HEIGHT, "none", &hairline);
    if (mark != MARK_NONE)
        svg_draw_box(picture->stream, x - 3, top - 3, width + 6, SWATCH_HEIGHT + 6, "none", &outline);
}

static double draw_line(const table_block *block, const cell_line *line, double center, double bottom) {
    const design_picture *picture = block->picture;
    const bool is_missed = line->mark == MARK_MISSED;
    const double mark_width = line->mark == MARK_NONE ? 0 : MARK_SIZE + 4;
    const double width =
        fmin(svg_text_width(line->text, PICTURE_NOTE_SIZE), block->column_width - 4 - mark_width);
    draw_mark(picture, center - (width + mark_width) / 2, bottom, line->mark);
    picture_text(picture, center + mark_width / 2, bottom, "middle", PICTURE_NOTE_SIZE,
                 block->column_width - 4 - mark_width,
                 line->is_pale && line->mark == MARK_NONE ? picture_pale_ink : picture_ink, is_missed,
                 line->text);
    return bottom + LINE_HEIGHT;
}

static void draw_cell(const table_block *block, mtm_cell cell, double x, double top) {
    const design_picture *picture = block->picture;
    const mtm_goal_result *goal = main_goal(picture, cell);
    const double center = x + block->cell_width / 2;
    double bottom = top + SWATCH_HEIGHT + LINE_HEIGHT + 4;
    char title[512];
    title_cell(picture, cell, goal, sizeof title, title);
    svg_begin_group(picture->stream, PICTURE_NOTE_SIZE, title);
    draw_swatch(block, cell, goal, x, top);
    for (int i = 0; i < picture->design->result_count; i++) {
        cell_line lines[LINES_OF_GOAL];
        if (!is_goal_of(&picture->design->results[i], cell)) continue;
        const int count = tell_goal(picture, &picture->design->results[i], lines);
        for (int k = 0; k < count; k++) bottom = draw_line(block, &lines[k], center, bottom);
    }
    if (goal == NULL) (void)draw_line(block, &(cell_line){.is_pale = true, .text = "–"}, center, bottom);
    svg_end_group(picture->stream);
}

/* --- the table --- */

static int block_count(const design_picture *picture) {
    return (picture->design->palette.light_count + LIGHTS_OF_BLOCK - 1) / LIGHTS_OF_BLOCK;
}

/* Blocks of about as many lights each; cells of the same size in all. */
static table_block block_of(const design_picture *picture, int number) {
    const int lights = picture->design->palette.light_count;
    const int blocks = block_count(picture);
    const double room = PICTURE_WIDTH - 2 * PICTURE_MARGIN - NAMES_WIDTH;
    const int most = (lights + blocks - 1) / blocks;
    const double column = fmin(room / most, COLUMN_MAX);
    return (table_block){.picture = picture,
                         .first = number * lights / blocks,
                         .end = (number + 1) * lights / blocks,
                         .left = PICTURE_MARGIN + NAMES_WIDTH,
                         .column_width = column,
                         .cell_width = column - CELL_GAP};
}

static double row_height(const table_block *block, int material) {
    int most = 1;
    for (int light = block->first; light < block->end; light++) {
        const int count = count_lines(block->picture, (mtm_cell){material, light});
        if (count > most) most = count;
    }
    return SWATCH_HEIGHT + most * (double)LINE_HEIGHT + ROW_GAP;
}

static double block_height(const table_block *block) {
    double height = NAME_HEIGHT;
    for (int i = 0; i < block->picture->design->palette.material_count; i++) height += row_height(block, i);
    return height;
}

/* Name, the piece of curve beside the color of white under the light, and where it is from. */
static void draw_light_name(const table_block *block, int light, double top) {
    const design_picture *picture = block->picture;
    const double center = block->left + (light - block->first) * block->column_width + block->cell_width / 2;
    char hex[8];
    char note[PICTURE_NOTE_BYTES];
    mtm_rgb_format(picture->whites[light], hex);
    picture_honesty_note(picture, true, light, note);
    svg_begin_group(picture->stream, PICTURE_NAME_SIZE, picture_name(picture, true, light));
    picture_text(picture, center, top + 10, "middle", PICTURE_NAME_SIZE, block->column_width - 6, picture_ink,
                 false, picture_name(picture, true, light));
    picture_draw_sample(picture, true, light, center - 22, top + 19, SAMPLE_WIDTH);
    svg_draw_circle(picture->stream, center + 15, top + 19, 4.5, hex, &hairline);
    svg_end_group(picture->stream);
    svg_begin_group(picture->stream, PICTURE_NOTE_SIZE, note);
    picture_text(picture, center, top + 34, "middle", PICTURE_NOTE_SIZE, block->column_width - 4,
                 picture_pale_ink, false, note);
    svg_end_group(picture->stream);
}

static void draw_material_name(const table_block *block, int material, double top) {
    const design_picture *picture = block->picture;
    const double x = PICTURE_MARGIN + SAMPLE_WIDTH + 8;
    const double width = NAMES_WIDTH - SAMPLE_WIDTH - 8 - 8;
    char note[PICTURE_NOTE_BYTES];
    picture_honesty_note(picture, false, material, note);
    picture_draw_sample(picture, false, material, PICTURE_MARGIN, top + 13, SAMPLE_WIDTH);
    svg_begin_group(picture->stream, PICTURE_NAME_SIZE, picture_name(picture, false, material));
    picture_text(picture, x, top + 17, "start", PICTURE_NAME_SIZE, width, picture_ink, false,
                 picture_name(picture, false, material));
    svg_end_group(picture->stream);
    svg_begin_group(picture->stream, PICTURE_NOTE_SIZE, note);
    picture_text(picture, x, top + 30, "start", PICTURE_NOTE_SIZE, width, picture_pale_ink, false, note);
    svg_end_group(picture->stream);
}

static double draw_block(const table_block *block, double top) {
    for (int light = block->first; light < block->end; light++) draw_light_name(block, light, top);
    top += NAME_HEIGHT;
    for (int material = 0; material < block->picture->design->palette.material_count; material++) {
        draw_material_name(block, material, top);
        for (int light = block->first; light < block->end; light++)
            draw_cell(block, (mtm_cell){material, light},
                      block->left + (light - block->first) * block->column_width, top);
        top += row_height(block, material);
    }
    return top;
}

/* --- the key --- */

static double draw_key_text(const design_picture *picture, double x, double bottom, const char *text) {
    svg_text(picture->stream, x, bottom, "start", picture_pale_ink, false, text);
    return x + svg_text_width(text, PICTURE_NOTE_SIZE) + 16;
}

static bool has_kind(const mtm_design *design, mtm_goal_kind kind) {
    bool is_found = false;
    for (int i = 0; i < design->result_count; i++) is_found |= design->results[i].goal.kind == kind;
    return is_found;
}

static bool has_mark(const mtm_design *design, mark_kind mark) {
    bool is_found = false;
    for (int i = 0; i < design->result_count; i++)
        is_found |= mark == MARK_MISSED ? !design->results[i].is_met
                                        : design->results[i].is_met && !design->results[i].is_met_basis;
    return is_found;
}

/* Only what the table has. */
static void draw_key(const design_picture *picture, double bottom) {
    const mtm_design *design = picture->design;
    char text[128];
    double x = PICTURE_MARGIN;
    svg_begin_group(picture->stream, PICTURE_NOTE_SIZE, NULL);
    svg_draw_box(picture->stream, x, bottom - 9, 10, 10, "#6b6b6b", NULL);
    svg_draw_box(picture->stream, x + 10, bottom - 9, 10, 10, "#c4c4c4", NULL);
    x = draw_key_text(picture, x + 25, bottom, "asked, achieved");
    (void)snprintf(text, sizeof text, "CIEDE2000 below, met up to %g", design->tolerance);
    x = draw_key_text(picture, x, bottom, text);
    if (has_kind(design, MTM_GOAL_SAME)) x = draw_key_text(picture, x, bottom, "= the same as");
    if (has_kind(design, MTM_GOAL_DIFFERENT)) x = draw_key_text(picture, x, bottom, "≠ at least as far from");
    if (has_mark(design, MARK_MISSED)) {
        draw_mark(picture, x, bottom, MARK_MISSED);
        x = draw_key_text(picture, x + MARK_SIZE + 4, bottom, "missed");
    }
    if (has_mark(design, MARK_BASIS)) {
        draw_mark(picture, x, bottom, MARK_BASIS);
        (void)snprintf(text, sizeof text, "met, but not as %s shows it", design->basis);
        (void)draw_key_text(picture, x + MARK_SIZE + 4, bottom, text);
    }
    svg_end_group(picture->stream);
}

double picture_table_height(const design_picture *picture) {
    double height = TITLE_HEIGHT;
    for (int i = 0; i < block_count(picture); i++) {
        const table_block block = block_of(picture, i);
        height += block_height(&block);
    }
    return height;
}

double picture_draw_table(const design_picture *picture, double top) {
    const mtm_design *design = picture->design;
    char title[64];
    int met = 0;
    for (int i = 0; i < design->result_count; i++) met += design->results[i].is_met;
    (void)snprintf(title, sizeof title, "Goals: %d of %d met", met, design->result_count);
    svg_text(picture->stream, PICTURE_MARGIN, top + 12, "start", picture_ink, true, title);
    draw_key(picture, top + 28);
    top += TITLE_HEIGHT;
    for (int i = 0; i < block_count(picture); i++) {
        const table_block block = block_of(picture, i);
        top = draw_block(&block, top);
    }
    return top;
}
