/* SPDX-License-Identifier: BSD-3-Clause
 * Models of products. Sources: eq. numbers are those of Bergner, Möller, Tory, Drew, TVCG 11(2), 2005; matrices for
 * reflectances: M. S. Peercy, "Linear Color Representations for Full Spectral Rendering", SIGGRAPH 1993; the cone space
 * of the Bradford transform: K. M. Lam, dissertation, University of Bradford, 1985, as ICC.1:2022 has it. */
#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fail.h"

enum {
    FIRST = 4,   /* 400 nm */
    SAMPLES = 61 /* to 700 nm */
};

static const char *const family_names[FAMILY_COUNT] = {
    [FAMILY_FACTORS] = "factors",
    [FAMILY_SHARPENED] = "sharpened",
    [FAMILY_SHARPENED_EXACT] = "sharpened, light exact",
    [FAMILY_FACTORS_ENCODED] = "factors, light encoded",
    [FAMILY_PEERCY] = "Peercy's matrices",
    [FAMILY_UNSHARPENED] = "unsharpened",
    [FAMILY_RGB] = "RGB",
    [FAMILY_RGB_BRADFORD] = "Bradford RGB",
    [FAMILY_WAVELENGTHS_31] = "wavelengths:31",
    [FAMILY_POINTS] = "points every 10 nm",
    [FAMILY_CUT] = "wavelengths, 400 to 700 nm",
    [FAMILY_WAVELENGTHS] = "wavelengths",
};

static bool has_dimension(model_family family) {
    return (int)family < MODEL_FAMILIES_WITH_DIMENSION;
}

model_choice model_choice_at(int index) {
    const int family = index / MODEL_DIMENSIONS;
    if (family < MODEL_FAMILIES_WITH_DIMENSION)
        return (model_choice){(model_family)family, MODEL_DIMENSION_MIN + index % MODEL_DIMENSIONS};
    return (model_choice){(model_family)(index - MODEL_FAMILIES_WITH_DIMENSION * (MODEL_DIMENSIONS - 1)), 0};
}

int model_index(model_family family, int dimension) {
    if (has_dimension(family)) return (int)family * MODEL_DIMENSIONS + dimension - MODEL_DIMENSION_MIN;
    return (int)family + MODEL_FAMILIES_WITH_DIMENSION * (MODEL_DIMENSIONS - 1);
}

const char *model_family_name(model_family family) {
    return family_names[family];
}

/* The dimension stands behind the first word: "sharpened:7, light exact". */
void model_name(model_choice choice, char name[MODEL_NAME_BYTES]) {
    const char *text = family_names[choice.family];
    const int first_word = (int)strcspn(text, ",");
    if (has_dimension(choice.family))
        (void)snprintf(name, MODEL_NAME_BYTES, "%.*s:%d%s", first_word, text, choice.dimension,
                       text + first_word);
    else
        (void)snprintf(name, MODEL_NAME_BYTES, "%s", text);
}

static mtm_status allocate_curves(model *made, int dimension, mtm_error *error) {
    made->dimension = dimension;
    made->encoder = calloc((size_t)dimension, sizeof *made->encoder);
    made->columns = calloc((size_t)dimension, sizeof *made->columns);
    return made->encoder != NULL && made->columns != NULL ? MTM_OK : fail_memory(error, "a model");
}

static mtm_status create_basis(model *made, const char *name, mtm_error *error) {
    const mtm_status status = mtm_basis_create(name, 0, NULL, NULL, &made->basis, error);
    if (status == MTM_OK) made->dimension = mtm_basis_dimension(made->basis);
    return status;
}

/* The basis, and its columns for a light that it would treat in another way. */
static mtm_status create_basis_with_columns(model *made, const char *kind, mtm_error *error) {
    char name[32];
    (void)snprintf(name, sizeof name, "%s:%d", kind, made->choice.dimension);
    mtm_status status = create_basis(made, name, error);
    if (status == MTM_OK) status = allocate_curves(made, made->dimension, error);
    float *rows = calloc((size_t)MTM_SPECTRUM_SAMPLES * MTM_DIMENSION_MAX, sizeof *rows);
    if (status == MTM_OK && rows == NULL) status = fail_memory(error, "a model");
    if (status == MTM_OK) status = mtm_basis_reconstruction(made->basis, rows, error);
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES && status == MTM_OK; k++)
        for (int i = 0; i < made->dimension; i++) made->columns[i].value[k] = rows[k * made->dimension + i];
    free(rows);
    return status;
}

