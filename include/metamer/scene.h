/* SPDX-License-Identifier: BSD-3-Clause
 * The scene document (version 1): everything a picture is made from, and making it. docs/scene.md is its manual. */
#ifndef METAMER_SCENE_H
#define METAMER_SCENE_H

#include "metamer/palette.h"
#include "metamer/relight.h"
#include "metamer/render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a light's bulb is on the dial (unit disk, y up). */
typedef struct mtm_bulb {
    int light;
    double at[2];
    bool is_on;
} mtm_bulb;

/* A mix of the palette's lights. The weights are the truth; the dial is only how it was found. */
typedef struct mtm_light_mix {
    double *weights; /* one for each light of the palette, ≥ 0 */
    double intensity;
    bool has_dot;
    double dot[2];
    int bulb_count;
    mtm_bulb *bulbs;
} mtm_light_mix;

/* A mix to return to. */
typedef struct mtm_stop {
    char name[MTM_NAME_MAX + 1];
    mtm_light_mix mix;
} mtm_stop;

typedef enum mtm_background {
    MTM_BACKGROUND_BLACK,    /* the document names none */
    MTM_BACKGROUND_COLOR,    /* a display color behind the picture */
    MTM_BACKGROUND_MATERIAL, /* a material, lit by the light, behind the volume */
    MTM_BACKGROUND_NONE,     /* the picture keeps its alpha */
} mtm_background;

typedef struct mtm_scene {
    char *document;         /* the file, for messages */
    char *folder;           /* where its relative file names begin */
    char *volume_file;      /* as the document names it */
    int volume_size[3];     /* 0: not stated */
    char volume_sha256[65]; /* of its voxels; "": not stated */
    mtm_palette palette;
    double opacity_length; /* world units; 0: the smallest voxel spacing */
    int point_count;
    mtm_transfer_point *points;
    mtm_camera camera;
    char renderer[32];
    char basis[32];
    mtm_render_options render; /* with shading and clip */
    mtm_background background;
    char background_srgb[8]; /* "#rrggbb" */
    int background_material;
    mtm_observer observer;
    bool is_white_adapted; /* "white": "light" */
    mtm_light_mix lights;
    int stop_count;
    mtm_stop *stops;
} mtm_scene;

/* Reads a scene document, strictly: unknown keys, wrong types and values out of range are errors that name file, key
 * and value: MTM_FORMAT; MTM_IO, MTM_LIMIT and MTM_MEMORY as its files give them. Release with mtm_scene_destroy (NULL
 * allowed). */
MTM_API MTM_CHECK mtm_status mtm_scene_read(const char *path, mtm_scene **scene, mtm_error *error);

/* The same from text; `document` names it in messages, `folder` is where its files are. NULL: an embedded document that
 * stands alone and may name no file but its volume, which is then looked for in the working folder. */
MTM_API MTM_CHECK mtm_status mtm_scene_parse(const char *document, const char *text, const char *folder,
                                             mtm_scene **scene, mtm_error *error);
MTM_API void mtm_scene_destroy(mtm_scene *scene);

/* A scene for a volume nobody has described: opacity from the percentiles of its values, three materials, three
 * lights, and a camera that shows the object whole in a square picture. `path` is the volume's file. MTM_LIMIT where its
 * values are too far apart, MTM_ARGUMENT where its name is not UTF-8, MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_scene_for_volume(const mtm_volume *volume, const char *path,
                                                  mtm_scene **scene, mtm_error *error);

/* Reads the scene's volume: `volume_path` where not NULL, else the document's file beside the document, then in the
 * folders of the environment variable METAMER_DATA (separated by colons). A volume of another size or hash than the
 * document states is refused (MTM_ARGUMENT) unless `volume_path` names it. Afterwards the scene states name, size and
 * hash of the volume that was read. MTM_IO, MTM_FORMAT, MTM_LIMIT and MTM_MEMORY as its file gives them. */
MTM_API MTM_CHECK mtm_status mtm_scene_load_volume(mtm_scene *scene, const char *volume_path,
                                                   mtm_volume **volume, mtm_error *error);

/* The scene as a document that stands alone: spectra inlined, the volume by file name, size and hash. The same scene
 * always gives the same text, and reading it gives the same scene but for the volume's folder, which is left out. Release with mtm_text_free; NULL when out of
 * memory. */
MTM_API char *mtm_scene_format(const mtm_scene *scene);

/* Sets the mix to one light after another: every weight to 0, or one by name (MTM_ARGUMENT for an unknown name), or
 * all of a stop's. */
MTM_API void mtm_scene_clear_weights(mtm_scene *scene);
MTM_API MTM_CHECK mtm_status mtm_scene_set_weight(mtm_scene *scene, const char *light, double weight,
                                                  mtm_error *error);
MTM_API MTM_CHECK mtm_status mtm_scene_use_stop(mtm_scene *scene, const char *stop, mtm_error *error);

/* Makes one light of that name and spectrum the only one that shines; added to the palette where it is new. Of a long
 * name only the first MTM_NAME_MAX bytes are kept. */
MTM_API MTM_CHECK mtm_status mtm_scene_use_light(mtm_scene *scene, const char *name,
                                                 const mtm_spectrum *emission, mtm_error *error);

/* Replaces reflectances and lights as mtm_palette_override does, keeping the weights by name. */
MTM_API MTM_CHECK mtm_status mtm_scene_override_palette(mtm_scene *scene, const mtm_palette *palette,
                                                        mtm_error *error);

/* The light, observer and display of the scene. */
MTM_API mtm_illumination mtm_scene_illumination(const mtm_scene *scene);

/* Where a basis is farthest from full spectra. */
typedef struct mtm_basis_error {
    double ciede2000; /* of picture colors, clipped, against D65 */
    int material, light;
} mtm_basis_error;

/* The largest color difference between the scene's basis and full spectra over its materials, each alone under one of the
 * lights alone; 0 for exact bases and where there are no materials or lights. "rgb" is exact under its own light, the
 * only one it has. MTM_NUMERIC and MTM_MEMORY as mtm_basis_create gives them. */
MTM_API MTM_CHECK mtm_status mtm_scene_basis_error(const mtm_scene *scene, mtm_basis_error *largest,
                                                   mtm_error *error);

/* Renders the scene into a new spectral image that carries palette and scene. */
MTM_API MTM_CHECK mtm_status mtm_scene_render(const mtm_scene *scene, const mtm_volume *volume,
                                              const mtm_progress *progress, mtm_image **image,
                                              mtm_error *error);

/* The 81 × dimension rows of mtm_basis_reconstruction for an image of the scene. */
MTM_API MTM_CHECK mtm_status mtm_scene_reconstruction(const mtm_scene *scene, const mtm_image *image,
                                                      float *rows, mtm_error *error);

/* The scene an image carries, or the default scene's lights for an image of another program. */
MTM_API MTM_CHECK mtm_status mtm_scene_of_image(const mtm_image *image, const char *path, mtm_scene **scene,
                                                mtm_error *error);

/* The image under the scene's light, on the scene's background. The scene is the image's own, changed: its materials are
 * the image's, in the image's order. MTM_ARGUMENT where the image's basis cannot be lit that way, with the reason;
 * MTM_FORMAT where the number of materials does not fit; MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_scene_relight(const mtm_scene *scene, const mtm_image *image,
                                               int thread_count, mtm_picture **picture, mtm_error *error);

#ifdef __cplusplus
}
#endif
#endif
