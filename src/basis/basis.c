/* SPDX-License-Identifier: BSD-3-Clause
 * The table of bases and what they share. */
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "basis/kind.h"

enum { MATERIALS_MAX = MTM_DIMENSION_MAX - 1 /* white is the last column */ };

static const mtm_basis_kind *const kinds[] = {&mtm_basis_materials, &mtm_basis_wavelengths, &mtm_basis_rgb};
enum { KIND_COUNT = sizeof kinds / sizeof *kinds };

static const mtm_basis_kind *find_kind(const char *name) {
    if (strcmp(name, "auto") == 0) return &mtm_basis_materials;
    for (size_t i = 0; i < KIND_COUNT; i++)
        if (strcmp(name, kinds[i]->name) == 0) return kinds[i];
    return NULL;
}

static mtm_status fail_unknown(const char *name, mtm_error *error) {
    for (size_t i = 0; i < KIND_COUNT; i++) {
        const size_t length = strlen(kinds[i]->name);
        if (strncmp(name, kinds[i]->name, length) == 0 && name[length] == ':')
            return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\": %s has no dimension to choose, write \"%s\"",
                            name, kinds[i]->name, kinds[i]->name);
    }
    char known[128] = "auto";
    for (size_t i = 0; i < KIND_COUNT; i++) {
        const size_t length = strlen(known);
        (void)snprintf(known + length, sizeof known - length, ", %s", kinds[i]->name);
    }
    return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\" is not known; known are %s", name, known);
}

mtm_status mtm_basis_create(const char *name, int material_count, const mtm_spectrum *reflectances,
                            const mtm_illumination *illumination, mtm_basis **basis, mtm_error *error) {
    assert(material_count >= 0 && (material_count == 0 || reflectances != NULL));
    const mtm_basis_kind *kind = find_kind(name);
    if (kind == NULL) return fail_unknown(name, error);
    if (kind->needs_illumination && illumination == NULL)
        return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\" needs a light to encode colors under", kind->name);
    if (material_count > MATERIALS_MAX)
        return mtm_fail(error, MTM_LIMIT, "%d materials are more than the %d a basis can hold",
                        material_count, MATERIALS_MAX);

    mtm_basis *made = mtm_allocate(1, sizeof *made);
    mtm_spectrum *copies = mtm_allocate((size_t)material_count + 1, sizeof *copies);
    if (made == NULL || copies == NULL) {
        free(made);
        free(copies);
        return mtm_fail_memory(error, "the basis", ((size_t)material_count + 1) * sizeof *copies);
    }
    if (material_count > 0) memcpy(copies, reflectances, (size_t)material_count * sizeof *copies);
    copies[material_count] = mtm_spectrum_constant(1);
    *made = (mtm_basis){.kind = kind,
                        .dimension = kind->dimension(material_count),
                        .material_count = material_count,
                        .reflectances = copies};
    if (illumination != NULL) made->illumination = *illumination;
    *basis = made;
    return MTM_OK;
}

void mtm_basis_destroy(mtm_basis *basis) {
    if (basis == NULL) return;
    free(basis->reflectances);
    free(basis);
}

const char *mtm_basis_name(const mtm_basis *basis) {
    return basis->kind->name;
}

int mtm_basis_dimension(const mtm_basis *basis) {
    return basis->dimension;
}

int mtm_basis_material_count(const mtm_basis *basis) {
    return basis->material_count;
}

void mtm_basis_encode_material(const mtm_basis *basis, int material, float *coefficients) {
    assert(material >= 0 && material < basis->material_count);
    basis->kind->encode(basis, material, coefficients);
}

void mtm_basis_encode_white(const mtm_basis *basis, float *coefficients) {
    basis->kind->encode(basis, basis->material_count, coefficients);
}

mtm_status mtm_basis_matrix(const mtm_basis *basis, const mtm_illumination *illumination, double *matrix,
                            mtm_error *error) {
    return basis->kind->matrix(basis, illumination, matrix, error);
}

mtm_status mtm_basis_reconstruction(const mtm_basis *basis, float *rows, mtm_error *error) {
    if (basis->kind->column == NULL)
        return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\" holds no spectra to reconstruct",
                        basis->kind->name);
    for (int column = 0; column < basis->dimension; column++) {
        const mtm_spectrum spectrum = basis->kind->column(basis, column);
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
            rows[i * basis->dimension + column] = (float)spectrum.value[i];
    }
    return MTM_OK;
}

int mtm_lanes(int dimension) {
    const int floats = dimension + 1;
    if (floats <= 4) return 4;
    if (floats <= 8) return 8;
    if (floats <= 16) return 16;
    return (floats + 3) / 4 * 4;
}

mtm_status mtm_basis_light_columns(const mtm_basis *basis, const mtm_illumination *illumination,
                                   double *matrix, mtm_error *error) {
    (void)error;
    const int d = basis->dimension;
    for (int i = 0; i < d; i++) {
        const mtm_spectrum spectrum = basis->kind->column(basis, i);
        const mtm_rgb color = mtm_illuminate(illumination, &spectrum);
        matrix[i] = color.r;
        matrix[d + i] = color.g;
        matrix[2 * d + i] = color.b;
    }
    return MTM_OK;
}
