/* SPDX-License-Identifier: BSD-3-Clause
 * Basis "sharpened", the paper's construction (section 3; M. Drew, G. Finlayson, Multispectral processing without
 * spectra, JOSA A 20(7), 2003): principal components of reflectances are mixed so that each column is as large as it
 * can be within one of d equal intervals of the 61 samples from 400 to 700 nm (L2 sharpening, G. Finlayson, M. Drew, B. Funt, JOSA A 11(5),
 * 1994), and scaled so that white has coefficients 1. Products of coefficients then come near products of spectra, and
 * the light itself is d coefficients: M(E) = X · CMFᵀ · B · diag(ε), eq. (2). Outside 400 … 700 nm the columns' ends are
 * held. The components (data/bases/reflectance_pca.csv) contain the flat spectrum exactly. */
#include "basis/sharpened.h"

#include <math.h>
#include <stdio.h>

#include "base/fail.h"
#include "base/linear.h"
#include "spectrum/embedded.h"

enum {
    DIMENSION_MAX = MTM_FEW_DIMENSIONS_MAX,
    FIRST = 4,   /* 400 nm */
    SAMPLES = 61 /* to 700 nm */
};
static const double condition_max = 10; /* beyond, the errors of products grow out of use */

/* The mixes t of the components: T[component][column]. */
typedef struct sharpening {
    int dimension;
    double mix[DIMENSION_MAX][DIMENSION_MAX];
    double factor[DIMENSION_MAX * DIMENSION_MAX]; /* Cholesky's of TᵀT */
    double white[DIMENSION_MAX]; /* the coefficients of 1 before the columns are scaled by them */
} sharpening;

/* The first sample behind interval 0 … d-1 of d equal ones; a sample that a border halves belongs to the lower. */
static int interval_end(int dimension, int interval) {
    return ((interval + 1) * 2 * SAMPLES + dimension) / (2 * dimension);
}

/* t maximises tᵀKt, K = UᵀU over the interval, among unit vectors: the eigenvector of the largest eigenvalue, its sign
 * such that the column's sum over the interval is positive. */
static void sharpen_column(sharpening *s, const mtm_spectrum *components, int column) {
    const int d = s->dimension;
    double energy[DIMENSION_MAX * DIMENSION_MAX] = {0};
    double vectors[DIMENSION_MAX * DIMENSION_MAX];
    double total[DIMENSION_MAX] = {0};
    const int begin = column == 0 ? 0 : interval_end(d, column - 1);
    for (int k = begin; k < interval_end(d, column); k++)
        for (int i = 0; i < d; i++) {
            const double value = components[i].value[FIRST + k];
            total[i] += value;
            for (int j = 0; j < d; j++) energy[i * d + j] += value * components[j].value[FIRST + k];
        }
    mtm_symmetric_eigen(d, energy, vectors);
    int largest = 0;
    for (int i = 1; i < d; i++)
        if (energy[i * d + i] > energy[largest * d + largest]) largest = i;
    double sum = 0;
    for (int i = 0; i < d; i++) sum += total[i] * vectors[i * d + largest];
    for (int i = 0; i < d; i++) s->mix[i][column] = (sum < 0 ? -1 : 1) * vectors[i * d + largest];
}

/* Solves T x = y for the components' coefficients y, by the normal equations. */
static void unmix(const sharpening *s, const double *y, double *x) {
    for (int j = 0; j < s->dimension; j++) {
        x[j] = 0;
        for (int i = 0; i < s->dimension; i++) x[j] += s->mix[i][j] * y[i];
    }
    mtm_cholesky_solve(s->dimension, s->dimension, s->factor, x);
}

/* The flat spectrum 1 is √61 times the first component. */
static bool find_white(sharpening *s) {
    const int d = s->dimension;
    const double flat[DIMENSION_MAX] = {sqrt(SAMPLES)};
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) {
            s->factor[i * d + j] = 0;
            for (int k = 0; k < d; k++) s->factor[i * d + j] += s->mix[k][i] * s->mix[k][j];
        }
    if (!mtm_cholesky_factor(d, d, s->factor)) return false;
    unmix(s, flat, s->white);
    return true;
}

/* Largest over smallest singular value of the scaled columns; infinite where white has a coefficient that is not
 * positive. */
