/* SPDX-License-Identifier: BSD-3-Clause
 * Raycasting: prepares what the inner loop reads and runs it over tiles of the picture. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "render/raycast_kernel.h"
#include "render/renderer.h"
#include "volume/blocks.h"

static const double samples_max = 1e6; /* along a ray: a picture of hours is a mistake in the step */

static void set_volume(mtm_raycast *raycast, const mtm_volume *volume) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    const mtm_render_options *options = &raycast->options;
    raycast->voxels = mtm_volume_voxels(volume);
    raycast->type = mtm_volume_type(volume);
    raycast->slope = mtm_volume_slope(volume);
    raycast->intercept = mtm_volume_intercept(volume);
    mtm_grid_inverse_axes(grid, raycast->inverse_axes);
    size_t stride = 1;
    for (int axis = 0; axis < 3; axis++) {
        raycast->size[axis] = grid->size[axis];
        raycast->stride[axis] = grid->size[axis] > 1 ? stride : 0;
        stride *= (size_t)grid->size[axis];
        raycast->grid_origin[axis] = grid->origin[axis];
        raycast->box_low[axis] = options->clip_low[axis] * (grid->size[axis] - 1);
        raycast->box_high[axis] = options->clip_high[axis] * (grid->size[axis] - 1);
    }
    mtm_raycast_choose_loaders(raycast);
}

static void set_shading(mtm_raycast *raycast, const mtm_volume *volume) {
    const mtm_shading *shading = &raycast->options.shading;
    double smallest = 0;
    double largest = 0;
    mtm_volume_range(volume, &smallest, &largest);
    const double range_positions = (largest - smallest) * raycast->transfer->scale;
    const double spacing = mtm_grid_smallest_spacing(mtm_volume_grid(volume));
    raycast->gradient_scale = range_positions > 0 ? spacing / range_positions : 0;
    raycast->lowest_position = mtm_transfer_position(raycast->transfer, smallest);
    raycast->needs_gradient = shading->diffuse > 0 || shading->specular > 0;
    const double *d = shading->direction;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++) raycast->light[i] = length > 0 ? d[i] / length : 0;
}

/* What a volume and a transfer function are brought to before any view. */
typedef struct raycast_prepared {
    const mtm_volume *volume;
    mtm_blocks blocks;
    const mtm_transfer *transfer;
    unsigned char *is_block_visible;
    float *block_highest;
} raycast_prepared;

static void release(void *prepared) {
    raycast_prepared *raycast = prepared;
    if (raycast == NULL) return;
    mtm_blocks_free(&raycast->blocks);
    free(raycast->is_block_visible);
    free(raycast->block_highest);
    free(raycast);
}

static size_t block_count(const mtm_blocks *blocks) {
    return (size_t)blocks->size[0] * (size_t)blocks->size[1] * (size_t)blocks->size[2];
}

static mtm_status prepare(const mtm_volume *volume, const mtm_render_options *options,
                          const mtm_progress *progress, void **prepared, mtm_error *error) {
    (void)progress;
    raycast_prepared *made = mtm_allocate(1, sizeof *made);
    if (made == NULL) return mtm_fail_memory(error, "the raycaster", sizeof *made);
    made->volume = volume;
    mtm_status status = mtm_blocks_create(volume, options->thread_count, &made->blocks, error);
    if (status == MTM_OK) {
        const size_t count = block_count(&made->blocks);
        made->is_block_visible = mtm_allocate(count, sizeof *made->is_block_visible);
        made->block_highest = mtm_allocate(count, sizeof *made->block_highest);
        if (made->is_block_visible == NULL || made->block_highest == NULL)
            status = mtm_fail_memory(error, "empty-space skipping", count * sizeof *made->block_highest);
    }
    if (status == MTM_OK)
        *prepared = made;
    else
        release(made);
    return status;
}

static mtm_status classify(void *prepared, const mtm_transfer *transfer, mtm_error *error) {
    (void)error;
    raycast_prepared *raycast = prepared;
    const mtm_blocks *blocks = &raycast->blocks;
    const size_t count = block_count(blocks);
    for (size_t i = 0; i < count; i++) {
        raycast->is_block_visible[i] =
            mtm_transfer_is_visible(transfer, blocks->lowest[i], blocks->highest[i]);
        raycast->block_highest[i] = mtm_transfer_position(transfer, blocks->highest[i]);
    }
    raycast->transfer = transfer;
    return MTM_OK;
}

static mtm_status check_step(const mtm_raycast *raycast, const mtm_grid *grid, mtm_error *error) {
    double longest_ray_bound = 0;
    for (int axis = 0; axis < 3; axis++)
        longest_ray_bound += (grid->size[axis] - 1) * mtm_grid_spacing(grid, axis);
    if (longest_ray_bound / raycast->step <= samples_max) return MTM_OK;
    return mtm_fail(error, MTM_LIMIT, "step %g needs more than %g samples along a ray", raycast->options.step,
                    samples_max);
}

typedef struct tile_job {
    const mtm_raycast *raycast;
    mtm_image *image;
    int tiles_across;
} tile_job;

static void render_one_tile(void *context, int task) {
    const tile_job *job = context;
    const int x = task % job->tiles_across * MTM_TILE_PIXELS;
    const int y = task / job->tiles_across * MTM_TILE_PIXELS;
    mtm_raycast_tile(job->raycast, x, y, job->image);
}

static mtm_status project(const void *prepared, const mtm_camera *camera, const mtm_render_options *options,
                          const mtm_progress *progress, mtm_image *image, mtm_error *error) {
    const raycast_prepared *from = prepared;
    const mtm_grid *grid = mtm_volume_grid(from->volume);
    mtm_raycast raycast = {.transfer = from->transfer,
                           .options = *options,
                           .is_block_visible = from->is_block_visible,
                           .block_highest = from->block_highest,
                           .view = mtm_camera_view(camera, grid),
                           .step = options->step * mtm_grid_smallest_spacing(grid)};
    memcpy(raycast.block_size, from->blocks.size, sizeof raycast.block_size);
    set_volume(&raycast, from->volume);
    set_shading(&raycast, from->volume);
    mtm_status status = check_step(&raycast, grid, error);
    if (status != MTM_OK) return status;
    const int tiles_across = (image->width + MTM_TILE_PIXELS - 1) / MTM_TILE_PIXELS;
    const int tiles_down = (image->height + MTM_TILE_PIXELS - 1) / MTM_TILE_PIXELS;
    tile_job job = {&raycast, image, tiles_across};
    status =
        mtm_parallel_for(options->thread_count, tiles_across * tiles_down, render_one_tile, &job, progress);
    if (status == MTM_CANCELLED) (void)mtm_fail(error, status, "rendering was cancelled");
    return status;
}

const mtm_renderer mtm_renderer_raycast = {"raycast", prepare, classify, project, release};
