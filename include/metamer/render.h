/* SPDX-License-Identifier: BSD-3-Clause
 * Projecting a volume into a spectral image, without any light. */
#ifndef METAMER_RENDER_H
#define METAMER_RENDER_H

#include "metamer/camera.h"
#include "metamer/image.h"
#include "metamer/transfer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How samples along a ray become a pixel. */
typedef enum mtm_blend {
    MTM_BLEND_COMPOSITE, /* emission and absorption, front to back */
    MTM_BLEND_SUM,       /* ∫ emission, nothing absorbs, alpha 0: an X-ray picture */
    MTM_BLEND_MAXIMUM, /* the largest value along the ray, classified as one opacity length of it, unshaded */
} mtm_blend;

/* Blinn–Phong with the normal turned to the viewer: ρ · (ambient + diffuse · n·l) + white · specular · (n·h)^shininess.
 * Highlights belong to matter that absorbs: they are weighted with the smaller of emission and extinction, so that an
 * X-ray material (emission without opacity) that a light makes black disappears. Unshaded is ambient 1, diffuse 0,
 * specular 0. */
typedef struct mtm_shading {
    double ambient, diffuse, specular; /* ≥ 0 */
    double shininess;                  /* ≥ 0 */
    bool is_headlight;                 /* the light shines along the ray */
    double direction[3];               /* else: from the volume toward the light, world axes, not zero */
    double
        gradient_threshold; /* below it only ambient; fades in up to twice that. In fractions of the volume's value
                                  range per smallest spacing */
} mtm_shading;

/* What makes rendering fast, to be left out one by one where that is measured. Pictures stay the same, to rounding. */
enum {
    MTM_WITHOUT_PACKETS = 1,  /* one ray at a time in double precision: the plain reference */
    MTM_WITHOUT_SKIPPING = 2, /* every sample is read, also in empty space */
    MTM_WITHOUT_PREFETCH = 4, /* voxels are not asked for ahead */
};

typedef struct mtm_render_options {
    int width, height; /* pixels */
    double step;       /* sample distance, in smallest spacings, > 0 */
    bool
        is_preintegrated; /* a step is the transfer function's mean over the values along it; false: its middle */
    mtm_blend blend;
    bool jitter; /* each ray's samples shifted by a fixed random part of a step: noise instead of rings */
    double termination; /* a ray ends where its transmittance falls below this; 0: never */
    mtm_shading shading;
    double clip_low[3], clip_high[3]; /* fractions of the volume's box */
    int thread_count;                 /* 0: all processors; the picture is the same bits for any */
    size_t
        memory_bytes; /* for layouts derived from the volume; 0: half of the machine's memory. Where they do not fit,
                            the volume's own voxels are read: slower, the same picture to 8 bits */
    int without; /* of MTM_WITHOUT_…; 0: nothing is left out */
} mtm_render_options;

/* All defaults, with their reasons. */
MTM_API mtm_render_options mtm_render_defaults(void);

/* The names of the renderers, in the order of their table; NULL beyond the last. */
MTM_API const char *mtm_renderer_name(int index);

/* Renders with the renderer of that name into `image`, whose size and dimension are those of the options and the
 * transfer function; what it held is replaced.
 * Step k of a ray begins (k + jitter) · step behind the ray's entry into the volume's box (or the eye inside it). It is
 * the mean of the transfer function over the values between its ends, in two halves beyond an optical depth of 0.3;
 * without pre-integration the sample in its middle stands for it. Clipping and the volume's end cut steps and never
 * move them.
 * MTM_ARGUMENT for an unknown renderer, MTM_LIMIT for a step that needs more than 10⁶ samples along a ray,
 * MTM_MEMORY, MTM_CANCELLED. Sources: paper section 5, Max (TVCG 1(2), 1995), Levoy (CG&A 8(3), 1988). */
MTM_API MTM_CHECK mtm_status mtm_render(const char *renderer, const mtm_volume *volume,
                                        const mtm_transfer *transfer, const mtm_camera *camera,
                                        const mtm_render_options *options, const mtm_progress *progress,
                                        mtm_image *image, mtm_error *error);

/* A renderer prepared for one volume. What a picture needs is made at three speeds: once per volume (blocks), once per
 * transfer function (which blocks are visible), once per view; a projector keeps the first two for many views. */
typedef struct mtm_projector mtm_projector;

/* Prepares the renderer of that name for the volume, which must outlive the projector. Of the options only
 * thread_count and memory_bytes are read. MTM_ARGUMENT for an unknown renderer, MTM_MEMORY, MTM_CANCELLED. Release
 * with mtm_projector_destroy (NULL allowed). */
MTM_API MTM_CHECK mtm_status mtm_projector_create(const char *renderer, const mtm_volume *volume,
                                                  const mtm_render_options *options,
                                                  const mtm_progress *progress, mtm_projector **projector,
                                                  mtm_error *error);
MTM_API void mtm_projector_destroy(mtm_projector *projector);

/* Takes another transfer function, which must outlive its use here. After MTM_MEMORY the projector has none. */
MTM_API MTM_CHECK mtm_status mtm_projector_set_transfer(mtm_projector *projector,
                                                        const mtm_transfer *transfer, mtm_error *error);

/* mtm_render without the preparations; the projector has a transfer function (precondition). Calls may run at the same
 * time for different images. */
MTM_API MTM_CHECK mtm_status mtm_projector_render(const mtm_projector *projector, const mtm_camera *camera,
                                                  const mtm_render_options *options,
                                                  const mtm_progress *progress, mtm_image *image,
                                                  mtm_error *error);

/* A picture that comes coarse first and then finer. */
typedef struct mtm_refinement {
    int coarsest; /* 1, 2, 4, 8 or 16: the stride of the first stage */
    /* A stage is complete: every stride-th pixel across and down is computed. Called from the thread that started the
     * work with the coarsest stride, half of it, … 1. Returning false ends the work there with MTM_CANCELLED. */
    bool (*refined)(void *user, int stride); /* NULL: nobody listens */
    void *user;
} mtm_refinement;

/* mtm_projector_render in stages, each with twice the pixels across and down. No pixel is computed twice, and the last
 * stage leaves the same bits. After the stage of a stride, pixel (x, y) holds what belongs to
 * (x - x mod stride, y - y mod stride); within the next stage, to that or to its pixel of half the stride, so that
 * the picture stays complete when it is cancelled there. Progress rises over all stages. */
MTM_API MTM_CHECK mtm_status mtm_projector_refine(const mtm_projector *projector, const mtm_camera *camera,
                                                  const mtm_render_options *options,
                                                  const mtm_refinement *refinement,
                                                  const mtm_progress *progress, mtm_image *image,
                                                  mtm_error *error);

/* Adds a reflecting background behind everything: c += (1 - A) · coefficients, A = 1 (paper eq. 5, first term). */
MTM_API void mtm_image_put_background(mtm_image *image, const float *coefficients);

#ifdef __cplusplus
}
#endif
#endif
