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

/* Block tables for empty-space skipping, freed by free_blocks. */
static mtm_status set_blocks(mtm_raycast *raycast, const mtm_volume *volume, mtm_error *error) {
    mtm_blocks blocks;
    mtm_status status = mtm_blocks_create(volume, raycast->options.thread_count, &blocks, error);
    if (status != MTM_OK) return status;
    memcpy(raycast->block_size, blocks.size, sizeof raycast->block_size);
    const size_t count = (size_t)blocks.size[0] * (size_t)blocks.size[1] * (size_t)blocks.size[2];
    unsigned char *is_visible = mtm_allocate(count, sizeof *is_visible);
    float *highest = mtm_allocate(count, sizeof *highest);
    raycast->is_block_visible = is_visible;
    raycast->block_highest = highest;
    if (is_visible == NULL || highest == NULL) {
        status = mtm_fail_memory(error, "empty-space skipping", count * sizeof *highest);
    } else {
        for (size_t i = 0; i < count; i++) {
            is_visible[i] = mtm_transfer_is_visible(raycast->transfer, blocks.lowest[i], blocks.highest[i]);
            highest[i] = mtm_transfer_position(raycast->transfer, blocks.highest[i]);
        }
    }
    mtm_blocks_free(&blocks);
    return status;
}

static void free_blocks(mtm_raycast *raycast) {
    free((void *)raycast->is_block_visible);
    free((void *)raycast->block_highest);
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

static mtm_status render(const mtm_volume *volume, const mtm_transfer *transfer, const mtm_camera *camera,
                         const mtm_render_options *options, const mtm_progress *progress, mtm_image *image,
                         mtm_error *error) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    mtm_raycast raycast = {.transfer = transfer,
                           .options = *options,
                           .view = mtm_camera_view(camera, grid),
                           .step = options->step * mtm_grid_smallest_spacing(grid)};
    set_volume(&raycast, volume);
    set_shading(&raycast, volume);
    mtm_status status = check_step(&raycast, grid, error);
    if (status == MTM_OK) status = set_blocks(&raycast, volume, error);
    if (status == MTM_OK) {
        const int tiles_across = (image->width + MTM_TILE_PIXELS - 1) / MTM_TILE_PIXELS;
        const int tiles_down = (image->height + MTM_TILE_PIXELS - 1) / MTM_TILE_PIXELS;
        tile_job job = {&raycast, image, tiles_across};
        status = mtm_parallel_for(options->thread_count, tiles_across * tiles_down, render_one_tile, &job,
                                  progress);
        if (status == MTM_CANCELLED) (void)mtm_fail(error, status, "rendering was cancelled");
    }
    free_blocks(&raycast);
    return status;
}

const mtm_renderer mtm_renderer_raycast = {.name = "raycast", .render = render};
