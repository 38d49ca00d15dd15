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

static const mtm_basis_kind *const kinds[] = {&mtm_basis_materials, &mtm_basis_factors, &mtm_basis_sharpened,
                                              &mtm_basis_wavelengths, &mtm_basis_rgb};
enum { KIND_COUNT = sizeof kinds / sizeof *kinds };

/* What a name asks for: the kind, and the number after the colon (0 without one, -1 for one that is none). */
typedef struct request {
    const mtm_basis_kind *kind;
    int dimension;
} request;

/* Up to six materials and white are exact and fill eight lanes with alpha, no more than factors:7. */
static request choose_kind(int material_count) {
    enum { MATERIALS_IN_EIGHT_LANES = 6 };
    return (request){material_count <= MATERIALS_IN_EIGHT_LANES ? &mtm_basis_materials : &mtm_basis_factors,
                     0};
}

static int parse_dimension(const char *text) {
    const size_t digits = strspn(text, "0123456789");
    const int value = digits == 0 || digits > 3 || text[digits] != '\0' ? 0 : atoi(text);
    return value > 0 ? value : -1;
}

static request find_kind(const char *name, int material_count) {
    if (strcmp(name, "auto") == 0) return choose_kind(material_count);
    for (size_t i = 0; i < KIND_COUNT; i++) {
        const size_t length = strlen(kinds[i]->name);
        if (strncmp(name, kinds[i]->name, length) != 0) continue;
        if (name[length] == '\0') return (request){kinds[i], 0};
        if (name[length] == ':') return (request){kinds[i], parse_dimension(name + length + 1)};
    }
    return (request){NULL, 0};
}

static mtm_status fail_unknown(const char *name, mtm_error *error) {
    char known[128] = "auto";
    for (size_t i = 0; i < KIND_COUNT; i++) {
        const size_t length = strlen(known);
        (void)snprintf(known + length, sizeof known - length, ", %s", kinds[i]->name);
    }
    return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\" is not known; known are %s", name, known);
}

static mtm_status fail_dimension(const char *name, const mtm_basis_kind *kind, mtm_error *error) {
    if (kind->dimensions == NULL)
        return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\": %s has no dimension to choose, write \"%s\"",
                        name, kind->name, kind->name);
    return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\": the dimension of %s is %s", name, kind->name,
                    kind->dimensions);
}

static void name_basis(mtm_basis *basis) {
    const mtm_basis_kind *kind = basis->kind;
    if (kind->dimensions == NULL || basis->dimension == kind->plain_dimension)
        (void)snprintf(basis->name, sizeof basis->name, "%s", kind->name);
    else
        (void)snprintf(basis->name, sizeof basis->name, "%s:%d", kind->name, basis->dimension);
}

/* A basis with everything but its encoder and columns, which are zero. NULL when out of memory. */
static mtm_basis *allocate_basis(const mtm_basis_kind *kind, int dimension, int material_count) {
    mtm_basis *made = mtm_allocate(1, sizeof *made);
    if (made == NULL) return NULL;
    *made = (mtm_basis){.kind = kind, .dimension = dimension, .material_count = material_count};
    made->reflectances = mtm_allocate((size_t)material_count + 1, sizeof *made->reflectances);
    made->encoder = mtm_allocate((size_t)dimension, sizeof *made->encoder);
    made->columns = mtm_allocate((size_t)dimension, sizeof *made->columns);
    if (made->reflectances != NULL && made->encoder != NULL && made->columns != NULL) return made;
    mtm_basis_destroy(made);
    return NULL;
}

mtm_status mtm_basis_create(const char *name, int material_count, const mtm_spectrum *reflectances,
                            const mtm_illumination *illumination, mtm_basis **basis, mtm_error *error) {
    assert(material_count >= 0 && (material_count == 0 || reflectances != NULL));
    const request asked = find_kind(name, material_count);
    if (asked.kind == NULL) return fail_unknown(name, error);
    const int dimension = asked.kind->dimension(asked.dimension, material_count);
    if (dimension == 0) return fail_dimension(name, asked.kind, error);
    if (asked.kind->needs_illumination && illumination == NULL)
        return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\" needs a light to encode colors under", name);
    if (material_count > MATERIALS_MAX)
        return mtm_fail(error, MTM_LIMIT, "%d materials are more than the %d a basis can hold",
                        material_count, MATERIALS_MAX);

    mtm_basis *made = allocate_basis(asked.kind, dimension, material_count);
    if (made == NULL)
        return mtm_fail_memory(error, "the basis",
                               ((size_t)material_count + 2 * (size_t)dimension) * sizeof *reflectances);
    name_basis(made);
    if (material_count > 0)
        memcpy(made->reflectances, reflectances, (size_t)material_count * sizeof *reflectances);
    made->reflectances[material_count] = mtm_spectrum_constant(1);
    if (illumination != NULL) made->illumination = *illumination;
    const mtm_status status = asked.kind->prepare(made, error);
    if (status != MTM_OK)
        mtm_basis_destroy(made);
    else
        *basis = made;
    return status;
}

