/* SPDX-License-Identifier: BSD-3-Clause
 * The sentences below a design's picture: why goals are not met. */
#include <string.h>

#include "design_picture.h"

enum { LINE_HEIGHT = 14, INDENT = 12, PROBLEM_GAP = 4, TITLE_HEIGHT = 22, PROBLEMS_MAX = 12 };

/* Bytes of the text that fit a line, up to a blank; a word that is too long for one has it for itself. */
static size_t bytes_of_line(const char *text) {
    const double width = PICTURE_WIDTH - 2 * PICTURE_MARGIN - INDENT;
    char line[512];
    size_t fitting = 0;
    for (size_t end = 1; end < sizeof line; end++) {
        if (text[end] != ' ' && text[end] != '\0') continue;
        memcpy(line, text, end);
        line[end] = '\0';
        if (fitting > 0 && svg_text_width(line, PICTURE_NOTE_SIZE) > width) break;
        fitting = end;
        if (text[end] == '\0') break;
    }
    return fitting > 0 ? fitting : strlen(text);
}

/* Returns the height; draws where `stream` is not NULL. */
static double set_paragraph(FILE *stream, const char *text, double top) {
    double bottom = top;
    const double left = PICTURE_MARGIN;
    while (*text != '\0') {
        char line[512];
        const size_t bytes = bytes_of_line(text);
        (void)snprintf(line, sizeof line, "%.*s", (int)bytes, text);
        if (stream != NULL)
            svg_text(stream, left + (bottom > top ? INDENT : 0), bottom + 10, "start", picture_ink, false,
                     line);
        bottom += LINE_HEIGHT;
        text += bytes;
        while (*text == ' ') text++;
    }
    return bottom - top + PROBLEM_GAP;
}

static double set_problems(const design_picture *picture, FILE *stream, double top) {
    const mtm_design *design = picture->design;
    const int shown = design->problem_count < PROBLEMS_MAX ? design->problem_count : PROBLEMS_MAX;
    double bottom = top;
    if (shown == 0) return 0;
    bottom += TITLE_HEIGHT;
    for (int i = 0; i < shown; i++) {
        char sentence[sizeof design->problems[i].reason + 4];
        (void)snprintf(sentence, sizeof sentence, "%s %s", design->problems[i].is_basis_only ? "△" : "▲",
                       design->problems[i].reason);
        bottom += set_paragraph(stream, sentence, bottom);
    }
    if (shown < design->problem_count) {
        char more[64];
        (void)snprintf(more, sizeof more, "… and %d more, which the report names.",
                       design->problem_count - shown);
        bottom += set_paragraph(stream, more, bottom);
    }
    return bottom - top;
}

double picture_problems_height(const design_picture *picture) {
    return set_problems(picture, NULL, 0);
}

double picture_draw_problems(const design_picture *picture, double top) {
    if (picture->design->problem_count > 0)
        svg_text(picture->stream, PICTURE_MARGIN, top + 12, "start", picture_ink, true, "Not as asked");
    svg_begin_group(picture->stream, PICTURE_NOTE_SIZE, NULL);
    const double height = set_problems(picture, picture->stream, top);
    svg_end_group(picture->stream);
    return top + height;
}
