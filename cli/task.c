/* SPDX-License-Identifier: BSD-3-Clause
 * What several subcommands do. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "task.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

int fail_command(const subcommand *command, const mtm_error *error) {
    (void)fprintf(stderr, "metamer %s: ", command->name);
    print_plainly(stderr, error->message);
    (void)fprintf(stderr, "\n");
    return EXIT_FAILED;
}

mtm_status name_failure(mtm_status status, const char *path, const char *option, mtm_error *error) {
    if (status == MTM_OK || strncmp(error->message, path, strlen(path)) == 0) return status;
    const mtm_error reason = *error;
    const char *colon = option == NULL ? "" : ": ";
    (void)snprintf(error->message, sizeof error->message, "%.400s: %s%s%.500s", path,
                   option == NULL ? "" : option, colon, reason.message);
    return status;
}

static bool show_progress(void *user, double fraction) {
    enum { WIDTH = 40 };
    progress_bar *bar = user;
    const int percent = (int)(100 * fraction);
    if (!bar->is_terminal || percent == bar->shown_percent) return true;
    bar->shown_percent = percent;
    char blocks[WIDTH + 1];
    memset(blocks, '.', WIDTH);
    memset(blocks, '#', (size_t)(WIDTH * percent / 100));
    blocks[WIDTH] = '\0';
    (void)fprintf(stderr, "\r%s [%s] %3d %%", bar->label, blocks, percent);
    return true;
}

mtm_progress start_progress(progress_bar *bar, const char *label) {
    *bar = (progress_bar){.label = label, .shown_percent = -1, .is_terminal = isatty(STDERR_FILENO) == 1};
    return (mtm_progress){show_progress, bar};
}

void end_progress(progress_bar *bar) {
    if (bar->is_terminal && bar->shown_percent >= 0) (void)fprintf(stderr, "\r\033[K");
}

bool has_extension(const char *path, const char *extension) {
    const size_t length = strlen(path);
    const size_t extension_length = strlen(extension);
    return length > extension_length && strcasecmp(path + length - extension_length, extension) == 0;
}

/* Neither a file nor a folder, but something to write into: a device, a pipe. */
static bool is_device(const char *path) {
    struct stat state;
    return stat(path, &state) == 0 && !S_ISREG(state.st_mode) && !S_ISDIR(state.st_mode);
}

void skip_utf8_mark(FILE *stream) {
    char mark[3] = "";
    if (fread(mark, 1, sizeof mark, stream) != sizeof mark || memcmp(mark, "\xEF\xBB\xBF", sizeof mark) != 0)
        rewind(stream);
}

file_kind kind_of_file(const char *path) {
    if (is_device(path)) return FILE_OTHER; /* what is read to look at it would be gone */
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) return FILE_UNREADABLE;
    skip_utf8_mark(stream);
    int first = fgetc(stream);
    while (first != EOF && isspace(first)) first = fgetc(stream);
    (void)fclose(stream);
    if (mtm_file_is_png(path)) return FILE_PNG;
    if (mtm_file_is_exr(path)) return FILE_EXR;
    return first == '{' || has_extension(path, ".json") ? FILE_JSON : FILE_OTHER;
}

/* The folder part of a path, in a new text for free(). */
static char *folder_of(const char *path) {
    char *folder = strdup(path);
    char *slash = folder == NULL ? NULL : strrchr(folder, '/');
    if (slash == NULL) {
        free(folder);
        return strdup(".");
    }
    slash[slash == folder ? 1 : 0] = '\0';
    return folder;
}

static mtm_status scene_of_text(const char *path, const char *text, mtm_scene **scene, mtm_error *error) {
    if (text == NULL) {
        (void)snprintf(error->message, sizeof error->message, "%s: carries no scene to render", path);
        return MTM_FORMAT;
    }
    const mtm_status status = mtm_scene_parse(path, text, NULL, scene, error);
    char *folder = status == MTM_OK ? folder_of(path) : NULL;
    if (folder != NULL) { /* its volume is looked for beside the picture */
        free((*scene)->folder);
        (*scene)->folder = folder;
    }
    return status;
}

static mtm_status scene_of_png(const char *path, mtm_scene **scene, mtm_error *error) {
    char *text = NULL;
    mtm_status status = mtm_scene_text_of_png(path, &text, error);
    if (status == MTM_OK) status = scene_of_text(path, text, scene, error);
    mtm_text_free(text);
    return status;
}

