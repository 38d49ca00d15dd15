/* SPDX-License-Identifier: BSD-3-Clause
 * Basis "rgb": materials are colors under one light, as in a plain renderer; what the paper compares with. */
#include <string.h>

#include "base/fail.h"
#include "basis/kind.h"

static int dimension(int asked, int material_count) {
    (void)material_count;
    return asked == 0 ? 3 : 0;
}

/* A color is linear in the reflectance: X · CMFᵀ · diag(E). */
static mtm_status prepare(mtm_basis *basis, mtm_error *error) {
    (void)error;
    const mtm_illumination *own = &basis->illumination;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
        for (int channel = 0; channel < 3; channel++) {
            const double *row = own->rgb_from_xyz[channel];
            const double sensitivity = row[0] * own->observer.x.value[i] + row[1] * own->observer.y.value[i] +
                                       row[2] * own->observer.z.value[i];
            basis->encoder[channel].value[i] = own->light.value[i] * sensitivity;
        }
    return MTM_OK;
}

static bool is_same_spectrum(const mtm_spectrum *a, const mtm_spectrum *b) {
    return memcmp(a, b, sizeof *a) == 0;
}

static bool is_same(const mtm_illumination *a, const mtm_illumination *b) {
    return is_same_spectrum(&a->light, &b->light) && is_same_spectrum(&a->observer.x, &b->observer.x) &&
           is_same_spectrum(&a->observer.y, &b->observer.y) &&
           is_same_spectrum(&a->observer.z, &b->observer.z) &&
           memcmp(a->rgb_from_xyz, b->rgb_from_xyz, sizeof a->rgb_from_xyz) == 0;
}

static mtm_status matrix(const mtm_basis *basis, const mtm_illumination *illumination, double *matrix,
                         mtm_error *error) {
    if (!is_same(&basis->illumination, illumination))
        return mtm_fail(
            error, MTM_ARGUMENT,
            "basis \"rgb\" holds colors under the light it was rendered with and no spectra, so it cannot "
            "be relit; render with --basis auto to change the light afterwards");
    memset(matrix, 0, 9 * sizeof *matrix);
    matrix[0] = matrix[4] = matrix[8] = 1;
    return MTM_OK;
}

const mtm_basis_kind mtm_basis_rgb = {.name = "rgb",
                                      .dimension = dimension,
                                      .prepare = prepare,
                                      .matrix = matrix,
                                      .needs_illumination = true,
                                      .has_encoder = true};
