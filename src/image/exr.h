/* SPDX-License-Identifier: BSD-3-Clause
 * What the OpenEXR writer and reader share. */
#ifndef METAMER_IMAGE_EXR_H
#define METAMER_IMAGE_EXR_H

#include <stdio.h>

#include <OpenEXR/openexr.h>

#include "metamer/image.h"

#define MTM_EXR_VERSION_TEXT "1" /* the layout this library writes and reads */

#define MTM_EXR_VERSION         "metamer.version"
#define MTM_EXR_BASIS           "metamer.basis"
#define MTM_EXR_PALETTE         "metamer.palette"
#define MTM_EXR_SCENE           "metamer.scene"
#define MTM_EXR_SPECTRAL_LAYOUT "spectralLayoutVersion" /* of Fichet, Pacanowski, Wilkie */

/* OpenEXR's error handler that says nothing: the result codes become sentences of our own. */
void mtm_exr_stay_silent(exr_const_context_t context, exr_result_t code, const char *message);

/* Fails with the status that belongs to a result of reading with OpenEXR: `what` is wrong with the file `path`. */
mtm_status mtm_exr_fail(mtm_error *error, exr_result_t result, const char *path, const char *what);

/* The reader behind mtm_image_read: `stream` can seek and stays open, `path` names it in messages. */
MTM_CHECK mtm_status mtm_image_read_stream(FILE *stream, const char *path, mtm_image **image,
                                           mtm_error *error);

#endif
