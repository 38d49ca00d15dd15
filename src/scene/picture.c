/* SPDX-License-Identifier: BSD-3-Clause
 * From a scene to a spectral image, and from an image to a picture: the two halves of the map. */
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "scene/scene.h"

/* Every light has Y = 1 before its weight. */
static double luminance_of(const mtm_scene *scene) {
    double sum = 0;
    for (int i = 0; i < scene->palette.light_count; i++) sum += scene->lights.weights[i];
    return scene->lights.intensity * sum;
}

mtm_illumination mtm_scene_illumination(const mtm_scene *scene) {
    const mtm_spectrum light =
        mtm_palette_mix(&scene->palette, scene->lights.weights, scene->lights.intensity);
    return mtm_illumination_of(&light, &scene->observer, scene->is_white_adapted ? luminance_of(scene) : 0);
}

mtm_status mtm_scene_make_basis(const mtm_scene *scene, const char *name, mtm_basis **basis,
                                mtm_error *error) {
    const mtm_palette *palette = &scene->palette;
    const mtm_illumination illumination = mtm_scene_illumination(scene);
    mtm_spectrum *reflectances = mtm_allocate((size_t)palette->material_count, sizeof *reflectances);
    if (reflectances == NULL) return mtm_fail_memory(error, "the basis", sizeof *reflectances);
    for (int i = 0; i < palette->material_count; i++) reflectances[i] = palette->materials[i].reflectance;
    const mtm_status status =
        mtm_basis_create(name, palette->material_count, reflectances, &illumination, basis, error);
    free(reflectances);
    return status;
}

static mtm_status make_image(const mtm_scene *scene, const mtm_basis *basis, mtm_image **image,
                             mtm_error *error) {
    char *palette = mtm_palette_format(&scene->palette);
    char *document = mtm_scene_format(scene);
    mtm_status status = MTM_OK;
    if (palette == NULL || document == NULL)
        status = mtm_fail_memory(error, "the scene's text", 1 << 16);
    else
        status = mtm_image_create(scene->render.width, scene->render.height, mtm_basis_dimension(basis),
                                  mtm_basis_name(basis), palette, document, image, error);
    mtm_text_free(palette);
    mtm_text_free(document);
    return status;
}

static void put_background(const mtm_scene *scene, const mtm_basis *basis, mtm_image *image) {
    float coefficients[MTM_DIMENSION_MAX];
    if (scene->background != MTM_BACKGROUND_MATERIAL) return;
    mtm_basis_encode_material(basis, scene->background_material, coefficients);
    mtm_image_put_background(image, coefficients);
}

mtm_status mtm_scene_render(const mtm_scene *scene, const mtm_volume *volume, const mtm_progress *progress,
                            mtm_image **image, mtm_error *error) {
    mtm_basis *basis = NULL;
    mtm_transfer *transfer = NULL;
    mtm_image *made = NULL;
    const double opacity_length = scene->opacity_length > 0
                                      ? scene->opacity_length
                                      : mtm_grid_smallest_spacing(mtm_volume_grid(volume));
    mtm_status status = mtm_scene_make_basis(scene, scene->basis, &basis, error);
    if (status == MTM_OK)
        status =
            mtm_transfer_create(scene->point_count, scene->points, opacity_length, basis, &transfer, error);
    if (status == MTM_OK) status = make_image(scene, basis, &made, error);
    if (status == MTM_OK)
        status = mtm_render(scene->renderer, volume, transfer, &scene->camera, &scene->render, progress, made,
                            error);
    if (status == MTM_OK)
        put_background(scene, basis, made);
    else
        mtm_image_destroy(made);
    mtm_transfer_destroy(transfer);
    mtm_basis_destroy(basis);
    if (status == MTM_OK) *image = made;
    return status;
}

mtm_status mtm_scene_reconstruction(const mtm_scene *scene, const mtm_image *image, float *rows,
                                    mtm_error *error) {
    mtm_basis *basis = NULL;
    mtm_status status = mtm_scene_make_basis(scene, image->basis, &basis, error);
    if (status == MTM_OK) status = mtm_basis_reconstruction(basis, rows, error);
    mtm_basis_destroy(basis);
    return status;
}

