/* SPDX-License-Identifier: BSD-3-Clause
 * Materials and lights: the palette of a scene. */
#ifndef METAMER_PALETTE_H
#define METAMER_PALETTE_H

#include "metamer/color.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    MTM_NAME_MAX = 63,      /* bytes of a name */
    MTM_MATERIALS_MAX = 82, /* materials of a palette */
    MTM_LIGHTS_MAX = 256,   /* lights of a palette */
};

typedef struct mtm_material {
    char name[MTM_NAME_MAX + 1];
    mtm_spectrum reflectance;
} mtm_material;

typedef struct mtm_light {
    char name[MTM_NAME_MAX + 1];
    mtm_spectrum emission; /* as given, after filters; mtm_palette_mix scales it */
} mtm_light;

/* Names are unique among the materials and among the lights. */
typedef struct mtm_palette {
    int material_count;
    mtm_material *materials;
    int light_count;
    mtm_light *lights;
} mtm_palette;

MTM_API void mtm_palette_free(mtm_palette *palette);
/* A copy of its own. MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_palette_copy(const mtm_palette *palette, mtm_palette *copy,
                                              mtm_error *error);

/* Three materials (soft, middle, dense) and three lights (daylight, lamp, tube) for a volume nobody has described. MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_palette_defaults(mtm_palette *palette, mtm_error *error);

/* Reads {"materials": […], "lights": […]} as described in docs/scene.md; CSV files are looked for beside it. Every
 * error names the file, the key and the value. On success release with mtm_palette_free. */
MTM_API MTM_CHECK mtm_status mtm_palette_read(const char *path, mtm_palette *palette, mtm_error *error);

/* The same from text; `document` names it in messages, `folder` is where its CSV files are. NULL: an embedded document
 * that stands alone and may name none. MTM_FORMAT; MTM_IO, MTM_LIMIT and MTM_MEMORY as its files give them. */
MTM_API MTM_CHECK mtm_status mtm_palette_parse(const char *document, const char *text, const char *folder,
                                               mtm_palette *palette, mtm_error *error);

/* The palette as a document that stands alone: every spectrum as 81 values that read back exactly. Release with
 * mtm_text_free; NULL when out of memory. */
MTM_API char *mtm_palette_format(const mtm_palette *palette);

/* Index by name, or -1. */
MTM_API int mtm_palette_find_material(const mtm_palette *palette, const char *name);
MTM_API int mtm_palette_find_light(const mtm_palette *palette, const char *name);

/* The name that is most like one that was not found, for messages; "" where the palette has none. */
MTM_API const char *mtm_palette_nearest_material(const mtm_palette *palette, const char *name);
MTM_API const char *mtm_palette_nearest_light(const mtm_palette *palette, const char *name);

/* The scene's light: intensity · Σ weights[i]·Eᵢ over the palette's lights, each scaled to Y = 1 on the perfect
 * reflector (CIE 1931) first; weights are not renormalised. A light without luminance, which no document can hold, adds
 * nothing. */
MTM_API mtm_spectrum mtm_palette_mix(const mtm_palette *palette, const double *weights, double intensity);

/* Takes the reflectances of materials and the lights of `other` that have the same name, and adds its other lights.
 * MTM_ARGUMENT where nothing is taken: no material in common and no light at all; MTM_LIMIT beyond MTM_LIGHTS_MAX
 * lights of both together; MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_palette_override(mtm_palette *palette, const mtm_palette *other,
                                                  mtm_error *error);

#ifdef __cplusplus
}
#endif
#endif