/* The principal components, orthonormal on 400 … 700 nm, with their ends held beyond. `scale` divides coefficients and
 * multiplies columns. */
static mtm_status create_principal(const char *source_folder, model *made, double scale, mtm_error *error) {
    char path[4096];
    mtm_spectrum_table table = {0};
    (void)snprintf(path, sizeof path, "%s/data/bases/reflectance_pca.csv", source_folder);
    mtm_status status = allocate_curves(made, made->choice.dimension, error);
    if (status == MTM_OK) status = mtm_spectrum_table_read(path, &table, error);
    for (int i = 0; i < made->dimension && status == MTM_OK; i++) {
        char column[16];
        mtm_spectrum component;
        (void)snprintf(column, sizeof column, "u_%d", i + 1);
        status = mtm_spectrum_table_column(&table, path, column, MTM_KIND_REFLECTANCE, &component, error);
        if (status != MTM_OK) break;
        made->columns[i] = mtm_spectrum_scale(&component, scale);
        for (int k = FIRST; k < FIRST + SAMPLES; k++) made->encoder[i].value[k] = component.value[k] / scale;
    }
    mtm_spectrum_table_free(&table);
    return status;
}

/* Samples `first`, first + step … of the grid, each standing for `step` of them. */
static mtm_status create_samples(model *made, int first, int step, int count, mtm_error *error) {
    const mtm_status status = allocate_curves(made, count, error);
    for (int i = 0; i < count && status == MTM_OK; i++) {
        made->encoder[i].value[first + step * i] = 1;
        made->columns[i].value[first + step * i] = step;
    }
    return status;
}

static void invert(const double m[3][3], double inverse[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int a = (j + 1) % 3;
            const int b = (j + 2) % 3;
            const int c = (i + 1) % 3;
            const int d = (i + 2) % 3;
            inverse[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    const double determinant = m[0][0] * inverse[0][0] + m[0][1] * inverse[1][0] + m[0][2] * inverse[2][0];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) inverse[i][j] /= determinant;
}

/* A reflectance is its color under D65, white all ones. */
static mtm_status create_color(model *made, mtm_error *error) {
    mtm_observer observer;
    mtm_spectrum d65;
    mtm_status status = mtm_observer_get("cie1931", &observer, error);
    if (status == MTM_OK) status = mtm_illuminant("D65", &d65, error);
    if (status == MTM_OK) status = allocate_curves(made, 3, error);
    if (status != MTM_OK) return status;
    for (int i = 0; i < 3; i++) {
        const double *row = made->color_from_xyz[i];
        double white = 0;
        for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
            made->encoder[i].value[k] =
                d65.value[k] *
                (row[0] * observer.x.value[k] + row[1] * observer.y.value[k] + row[2] * observer.z.value[k]);
            white += made->encoder[i].value[k];
        }
        made->encoder[i] = mtm_spectrum_scale(&made->encoder[i], 1 / white);
    }
    invert((const double(*)[3])made->color_from_xyz, made->xyz_from_color);
    return MTM_OK;
}

static mtm_status create_family(const char *source_folder, model *made, mtm_error *error) {
    static const double bradford[3][3] = {
        {0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}};
    char name[MODEL_NAME_BYTES];
    switch (made->choice.family) {
    case FAMILY_FACTORS:
    case FAMILY_SHARPENED: model_name(made->choice, name); return create_basis(made, name, error);
    case FAMILY_SHARPENED_EXACT: return create_basis_with_columns(made, "sharpened", error);
    case FAMILY_FACTORS_ENCODED: return create_basis_with_columns(made, "factors", error);
    case FAMILY_PEERCY:
        made->has_matrix_products = true;
        return create_principal(source_folder, made, 1, error);
    case FAMILY_UNSHARPENED: /* so scaled, the flat spectrum is 1, 0, 0 … */
        return create_principal(source_folder, made, sqrt(SAMPLES), error);
    case FAMILY_RGB: mtm_rgb_from_xyz_matrix(made->color_from_xyz); return create_color(made, error);
    case FAMILY_RGB_BRADFORD:
        memcpy(made->color_from_xyz, bradford, sizeof bradford);
        return create_color(made, error);
    case FAMILY_POINTS: return create_samples(made, 0, 2, (MTM_SPECTRUM_SAMPLES + 1) / 2, error);
    case FAMILY_CUT: return create_samples(made, FIRST, 1, SAMPLES, error);
    case FAMILY_WAVELENGTHS_31:
    case FAMILY_WAVELENGTHS:
    default: return create_basis(made, family_names[made->choice.family], error);
    }
}

