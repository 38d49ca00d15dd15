/* SPDX-License-Identifier: BSD-3-Clause
 * Raycasting: prepares what the inner loop reads and runs it over tiles of the picture. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "render/raycast_kernel.h"
#include "render/raycast_plain.h"
#include "render/renderer.h"

static const mtm_raycast_kernel *const kernels[] = MTM_ISA_LIST(mtm_raycast_kernel);

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
        if (options->clip_low[axis] > 0 || options->clip_high[axis] < 1) raycast->is_clipped = true;
    }
}

/* Stored values of the smallest and the largest physical one. */
static void stored_range(const mtm_volume *volume, double *of_smallest, double *of_largest) {
    double smallest = 0;
    double largest = 0;
    mtm_volume_range(volume, &smallest, &largest);
    *of_smallest = (smallest - mtm_volume_intercept(volume)) / mtm_volume_slope(volume);
    *of_largest = (largest - mtm_volume_intercept(volume)) / mtm_volume_slope(volume);
}

/* How packets come from values to rows of the table. They read voxels of up to 16 bits as they are stored and others as
 * shares of the range. */
static void set_rows(mtm_raycast *raycast, const mtm_volume *volume) {
    const mtm_transfer_rows *rows = raycast->rows;
    const double spacing = mtm_grid_smallest_spacing(mtm_volume_grid(volume));
    double from = 0;
    double to = 0;
    stored_range(volume, &from, &to);
    const bool is_share = raycast->type > MTM_VOXEL_UINT16;
    const double range = to - from;
    raycast->lowest_stored = from;
    raycast->inverse_range = range != 0 ? 1 / range : 0;
    raycast->row_scale = (float)((is_share ? range : 1) / rows->spacing);
    raycast->row_offset = (float)(((is_share ? from : 0) - rows->first) / rows->spacing);
    const double per_gradient = is_share ? spacing : spacing * fabs(raycast->inverse_range);
    const double packed_unit = raycast->packed->gradient_scale * 16384; /* weights have 14 bits */
    raycast->fetched_gradient_scale =
        (float)(raycast->packed->voxel_bytes > 0 ? per_gradient / packed_unit : per_gradient);
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
    mtm_packed packed; /* voxel_bytes 0: not made */
    const mtm_transfer *transfer;
    mtm_occupancy occupancy;
    mtm_transfer_rows rows;
} raycast_prepared;

static void release(void *prepared) {
    raycast_prepared *raycast = prepared;
    if (raycast == NULL) return;
    mtm_blocks_free(&raycast->blocks);
    mtm_packed_free(&raycast->packed);
    mtm_occupancy_free(&raycast->occupancy);
    mtm_transfer_rows_free(&raycast->rows);
    free(raycast);
}

enum { BLOCK_LOG2 = 2, BLOCK_LOG2_MAX = 6, BYTES_PER_BLOCK = 2 * sizeof(float) + sizeof(uint32_t) + 1 };

/* Small blocks skip most; where memory is short they are larger. */
static int choose_block(const mtm_volume *volume, size_t memory_bytes) {
    int cells_log2 = BLOCK_LOG2;
    while (cells_log2 < BLOCK_LOG2_MAX &&
           (mtm_volume_voxel_count(volume) >> (3 * cells_log2)) > memory_bytes / BYTES_PER_BLOCK)
        cells_log2++;
    return cells_log2;
}

/* Packing comes first: it takes most of the time and of the memory. */
static mtm_status prepare_layouts(raycast_prepared *made, const mtm_render_options *options,
                                  const mtm_progress *progress, mtm_error *error) {
    size_t memory = options->memory_bytes > 0 ? options->memory_bytes : mtm_machine_memory() / 2;
    const mtm_volume *volume = made->volume;
    const size_t packed_bytes = mtm_packed_is_possible(volume) ? mtm_packed_bytes(volume) : SIZE_MAX;
    if (packed_bytes <= memory) {
        const mtm_status status =
            mtm_packed_create(volume, options->thread_count, progress, &made->packed, error);
        if (status != MTM_OK && status != MTM_MEMORY) return status;
        if (status == MTM_OK) memory -= packed_bytes;
    }
    const mtm_status status = mtm_blocks_create(volume, choose_block(volume, memory), options->thread_count,
                                                progress, &made->blocks, error);
    return status == MTM_OK ? mtm_occupancy_create(&made->blocks, &made->occupancy, error) : status;
}

static mtm_status prepare(const mtm_volume *volume, const mtm_render_options *options,
                          const mtm_progress *progress, void **prepared, mtm_error *error) {
    raycast_prepared *made = mtm_allocate(1, sizeof *made);
    if (made == NULL) return mtm_fail_memory(error, "the raycaster", sizeof *made);
    made->volume = volume;
    const mtm_status status = prepare_layouts(made, options, progress, error);
    if (status == MTM_OK)
        *prepared = made;
    else
        release(made);
    return status;
}