/* What an image of another program is looked at with: the default lights. */
static mtm_status make_plain_scene(const char *path, mtm_scene **scene, mtm_error *error) {
    mtm_scene *made = NULL;
    mtm_status status = mtm_scene_create(path, ".", &made, error);
    if (status == MTM_OK) status = mtm_palette_defaults(&made->palette, error);
    if (status == MTM_OK) {
        made->palette.material_count = 0;
        status = mtm_light_mix_create(made->palette.light_count, &made->lights, error);
    }
    if (status != MTM_OK)
        mtm_scene_destroy(made);
    else
        *scene = made;
    return status;
}

mtm_status mtm_scene_of_image(const mtm_image *image, const char *path, mtm_scene **scene, mtm_error *error) {
    if (image->scene == NULL) return make_plain_scene(path, scene, error);
    return mtm_scene_parse(path, image->scene, NULL, scene, error);
}

/* The reflectances of a finished image are in its coefficients, unless its basis is the materials. */
static mtm_status check_reflectances(const mtm_scene *scene, const mtm_image *image, mtm_error *error) {
    mtm_palette rendered;
    if (strcmp(image->basis, "materials") == 0 || image->palette == NULL) return MTM_OK;
    mtm_status status = mtm_palette_parse("metamer.palette", image->palette, NULL, &rendered, error);
    for (int i = 0; status == MTM_OK && i < rendered.material_count; i++) {
        const int match = mtm_palette_find_material(&scene->palette, rendered.materials[i].name);
        const mtm_spectrum *before = &rendered.materials[i].reflectance;
        if (match < 0 || memcmp(before, &scene->palette.materials[match].reflectance, sizeof *before) == 0)
            continue;
        status =
            mtm_fail(error, MTM_ARGUMENT,
                     "material \"%s\" has another reflectance than the image was rendered with; basis \"%s\" "
                     "cannot change it afterwards, render with --basis materials",
                     rendered.materials[i].name, image->basis);
    }
    mtm_palette_free(&rendered);
    return status;
}

static mtm_status make_matrix(const mtm_scene *scene, const mtm_image *image, double *matrix,
                              mtm_error *error) {
    const mtm_illumination illumination = mtm_scene_illumination(scene);
    mtm_basis *basis = NULL;
    mtm_scene *rendered = NULL; /* "rgb" knows only the light it was rendered under */
    mtm_status status = check_reflectances(scene, image, error);
    if (status == MTM_OK && strcmp(image->basis, "rgb") == 0)
        status = mtm_scene_of_image(image, scene->document, &rendered, error);
    if (status == MTM_OK)
        status = mtm_scene_make_basis(rendered != NULL ? rendered : scene, image->basis, &basis, error);
    if (status == MTM_OK && mtm_basis_dimension(basis) != image->dimension)
        status = mtm_fail(error, MTM_FORMAT, "%s: has %d coefficients, its palette in basis \"%s\" needs %d",
                          scene->document, image->dimension, image->basis, mtm_basis_dimension(basis));
    if (status == MTM_OK) status = mtm_basis_matrix(basis, &illumination, matrix, error);
    mtm_basis_destroy(basis);
    mtm_scene_destroy(rendered);
    return status;
}

mtm_status mtm_scene_relight(const mtm_scene *scene, const mtm_image *image, int thread_count,
                             mtm_picture **picture, mtm_error *error) {
    double matrix[3 * MTM_DIMENSION_MAX];
    mtm_relight_options options = mtm_relight_defaults();
    options.thread_count = thread_count;
    options.has_background = scene->background != MTM_BACKGROUND_NONE;
    mtm_status status = make_matrix(scene, image, matrix, error);
    if (status == MTM_OK && scene->background == MTM_BACKGROUND_COLOR)
        status = mtm_rgb_parse(scene->background_srgb, &options.background, error);
    if (status == MTM_OK) status = mtm_relight(image, matrix, &options, picture, error);
    return status;
}
