/* SPDX-License-Identifier: BSD-3-Clause
 * Basis "factors": d encoding curves that are nowhere negative, and d reconstruction curves, fitted together
 * (accuracy/fit.c, data/bases/) so that the coefficients of a product of spectra are the products of coefficients as
 * far as the eye can tell. The light is not encoded: it multiplies the reconstruction curves wavelength by wavelength,
 * which costs a pixel nothing and removes most of the error (docs/accuracy.md). Every encoding curve sums to 1 and so
 * do the reconstruction curves at every wavelength: white is all ones, a physical reflectance is within 0 … 1. */
#include <stdio.h>

#include "basis/kind.h"
#include "spectrum/embedded.h"

static mtm_status prepare(mtm_basis *basis, mtm_error *error) {
    char name[32];
    mtm_spectrum_table table;
    (void)snprintf(name, sizeof name, "factors_%d", basis->dimension);
    mtm_status status = mtm_embedded_table_read(name, &table, error);
    if (status != MTM_OK) return status;
    for (int i = 0; i < basis->dimension && status == MTM_OK; i++) {
        char column[32];
        (void)snprintf(column, sizeof column, "encode_%d", i + 1);
        status =
            mtm_spectrum_table_column(&table, name, column, MTM_KIND_REFLECTANCE, &basis->encoder[i], error);
        if (status != MTM_OK) break;
        (void)snprintf(column, sizeof column, "spectrum_%d", i + 1);
        status =
            mtm_spectrum_table_column(&table, name, column, MTM_KIND_REFLECTANCE, &basis->columns[i], error);
    }
    mtm_spectrum_table_free(&table);
    return status;
}

const mtm_basis_kind mtm_basis_factors = {.name = "factors",
                                          .dimensions = "3 … 9",
                                          .dimension = mtm_basis_few_dimensions,
                                          .prepare = prepare,
                                          .matrix = mtm_basis_light_columns,
                                          .has_encoder = true,
                                          .has_spectra = true,
                                          .has_products = true};
