/* SPDX-License-Identifier: BSD-3-Clause
 * The spectral image (before light) and the picture (after it); EXR, PNG, comparison. */
#ifndef METAMER_IMAGE_H
#define METAMER_IMAGE_H

#include "metamer/basis.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { MTM_IMAGE_EDGE_MAX = 32768 /* pixels along an edge */ };

/* A spectral image: `dimension` coefficients and then alpha (1 − transmittance) per pixel, premultiplied, padded
 * with zeros to `lanes` floats; rows from the top. The texts make the file stand alone. */
typedef struct mtm_image {
    int width, height;
    int dimension;
    int lanes;
    float *pixels; /* height × width × lanes */
    char *basis;   /* the basis the coefficients are in: "materials", "wavelengths", "rgb"; never NULL */
    char *palette; /* the palette (JSON) it was rendered with; NULL for a file of another program */
    char *scene;   /* the scene (JSON); NULL likewise */
} mtm_image;

/* A black, transparent image; the texts are copied, `palette` and `scene` may be NULL. Preconditions: width and
 * height 1 … MTM_IMAGE_EDGE_MAX, dimension 1 … MTM_DIMENSION_MAX. MTM_MEMORY. Release with mtm_image_destroy. */
MTM_API MTM_CHECK mtm_status mtm_image_create(int width, int height, int dimension, const char *basis,
                                              const char *palette, const char *scene, mtm_image **image,
                                              mtm_error *error);
MTM_API void mtm_image_destroy(mtm_image *image);

/* The numbers of a spectral image as halves, for relighting at half the memory and bandwidth: coefficients lose at most
 * 2^-11 of themselves. */
typedef struct mtm_half_image {
    int width, height;
    int dimension;
    int lanes;
    uint16_t *pixels; /* IEEE 754 binary16, height × width × lanes, in mtm_image's order */
} mtm_half_image;

/* Every number rounded to the nearest half, the even one of two; beyond 65504 to infinity. MTM_MEMORY. Release with
 * mtm_half_image_destroy (NULL allowed). */
MTM_API MTM_CHECK mtm_status mtm_half_image_create(const mtm_image *image, mtm_half_image **half,
                                                   mtm_error *error);
MTM_API void mtm_half_image_destroy(mtm_half_image *half);

/* A picture: linear sRGB red, green, blue and alpha per pixel, color premultiplied by alpha, not clipped; rows from
 * the top. */
typedef struct mtm_picture {
    int width, height;
    float *rgba; /* height × width × 4 */
} mtm_picture;

/* A black, transparent picture of width × height pixels, each 1 … MTM_IMAGE_EDGE_MAX (precondition). MTM_MEMORY. Release
 * with mtm_picture_destroy (NULL allowed). */
MTM_API MTM_CHECK mtm_status mtm_picture_create(int width, int height, mtm_picture **picture,
                                                mtm_error *error);
MTM_API void mtm_picture_destroy(mtm_picture *picture);

typedef struct mtm_image_write_options {
    bool is_half;                /* 16-bit instead of 32-bit float coefficients; default false, lossless */
    const mtm_picture *preview;  /* written as channels R G B (linear); NULL: none */
    const float *reconstruction; /* 81 × dimension, row per wavelength of the grid: also write T.<nm> channels
                                      (Fichet, Pacanowski, Wilkie, JCGT 10(3), 2021); NULL: none */
} mtm_image_write_options;

MTM_API mtm_image_write_options mtm_image_write_defaults(void);

/* Writes OpenEXR: channels C.00 … and A, ZIP, string attributes metamer.version, metamer.basis, metamer.palette,
 * metamer.scene. Nothing is left behind on failure (MTM_IO, MTM_MEMORY). */
MTM_API MTM_CHECK mtm_status mtm_image_write(const mtm_image *image, const char *path,
                                             const mtm_image_write_options *options, mtm_error *error);

/* Reads such a file back, bit for bit, or the T.* channels of another program's reflective spectral EXR as a
 * "wavelengths" image (brought to the grid as reflectances; alpha from A, else 1). MTM_IO, MTM_FORMAT for a file
 * without coefficients or with an unknown layout, MTM_LIMIT, MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_image_read(const char *path, mtm_image **image, mtm_error *error);

/* Writes an 8-bit sRGB PNG: colors clipped to 0..1 and encoded. RGB where every alpha is 1, else
 * RGBA with straight alpha (raised to the largest color channel where light was added without covering anything,
 * so that the picture over black stays the same). `scene` (NULL: none) is embedded as iTXt chunk "metamer.scene".
 * The same picture and scene give the same bytes. MTM_IO, MTM_MEMORY; nothing is left behind on
 * failure. */
MTM_API MTM_CHECK mtm_status mtm_picture_write_png(const mtm_picture *picture, const char *path,
                                                   const char *scene, mtm_error *error);

/* Reads any PNG as a picture (8- or 16-bit, grey, palette or color, with or without alpha, taken as sRGB); `scene`
 * (NULL: not wanted) receives the embedded scene or NULL, release with mtm_text_free. MTM_IO, MTM_FORMAT for a
 * damaged file, MTM_LIMIT, MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_picture_read_png(const char *path, mtm_picture **picture, char **scene,
                                                  mtm_error *error);

/* Only the scene embedded in a PNG, without decoding the picture; *scene is NULL where there is none. */
MTM_API MTM_CHECK mtm_status mtm_scene_text_of_png(const char *path, char **scene, mtm_error *error);

/* Whether the file begins as a PNG, or as an OpenEXR file; false also where it cannot be read. */
MTM_API bool mtm_file_is_png(const char *path);
MTM_API bool mtm_file_is_exr(const char *path);

/* How far two pictures are apart: over black, clipped to 0..1 (what is not a number counts as 0) and encoded, all
 * channels of all pixels. */
typedef struct mtm_comparison {
    double max_error, mean_error;                        /* absolute differences of encoded channels, 0..1 */
    double psnr_db;                                      /* capped at 200, the value of equal pictures */
    double ciede2000_mean, ciede2000_p99, ciede2000_max; /* per pixel, against D65 */
    size_t pixels;
} mtm_comparison;

/* Compares two pictures of one size. MTM_ARGUMENT where the sizes differ, MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_picture_compare(const mtm_picture *a, const mtm_picture *b,
                                                 mtm_comparison *comparison, mtm_error *error);

/* The difference to look at: absolute encoded difference times `gain`, grey level by channel, opaque. */
MTM_API MTM_CHECK mtm_status mtm_picture_difference(const mtm_picture *a, const mtm_picture *b, double gain,
                                                    mtm_picture **difference, mtm_error *error);

#ifdef __cplusplus
}
#endif
#endif
