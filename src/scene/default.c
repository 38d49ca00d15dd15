/* SPDX-License-Identifier: BSD-3-Clause
 * A scene for a volume nobody has described: what is object, how opaque, and from where it is seen. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "scene/scene.h"
#include "volume/voxel_type.h"

enum { HISTOGRAM_BINS = 1024 };

/* The value below which a fraction of the counted voxels lies. */
static double percentile(const uint64_t counts[HISTOGRAM_BINS], int first_bin, double fraction,
                         double smallest, double largest) {
    uint64_t total = 0;
    for (int i = first_bin; i < HISTOGRAM_BINS; i++) total += counts[i];
    uint64_t below = 0;
    for (int i = first_bin; i < HISTOGRAM_BINS; i++) {
        below += counts[i];
        if ((double)below >= fraction * (double)total)
            return smallest + (largest - smallest) * (i + 0.5) / HISTOGRAM_BINS;
    }
    return largest;
}

/* The bin that parts background from object so that the two are as far apart as they can be
 * (Otsu, "A threshold selection method from gray-level histograms", IEEE Trans. SMC 9(1), 1979). */
static int object_bin(const uint64_t counts[HISTOGRAM_BINS]) {
    double total = 0;
    double moment = 0;
    for (int i = 0; i < HISTOGRAM_BINS; i++) {
        total += (double)counts[i];
        moment += (double)counts[i] * i;
    }
    double below = 0;
    double below_moment = 0;
    double best = -1;
    int bin = 1;
    for (int i = 0; i + 1 < HISTOGRAM_BINS; i++) {
        below += (double)counts[i];
        below_moment += (double)counts[i] * i;
        if (below == 0 || below == total) continue;
        const double distance = below_moment / below - (moment - below_moment) / (total - below);
        const double separation = below * (total - below) * distance * distance;
        if (separation <= best) continue;
        best = separation;
        bin = i + 1;
    }
    return bin;
}

enum { DEFAULT_POINTS = 5 };

/* A haze over what lies just above the background, more for the middle, a solid core. Returns the value that parts
 * object from background. */
static double set_default_points(const mtm_volume *volume, mtm_scene *scene) {
    uint64_t counts[HISTOGRAM_BINS];
    double smallest = 0;
    double largest = 0;
    mtm_volume_range(volume, &smallest, &largest);
    mtm_volume_histogram(volume, HISTOGRAM_BINS, counts);
    const int first_bin = object_bin(counts);
    const double threshold = smallest + (largest - smallest) * first_bin / HISTOGRAM_BINS;
    const double values[DEFAULT_POINTS] = {
        smallest + 0.75 * (threshold - smallest),
        threshold,
        percentile(counts, first_bin, 0.5, smallest, largest),
        percentile(counts, first_bin, 0.9, smallest, largest),
        percentile(counts, first_bin, 0.99, smallest, largest),
    };
    static const double opacities[DEFAULT_POINTS] = {0, 0.03, 0.06, 0.3, 0.8};
    static const int materials[DEFAULT_POINTS] = {0, 0, 1, 1, 2};
    for (int i = 0; i < DEFAULT_POINTS; i++)
        scene->points[i] =
            (mtm_transfer_point){.value = values[i], .opacity = opacities[i], .material = materials[i]};
    scene->point_count = DEFAULT_POINTS;
    return threshold;
}

/* The voxels above a threshold, plane by plane along each axis. */
typedef struct plane_counts {
    size_t *counts[3];
} plane_counts;

static void count_row(const mtm_volume *volume, double threshold, int j, int k, const plane_counts *planes,
                      double *values) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    const size_t width = (size_t)grid->size[0];
    const size_t first = ((size_t)k * (size_t)grid->size[1] + (size_t)j) * width;
    mtm_voxels_to_double(mtm_volume_type(volume), mtm_volume_voxels(volume), first, width, values);
    for (size_t i = 0; i < width; i++) {
        if (!(mtm_volume_slope(volume) * values[i] + mtm_volume_intercept(volume) >= threshold)) continue;
        planes->counts[0][i]++;
        planes->counts[1][j]++;
        planes->counts[2][k]++;
    }
}

/* First and last plane along an axis that holds more than a few stray voxels; all of them where none does. */
static void find_extent(const mtm_grid *grid, int axis, const size_t *counts, double extent[2]) {
    const double others = (double)grid->size[(axis + 1) % 3] * grid->size[(axis + 2) % 3];
    const double stray = 2e-4 * others;
    int first = 0;
    int last = grid->size[axis] - 1;
    while (first < last && (double)counts[first] <= stray) first++;
    while (last > first && (double)counts[last] <= stray) last--;
    extent[0] = first < last ? first : 0;
    extent[1] = first < last ? last : grid->size[axis] - 1;
}

