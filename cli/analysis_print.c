/* SPDX-License-Identifier: BSD-3-Clause
 * The analysis of a palette for people who may never have heard of metamers: under every light what looks the same, what
 * changes from light to light, and what color-blind eyes miss. What is as one would expect is not said. */
#include <stdio.h>
#include <string.h>

#include "analysis.h"
#include "command.h"
#include "task.h"

enum { LINES_MAX = 12 /* of a heading */ };

/* Lines below a heading, which is printed before the first; only some, and then how many more there are. */
typedef struct paragraph {
    const char *heading;
    int indent, count;
    size_t left_out; /* that the list itself lacks */
} paragraph;

/* Begins a line; false where there are enough. */
static bool begin_line(paragraph *p) {
    if (p->count == 0) (void)printf("%*s%s\n", p->indent, "", p->heading);
    if (p->count++ >= LINES_MAX) return false;
    (void)printf("%*s", p->indent + 2, "");
    return true;
}

/* The number of lines there would be. */
static int end_paragraph(const paragraph *p) {
    const size_t more = p->left_out + (size_t)(p->count > LINES_MAX ? p->count - LINES_MAX : 0);
    if (p->count == 0) return 0;
    if (more > 0) (void)printf("%*sand %zu more\n", p->indent + 2, "", more);
    return p->count;
}

static double number(const json_t *entry, const char *key) {
    return json_number_value(json_object_get(entry, key));
}

static const char *text(const json_t *entry, const char *key) {
    return json_string_value(json_object_get(entry, key));
}

static const char *text_at(const json_t *entry, const char *key, size_t index) {
    return json_string_value(json_array_get(json_object_get(entry, key), index));
}

static void print_text(const char *words) {
    print_plainly(stdout, words);
}

/* "haze and core" */
static void print_both(const json_t *entry, const char *key) {
    print_text(text_at(entry, key, 0));
    (void)printf(" and ");
    print_text(text_at(entry, key, 1));
}

static bool is_invisible(const json_t *analysis, const char *material, const char *light) {
    size_t i = 0;
    json_t *entry = NULL;
    json_array_foreach(json_object_get(analysis, "invisible"), i, entry) {
        if (strcmp(text(entry, "material"), material) == 0 && strcmp(text(entry, "light"), light) == 0)
            return true;
    }
    return false;
}

/* Both black: that they match goes without saying. */
static bool are_invisible(const json_t *analysis, const json_t *pair, const char *light) {
    return is_invisible(analysis, text_at(pair, "materials", 0), light) &&
           is_invisible(analysis, text_at(pair, "materials", 1), light);
}

static size_t left_out(const json_t *analysis, const char *key) {
    return (size_t)json_integer_value(json_object_get(json_object_get(analysis, "left_out"), key));
}

static int print_pairs(const json_t *analysis, const char *verdict, const char *heading, int indent) {
    size_t i = 0;
    json_t *pair = NULL;
    paragraph p = {.heading = heading, .indent = indent};
    json_array_foreach(json_object_get(analysis, "pairs"), i, pair) {
        const char *light = text(pair, "light");
        if (strcmp(text(pair, "verdict"), verdict) != 0 || are_invisible(analysis, pair, light)) continue;
        if (!begin_line(&p)) continue;
        print_both(pair, "materials");
        (void)printf(" under ");
        print_text(light);
        (void)printf(" (%.1f)\n", number(json_object_get(pair, "ciede2000"), "normal"));
    }
    return end_paragraph(&p);
}

static int print_invisible(const json_t *analysis, int indent) {
    size_t i = 0;
    json_t *entry = NULL;
    paragraph p = {
        .heading = "black, so not seen", .indent = indent, .left_out = left_out(analysis, "invisible")};
    json_array_foreach(json_object_get(analysis, "invisible"), i, entry) {
        if (!begin_line(&p)) continue;
        print_text(text(entry, "material"));
        (void)printf(" under ");
        print_text(text(entry, "light"));
        (void)printf("\n");
    }
    return end_paragraph(&p);
}

