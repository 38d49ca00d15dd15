/* SPDX-License-Identifier: BSD-3-Clause
 * The inner loop of postillumination to 8-bit sRGB, per instruction set. */
#ifndef METAMER_RELIGHT_BYTES_KERNEL_H
#define METAMER_RELIGHT_BYTES_KERNEL_H

#include "base/isa.h"
#include "color/srgb_levels.h"
#include "relight/relight_kernel.h"

typedef struct mtm_bytes_pass {
    mtm_relight_pass relight;
    mtm_srgb_levels levels;
    int32_t empty; /* the bytes of a pixel that holds nothing */
} mtm_bytes_pass;

/* Like mtm_relight_pixels and then the PNG writer's encoding, bit for bit: `count` pixels of `lanes` numbers to as many
 * of red, green, blue, alpha. */
typedef struct mtm_bytes_kernel {
    void (*relight_floats)(const mtm_bytes_pass *pass, const void *pixels, size_t count, unsigned char *rgba);
    void (*relight_halves)(const mtm_bytes_pass *pass, const void *pixels, size_t count, unsigned char *rgba);
} mtm_bytes_kernel;

MTM_ISA_DECLARE(mtm_bytes_kernel, mtm_bytes_kernel);

#endif
