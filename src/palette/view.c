/* SPDX-License-Identifier: BSD-3-Clause
 * Colors as bilinear forms: a picture's color is linear in the light and linear in the reflectance, whatever basis stands
 * between them (paper eq. 1 and 2), so a basis is read off by asking for unit spectra. */
#include "palette/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/linear.h"
#include "base/memory.h"

enum { N = MTM_SPECTRUM_SAMPLES, CHANNELS = MTM_COLOR_CHANNELS };

static mtm_status get_observer(mtm_observer *observer, double *luminance, mtm_error *error) {
    const mtm_spectrum equal_energy = mtm_spectrum_constant(1);
    const mtm_status status = mtm_observer_get("cie1931", observer, error);
    if (status == MTM_OK) *luminance = mtm_xyz_of(&equal_energy, observer).y;
    return status;
}

mtm_status mtm_color_view_full(mtm_color_view *view, mtm_error *error) {
    mtm_observer observer;
    double luminance = 0;
    double matrix[3][3];
    const mtm_status status = get_observer(&observer, &luminance, error);
    if (status != MTM_OK) return status;
    *view = (mtm_color_view){.dimension = N, .response = mtm_allocate(1, sizeof *view->response)};
    if (view->response == NULL)
        return mtm_fail_memory(error, "the weights of colors", sizeof *view->response);
    mtm_rgb_from_xyz_matrix(matrix);
    for (int c = 0; c < CHANNELS; c++)
        for (int i = 0; i < N; i++)
            view->response[0][c][i] =
                (matrix[c][0] * observer.x.value[i] + matrix[c][1] * observer.y.value[i] +
                 matrix[c][2] * observer.z.value[i]) /
                luminance;
    return MTM_OK;
}

static mtm_status probe_encoder(const mtm_basis *basis, mtm_color_view *view, mtm_error *error) {
    double coefficients[MTM_DIMENSION_MAX];
    for (int i = 0; i < N; i++) {
        mtm_spectrum unit = mtm_spectrum_constant(0);
        unit.value[i] = 1;
        const mtm_status status = mtm_basis_encode(basis, &unit, coefficients, error);
        if (status != MTM_OK) return status;
        for (int k = 0; k < view->dimension; k++) view->encoder[k][i] = coefficients[k];
    }
    return MTM_OK;
}

static mtm_status probe_response(const mtm_basis *basis, mtm_color_view *view, mtm_error *error) {
    double matrix[CHANNELS * MTM_DIMENSION_MAX];
    mtm_observer observer;
    double luminance = 0;
    mtm_status status = get_observer(&observer, &luminance, error);
    for (int i = 0; i < N && status == MTM_OK; i++) {
        mtm_spectrum unit = mtm_spectrum_constant(0);
        unit.value[i] = 1 / luminance;
        const mtm_illumination illumination = mtm_illumination_of(&unit, &observer, 0);
        status = mtm_basis_matrix(basis, &illumination, matrix, error);
        for (int c = 0; c < CHANNELS && status == MTM_OK; c++)
            for (int k = 0; k < view->dimension; k++)
                view->response[k][c][i] = matrix[c * view->dimension + k];
    }
    return status;
}

mtm_status mtm_color_view_basis(const char *name, mtm_color_view *view, mtm_error *error) {
    mtm_basis *basis = NULL;
    *view = (mtm_color_view){0};
    mtm_status status = mtm_basis_create(name, 0, NULL, NULL, &basis, error);
    if (status != MTM_OK) return status;
    view->dimension = mtm_basis_dimension(basis);
    view->encoder = mtm_allocate((size_t)view->dimension, sizeof *view->encoder);
    view->response = mtm_allocate((size_t)view->dimension, sizeof *view->response);
    if (view->encoder == NULL || view->response == NULL)
        status =
            mtm_fail_memory(error, "the weights of colors", (size_t)view->dimension * sizeof *view->response);
    if (status == MTM_OK) status = probe_encoder(basis, view, error);
    if (status == MTM_OK) status = probe_response(basis, view, error);
    if (status != MTM_OK) mtm_color_view_free(view);
    mtm_basis_destroy(basis);
    return status;
}

void mtm_color_view_free(mtm_color_view *view) {
    free(view->encoder);
    free(view->response);
    *view = (mtm_color_view){0};
}

void mtm_color_view_encode(const mtm_color_view *view, const mtm_samples reflectance, double *coefficients) {
    if (view->encoder == NULL)
        memcpy(coefficients, reflectance, sizeof(mtm_samples));
    else
        for (int k = 0; k < view->dimension; k++) coefficients[k] = mtm_dot(N, view->encoder[k], reflectance);
}

/* `factor` is a light or a reflectance: for full spectra both are treated alike. */
static void weigh_full(const mtm_color_view *view, const mtm_samples factor, mtm_color_weights weights) {
    for (int c = 0; c < CHANNELS; c++)
        for (int i = 0; i < N; i++) weights[c][i] = view->response[0][c][i] * factor[i];
}

