/* SPDX-License-Identifier: BSD-3-Clause
 * Models of products: how a light, and the reflectances that it meets one after the other, become a color. The bases of
 * the library, and others to compare them with. */
#ifndef METAMER_ACCURACY_MODEL_H
#define METAMER_ACCURACY_MODEL_H

#include "metamer/metamer.h"

typedef enum model_family {
    FAMILY_FACTORS,
    FAMILY_SHARPENED,
    FAMILY_SHARPENED_EXACT, /* with the light as factors has it: wavelength by wavelength */
    FAMILY_FACTORS_ENCODED, /* with the light as sharpened has it: d coefficients (paper eq. 2) */
    FAMILY_PEERCY,          /* Galerkin: a d×d matrix for every reflectance, in the subspace of sharpened */
    FAMILY_UNSHARPENED,     /* products of that subspace's principal components, coefficient by coefficient */
    FAMILY_RGB,             /* linear sRGB of the light times those of reflectances */
    FAMILY_RGB_BRADFORD,    /* the same in the cone space of the Bradford transform */
    FAMILY_WAVELENGTHS_31,
    FAMILY_POINTS, /* light and reflectances sampled every 10 nm, plain sums */
    FAMILY_CUT,    /* full spectra of 400 … 700 nm */
    FAMILY_WAVELENGTHS,
    FAMILY_COUNT
} model_family;

typedef struct model_choice {
    model_family family;
    int dimension; /* of a family that comes in several */
} model_choice;

enum {
    MODEL_DIMENSION_MIN = 3,
    MODEL_DIMENSION_MAX = 9,
    MODEL_DIMENSIONS = MODEL_DIMENSION_MAX - MODEL_DIMENSION_MIN + 1,
    MODEL_FAMILIES_WITH_DIMENSION = FAMILY_UNSHARPENED + 1,
    MODEL_COUNT =
        MODEL_FAMILIES_WITH_DIMENSION * MODEL_DIMENSIONS + FAMILY_COUNT - MODEL_FAMILIES_WITH_DIMENSION,
};

/* Model 0 … MODEL_COUNT-1, family by family with rising dimension; and the way back, where `dimension` only counts for
 * families that come in several. */
model_choice model_choice_at(int index);
int model_index(model_family family, int dimension);

/* "factors", "sharpened, light exact"; and the name of one, "factors:7", "sharpened:7, light exact". */
const char *model_family_name(model_family family);
enum { MODEL_NAME_BYTES = 64 };
void model_name(model_choice choice, char name[MODEL_NAME_BYTES]);

typedef struct model {
    model_choice choice;
    int dimension; /* numbers of a reflectance, before they are multiplied */
    bool has_matrix_products;
    mtm_basis *basis;      /* NULL: the model brings its own encoder */
    mtm_spectrum *encoder; /* coefficient i of a spectrum S is Σ encoder[i]·S */
    mtm_spectrum *columns; /* coefficients c stand for the spectrum Σ c[i]·columns[i] */
    double color_from_xyz[3][3], xyz_from_color[3][3]; /* of the RGB families */
} model;

/* `source_folder` has data/bases. Errors: those of mtm_basis_create and mtm_spectrum_table_read; MTM_MEMORY. On success
 * the caller calls model_free. */
MTM_CHECK mtm_status model_create(const char *source_folder, model_choice choice, model *made,
                                  mtm_error *error);
void model_free(model *made);

/* The coefficients of a reflectance, and with has_matrix_products the d×d matrix that multiplies by it. */
MTM_CHECK mtm_status model_encode(const model *made, const mtm_spectrum *reflectance, double *coefficients,
                                  mtm_error *error);
void model_multiplier(const model *made, const mtm_spectrum *reflectance, double *matrix);

/* The product of two reflectances' coefficients; not for has_matrix_products. `product` may be `a`. */
MTM_CHECK mtm_status model_multiply(const model *made, const double *a, const double *b, double *product,
                                    mtm_error *error);

/* 3 rows of d: from coefficients to XYZ under a light, observer CIE 1931. */
MTM_CHECK mtm_status model_light(const model *made, const mtm_spectrum *light, const mtm_observer *observer,
                                 double *matrix, mtm_error *error);

#endif
