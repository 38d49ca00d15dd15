/* SPDX-License-Identifier: BSD-3-Clause
 * What several subcommands do: opening inputs of any kind, progress, writing pictures. */
#ifndef METAMER_CLI_TASK_H
#define METAMER_CLI_TASK_H

#include <stdio.h>

#include "command.h"
#include "metamer/metamer.h"

/* Prints "metamer NAME: message" and returns EXIT_FAILED. */
int fail_command(const subcommand *command, const mtm_error *error);

/* Puts the file, and the option where not NULL, before a message that does not begin with the file already. Returns the
 * status; does nothing for MTM_OK. */
mtm_status name_failure(mtm_status status, const char *path, const char *option, mtm_error *error);

/* A progress bar on standard error where that is a terminal, else silence. `label` is shown before it. */
typedef struct progress_bar {
    const char *label;
    int shown_percent;
    bool is_terminal;
} progress_bar;
mtm_progress start_progress(progress_bar *bar, const char *label);
void end_progress(progress_bar *bar);

/* What a file is, by its content (a scene by its first character). */
typedef enum file_kind { FILE_UNREADABLE, FILE_PNG, FILE_EXR, FILE_JSON, FILE_OTHER } file_kind;
file_kind kind_of_file(const char *path);

/* Moves a stream at its beginning behind the mark that some editors put before UTF-8 text. */
void skip_utf8_mark(FILE *stream);
bool has_extension(const char *path, const char *extension);

/* The scene a file describes (a document, a picture or an image that carries one, or a volume's default scene) and its
 * volume; `volume_path` NULL: where the scene says. */
mtm_status open_scene(const char *path, const char *volume_path, mtm_scene **scene, mtm_volume **volume,
                      mtm_error *error);

/* The light "FILE.csv:COLUMN" is, or the illuminant of that name. MTM_NUMERIC where it has no luminance, and the
 * errors of mtm_spectrum_read and mtm_illuminant. */
mtm_status open_illuminant(const char *text, mtm_spectrum *light, mtm_error *error);

/* The observer or camera a file that ends in .csv holds, or the observer of that name; errors as mtm_observer_read and
 * mtm_observer_get. */
mtm_status open_observer(const char *name_or_file, mtm_observer *observer, mtm_error *error);

/* MTM_IO where an output file cannot be written: worth knowing before long work. A file is replaced by a new one, so
 * its folder must allow that; a device or a pipe is written itself. */
mtm_status check_output(const char *path, mtm_error *error);

/* The same for a picture, whose name ends in .png (or .exr where `is_image_possible`), so that no spectral image is
 * replaced by a picture by mistake. Devices and pipes may have any name. */
mtm_status check_picture_output(const char *path, bool is_image_possible, mtm_error *error);

/* Writes the picture with the scene it shows embedded. */
mtm_status write_picture(const mtm_picture *picture, const mtm_scene *scene, const char *path,
                         mtm_error *error);

#endif