static double condition_of(const sharpening *s) {
    const int d = s->dimension;
    double gram[DIMENSION_MAX * DIMENSION_MAX];
    double vectors[DIMENSION_MAX * DIMENSION_MAX];
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) {
            if (!(s->white[i] > 0)) return INFINITY;
            gram[i * d + j] = 0;
            for (int k = 0; k < d; k++)
                gram[i * d + j] += s->mix[k][i] * s->mix[k][j] * s->white[i] * s->white[j];
        }
    mtm_symmetric_eigen(d, gram, vectors);
    double smallest = gram[0];
    double largest = gram[0];
    for (int i = 1; i < d; i++) {
        smallest = fmin(smallest, gram[i * d + i]);
        largest = fmax(largest, gram[i * d + i]);
    }
    return smallest > 0 ? sqrt(largest / smallest) : INFINITY;
}

static void fill_curves(const sharpening *s, const mtm_spectrum *components, mtm_basis *basis) {
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++) {
        const int within = k < FIRST ? FIRST : k >= FIRST + SAMPLES ? FIRST + SAMPLES - 1 : k;
        double at[DIMENSION_MAX];
        double unmixed[DIMENSION_MAX];
        for (int i = 0; i < s->dimension; i++) at[i] = components[i].value[within];
        unmix(s, at, unmixed);
        for (int j = 0; j < s->dimension; j++) {
            double column = 0;
            for (int i = 0; i < s->dimension; i++) column += at[i] * s->mix[i][j];
            basis->columns[j].value[k] = column * s->white[j];
            basis->encoder[j].value[k] = within == k ? unmixed[j] / s->white[j] : 0;
        }
    }
}

mtm_status mtm_basis_sharpen(mtm_basis *basis, const mtm_spectrum *components, mtm_error *error) {
    sharpening s = {.dimension = basis->dimension};
    for (int column = 0; column < s.dimension; column++) sharpen_column(&s, components, column);
    const double condition = find_white(&s) ? condition_of(&s) : INFINITY;
    if (!(condition <= condition_max))
        return mtm_fail(error, MTM_NUMERIC,
                        "basis \"%s\" is ill-conditioned: its condition is %.3g, at most %g is usable",
                        basis->name, condition, condition_max);
    fill_curves(&s, components, basis);
    return MTM_OK;
}

static mtm_status prepare(mtm_basis *basis, mtm_error *error) {
    static const char table_name[] = "reflectance_pca";
    mtm_spectrum components[DIMENSION_MAX];
    mtm_spectrum_table table;
    mtm_status status = mtm_embedded_table_read(table_name, &table, error);
    if (status != MTM_OK) return status;
    for (int i = 0; i < basis->dimension && status == MTM_OK; i++) {
        char column[16];
        (void)snprintf(column, sizeof column, "u_%d", i + 1);
        status = mtm_spectrum_table_column(&table, table_name, column, MTM_KIND_REFLECTANCE, &components[i],
                                           error);
    }
    mtm_spectrum_table_free(&table);
    return status == MTM_OK ? mtm_basis_sharpen(basis, components, error) : status;
}

/* Eq. (2): the columns under equal energy, each times the light's own coefficient. */
static mtm_status matrix(const mtm_basis *basis, const mtm_illumination *illumination, double *matrix,
                         mtm_error *error) {
    double light[DIMENSION_MAX];
    mtm_illumination flat = *illumination;
    flat.light = mtm_spectrum_constant(1);
    mtm_status status = mtm_basis_light_columns(basis, &flat, matrix, error);
    if (status == MTM_OK) status = mtm_basis_encode(basis, &illumination->light, light, error);
    if (status != MTM_OK) return status;
    for (int row = 0; row < 3; row++)
        for (int i = 0; i < basis->dimension; i++) matrix[row * basis->dimension + i] *= light[i];
    return MTM_OK;
}

const mtm_basis_kind mtm_basis_sharpened = {.name = "sharpened",
                                            .dimensions = "3 … 9",
                                            .dimension = mtm_basis_few_dimensions,
                                            .prepare = prepare,
                                            .matrix = matrix,
                                            .has_encoder = true,
                                            .has_spectra = true,
                                            .has_products = true};
