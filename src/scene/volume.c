/* SPDX-License-Identifier: BSD-3-Clause
 * Finding a scene's volume and knowing it again. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/json.h"
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

mtm_status mtm_scene_state_volume(mtm_scene *scene, const mtm_volume *volume, const char *path,
                                  const char *sha256, mtm_error *error) {
    if (!mtm_json_can_hold(mtm_path_name(path), strlen(mtm_path_name(path))))
        return mtm_fail(error, MTM_ARGUMENT,
                        "%s: its name is not UTF-8, which a scene cannot hold; rename it", path);
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
    if (status == MTM_OK) status = mtm_scene_state_volume(scene, read, path, sha256, error);
    free(path);
    if (status != MTM_OK) {
        mtm_volume_destroy(read);
        return status;
    }
    *volume = read;
    return MTM_OK;
}
