/* SPDX-License-Identifier: BSD-3-Clause
 * How far a scene's basis can be trusted: its materials one by one against full spectra. Designed spectra are steep, and
 * what merges under a light by full spectra may part in a few coefficients. */
#include <string.h>

#include "scene/scene.h"

static mtm_rgb color_of(const mtm_basis *basis, const double *matrix, int material) {
    float in_lanes[MTM_DIMENSION_MAX];
    double coefficients[MTM_DIMENSION_MAX];
    const int d = mtm_basis_dimension(basis);
    mtm_basis_encode_material(basis, material, in_lanes);
    for (int i = 0; i < d; i++) coefficients[i] = in_lanes[i];
    return mtm_basis_color(d, matrix, coefficients);
}

static mtm_status compare_light(const mtm_scene *scene, const mtm_basis *basis, int light,
                                mtm_basis_error *largest, mtm_error *error) {
    double weights[MTM_LIGHTS_MAX] = {0};
    double matrix[3 * MTM_DIMENSION_MAX];
    weights[light] = 1;
    const mtm_spectrum emission = mtm_palette_mix(&scene->palette, weights, 1);
    const mtm_illumination illumination =
        mtm_illumination_of(&emission, &scene->observer, scene->is_white_adapted ? 1 : 0);
    const mtm_status status = mtm_basis_matrix(basis, &illumination, matrix, error);
    for (int i = 0; i < scene->palette.material_count && status == MTM_OK; i++) {
        const mtm_rgb truth = mtm_illuminate(&illumination, &scene->palette.materials[i].reflectance);
        const double difference =
            mtm_ciede2000(mtm_lab_shown(color_of(basis, matrix, i)), mtm_lab_shown(truth));
        if (difference > largest->ciede2000) *largest = (mtm_basis_error){difference, i, light};
    }
    return status;
}

mtm_status mtm_scene_basis_error(const mtm_scene *scene, mtm_basis_error *largest, mtm_error *error) {
    mtm_basis *basis = NULL;
    *largest = (mtm_basis_error){0};
    mtm_status status = mtm_scene_make_basis(scene, scene->basis, &basis, error);
    if (status != MTM_OK || strcmp(mtm_basis_name(basis), "rgb") == 0) {
        mtm_basis_destroy(basis);
        return status;
    }
    for (int light = 0; light < scene->palette.light_count && status == MTM_OK; light++)
        status = compare_light(scene, basis, light, largest, error);
    mtm_basis_destroy(basis);
    return status;
}