static int print_constant(const json_t *analysis, int indent) {
    size_t i = 0;
    json_t *entry = NULL;
    paragraph p = {
        .heading = "keep their color", .indent = indent, .left_out = left_out(analysis, "constant")};
    json_array_foreach(json_object_get(analysis, "constant"), i, entry) {
        if (!begin_line(&p)) continue;
        print_text(text(entry, "material"));
        (void)printf(" under ");
        print_both(entry, "lights");
        (void)printf(" (%.1f)\n", number(entry, "ciede2000"));
    }
    return end_paragraph(&p);
}

static void print_possible(const json_t *metamers) {
    const json_t *largest = json_object_get(metamers, "largest");
    const json_t *smooth = json_object_get(metamers, "largest_smooth");
    if (json_is_null(largest)) return;
    (void)printf("; up to %.0f is possible", json_number_value(largest));
    if (!json_is_null(smooth)) (void)printf(", %.0f with smooth spectra", json_number_value(smooth));
}

static int print_metamers(const json_t *analysis, int indent) {
    size_t i = 0;
    json_t *entry = NULL;
    paragraph p = {.heading = "metamers: the same color under one light, different ones under another",
                   .indent = indent,
                   .left_out = left_out(analysis, "metamers")};
    const double match = number(json_object_get(analysis, "thresholds"), "match");
    json_array_foreach(json_object_get(analysis, "metamers"), i, entry) {
        if (number(entry, "ciede2000") <= match || !begin_line(&p)) continue;
        print_both(entry, "materials");
        (void)printf(" match under ");
        print_text(text(entry, "match"));
        (void)printf(" and part by %.1f under ", number(entry, "ciede2000"));
        print_text(text(entry, "other"));
        print_possible(entry);
        (void)printf("\n");
    }
    return end_paragraph(&p);
}

static int print_confused(const json_t *analysis, int indent) {
    size_t i = 0;
    json_t *pair = NULL;
    paragraph p = {.heading = "hard for color-blind eyes (protan, deutan, tritan: no cones for long, middle, "
                              "short wavelengths)",
                   .indent = indent};
    const double similar = number(json_object_get(analysis, "thresholds"), "similar");
    json_array_foreach(json_object_get(analysis, "pairs"), i, pair) {
        const json_t *differences = json_object_get(pair, "ciede2000");
        bool is_confused = false;
        for (int n = 1; n < MTM_VISION_COUNT; n++)
            if (number(differences, mtm_vision_name((mtm_vision)n)) <= similar) is_confused = true;
        if (strcmp(text(pair, "verdict"), "differ") != 0 || !is_confused || !begin_line(&p)) continue;
        print_both(pair, "materials");
        (void)printf(" under ");
        print_text(text(pair, "light"));
        (void)printf(" (%.1f;", number(differences, "normal"));
        for (int n = 1; n < MTM_VISION_COUNT; n++) {
            const char *name = mtm_vision_name((mtm_vision)n);
            if (number(differences, name) <= similar)
                (void)printf(" %s %.1f", name, number(differences, name));
        }
        (void)printf(")\n");
    }
    return end_paragraph(&p);
}

void print_analysis(const json_t *analysis, int indent) {
    const json_t *thresholds = json_object_get(analysis, "thresholds");
    (void)printf("%*snumbers are color differences (CIEDE2000): up to %.0f looks the same, up to %.0f is "
                 "hard to tell apart\n",
                 indent, "", number(thresholds, "match"), number(thresholds, "similar"));
    int count = print_pairs(analysis, "match", "look the same", indent);
    count += print_pairs(analysis, "similar", "hard to tell apart", indent);
    count += print_invisible(analysis, indent);
    count += print_metamers(analysis, indent);
    count += print_constant(analysis, indent);
    count += print_confused(analysis, indent);
    if (count == 0)
        (void)printf("%*severy material is seen and told apart from the others under every light\n", indent,
                     "");
    if (left_out(analysis, "pairs") > 0)
        (void)printf("%*sof this large palette %zu pairs are not listed\n", indent, "",
                     left_out(analysis, "pairs"));
}
