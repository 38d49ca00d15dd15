/* SPDX-License-Identifier: BSD-3-Clause
 * Finding a scene's volume, knowing it again, and a scene for a volume that has none. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/memory.h"
#include "scene/scene.h"

/* The file in one of the folders of a colon-separated list; NULL where none has it. */
static char *find_in_folders(const char *folders, const char *file) {
    while (folders != NULL && *folders != '\0') {
        const char *end = strchr(folders, ':');
        const size_t length = end == NULL ? strlen(folders) : (size_t)(end - folders);
        char *folder = malloc(length + 1);
        if (folder == NULL) return NULL;
        memcpy(folder, folders, length);
        folder[length] = '\0';
        char *path = length > 0 ? mtm_path_join(folder, file) : NULL;
        free(folder);
        if (path != NULL && mtm_file_exists(path)) return path;
        free(path);
        folders = end == NULL ? NULL : end + 1;
    }
    return NULL;
}

static mtm_status find_volume(const mtm_scene *scene, char **path, mtm_error *error) {
    char *beside = mtm_path_join(scene->folder, scene->volume_file);
    if (beside == NULL) return mtm_fail_memory(error, "a path", strlen(scene->volume_file));
    *path = beside;
    if (mtm_file_exists(beside)) return MTM_OK;
    free(beside);
    *path = find_in_folders(getenv("METAMER_DATA"), scene->volume_file);
    if (*path != NULL) return MTM_OK;
    return mtm_fail(
        error, MTM_IO,
        "%s: volume.file \"%s\" is neither in %s nor in the folders of METAMER_DATA; set METAMER_DATA or "
        "name the volume with --volume",
        scene->document, scene->volume_file, scene->folder);
}

static mtm_status check_identity(const mtm_scene *scene, const char *path, const int size[3],
                                 const char *sha256, mtm_error *error) {
    const int *stated = scene->volume_size;
    if (stated[0] > 0 && (stated[0] != size[0] || stated[1] != size[1] || stated[2] != size[2]))
        return mtm_fail(
            error, MTM_ARGUMENT,
            "%s: is %d x %d x %d voxels, %s was made from %d x %d x %d; name the volume with --volume to "
            "use it all the same",
            path, size[0], size[1], size[2], scene->document, stated[0], stated[1], stated[2]);
    if (scene->volume_sha256[0] != '\0' && strcmp(scene->volume_sha256, sha256) != 0)
        return mtm_fail(
            error, MTM_ARGUMENT,
            "%s: is not the volume %s was made from (SHA-256 of its voxels %.12s…, not %.12s…); name it "
            "with --volume to use it all the same",
            path, scene->document, sha256, scene->volume_sha256);
    return MTM_OK;
}

/* Makes the scene state the volume it is rendered from. */
static mtm_status state_volume(mtm_scene *scene, const mtm_volume *volume, const char *path,
                               const char *sha256, mtm_error *error) {
    char *name = mtm_text_copy(mtm_path_name(path));
    if (name == NULL) return mtm_fail_memory(error, "the scene", strlen(path));
    free(scene->volume_file);
    scene->volume_file = name;
    memcpy(scene->volume_size, mtm_volume_grid(volume)->size, sizeof scene->volume_size);
    (void)snprintf(scene->volume_sha256, sizeof scene->volume_sha256, "%s", sha256);
    return MTM_OK;
}

mtm_status mtm_scene_load_volume(mtm_scene *scene, const char *volume_path, mtm_volume **volume,
                                 mtm_error *error) {
    char *path = NULL;
    mtm_volume *read = NULL;
    char sha256[65] = "";
    mtm_status status = MTM_OK;
    if (volume_path == NULL)
        status = find_volume(scene, &path, error);
    else if ((path = mtm_text_copy(volume_path)) == NULL)
        status = mtm_fail_memory(error, "a path", strlen(volume_path));
    if (status == MTM_OK) status = mtm_volume_read(path, &read, error);
    if (status == MTM_OK) {
        mtm_volume_sha256(read, sha256);
        if (volume_path == NULL)
            status = check_identity(scene, path, mtm_volume_grid(read)->size, sha256, error);
    }
    if (status == MTM_OK) status = state_volume(scene, read, path, sha256, error);
    free(path);
    if (status != MTM_OK) {
        mtm_volume_destroy(read);
        return status;
    }
    *volume = read;
    return MTM_OK;
}

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

/* A haze over what lies just above the background, more for the middle, a solid core. */
static void set_default_points(const mtm_volume *volume, mtm_scene *scene) {
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
    char *folder = mtm_path_folder(path);
    if (folder == NULL) return mtm_fail_memory(error, "a path", strlen(path));
    mtm_status status = mtm_scene_create(path, folder, &made, error);
    free(folder);
    if (status != MTM_OK) return status;
    mtm_volume_sha256(volume, sha256);
    status = state_volume(made, volume, path, sha256, error);
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
    set_default_points(volume, made);
    made->opacity_length = default_opacity_length(grid);
    if (grid->is_oriented) memcpy(made->camera.up, (const double[3]){0, 0, 1}, sizeof made->camera.up);
    *scene = made;
    return MTM_OK;
}
