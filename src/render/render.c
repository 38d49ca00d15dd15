/* SPDX-License-Identifier: BSD-3-Clause
 * The table of renderers and what they share. */
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "render/renderer.h"
#include "transfer/table.h"

static const mtm_renderer *const renderers[] = {&mtm_renderer_raycast};
enum { RENDERER_COUNT = sizeof renderers / sizeof *renderers };

mtm_render_options mtm_render_defaults(void) {
    return (mtm_render_options){
        .width = 512, /* the paper's picture size */
        .height = 512,
        .step = 0.5, /* half a voxel: the sampling rate that a linear transfer function needs (Nyquist) */
        .is_preintegrated = true, /* without it, thin peaks of the transfer function show as rings */
        .blend = MTM_BLEND_COMPOSITE,
        .termination = 1.0 / 1024, /* invisible even where a light is raised a few times afterwards */
        .shading = {.ambient = 0.3,
                    .diffuse = 0.7,
                    .specular = 0.3,
                    .shininess = 32,
                    .is_headlight = true,
                    .direction = {0, 0, 1},
                    .gradient_threshold = 0.01}, /* noise of 8-bit scans stays below it */
        .clip_high = {1, 1, 1},
    };
}

const char *mtm_renderer_name(int index) {
    return index >= 0 && index < RENDERER_COUNT ? renderers[index]->name : NULL;
}

static mtm_status fail_unknown(const char *name, mtm_error *error) {
    char known[128] = "";
    for (size_t i = 0; i < RENDERER_COUNT; i++) {
        const size_t length = strlen(known);
        (void)snprintf(known + length, sizeof known - length, "%s%s", i > 0 ? ", " : "", renderers[i]->name);
    }
    return mtm_fail(error, MTM_ARGUMENT, "renderer \"%s\" is not known; known are %s", name, known);
}

struct mtm_projector {
    const mtm_renderer *renderer;
    const mtm_transfer *transfer; /* NULL: none yet */
    void *prepared;
};

static const mtm_renderer *find_renderer(const char *name) {
    for (size_t i = 0; i < RENDERER_COUNT; i++)
        if (strcmp(name, renderers[i]->name) == 0) return renderers[i];
    return NULL;
}

mtm_status mtm_projector_create(const char *renderer, const mtm_volume *volume,
                                const mtm_render_options *options, const mtm_progress *progress,
                                mtm_projector **projector, mtm_error *error) {
    const mtm_renderer *found = find_renderer(renderer);
    if (found == NULL) return fail_unknown(renderer, error);
    mtm_projector *made = mtm_allocate(1, sizeof *made);
    if (made == NULL) return mtm_fail_memory(error, "the projector", sizeof *made);
    made->renderer = found;
    const mtm_status status = found->prepare(volume, options, progress, &made->prepared, error);
    if (status != MTM_OK) {
        mtm_projector_destroy(made);
        return status;
    }
    *projector = made;
    return MTM_OK;
}

void mtm_projector_destroy(mtm_projector *projector) {
    if (projector == NULL) return;
    projector->renderer->release(projector->prepared);
    free(projector);
}

mtm_status mtm_projector_set_transfer(mtm_projector *projector, const mtm_transfer *transfer,
                                      mtm_error *error) {
    const mtm_status status = projector->renderer->classify(projector->prepared, transfer, error);
    projector->transfer = status == MTM_OK ? transfer : NULL;
    return status;
}

/* A picture on the way through its lattices. */
typedef struct refining {
    const mtm_projector *projector;
    const mtm_camera *camera;
    const mtm_render_options *options;
    const mtm_progress *progress; /* NULL: nobody listens */
    mtm_image *image;
    double begun, share; /* of the pixels: in lattices before this one, in this one */
} refining;

static bool report_share(void *user, double fraction) {
    const refining *picture = user;
    const mtm_progress *progress = picture->progress;
    if (progress == NULL || progress->report == NULL) return true;
    return progress->report(progress->user, fmin(picture->begun + fraction * picture->share, 1));
}

static mtm_status project(refining *picture, const mtm_lattice *lattice, mtm_error *error) {
    const mtm_projector *projector = picture->projector;
    const mtm_image *image = picture->image;
    const mtm_progress progress = {report_share, picture};
    picture->share = (double)mtm_lattice_count(lattice, lattice->x, image->width) / image->width *
                     mtm_lattice_count(lattice, lattice->y, image->height) / image->height;
    const mtm_status status = projector->renderer->project(
        projector->prepared, picture->camera, picture->options, lattice, &progress, picture->image, error);
    picture->begun += picture->share;
    return status;
}

static mtm_status finish_stage(const mtm_refinement *refinement, int stride, mtm_error *error) {
    if (refinement->refined == NULL || refinement->refined(refinement->user, stride)) return MTM_OK;
    return mtm_fail(error, MTM_CANCELLED, "rendering was cancelled");
}

mtm_status mtm_projector_refine(const mtm_projector *projector, const mtm_camera *camera,
                                const mtm_render_options *options, const mtm_refinement *refinement,
                                const mtm_progress *progress, mtm_image *image, mtm_error *error) {
    const int coarsest = refinement->coarsest;
    assert(projector->transfer != NULL);
    assert(image->width == options->width && image->height == options->height);
    assert(image->dimension == projector->transfer->dimension && image->lanes == projector->transfer->lanes);
    assert(coarsest >= 1 && coarsest <= 16 && (coarsest & (coarsest - 1)) == 0);
    refining picture = {
        .projector = projector, .camera = camera, .options = options, .progress = progress, .image = image};
    mtm_status status = project(&picture, &(mtm_lattice){0, 0, coarsest}, error);
    if (status == MTM_OK) status = finish_stage(refinement, coarsest, error);
    for (int stride = coarsest; stride > 1 && status == MTM_OK; stride /= 2) {
        const int half = stride / 2;
        const mtm_lattice finer[] = {{half, 0, stride}, {0, half, stride}, {half, half, stride}};
        for (int i = 0; i < 3 && status == MTM_OK; i++) status = project(&picture, &finer[i], error);
        if (status == MTM_OK) status = finish_stage(refinement, half, error);
    }
    return status;
}

mtm_status mtm_projector_render(const mtm_projector *projector, const mtm_camera *camera,
                                const mtm_render_options *options, const mtm_progress *progress,
                                mtm_image *image, mtm_error *error) {
    return mtm_projector_refine(projector, camera, options, &(mtm_refinement){.coarsest = 1}, progress, image,
                                error);
}

mtm_status mtm_render(const char *renderer, const mtm_volume *volume, const mtm_transfer *transfer,
                      const mtm_camera *camera, const mtm_render_options *options,
                      const mtm_progress *progress, mtm_image *image, mtm_error *error) {
    mtm_projector *projector = NULL;
    mtm_status status = mtm_projector_create(renderer, volume, options, NULL, &projector, error);
    if (status == MTM_OK) status = mtm_projector_set_transfer(projector, transfer, error);
    if (status == MTM_OK) status = mtm_projector_render(projector, camera, options, progress, image, error);
    mtm_projector_destroy(projector);
    return status;
}

void mtm_image_put_background(mtm_image *image, const float *coefficients) {
    const size_t pixel_count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixel_count; i++) {
        float *pixel = image->pixels + i * (size_t)image->lanes;
        const float transmittance = 1 - pixel[image->dimension];
        for (int k = 0; k < image->dimension; k++) pixel[k] += transmittance * coefficients[k];
        pixel[image->dimension] = 1;
    }
}
