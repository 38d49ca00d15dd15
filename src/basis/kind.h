/* SPDX-License-Identifier: BSD-3-Clause
 * What a kind of basis is: a row of the table in basis.c, implemented in a file of its own. */
#ifndef METAMER_BASIS_KIND_H
#define METAMER_BASIS_KIND_H

#include "metamer/basis.h"

typedef struct mtm_basis_kind {
    const char *name;
    const char *dimensions; /* what may follow "name:", for messages; NULL: nothing */
    int plain_dimension;    /* the one that files call by the kind's name alone; 0: none */
    /* d for a scene of `material_count` materials; `asked` is the number after the name, 0 without one. 0 where the
     * kind has no such dimension. */
    int (*dimension)(int asked, int material_count);
    /* Fills the encoder and the columns, each d zero spectra. */
    mtm_status (*prepare)(mtm_basis *basis, mtm_error *error);
    /* 3 rows of d. */
    mtm_status (*matrix)(const mtm_basis *basis, const mtm_illumination *illumination, double *matrix,
                         mtm_error *error);
    bool needs_illumination;
    bool has_encoder;  /* any spectrum can be encoded, not the scene's materials alone */
    bool has_spectra;  /* coefficients stand for spectra: the columns */
    bool has_products; /* coefficients multiply as spectra do (paper eq. 2) */
} mtm_basis_kind;

struct mtm_basis {
    const mtm_basis_kind *kind;
    char name[32]; /* as files call it: "factors:7" */
    int dimension;
    int material_count;
    mtm_spectrum *reflectances;    /* the materials and, last, white */
    mtm_spectrum *encoder;         /* coefficient i of a spectrum S is Σ encoder[i]·S over the grid */
    mtm_spectrum *columns;         /* coefficients c stand for the spectrum Σ c[i]·columns[i] */
    mtm_illumination illumination; /* of kinds that need one */
};

extern const mtm_basis_kind mtm_basis_materials;
extern const mtm_basis_kind mtm_basis_factors;
extern const mtm_basis_kind mtm_basis_sharpened;
extern const mtm_basis_kind mtm_basis_wavelengths;
extern const mtm_basis_kind mtm_basis_rgb;

/* The dimensions of the kinds that approximate: 3 … 9, 7 where none is asked for. */
enum { MTM_FEW_DIMENSIONS_MAX = 9 };
int mtm_basis_few_dimensions(int asked, int material_count);

/* M(E) = X · CMFᵀ · diag(E) · B, the matrix of every kind whose columns the light multiplies wavelength by wavelength. */
mtm_status mtm_basis_light_columns(const mtm_basis *basis, const mtm_illumination *illumination,
                                   double *matrix, mtm_error *error);

#endif