void mtm_color_view_material(const mtm_color_view *view, const mtm_samples light, mtm_color_weights weights) {
    if (view->encoder == NULL) {
        weigh_full(view, light, weights);
        return;
    }
    memset(weights, 0, sizeof(mtm_color_weights));
    for (int k = 0; k < view->dimension; k++) {
        for (int c = 0; c < CHANNELS; c++) {
            const double seen = mtm_dot(N, view->response[k][c], light);
            for (int i = 0; i < N; i++) weights[c][i] += seen * view->encoder[k][i];
        }
    }
}

void mtm_color_view_light(const mtm_color_view *view, const mtm_samples reflectance,
                          mtm_color_weights weights) {
    if (view->encoder == NULL) {
        weigh_full(view, reflectance, weights);
        return;
    }
    memset(weights, 0, sizeof(mtm_color_weights));
    for (int k = 0; k < view->dimension; k++) {
        const double coefficient = mtm_dot(N, view->encoder[k], reflectance);
        for (int c = 0; c < CHANNELS; c++)
            for (int i = 0; i < N; i++) weights[c][i] += coefficient * view->response[k][c][i];
    }
}

void mtm_color_view_cell(const mtm_color_view *view, const mtm_samples light, const mtm_samples reflectance,
                         mtm_color color) {
    mtm_color_weights weights;
    mtm_color_view_light(view, reflectance, weights);
    for (int c = 0; c < CHANNELS; c++) color[c] = mtm_dot(N, weights[c], light);
}

bool mtm_samples_of_light(const mtm_spectrum *light, mtm_samples samples) {
    mtm_observer observer;
    mtm_spectrum normalized;
    double luminance = 0;
    if (get_observer(&observer, &luminance, NULL) != MTM_OK ||
        mtm_light_normalize(light, &observer, &normalized, NULL) != MTM_OK)
        return false;
    for (int i = 0; i < N; i++) samples[i] = normalized.value[i] * luminance;
    return true;
}

mtm_xyz mtm_xyz_of_color(const mtm_color color) {
    return mtm_xyz_from_rgb((mtm_rgb){color[0], color[1], color[2]});
}

static mtm_lab lab_of(const mtm_color color) {
    return mtm_lab_from_xyz(mtm_xyz_of_color(color), mtm_white_d65());
}

double mtm_color_difference(const mtm_color a, const mtm_color b) {
    return mtm_ciede2000(lab_of(a), lab_of(b));
}

void mtm_color_difference_slopes(const mtm_color a, const mtm_color b, mtm_color by_a, mtm_color by_b) {
    static const double step = 1e-6;
    for (int which = 0; which < 2; which++) {
        for (int c = 0; c < CHANNELS; c++) {
            mtm_color more[2];
            mtm_color less[2];
            memcpy(more[0], a, sizeof(mtm_color));
            memcpy(more[1], b, sizeof(mtm_color));
            memcpy(less, more, sizeof less);
            more[which][c] += step;
            less[which][c] -= step;
            (which == 0 ? by_a : by_b)[c] =
                (mtm_color_difference(more[0], more[1]) - mtm_color_difference(less[0], less[1])) /
                (2 * step);
        }
    }
}

/* CIEDE2000 of small steps from a color is a quadratic form of them; its matrix from the lengths of steps along the axes of
 * L*a*b* and between them. */
static void find_form(mtm_lab lab, double form[3][3]) {
    static const double step = 1e-3;
    double along[3][3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j <= i; j++) {
            double moved[3] = {lab.l, lab.a, lab.b};
            moved[i] += step;
            if (j != i) moved[j] += step;
            const double length = mtm_ciede2000(lab, (mtm_lab){moved[0], moved[1], moved[2]}) / step;
            along[i][j] = length * length;
        }
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++)
            form[i][j] = i == j ? along[i][i] : (along[i][j] - along[i][i] - along[j][j]) / 2;
}

/* The derivative of L*a*b* by linear sRGB. */
static void find_lab_slopes(const mtm_color color, double slopes[3][3]) {
    for (int c = 0; c < CHANNELS; c++) {
        static const double step = 1e-6;
        mtm_color more;
        mtm_color less;
        memcpy(more, color, sizeof more);
        memcpy(less, color, sizeof less);
        more[c] += step;
        less[c] -= step;
        const mtm_lab high = lab_of(more);
        const mtm_lab low = lab_of(less);
        slopes[0][c] = (high.l - low.l) / (2 * step);
        slopes[1][c] = (high.a - low.a) / (2 * step);
        slopes[2][c] = (high.b - low.b) / (2 * step);
    }
}

void mtm_color_metric(const mtm_color color, double metric[3][3]) {
    double form[3][3] = {{0}};
    double slopes[3][3];
    find_form(lab_of(color), form);
    if (!mtm_cholesky_factor(3, 3, form[0])) /* a form that is no length: L*a*b* itself */
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) form[i][j] = i == j;
    find_lab_slopes(color, slopes);
    for (int i = 0; i < 3; i++) { /* metric = Lᵀ · slopes, form = L · Lᵀ */
        for (int c = 0; c < CHANNELS; c++) {
            metric[i][c] = 0;
            for (int k = i; k < 3; k++) metric[i][c] += form[k][i] * slopes[k][c];
        }
    }
}
