/* SPDX-License-Identifier: BSD-3-Clause
 * What a renderer is: a row of the table in render.c, implemented in a file of its own. */
#ifndef METAMER_RENDER_RENDERER_H
#define METAMER_RENDER_RENDERER_H

#include "metamer/render.h"

typedef struct mtm_renderer {
    const char *name;
    mtm_status (*render)(const mtm_volume *volume, const mtm_transfer *transfer, const mtm_camera *camera,
                         const mtm_render_options *options, const mtm_progress *progress, mtm_image *image,
                         mtm_error *error);
} mtm_renderer;

extern const mtm_renderer mtm_renderer_raycast;

#endif
