/* SPDX-License-Identifier: BSD-3-Clause
 * A design as a picture for people. */
#include "design_plot.h"

#include <stdlib.h>

#include "design_picture.h"

/* A stream that collects text; NULL when out of memory. The text is the caller's to free, also after a failure. */
static FILE *open_text(char **text, size_t *size) {
    *text = NULL;
    *size = 0;
    return open_memstream(text, size);
}

static bool close_text(FILE *stream) {
    const bool is_whole = ferror(stream) == 0;
    return fclose(stream) == 0 && is_whole;
}

static int count_met(const mtm_design *design) {
    int count = 0;
    for (int i = 0; i < design->result_count; i++) count += design->results[i].is_met;
    return count;
}

static void list_names(FILE *stream, const design_picture *picture, bool is_light) {
    const mtm_palette *palette = &picture->design->palette;
    const int count = is_light ? palette->light_count : palette->material_count;
    for (int i = 0; i < count; i++)
        (void)fprintf(stream, "%s%s (%s)", i == 0 ? is_light ? "Lights: " : "Materials: " : ", ",
                      picture_name(picture, is_light, i),
                      mtm_honesty_name(picture_honesty(picture, is_light, i)));
    (void)fprintf(stream, ". ");
}

static void list_missed(FILE *stream, const design_picture *picture) {
    const char *before = "Missed: ";
    for (int i = 0; i < picture->design->result_count; i++) {
        const mtm_goal_result *result = &picture->design->results[i];
        if (result->is_met) continue;
        (void)fprintf(stream, "%s%s under %s by %.2f", before,
                      picture_name(picture, false, result->goal.cell.material),
                      picture_name(picture, true, result->goal.cell.light), result->ciede2000);
        before = ", ";
    }
    (void)fprintf(stream, "%s", before[0] == ',' ? "." : "No goal is missed.");
}

/* What those who cannot see the picture want to know. */
static mtm_status describe(const design_picture *picture, char **text) {
    size_t size = 0;
    FILE *stream = open_text(text, &size);
    if (stream == NULL) return MTM_MEMORY;
    list_names(stream, picture, false);
    list_names(stream, picture, true);
    list_missed(stream, picture);
    return close_text(stream) ? MTM_OK : MTM_MEMORY;
}

static mtm_status draw(design_picture *picture, const char *description, char **text) {
    enum { TOP = 8, BOTTOM = 16 };
    size_t size = 0;
    char title[96];
    const double height = picture_curves_height(picture) + picture_table_height(picture) +
                          picture_problems_height(picture) + TOP + BOTTOM;
    (void)snprintf(title, sizeof title, "Design of a palette: %d of %d goals met within CIEDE2000 %g",
                   count_met(picture->design), picture->design->result_count, picture->design->tolerance);
    picture->stream = open_text(text, &size);
    if (picture->stream == NULL) return MTM_MEMORY;
    svg_begin(picture->stream, PICTURE_WIDTH, (int)height, title, description);
    double top = picture_draw_curves(picture, TOP);
    top = picture_draw_table(picture, top);
    (void)picture_draw_problems(picture, top);
    svg_end(picture->stream);
    return close_text(picture->stream) ? MTM_OK : MTM_MEMORY;
}

mtm_status write_design_plot(const mtm_design *design, const char *path, mtm_error *error) {
    design_picture picture = {.curves_light = -1};
    char *description = NULL;
    char *text = NULL;
    mtm_status status = picture_prepare(design, &picture, error);
    if (status == MTM_OK) {
        status = describe(&picture, &description);
        if (status == MTM_OK) status = draw(&picture, description, &text);
        if (status != MTM_OK)
            (void)snprintf(error->message, sizeof error->message, "%.400s: out of memory", path);
    }
    if (status == MTM_OK) status = mtm_text_write(path, text, error);
    free(description);
    free(text);
    picture_free(&picture);
    return status;
}