static mtm_status scene_of_exr(const char *path, mtm_scene **scene, mtm_error *error) {
    mtm_image *image = NULL;
    mtm_status status = mtm_image_read(path, &image, error);
    if (status == MTM_OK) status = scene_of_text(path, image->scene, scene, error);
    mtm_image_destroy(image);
    return status;
}

mtm_status open_scene(const char *path, const char *volume_path, mtm_scene **scene, mtm_volume **volume,
                      mtm_error *error) {
    mtm_status status = MTM_OK;
    switch (kind_of_file(path)) {
    case FILE_PNG: status = scene_of_png(path, scene, error); break;
    case FILE_EXR: status = scene_of_exr(path, scene, error); break;
    case FILE_JSON: status = mtm_scene_read(path, scene, error); break;
    case FILE_UNREADABLE:
    case FILE_OTHER:
        if (volume_path != NULL) {
            (void)snprintf(error->message, sizeof error->message,
                           "%s: is no scene and no picture, so there is no volume to replace by --volume %s",
                           path, volume_path);
            return MTM_ARGUMENT;
        }
        status = mtm_volume_read(path, volume, error);
        return status == MTM_OK ? mtm_scene_for_volume(*volume, path, scene, error) : status;
    }
    return status == MTM_OK ? mtm_scene_load_volume(*scene, volume_path, volume, error) : status;
}

mtm_status open_illuminant(const char *text, mtm_spectrum *light, mtm_error *error) {
    mtm_observer observer;
    mtm_spectrum normalized;
    const bool is_file =
        strchr(text, ':') != NULL || has_extension(text, ".csv"); /* which then lacks a column */
    mtm_status status = is_file ? mtm_spectrum_read(".", text, MTM_KIND_LIGHT, light, error)
                                : mtm_illuminant(text, light, error);
    if (status == MTM_OK) status = mtm_observer_get("cie1931", &observer, error);
    return status == MTM_OK ? mtm_light_normalize(light, &observer, &normalized, error) : status;
}

mtm_status open_observer(const char *name_or_file, mtm_observer *observer, mtm_error *error) {
    return has_extension(name_or_file, ".csv") ? mtm_observer_read(name_or_file, observer, error)
                                               : mtm_observer_get(name_or_file, observer, error);
}

mtm_status check_output(const char *path, mtm_error *error) {
    char *target = realpath(path, NULL); /* of a link, the file behind it is replaced */
    char *folder = folder_of(target == NULL ? path : target);
    struct stat state;
    bool is_writable = folder != NULL && (is_device(path) || access(folder, W_OK | X_OK) == 0);
    if (is_writable && stat(path, &state) == 0) {
        is_writable = !S_ISDIR(state.st_mode) && access(path, W_OK) == 0;
        if (S_ISDIR(state.st_mode)) errno = EISDIR;
    }
    if (!is_writable)
        (void)snprintf(error->message, sizeof error->message, "%s: cannot be written: %s", path,
                       strerror(errno));
    free(folder);
    free(target);
    return is_writable ? MTM_OK : MTM_IO;
}

mtm_status check_picture_output(const char *path, bool is_image_possible, mtm_error *error) {
    if (has_extension(path, ".png") || (is_image_possible && has_extension(path, ".exr")) || is_device(path))
        return check_output(path, error);
    (void)snprintf(error->message, sizeof error->message, "%s: %s", path,
                   is_image_possible ? "the output's name must end in .exr (spectral image) or .png (picture)"
                                     : "the output is a picture, so its name must end in .png");
    return MTM_ARGUMENT;
}

mtm_status write_picture(const mtm_picture *picture, const mtm_scene *scene, const char *path,
                         mtm_error *error) {
    if (scene->volume_file == NULL) return mtm_picture_write_png(picture, path, NULL, error);
    char *text = mtm_scene_format(scene);
    if (text == NULL) {
        (void)snprintf(error->message, sizeof error->message, "%s: out of memory for the embedded scene",
                       path);
        return MTM_MEMORY;
    }
    const mtm_status status = mtm_picture_write_png(picture, path, text, error);
    mtm_text_free(text);
    return status;
}
