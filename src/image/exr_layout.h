/* SPDX-License-Identifier: BSD-3-Clause
 * What the names of an OpenEXR file's channels say about its content. */
#ifndef METAMER_IMAGE_EXR_LAYOUT_H
#define METAMER_IMAGE_EXR_LAYOUT_H

#include <OpenEXR/openexr.h>

#include "metamer/image.h"

/* The channels that make an image. Channel i of the file goes to float slot[i] of a pixel, or nowhere where
 * that is -1. Slots are the coefficients and then alpha; for reflectances, rising wavelengths and then alpha.
 * */
typedef struct mtm_exr_layout {
    int channel_count;
    int *slot;             /* channel_count */
    int slot_count;        /* coefficients or wavelengths, without alpha */
    bool has_alpha;        /* else alpha is 1 */
    double *wavelength_nm; /* slot_count, rising strictly; NULL for a file of coefficients */
} mtm_exr_layout;

/* Decides by the channels. MTM_FORMAT says what the file holds instead of coefficients or reflectances.
 * Release with mtm_exr_layout_free, also after a failure. */
MTM_CHECK mtm_status mtm_exr_layout_find(const exr_attr_chlist_t *channels, const char *path,
                                         mtm_exr_layout *layout, mtm_error *error);
void mtm_exr_layout_free(mtm_exr_layout *layout);

/* What a channel's name says, after the pattern of Fichet, Pacanowski, Wilkie (2021). */
typedef enum mtm_exr_meaning {
    MTM_EXR_OTHER,
    MTM_EXR_REFLECTIVE,  /* T.<wavelength> */
    MTM_EXR_EMISSIVE,    /* S0.<wavelength> … S3.<wavelength> */
    MTM_EXR_FLUORESCENT, /* T.<wavelength>.<wavelength> */
} mtm_exr_meaning;

/* The wavelength in nm is stored except for MTM_EXR_OTHER. */
mtm_exr_meaning mtm_exr_channel_meaning(const char *name, double *wavelength_nm);

#endif
