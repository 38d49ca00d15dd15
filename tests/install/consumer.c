/* SPDX-License-Identifier: BSD-3-Clause
 * A program outside of the project that uses most of what the static library links: EXR, PNG, JSON, hashing. */
#include <stdio.h>
#include <string.h>

#include <metamer/metamer.h>

static mtm_status use_everything(mtm_error *error) {
    const mtm_grid grid = mtm_grid_defaults(8, 8, 8);
    mtm_volume *volume = NULL;
    mtm_scene *scene = NULL;
    mtm_image *image = NULL;
    mtm_picture *picture = NULL;
    const mtm_image_write_options options = mtm_image_write_defaults();
    mtm_status status = mtm_volume_create(&grid, MTM_VOXEL_UINT8, NULL, 1, 0, &volume, error);
    if (status == MTM_OK) status = mtm_scene_for_volume(volume, "zeros.nrrd", &scene, error);
    if (status == MTM_OK) {
        scene->render.width = 16;
        scene->render.height = 16;
        status = mtm_scene_render(scene, volume, NULL, &image, error);
    }
    if (status == MTM_OK) status = mtm_image_write(image, "consumer.exr", &options, error);
    if (status == MTM_OK) status = mtm_scene_relight(scene, image, 1, &picture, error);
    if (status == MTM_OK) status = mtm_picture_write_png(picture, "consumer.png", NULL, error);
    mtm_picture_destroy(picture);
    mtm_image_destroy(image);
    mtm_scene_destroy(scene);
    mtm_volume_destroy(volume);
    return status;
}

int main(void) {
    mtm_error error = {""};
    if (strcmp(mtm_version(), EXPECTED_VERSION) != 0) {
        (void)fprintf(stderr, "version %s, expected %s\n", mtm_version(), EXPECTED_VERSION);
        return 1;
    }
    if (use_everything(&error) == MTM_OK) return 0;
    (void)fprintf(stderr, "%s\n", error.message);
    return 1;
}
