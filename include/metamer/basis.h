/* SPDX-License-Identifier: BSD-3-Clause
 * Spectral representations: how materials become coefficients, and how a light turns coefficients into color. */
#ifndef METAMER_BASIS_H
#define METAMER_BASIS_H

#include "metamer/color.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All that stands between coefficients and linear sRGB: the light, who looks, and the display. */
typedef struct mtm_illumination {
    mtm_spectrum light; /* intensity · Σ wᵢEᵢ, each Eᵢ with Y = 1 on the perfect reflector */
    mtm_observer observer;
    double rgb_from_xyz[3][3]; /* from the observer's sums (XYZ, or a camera's responses) to linear sRGB */
} mtm_illumination;

/* Fills an illumination for a light whose amount is its CIE 1931 luminance, as in palettes, whoever looks; the sum of
 * the observer's y over the grid is positive.
 *   An observer's XYZ become linear sRGB. They are multiplied with a fixed exposure that makes y 1 on the perfect
 * reflector under equal-energy light of luminance 1 (for CIE 1931 it is 1). Where `adapted_y` is not 0, the light's own
 * white is mapped to sRGB's D65 of that y (Bradford), so that white looks white under every light.
 *   A camera's responses are shown raw, as linear red, green, blue: rgb_from_xyz is the same kind of exposure, which
 * makes green 1, times the identity. Where `adapted_y` is not 0, each channel is scaled so that white has that value.
 *   Exposures know no light, so without adaptation the picture under a mix of lights is the mix of the pictures. A light
 * without luminance is left unadapted, and so is a camera's channel that does not see it. */
MTM_API mtm_illumination mtm_illumination_of(const mtm_spectrum *light, const mtm_observer *observer,
                                             double adapted_y);

/* Linear sRGB of a reflectance: X · CMFᵀ · diag(E) · ρ, the full-spectral truth every basis is measured against. */
MTM_API mtm_rgb mtm_illuminate(const mtm_illumination *illumination, const mtm_spectrum *reflectance);

enum { MTM_DIMENSION_MAX = 83 /* d of any basis */ };

/* Floats of a pixel, a table row or a splat with d coefficients and alpha: 4, 8, 16, or the next multiple of 4. */
MTM_API int mtm_lanes(int dimension);

/* A basis of d columns. It encodes the scene's materials and gives, for an illumination, the 3×d matrix M(E) from
 * coefficients to linear sRGB. */
typedef struct mtm_basis mtm_basis;

/* Makes the basis `name`:
 *   "materials"    d = m + 1: the m reflectances themselves and white; exact under every light
 *   "factors:D"    D = 3 … 9 ("factors": 7): curves fitted so that products of coefficients stand for products of
 *                  spectra; coefficients of reflectances are 0 … 1; the light enters exactly
 *   "sharpened:D"  D = 3 … 9 ("sharpened": 7): principal components of reflectances, spectrally sharpened, the light
 *                  as D coefficients of its own (paper eq. 2)
 *   "wavelengths"  d = 81: the grid; exact, the reference. "wavelengths:31": 400, 410 … 700 nm, linear between
 *   "rgb"          d = 3: colors under `illumination`; the plain renderer, cannot be relit
 *   "auto"         materials for up to 6 of them, else factors:7
 * for `material_count` reflectances (copied; 0 … 82). `illumination` is needed for "rgb" and may be NULL for the rest.
 * MTM_ARGUMENT for an unknown name, a dimension the kind does not have, and "rgb" without illumination; MTM_LIMIT for
 * too many materials; MTM_NUMERIC for an ill-conditioned sharpened basis; MTM_MEMORY. Release with mtm_basis_destroy
 * (NULL allowed). */
MTM_API MTM_CHECK mtm_status mtm_basis_create(const char *name, int material_count,
                                              const mtm_spectrum *reflectances,
                                              const mtm_illumination *illumination, mtm_basis **basis,
                                              mtm_error *error);
MTM_API void mtm_basis_destroy(mtm_basis *basis);

MTM_API const char *
mtm_basis_name(const mtm_basis *basis);                  /* with its dimension, "factors:7"; never "auto" */
MTM_API int mtm_basis_dimension(const mtm_basis *basis); /* d */
MTM_API int mtm_basis_material_count(const mtm_basis *basis);

/* The d coefficients of material 0 … m-1, and of the perfect white reflector (for highlights). */
MTM_API void mtm_basis_encode_material(const mtm_basis *basis, int material, float *coefficients);
MTM_API void mtm_basis_encode_white(const mtm_basis *basis, float *coefficients);

/* The d coefficients of any reflectance or light. MTM_ARGUMENT from "materials", which only holds the scene's own. */
MTM_API MTM_CHECK mtm_status mtm_basis_encode(const mtm_basis *basis, const mtm_spectrum *spectrum,
                                              double *coefficients, mtm_error *error);

/* The d coefficients of the product of two spectra from theirs (paper eq. 2: coefficient by coefficient): a light
 * through a filter, or light reflected twice. `product` may be `a` or `b`. White, all ones, changes nothing.
 * MTM_ARGUMENT from "materials" and "rgb", whose coefficients do not multiply. */
MTM_API MTM_CHECK mtm_status mtm_basis_multiply(const mtm_basis *basis, const double *a, const double *b,
                                                double *product, mtm_error *error);

/* M(E): 3 rows of d, to linear sRGB. MTM_ARGUMENT from "rgb" under any other illumination than its own, with the
 * reason. */
MTM_API MTM_CHECK mtm_status mtm_basis_matrix(const mtm_basis *basis, const mtm_illumination *illumination,
                                              double *matrix, mtm_error *error);

/* The color of d coefficients: `matrix` (3 rows of d, from mtm_basis_matrix) times them. */
MTM_API mtm_rgb mtm_basis_color(int dimension, const double *matrix, const double *coefficients);

/* The spectrum of every coefficient: 81 rows (the grid) of d, so that rows · coefficients is the reflectance a pixel
 * stands for. MTM_ARGUMENT from "rgb", which holds no spectra. */
MTM_API MTM_CHECK mtm_status mtm_basis_reconstruction(const mtm_basis *basis, float *rows, mtm_error *error);

#ifdef __cplusplus
}
#endif
#endif
