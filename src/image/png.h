/* SPDX-License-Identifier: BSD-3-Clause
 * What the PNG writer and reader share. */
#ifndef METAMER_IMAGE_PNG_H
#define METAMER_IMAGE_PNG_H

#include <stdio.h>

#include "metamer/image.h"

#define MTM_PNG_SCENE "metamer.scene" /* keyword of the iTXt chunk */

/* libpng leaves by a jump. What must outlive that is kept in a structure behind a pointer, never in a local
 * variable of the function that calls setjmp. */
enum { MTM_PNG_REASON_BYTES = 256 };

/* The reader behind mtm_picture_read_png and mtm_scene_text_of_png: `stream` stays open, `path` names it in
 * messages. `scene` may be NULL. Where `picture` is NULL only the chunks before the pixels are read. */
MTM_CHECK mtm_status mtm_png_read_stream(FILE *stream, const char *path, mtm_picture **picture, char **scene,
                                         mtm_error *error);

#endif