mtm_status model_create(const char *source_folder, model_choice choice, model *made, mtm_error *error) {
    *made = (model){.choice = choice};
    const mtm_status status = create_family(source_folder, made, error);
    if (status != MTM_OK) model_free(made);
    return status;
}

void model_free(model *made) {
    mtm_basis_destroy(made->basis);
    free(made->encoder);
    free(made->columns);
    *made = (model){.basis = NULL};
}

static double weigh(const mtm_spectrum *curve, const mtm_spectrum *spectrum) {
    double sum = 0;
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) sum += curve->value[k] * spectrum->value[k];
    return sum;
}

mtm_status model_encode(const model *made, const mtm_spectrum *reflectance, double *coefficients,
                        mtm_error *error) {
    if (made->basis != NULL) return mtm_basis_encode(made->basis, reflectance, coefficients, error);
    for (int i = 0; i < made->dimension; i++) coefficients[i] = weigh(&made->encoder[i], reflectance);
    return MTM_OK;
}

/* Galerkin: the spectrum of coefficients, times the reflectance, encoded again. */
void model_multiplier(const model *made, const mtm_spectrum *reflectance, double *matrix) {
    for (int j = 0; j < made->dimension; j++) {
        const mtm_spectrum product = mtm_spectrum_multiply(&made->columns[j], reflectance);
        for (int i = 0; i < made->dimension; i++)
            matrix[i * made->dimension + j] = weigh(&made->encoder[i], &product);
    }
}

mtm_status model_multiply(const model *made, const double *a, const double *b, double *product,
                          mtm_error *error) {
    if (made->basis != NULL) return mtm_basis_multiply(made->basis, a, b, product, error);
    for (int i = 0; i < made->dimension; i++) product[i] = a[i] * b[i];
    return MTM_OK;
}

static void set_column(const model *made, int i, mtm_xyz color, double factor, double *matrix) {
    matrix[i] = color.x * factor;
    matrix[made->dimension + i] = color.y * factor;
    matrix[2 * made->dimension + i] = color.z * factor;
}

/* The color of the light, channel by channel, on that of the reflectances. */
static void light_color(const model *made, mtm_xyz light, double *matrix) {
    for (int i = 0; i < 3; i++) {
        const double *row = made->color_from_xyz[i];
        const double channel = row[0] * light.x + row[1] * light.y + row[2] * light.z;
        const mtm_xyz color = {made->xyz_from_color[0][i], made->xyz_from_color[1][i],
                               made->xyz_from_color[2][i]};
        set_column(made, i, color, channel, matrix);
    }
}

/* The light of its own coefficients, on the columns under equal energy (paper eq. 2). */
static mtm_status light_encoded(const model *made, const mtm_spectrum *light, const mtm_observer *observer,
                                double *matrix, mtm_error *error) {
    double coefficients[MTM_DIMENSION_MAX];
    const mtm_status status = model_encode(made, light, coefficients, error);
    for (int i = 0; i < made->dimension && status == MTM_OK; i++)
        set_column(made, i, mtm_xyz_of(&made->columns[i], observer), coefficients[i], matrix);
    return status;
}

static void light_exact(const model *made, const mtm_spectrum *light, const mtm_observer *observer,
                        double *matrix) {
    for (int i = 0; i < made->dimension; i++) {
        const mtm_spectrum lit = mtm_spectrum_multiply(&made->columns[i], light);
        set_column(made, i, mtm_xyz_of(&lit, observer), 1, matrix);
    }
}

mtm_status model_light(const model *made, const mtm_spectrum *light, const mtm_observer *observer,
                       double *matrix, mtm_error *error) {
    const mtm_illumination illumination = {
        .light = *light, .observer = *observer, .rgb_from_xyz = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    switch (made->choice.family) {
    case FAMILY_RGB:
    case FAMILY_RGB_BRADFORD: light_color(made, mtm_xyz_of(light, observer), matrix); return MTM_OK;
    case FAMILY_FACTORS_ENCODED:
    case FAMILY_UNSHARPENED: return light_encoded(made, light, observer, matrix, error);
    case FAMILY_SHARPENED_EXACT:
    case FAMILY_PEERCY:
    case FAMILY_POINTS:
    case FAMILY_CUT: light_exact(made, light, observer, matrix); return MTM_OK;
    default: return mtm_basis_matrix(made->basis, &illumination, matrix, error);
    }
}
