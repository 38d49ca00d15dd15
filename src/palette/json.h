/* SPDX-License-Identifier: BSD-3-Clause
 * Palettes inside other documents. */
#ifndef METAMER_PALETTE_JSON_H
#define METAMER_PALETTE_JSON_H

#include "base/json.h"
#include "metamer/palette.h"

/* Reads the keys "materials" and "lights" of `object`, which the caller has checked for unknown keys. A failure
 * stays in the reader and leaves the palette empty. */
void mtm_palette_from_json(mtm_json_reader *reader, const json_t *object, const char *folder,
                           mtm_palette *palette);

/* The palette with spectra as values; NULL when out of memory. */
json_t *mtm_palette_to_json(const mtm_palette *palette);

#endif