void mtm_basis_destroy(mtm_basis *basis) {
    if (basis == NULL) return;
    free(basis->reflectances);
    free(basis->encoder);
    free(basis->columns);
    free(basis);
}

const char *mtm_basis_name(const mtm_basis *basis) {
    return basis->name;
}

int mtm_basis_dimension(const mtm_basis *basis) {
    return basis->dimension;
}

int mtm_basis_material_count(const mtm_basis *basis) {
    return basis->material_count;
}

static double encode_one(const mtm_basis *basis, int coefficient, const mtm_spectrum *spectrum) {
    double sum = 0;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        sum += basis->encoder[coefficient].value[i] * spectrum->value[i];
    return sum;
}

/* The reflectance of index `material`; white is the last. */
static void encode_reflectance(const mtm_basis *basis, int material, float *coefficients) {
    for (int i = 0; i < basis->dimension; i++)
        coefficients[i] = !basis->kind->has_encoder
                              ? (float)(i == material)
                              : (float)encode_one(basis, i, &basis->reflectances[material]);
}

void mtm_basis_encode_material(const mtm_basis *basis, int material, float *coefficients) {
    assert(material >= 0 && material < basis->material_count);
    encode_reflectance(basis, material, coefficients);
}

void mtm_basis_encode_white(const mtm_basis *basis, float *coefficients) {
    encode_reflectance(basis, basis->material_count, coefficients);
}

mtm_status mtm_basis_encode(const mtm_basis *basis, const mtm_spectrum *spectrum, double *coefficients,
                            mtm_error *error) {
    if (!basis->kind->has_encoder)
        return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\" encodes nothing but the scene's own materials",
                        basis->name);
    for (int i = 0; i < basis->dimension; i++) coefficients[i] = encode_one(basis, i, spectrum);
    return MTM_OK;
}

mtm_status mtm_basis_multiply(const mtm_basis *basis, const double *a, const double *b, double *product,
                              mtm_error *error) {
    if (!basis->kind->has_products)
        return mtm_fail(error, MTM_ARGUMENT,
                        "basis \"%s\" has no products; use factors, sharpened or wavelengths", basis->name);
    for (int i = 0; i < basis->dimension; i++) product[i] = a[i] * b[i];
    return MTM_OK;
}

mtm_status mtm_basis_matrix(const mtm_basis *basis, const mtm_illumination *illumination, double *matrix,
                            mtm_error *error) {
    return basis->kind->matrix(basis, illumination, matrix, error);
}

mtm_rgb mtm_basis_color(int dimension, const double *matrix, const double *coefficients) {
    mtm_rgb color = {0, 0, 0};
    for (int i = 0; i < dimension; i++) {
        color.r += matrix[i] * coefficients[i];
        color.g += matrix[dimension + i] * coefficients[i];
        color.b += matrix[2 * dimension + i] * coefficients[i];
    }
    return color;
}

mtm_status mtm_basis_reconstruction(const mtm_basis *basis, float *rows, mtm_error *error) {
    if (!basis->kind->has_spectra)
        return mtm_fail(error, MTM_ARGUMENT, "basis \"%s\" holds no spectra to reconstruct", basis->name);
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        for (int column = 0; column < basis->dimension; column++)
            rows[i * basis->dimension + column] = (float)basis->columns[column].value[i];
    return MTM_OK;
}

int mtm_basis_few_dimensions(int asked, int material_count) {
    enum { MIN = 3, DEFAULT = 7, MAX = MTM_FEW_DIMENSIONS_MAX };
    (void)material_count;
    if (asked == 0) return DEFAULT;
    return asked >= MIN && asked <= MAX ? asked : 0;
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
        const mtm_rgb color = mtm_illuminate(illumination, &basis->columns[i]);
        matrix[i] = color.r;
        matrix[d + i] = color.g;
        matrix[2 * d + i] = color.b;
    }
    return MTM_OK;
}
