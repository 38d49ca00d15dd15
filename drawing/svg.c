/* SPDX-License-Identifier: BSD-3-Clause
 * Line plots as SVG. Two decimals of a pixel are written, no less than can be seen. */
#include "svg.h"

#include <math.h>
#include <string.h>

static const char ink[] = "#222222";
static const char pale[] = "#e3e3e3";
enum { TICK_GAP = 6, TEXT_HEIGHT = 12 };

/* Bytes of the UTF-8 character at `text`, 1 where it is none. */
static size_t character_bytes(const char *text) {
    const unsigned char first = (unsigned char)*text;
    const size_t wanted = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 1;
    for (size_t i = 1; i < wanted; i++)
        if (((unsigned char)text[i] & 0xc0) != 0x80) return 1;
    return wanted;
}

/* XML 1.0, production 2: no control characters but blanks, neither U+FFFE nor U+FFFF. */
static bool is_in_xml(const char *character, size_t bytes) {
    const unsigned char first = (unsigned char)*character;
    if (bytes == 1) return first < 0x80 && (first >= ' ' || strchr("\t\n\r", first) != NULL);
    return memcmp(character, "\xef\xbf\xbe", bytes) != 0 && memcmp(character, "\xef\xbf\xbf", bytes) != 0;
}

void svg_escape(FILE *stream, const char *text) {
    while (*text != '\0') {
        const size_t bytes = character_bytes(text);
        if (*text == '&')
            (void)fputs("&amp;", stream);
        else if (*text == '<')
            (void)fputs("&lt;", stream);
        else if (*text == '>')
            (void)fputs("&gt;", stream);
        else if (is_in_xml(text, bytes))
            (void)fwrite(text, 1, bytes, stream);
        else
            (void)fputs("\xef\xbf\xbd", stream);
        text += bytes;
    }
}

static void write_element(FILE *stream, const char *name, const char *text) {
    if (text == NULL) return;
    (void)fprintf(stream, "<%s>", name);
    svg_escape(stream, text);
    (void)fprintf(stream, "</%s>\n", name);
}

void svg_begin(FILE *stream, int width, int height, const char *title, const char *description) {
    (void)fprintf(stream,
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
                  "viewBox=\"0 0 %d %d\" role=\"img\" font-family=\"Helvetica, Arial, sans-serif\" "
                  "font-size=\"%d\">\n",
                  width, height, width, height, TEXT_HEIGHT);
    write_element(stream, "title", title);
    write_element(stream, "desc", description);
    (void)fprintf(stream, "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n");
}

void svg_end(FILE *stream) {
    (void)fprintf(stream, "</svg>\n");
}

void svg_begin_group(FILE *stream, double font_size, const char *title) {
    (void)fprintf(stream, "<g font-size=\"%g\">\n", font_size);
    write_element(stream, "title", title);
}

void svg_end_group(FILE *stream) {
    (void)fprintf(stream, "</g>\n");
}

void svg_text(FILE *stream, double x, double y, const char *anchor, const char *color, bool is_bold,
              const char *text) {
    (void)fprintf(stream, "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"%s\" fill=\"%s\"%s>", x, y, anchor,
                  color, is_bold ? " font-weight=\"bold\"" : "");
    svg_escape(stream, text);
    (void)fprintf(stream, "</text>\n");
}

/* In the font's size. Scripts of wide letters begin with Hangul, U+1100. */
static double character_width(const char *character, size_t bytes) {
    const unsigned char first = (unsigned char)*character;
    if (bytes >= 3)
        return first == 0xe2 ? 0.8 : first > 0xe1 || (first == 0xe1 && character[1] & 0x20) ? 1.05 : 0.7;
    if (strchr("mwMW%@", *character) != NULL) return 0.9;
    if (strchr("iljtfrI.,:;'|!() ", *character) != NULL) return 0.33;
    return *character >= 'A' && *character <= 'Z' ? 0.71 : 0.57;
}

double svg_text_width(const char *text, double font_size) {
    double width = 0;
    while (*text != '\0') {
        const size_t bytes = character_bytes(text);
        width += character_width(text, bytes);
        text += bytes;
    }
    return width * font_size;
}

void svg_shorten(const char *text, double font_size, double width, size_t capacity, char *shortened) {
    static const char ellipsis[] = "\xe2\x80\xa6";
    const bool is_whole = svg_text_width(text, font_size) <= width && strlen(text) < capacity;
    double left = is_whole ? INFINITY : width / font_size - character_width(ellipsis, 3);
    size_t room = capacity - (is_whole ? 1 : sizeof ellipsis);
    size_t count = 0;
    while (text[count] != '\0') {
        const size_t bytes = character_bytes(text + count);
        left -= character_width(text + count, bytes);
        if (left < 0 || bytes > room) break;
        count += bytes;
        room -= bytes;
    }
    memcpy(shortened, text, count);
    memcpy(shortened + count, ellipsis, is_whole ? 0 : sizeof ellipsis);
    if (is_whole) shortened[count] = '\0';
}

static void write_stroke(FILE *stream, const svg_stroke *stroke) {
    (void)fprintf(stream, " stroke=\"%s\" stroke-width=\"%.2f\"", stroke->color, stroke->width);
    if (stroke->dashes != NULL) (void)fprintf(stream, " stroke-dasharray=\"%s\"", stroke->dashes);
}

void svg_draw_line(FILE *stream, double x1, double y1, double x2, double y2, const svg_stroke *stroke) {
    (void)fprintf(stream, "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\"", x1, y1, x2, y2);
    write_stroke(stream, stroke);
    (void)fprintf(stream, "/>\n");
}

void svg_draw_box(FILE *stream, double left, double top, double width, double height, const char *fill,
                  const svg_stroke *outline) {
    (void)fprintf(stream, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\"", left, top,
                  width, height, fill);
    if (outline != NULL) write_stroke(stream, outline);
    (void)fprintf(stream, "/>\n");
}

void svg_draw_circle(FILE *stream, double x, double y, double radius, const char *fill,
                     const svg_stroke *outline) {
    (void)fprintf(stream, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%g\" fill=\"%s\"", x, y, radius, fill);
    if (outline != NULL) write_stroke(stream, outline);
    (void)fprintf(stream, "/>\n");
}

static void draw_line(FILE *stream, double x1, double y1, double x2, double y2, const char *color) {
    (void)fprintf(stream, "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\"/>\n", x1, y1,
                  x2, y2, color);
}

void svg_fit_axis(double low, double high, svg_axis *axis, double ticks[SVG_TICKS_MAX]) {
    const double rough = (high - low) / 5;
    const double power = pow(10, floor(log10(rough)));
    const double ratio = rough / power;
    const double step = power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
    const int first = (int)floor(low / step + 1e-9);
    const int last = (int)ceil(high / step - 1e-9);
    axis->low = first * step;
    axis->high = last * step;
    axis->ticks = ticks;
    for (int i = first; i <= last && axis->tick_count < SVG_TICKS_MAX; i++)
        ticks[axis->tick_count++] = i == 0 ? 0 : i * step;
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
        svg_draw_circle(stream, svg_place_x(panel, x[i]), svg_place_y(panel, y[i]), 3, color, NULL);
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
