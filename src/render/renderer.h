/* SPDX-License-Identifier: BSD-3-Clause
 * What a renderer is: a row of the table in render.c, implemented in a file of its own. */
#ifndef METAMER_RENDER_RENDERER_H
#define METAMER_RENDER_RENDERER_H

#include "metamer/render.h"
#include "render/lattice.h"

/* `prepared` is the renderer's own and belongs to one volume; `release` takes NULL. `project` computes the pixels of a
 * lattice, each the same bits in any, and spreads them (mtm_lattice_spread). */
typedef struct mtm_renderer {
    const char *name;
    mtm_status (*prepare)(const mtm_volume *volume, const mtm_render_options *options,
                          const mtm_progress *progress, void **prepared, mtm_error *error);
    mtm_status (*classify)(void *prepared, const mtm_transfer *transfer, mtm_error *error);
    mtm_status (*project)(const void *prepared, const mtm_camera *camera, const mtm_render_options *options,
                          const mtm_lattice *lattice, const mtm_progress *progress, mtm_image *image,
                          mtm_error *error);
    void (*release)(void *prepared);
} mtm_renderer;

extern const mtm_renderer mtm_renderer_raycast;

#endif