static mtm_status classify(void *prepared, const mtm_transfer *transfer, mtm_error *error) {
    raycast_prepared *raycast = prepared;
    const mtm_volume *volume = raycast->volume;
    double a = 0;
    double b = 0;
    stored_range(volume, &a, &b);
    mtm_transfer_rows_free(&raycast->rows);
    mtm_occupancy_update(&raycast->occupancy, &raycast->blocks, transfer);
    raycast->transfer = transfer;
    return mtm_transfer_rows_create(transfer, mtm_volume_slope(volume), mtm_volume_intercept(volume),
                                    fmin(a, b), fmax(a, b), mtm_volume_type(volume) < MTM_VOXEL_FLOAT32,
                                    &raycast->rows, error);
}

/* Moves the plane that orthographic rays are counted from before the whole volume. */
static void step_back(mtm_raycast *raycast, const mtm_grid *grid) {
    mtm_view *view = &raycast->view;
    if (!view->is_orthographic) return;
    double nearest = 0;
    for (int corner = 0; corner < 8; corner++) {
        double world[3];
        double depth = 0;
        const double voxel[3] = {corner & 1 ? grid->size[0] - 1 : 0, corner & 2 ? grid->size[1] - 1 : 0,
                                 corner & 4 ? grid->size[2] - 1 : 0};
        mtm_grid_to_world(grid, voxel, world);
        for (int i = 0; i < 3; i++) depth += (world[i] - view->eye[i]) * view->forward[i];
        nearest = fmin(nearest, depth);
    }
    for (int i = 0; i < 3; i++) view->eye[i] += (nearest - raycast->step) * view->forward[i];
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
    void (*render_tile)(const mtm_raycast *raycast, const mtm_lattice *lattice, int across, int down,
                        mtm_image *image);
    mtm_lattice lattice;
    mtm_image *image;
    int tiles_across;
} tile_job;

static void render_one_tile(void *context, int task) {
    const tile_job *job = context;
    const int across = task % job->tiles_across;
    const int down = task / job->tiles_across;
    job->render_tile(job->raycast, &job->lattice, across, down, job->image);
    mtm_lattice_spread(&job->lattice, across * MTM_TILE_PIXELS, down * MTM_TILE_PIXELS, MTM_TILE_PIXELS,
                       job->image);
}

static int tiles_along(const mtm_lattice *lattice, int first, int size) {
    return (mtm_lattice_count(lattice, first, size) + MTM_TILE_PIXELS - 1) / MTM_TILE_PIXELS;
}

static mtm_status render_lattice(const mtm_raycast *raycast, const mtm_lattice *lattice,
                                 const mtm_progress *progress, mtm_image *image, mtm_error *error) {
    const mtm_render_options *options = &raycast->options;
    const bool is_plain =
        options->blend == MTM_BLEND_MAXIMUM || (options->without & MTM_WITHOUT_PACKETS) != 0;
    tile_job job = {raycast, is_plain ? mtm_raycast_plain_tile : kernels[mtm_isa_chosen()]->render_tile,
                    *lattice, image, tiles_along(lattice, lattice->x, image->width)};
    const int tile_count = job.tiles_across * tiles_along(lattice, lattice->y, image->height);
    const mtm_status status =
        mtm_parallel_for(options->thread_count, tile_count, render_one_tile, &job, progress);
    return status == MTM_CANCELLED ? mtm_fail(error, status, "rendering was cancelled") : status;
}

static mtm_status project(const void *prepared, const mtm_camera *camera, const mtm_render_options *options,
                          const mtm_lattice *lattice, const mtm_progress *progress, mtm_image *image,
                          mtm_error *error) {
    const raycast_prepared *from = prepared;
    const mtm_grid *grid = mtm_volume_grid(from->volume);
    mtm_raycast raycast = {.transfer = from->transfer,
                           .rows = &from->rows,
                           .occupancy = &from->occupancy,
                           .block_highest = from->blocks.highest,
                           .packed = &from->packed,
                           .options = *options,
                           .view = mtm_camera_view(camera, grid),
                           .step = options->step * mtm_grid_smallest_spacing(grid)};
    step_back(&raycast, grid);
    set_volume(&raycast, from->volume);
    set_shading(&raycast, from->volume);
    set_rows(&raycast, from->volume);
    const mtm_status status = check_step(&raycast, grid, error);
    if (status != MTM_OK) return status;
    return render_lattice(&raycast, lattice, progress, image, error);
}

const mtm_renderer mtm_renderer_raycast = {"raycast", prepare, classify, project, release};
