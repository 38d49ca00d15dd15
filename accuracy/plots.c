/* SPDX-License-Identifier: BSD-3-Clause
 * The pictures of docs/accuracy.md: the curves of two bases, and errors by dimension. */
#include "plots.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "drawing/svg.h"
#include "fail.h"
#include "output.h"

/* From short to long waves; told apart on white by light and dark as well. */
static const char *const curve_colors[MODEL_DIMENSION_MAX] = {
    "#5e3c99", "#2166ac", "#1b9aaa", "#1b7837", "#a6a11a", "#e08214", "#c4302b", "#7f3b08", "#444444"};

static double wavelength_at(int sample) {
    return MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * sample;
}

typedef struct basis_curves {
    int dimension;
    double encoder[MODEL_DIMENSION_MAX][MTM_SPECTRUM_SAMPLES];
    double columns[MODEL_DIMENSION_MAX][MTM_SPECTRUM_SAMPLES];
} basis_curves;

/* The curves as the library uses them; coefficients of single wavelengths are the encoder's. */
static mtm_status read_curves(const char *name, basis_curves *curves, mtm_error *error) {
    mtm_basis *basis = NULL;
    float rows[MTM_SPECTRUM_SAMPLES * MODEL_DIMENSION_MAX];
    mtm_status status = mtm_basis_create(name, 0, NULL, NULL, &basis, error);
    if (status != MTM_OK) return status;
    curves->dimension = mtm_basis_dimension(basis);
    status = mtm_basis_reconstruction(basis, rows, error);
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES && status == MTM_OK; k++) {
        mtm_spectrum line = mtm_spectrum_constant(0);
        double coefficients[MODEL_DIMENSION_MAX];
        line.value[k] = 1;
        status = mtm_basis_encode(basis, &line, coefficients, error);
        for (int i = 0; i < curves->dimension && status == MTM_OK; i++) {
            curves->encoder[i][k] = coefficients[i];
            curves->columns[i][k] = rows[k * curves->dimension + i];
        }
    }
    mtm_basis_destroy(basis);
    return status;
}

/* Within 400 … 700 nm, so that its label is clear of the frame. */
static int find_peak(const double curve[MTM_SPECTRUM_SAMPLES]) {
    enum { FIRST = 4, LAST = 64 };
    int peak = FIRST;
    for (int k = FIRST; k <= LAST; k++)
        if (curve[k] > curve[peak]) peak = k;
    return peak;
}

/* Curves with their numbers over their peaks. */
static void draw_curves(FILE *stream, svg_panel *panel, int count, double curves[][MTM_SPECTRUM_SAMPLES]) {
    static const double wavelength_ticks[] = {400, 450, 500, 550, 600, 650, 700, 750};
    double wavelengths[MTM_SPECTRUM_SAMPLES];
    double ticks[SVG_TICKS_MAX];
    double low = 0;
    double high = 0;
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
        wavelengths[k] = wavelength_at(k);
        for (int i = 0; i < count; i++) {
            low = fmin(low, curves[i][k]);
            high = fmax(high, curves[i][k]);
        }
    }
    panel->x =
        (svg_axis){"wavelength (nm)", 380, 780, false, sizeof wavelength_ticks / sizeof *wavelength_ticks,
                   wavelength_ticks};
    svg_fit_axis(low, high * 1.08, &panel->y, ticks);
    svg_draw_panel(stream, panel);
    for (int i = 0; i < count; i++)
        svg_draw_curve(stream, panel, MTM_SPECTRUM_SAMPLES, wavelengths, curves[i],
                       &(svg_stroke){curve_colors[i], 1.8, NULL});
    for (int i = 0; i < count; i++) {
        char text[16];
        const int peak = find_peak(curves[i]);
        (void)snprintf(text, sizeof text, "%d", i + 1);
        svg_text(stream, svg_place_x(panel, wavelengths[peak]), svg_place_y(panel, curves[i][peak]) - 4,
                 "middle", curve_colors[i], true, text);
    }
}

static mtm_status open_picture(const char *folder, const char *name, output_file *file, mtm_error *error) {
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    if (length < 0 || length >= (int)sizeof path)
        return fail(error, MTM_LIMIT, "%s: its path is too long", name);
    return output_open(path, file, error);
}

