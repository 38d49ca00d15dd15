/* SPDX-License-Identifier: BSD-3-Clause
 * How far pictures of the engine scene are off in each basis, with its own palette and with measured reflectances. */
#ifndef METAMER_ACCURACY_ENGINE_H
#define METAMER_ACCURACY_ENGINE_H

#include "metamer/metamer.h"
#include "statistics.h"

enum { ENGINE_PALETTES = 5, ENGINE_LIGHTS = 5, ENGINE_BASES = 7, ENGINE_FACTORS_7 = 3 };

extern const char *const engine_bases[ENGINE_BASES];       /* [ENGINE_FACTORS_7] is "factors:7" */
extern const char *const engine_palettes[ENGINE_PALETTES]; /* 0 is the scene's own; the rest are measured */
extern const char *const engine_lights[ENGINE_LIGHTS];

typedef struct engine_options {
    const char *source_folder; /* with examples/engine */
    int edge;                  /* pixels along both edges of a picture */
    double step;               /* as in the scene; 0: the scene's own */
    int thread_count;          /* 0: all processors */
} engine_options;

/* CIEDE2000 of pixels that hold anything against "wavelengths"; white is the light. "rgb" is relit as a plain renderer
 * does it: rendered under D65, then multiplied with the light's own color. */
typedef struct engine_errors {
    error_summary each[ENGINE_BASES][ENGINE_PALETTES][ENGINE_LIGHTS];
    error_summary palette[ENGINE_BASES][ENGINE_PALETTES]; /* all lights */
    error_summary measured[ENGINE_BASES];                 /* all lights, all palettes but the scene's own */
    int edge, pixel_count;                                /* of a picture; pixels that hold anything */
} engine_errors;

/* Renders the scene in all bases with all palettes. Errors: those of reading and rendering a scene. */
MTM_CHECK mtm_status engine_measure(const engine_options *options, engine_errors *errors, mtm_error *error);

/* The scene with its volume; and with the palette of that index (0 … ENGINE_PALETTES-1) instead of its own. On success
 * the caller calls mtm_scene_destroy and mtm_volume_destroy. */
MTM_CHECK mtm_status engine_read(const engine_options *options, mtm_scene **scene, mtm_volume **volume,
                                 mtm_error *error);
MTM_CHECK mtm_status engine_use_palette(const char *source_folder, int palette, mtm_scene *scene,
                                        mtm_error *error);

/* The scene in that basis, and a picture of the image under light 0 … ENGINE_LIGHTS-1. */
MTM_CHECK mtm_status engine_render(mtm_scene *scene, const mtm_volume *volume, const char *basis,
                                   mtm_image **image, mtm_error *error);
MTM_CHECK mtm_status engine_relight(mtm_scene *scene, const mtm_image *image, int light,
                                    mtm_picture **picture, mtm_error *error);

#endif
