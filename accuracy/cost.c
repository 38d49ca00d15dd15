/* SPDX-License-Identifier: BSD-3-Clause
 * What a basis costs. */
#include "cost.h"

#include <assert.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "fail.h"

static const char *const bases[COST_BASES] = {"rgb",       "materials",   "factors:5",      "factors:7",
                                              "factors:9", "sharpened:7", "wavelengths:31", "wavelengths"};
enum { PALETTE = 1 /* measured */, LIGHT = 3 /* FL11 */ };

/* What the runs share; times in ms. */
typedef struct cost_work {
    const char *out_folder;
    mtm_scene *scene;
    mtm_volume *volume;
    double render[COST_BASES][COST_RUNS_MAX];
    double relight[COST_BASES][COST_RUNS_MAX];
} cost_work;

static double now_ms(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static mtm_status measure_file(const cost_work *work, const mtm_image *image, double *mib, mtm_error *error) {
    char path[4096];
    struct stat file;
    const mtm_image_write_options options = mtm_image_write_defaults();
    (void)snprintf(path, sizeof path, "%s/cost.exr", work->out_folder);
    mtm_status status = mtm_image_write(image, path, &options, error);
    if (status != MTM_OK) return status;
    if (stat(path, &file) != 0)
        status = fail(error, MTM_IO, "%s: cannot be read: %s", path, strerror(errno));
    else
        *mib = (double)file.st_size / (1 << 20);
    (void)remove(path);
    return status;
}

static mtm_status run_once(cost_work *work, int basis, int run, basis_cost *cost, mtm_error *error) {
    mtm_image *image = NULL;
    mtm_picture *picture = NULL;
    const double begin = now_ms();
    mtm_status status = engine_render(work->scene, work->volume, bases[basis], &image, error);
    const double middle = now_ms();
    if (status == MTM_OK) status = engine_relight(work->scene, image, LIGHT, &picture, error);
    work->relight[basis][run] = now_ms() - middle;
    work->render[basis][run] = middle - begin;
    if (status == MTM_OK && run == 0) {
        cost->dimension = image->dimension;
        status = measure_file(work, image, &cost->file_mib, error);
    }
    mtm_picture_destroy(picture);
    mtm_image_destroy(image);
    return status;
}

mtm_status cost_measure(const engine_options *options, const char *out_folder, int run_count,
                        basis_cost costs[COST_BASES], mtm_error *error) {
    assert(run_count >= 1 && run_count <= COST_RUNS_MAX);
    cost_work work = {.out_folder = out_folder};
    mtm_status status = engine_read(options, &work.scene, &work.volume, error);
    if (status != MTM_OK) return status;
    status = engine_use_palette(options->source_folder, PALETTE, work.scene, error);
    for (int run = 0; run < run_count; run++)
        for (int basis = 0; basis < COST_BASES && status == MTM_OK; basis++)
            status = run_once(&work, basis, run, &costs[basis], error);
    for (int basis = 0; basis < COST_BASES && status == MTM_OK; basis++) {
        (void)snprintf(costs[basis].basis, sizeof costs[basis].basis, "%s", bases[basis]);
        costs[basis].render_ms = median(run_count, work.render[basis]);
        costs[basis].relight_ms = median(run_count, work.relight[basis]);
    }
    mtm_volume_destroy(work.volume);
    mtm_scene_destroy(work.scene);
    return status;
}