static mtm_status draw_basis(const char *folder, const char *name, const char *basis, const char *title,
                             mtm_error *error) {
    basis_curves curves;
    output_file file;
    mtm_status status = read_curves(basis, &curves, error);
    if (status == MTM_OK) status = open_picture(folder, name, &file, error);
    if (status != MTM_OK) return status;
    svg_panel encoding = {.title = "encoding: weights of a spectrum's samples",
                          .left = 62,
                          .top = 30,
                          .width = 370,
                          .height = 230,
                          .y = {.title = "weight of a 5 nm sample"}};
    svg_panel reconstruction = {.title = "reconstruction: what a coefficient stands for",
                                .left = 510,
                                .top = 30,
                                .width = 370,
                                .height = 230,
                                .y = {.title = "spectrum of coefficient 1"}};
    svg_begin(file.stream, 900, 312, title, NULL);
    draw_curves(file.stream, &encoding, curves.dimension, curves.encoder);
    draw_curves(file.stream, &reconstruction, curves.dimension, curves.columns);
    svg_end(file.stream);
    return output_close(&file, error);
}

/* A line of the picture of errors: a family by dimension, or one that has none, straight across. */
typedef struct error_line {
    model_family family;
    svg_stroke stroke;
    bool is_straight;
} error_line;

static const error_line error_lines[] = {
    {FAMILY_RGB, {"#666666", 1.6, "7 4"}, true},
    {FAMILY_RGB_BRADFORD, {"#666666", 1.6, "2 3"}, true},
    {FAMILY_SHARPENED, {"#e08214", 2.2, NULL}, false},
    {FAMILY_PEERCY, {"#1b7837", 2.2, NULL}, false},
    {FAMILY_SHARPENED_EXACT, {"#8c510a", 1.6, "5 4"}, false},
    {FAMILY_FACTORS, {"#2166ac", 2.6, NULL}, false},
};
enum { ERROR_LINES = sizeof error_lines / sizeof *error_lines };

static double mean_error(const measurements *made, const error_line *line, int dimension, bool is_matched) {
    const product_errors *errors = measured_products(made, SET_HELD_OUT, line->family, dimension);
    return is_matched ? errors->matched.mean : errors->products[0].mean;
}

static void draw_errors(FILE *stream, const measurements *made, svg_panel *panel, bool is_matched) {
    static const double dimensions[MODEL_DIMENSIONS] = {3, 4, 5, 6, 7, 8, 9};
    static const double ticks[] = {0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20};
    double labels[ERROR_LINES];
    panel->x = (svg_axis){"dimension d", 2.8, 9.2, false, MODEL_DIMENSIONS, dimensions};
    panel->y = (svg_axis){"mean CIEDE2000", 0.05, 20, true, sizeof ticks / sizeof *ticks, ticks};
    svg_draw_panel(stream, panel);
    for (int line = 0; line < ERROR_LINES; line++) {
        const error_line *drawn = &error_lines[line];
        double means[MODEL_DIMENSIONS];
        int count = 0; /* of what there is: the largest dimensions may be missing */
        for (; count < MODEL_DIMENSIONS; count++) {
            const int dimension = MODEL_DIMENSION_MIN + count;
            if (made->is_missing[model_index(drawn->family, dimension)]) break;
            means[count] = mean_error(made, drawn, dimension, is_matched);
        }
        svg_draw_curve(stream, panel, count, dimensions, means, &drawn->stroke);
        if (!drawn->is_straight) svg_draw_dots(stream, panel, count, dimensions, means, drawn->stroke.color);
        labels[line] = svg_place_y(panel, count > 0 ? means[count - 1] : panel->y.high) + 4;
    }
    svg_spread(ERROR_LINES, labels, 15, panel->top + 8, panel->top + panel->height);
    for (int line = 0; line < ERROR_LINES; line++)
        svg_text(stream, panel->left + panel->width + 6, labels[line], "start",
                 error_lines[line].stroke.color, true, model_family_name(error_lines[line].family));
}

static mtm_status draw_all_errors(const measurements *made, const char *folder, mtm_error *error) {
    output_file file;
    const mtm_status status = open_picture(folder, "accuracy.svg", &file, error);
    if (status != MTM_OK) return status;
    svg_panel one = {
        .title = "a light on one reflectance", .left = 62, .top = 30, .width = 280, .height = 290};
    svg_panel three = {
        .title = "on three, exposure-matched", .left = 562, .top = 30, .width = 280, .height = 290};
    svg_begin(file.stream, 1010, 372,
              "Mean color error of products by dimension, for factors and other models", NULL);
    draw_errors(file.stream, made, &one, false);
    draw_errors(file.stream, made, &three, true);
    svg_end(file.stream);
    return output_close(&file, error);
}

mtm_status plots_write(const measurements *made, const char *folder, mtm_error *error) {
    mtm_status status = draw_basis(folder, "basis-factors-7.svg", "factors:7",
                                   "Encoding and reconstruction curves of the basis factors:7", error);
    if (status == MTM_OK)
        status = draw_basis(folder, "basis-sharpened-7.svg", "sharpened:7",
                            "Encoding and reconstruction curves of the basis sharpened:7", error);
    return status == MTM_OK ? draw_all_errors(made, folder, error) : status;
}
