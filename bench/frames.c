/* SPDX-License-Identifier: BSD-3-Clause
 * How long a picture takes: projecting the volume (slow, knows no light) against relighting the result (instant, knows
 * no volume). Prints medians; asserts nothing. Usage: frames [SCENE.json [RUNS]] */
#include <stdio.h>
#include <stdlib.h>

#include "metamer/metamer.h"
#include "timing.h"

enum { RUNS_MAX = 1000 };

/* One projection and one relighting; the two alternate, so that a busy machine slows both. */
static mtm_status time_frame(const mtm_scene *scene, const mtm_volume *volume, double *project_ms,
                             double *relight_ms, mtm_error *error) {
    mtm_image *image = NULL;
    mtm_picture *picture = NULL;
    const double begin = now_ms();
    mtm_status status = mtm_scene_render(scene, volume, NULL, &image, error);
    const double middle = now_ms();
    if (status == MTM_OK) status = mtm_scene_relight(scene, image, 0, &picture, error);
    *relight_ms = now_ms() - middle;
    *project_ms = middle - begin;
    mtm_picture_destroy(picture);
    mtm_image_destroy(image);
    return status;
}

static mtm_status run(const char *path, int run_count, mtm_error *error) {
    double project_ms[RUNS_MAX];
    double relight_ms[RUNS_MAX];
    mtm_scene *scene = NULL;
    mtm_volume *volume = NULL;
    mtm_status status = mtm_scene_read(path, &scene, error);
    if (status == MTM_OK) status = mtm_scene_load_volume(scene, NULL, &volume, error);
    for (int i = 0; i < run_count && status == MTM_OK; i++)
        status = time_frame(scene, volume, &project_ms[i], &relight_ms[i], error);
    if (status == MTM_OK) {
        const double project = median(run_count, project_ms);
        const double relight = median(run_count, relight_ms);
        (void)printf("%s, %d x %d pixels, %d threads, median of %d\n", path, scene->render.width,
                     scene->render.height, mtm_default_thread_count(), run_count);
        (void)printf("  projecting  %9.2f ms\n  relighting  %9.2f ms\n  ratio       %9.1f\n", project,
                     relight, project / relight);
    }
    mtm_volume_destroy(volume);
    mtm_scene_destroy(scene);
    return status;
}

int main(int argc, char **argv) {
    const char *path = argc > 1 ? argv[1] : "examples/engine/engine.json";
    const int run_count = argc > 2 ? atoi(argv[2]) : 5;
    mtm_error error = {""};
    if (argc > 3 || run_count < 1 || run_count > RUNS_MAX) {
        (void)fprintf(stderr, "usage: frames [SCENE.json [RUNS]], RUNS from 1 to %d\n", RUNS_MAX);
        return 2;
    }
    if (run(path, run_count, &error) == MTM_OK) return 0;
    (void)fprintf(stderr, "frames: %s\n", error.message);
    return 1;
}
