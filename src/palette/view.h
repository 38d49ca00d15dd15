/* SPDX-License-Identifier: BSD-3-Clause
 * Colors as bilinear forms of a light and a reflectance, by full spectra or through a basis, and how the eye measures small
 * steps between them. */
#ifndef METAMER_PALETTE_VIEW_H
#define METAMER_PALETTE_VIEW_H

#include "metamer/basis.h"

enum { MTM_COLOR_CHANNELS = 3 };

/* A spectrum of a design as plain samples. Lights have the mean 1 over the luminous efficiency: equal-energy light is all
 * ones, and every light has Y = 1 on the perfect reflector. */
typedef double mtm_samples[MTM_SPECTRUM_SAMPLES];

/* Linear sRGB of the picture, not clipped. */
typedef double mtm_color[MTM_COLOR_CHANNELS];

/* The weights whose sums with the samples of one spectrum are a color, the other spectrum being given. */
typedef mtm_samples mtm_color_weights[MTM_COLOR_CHANNELS];

/* color = Σ light[i] · response[channel][i][k] · coefficient[k], coefficient[k] = Σ encoder[k][i] · reflectance[i]. Full
 * spectra have no encoder: their coefficients are the samples, each seen at its own wavelength only. */
typedef struct mtm_color_view {
    int dimension;
    mtm_samples *encoder;        /* dimension; NULL: full spectra */
    mtm_color_weights *response; /* dimension; of full spectra one */
} mtm_color_view;

/* Makes a view: of full spectra, or of a basis that approximates them (its name as for mtm_basis_create). MTM_MEMORY and
 * the errors of mtm_basis_create. Release with mtm_color_view_free. */
MTM_CHECK mtm_status mtm_color_view_full(mtm_color_view *view, mtm_error *error);
MTM_CHECK mtm_status mtm_color_view_basis(const char *basis, mtm_color_view *view, mtm_error *error);
void mtm_color_view_free(mtm_color_view *view);

/* How a color depends on the reflectance under a light, and on the light on a reflectance. */
void mtm_color_view_material(const mtm_color_view *view, const mtm_samples light, mtm_color_weights weights);
void mtm_color_view_light(const mtm_color_view *view, const mtm_samples reflectance,
                          mtm_color_weights weights);

void mtm_color_view_cell(const mtm_color_view *view, const mtm_samples light, const mtm_samples reflectance,
                         mtm_color color);

/* The coefficients of a reflectance, `dimension` of them; of full spectra the samples. */
void mtm_color_view_encode(const mtm_color_view *view, const mtm_samples reflectance, double *coefficients);

/* The light scaled to the mean 1; false where its luminance is not positive. */
MTM_CHECK bool mtm_samples_of_light(const mtm_spectrum *light, mtm_samples samples);

mtm_xyz mtm_xyz_of_color(const mtm_color color);

/* CIEDE2000 of two colors against D65. */
double mtm_color_difference(const mtm_color a, const mtm_color b);

/* Its derivatives by the channels of both colors, which are not equal. */
void mtm_color_difference_slopes(const mtm_color a, const mtm_color b, mtm_color by_a, mtm_color by_b);

/* What makes small steps from a color as long as they look: |metric · step| is their CIEDE2000. */
void mtm_color_metric(const mtm_color color, double metric[3][3]);

#endif
