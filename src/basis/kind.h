/* SPDX-License-Identifier: BSD-3-Clause
 * What a kind of basis is: a row of the table in basis.c, implemented in a file of its own. */
#ifndef METAMER_BASIS_KIND_H
#define METAMER_BASIS_KIND_H

#include "metamer/basis.h"

typedef struct mtm_basis_kind {
    const char *name;
    /* Coefficients per pixel for a scene of `material_count` materials. */
    int (*dimension)(int material_count);
    /* The reflectance of index `material` (material_count: white), as d coefficients. */
    void (*encode)(const mtm_basis *basis, int material, float *coefficients);
    /* 3 rows of d. */
    mtm_status (*matrix)(const mtm_basis *basis, const mtm_illumination *illumination, double *matrix,
                         mtm_error *error);
    /* The spectrum that coefficient `column` stands for; NULL for a kind without spectra. */
    mtm_spectrum (*column)(const mtm_basis *basis, int column);
    bool needs_illumination;
} mtm_basis_kind;

struct mtm_basis {
    const mtm_basis_kind *kind;
    int dimension;
    int material_count;
    mtm_spectrum *reflectances;    /* the materials and, last, white */
    mtm_illumination illumination; /* of kinds that need one */
};

extern const mtm_basis_kind mtm_basis_materials;
extern const mtm_basis_kind mtm_basis_wavelengths;
extern const mtm_basis_kind mtm_basis_rgb;

/* M(E) = X · CMFᵀ · diag(E) · B, the matrix of every kind whose coefficients stand for spectra. */
mtm_status mtm_basis_light_columns(const mtm_basis *basis, const mtm_illumination *illumination,
                                   double *matrix, mtm_error *error);

#endif