/* The box of what is above the threshold, in voxel coordinates. */
static mtm_status find_object(const mtm_volume *volume, double threshold, double extents[3][2],
                              mtm_error *error) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    plane_counts planes = {{NULL}};
    double *values = mtm_allocate((size_t)grid->size[0], sizeof *values);
    bool is_complete = values != NULL;
    for (int axis = 0; axis < 3; axis++) {
        planes.counts[axis] = mtm_allocate((size_t)grid->size[axis], sizeof *planes.counts[axis]);
        is_complete = is_complete && planes.counts[axis] != NULL;
    }
    if (is_complete) {
        for (int k = 0; k < grid->size[2]; k++)
            for (int j = 0; j < grid->size[1]; j++) count_row(volume, threshold, j, k, &planes, values);
        for (int axis = 0; axis < 3; axis++) find_extent(grid, axis, planes.counts[axis], extents[axis]);
    }
    for (int axis = 0; axis < 3; axis++) free(planes.counts[axis]);
    free(values);
    return is_complete ? MTM_OK : mtm_fail_memory(error, "the scene", (size_t)grid->size[0] * sizeof *values);
}

/* Looks at the middle of the object from as near as shows all eight corners of its box in a square or wider picture. */
static void frame_object(const mtm_grid *grid, double extents[3][2], mtm_camera *camera) {
    static const double margin = 1; /* a box-shaped object just fits */
    const double middle[3] = {(extents[0][0] + extents[0][1]) / 2, (extents[1][0] + extents[1][1]) / 2,
                              (extents[2][0] + extents[2][1]) / 2};
    camera->has_target = true;
    mtm_grid_to_world(grid, middle, camera->target);
    const mtm_view view = mtm_camera_view(camera, grid);
    double distance = 0;
    for (int corner = 0; corner < 8; corner++) {
        const double voxel[3] = {extents[0][corner & 1], extents[1][corner >> 1 & 1],
                                 extents[2][corner >> 2 & 1]};
        double world[3];
        double across = 0;
        double upward = 0;
        double nearer = 0;
        mtm_grid_to_world(grid, voxel, world);
        for (int i = 0; i < 3; i++) {
            const double offset = world[i] - camera->target[i];
            across += offset * view.right[i];
            upward += offset * view.up[i];
            nearer -= offset * view.forward[i];
        }
        distance = fmax(distance, nearer + margin * fmax(fabs(across), fabs(upward)) / view.half_height);
    }
    camera->distance = distance;
}

/* Opacity per hundredth of the volume's longest edge, so that small and large volumes look alike. */
static double default_opacity_length(const mtm_grid *grid) {
    double longest = 0;
    for (int axis = 0; axis < 3; axis++)
        longest = fmax(longest, grid->size[axis] * mtm_grid_spacing(grid, axis));
    return longest / 100;
}

mtm_status mtm_scene_for_volume(const mtm_volume *volume, const char *path, mtm_scene **scene,
                                mtm_error *error) {
    mtm_scene *made = NULL;
    char sha256[65];
    double smallest = 0;
    double largest = 0;
    mtm_volume_range(volume, &smallest, &largest);
    if (!isfinite(largest - smallest))
        return mtm_fail(error, MTM_LIMIT,
                        "%s: its values, %g to %g, are too far apart for a default scene; write a scene with "
                        "points of your own",
                        path, smallest, largest);
    char *folder = mtm_path_folder(path);
    if (folder == NULL) return mtm_fail_memory(error, "a path", strlen(path));
    mtm_status status = mtm_scene_create(path, folder, &made, error);
    free(folder);
    if (status != MTM_OK) return status;
    mtm_volume_sha256(volume, sha256);
    status = mtm_scene_state_volume(made, volume, path, sha256, error);
    if (status == MTM_OK) status = mtm_palette_defaults(&made->palette, error);
    if (status == MTM_OK) status = mtm_light_mix_create(made->palette.light_count, &made->lights, error);
    made->points = mtm_allocate(DEFAULT_POINTS, sizeof *made->points);
    if (status == MTM_OK && made->points == NULL)
        status = mtm_fail_memory(error, "the scene", DEFAULT_POINTS * sizeof *made->points);
    if (status != MTM_OK) {
        mtm_scene_destroy(made);
        return status;
    }
    const mtm_grid *grid = mtm_volume_grid(volume);
    double extents[3][2];
    const double threshold = set_default_points(volume, made);
    made->opacity_length = default_opacity_length(grid);
    if (grid->is_oriented) memcpy(made->camera.up, (const double[3]){0, 0, 1}, sizeof made->camera.up);
    status = find_object(volume, threshold, extents, error);
    if (status != MTM_OK) {
        mtm_scene_destroy(made);
        return status;
    }
    frame_object(grid, extents, &made->camera);
    *scene = made;
    return MTM_OK;
}
