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

/* The parts of that, for documents whose elements can say more. A failure stays in the reader, after which the calls do
 * nothing. */

/* Room for as many materials and lights as a palette may have, none there yet; false after a failure. */
bool mtm_palette_reserve(mtm_json_reader *reader, mtm_palette *palette);

/* One element of "materials" or "lights", added to a palette of mtm_palette_reserve that has room. */
void mtm_palette_read_material(mtm_json_reader *reader, const json_t *object, const char *folder,
                               mtm_palette *palette);
void mtm_palette_read_light(mtm_json_reader *reader, const json_t *object, const char *folder,
                            mtm_palette *palette);

/* The first key of the object that says where a spectrum comes from; NULL: it has none. */
const char *mtm_palette_source_of(const json_t *object);

/* The spectrum that the object's one source gives; without a folder it may be no file. */
void mtm_palette_read_source(mtm_json_reader *reader, const json_t *object, const char *folder,
                             mtm_spectrum_kind kind, mtm_spectrum *spectrum);

/* The key "name", required; and any text that is to be a name. */
void mtm_palette_read_name(mtm_json_reader *reader, const json_t *object, char name[MTM_NAME_MAX + 1]);
void mtm_palette_check_name(mtm_json_reader *reader, const char *key, const char *text,
                            char name[MTM_NAME_MAX + 1]);

/* Adds one to a palette of mtm_palette_reserve that has room; its name must be new. */
void mtm_palette_add_material(mtm_json_reader *reader, const mtm_material *material, mtm_palette *palette);
void mtm_palette_add_light(mtm_json_reader *reader, const mtm_light *light, mtm_palette *palette);

/* The palette with spectra as values; NULL when out of memory. */
json_t *mtm_palette_to_json(const mtm_palette *palette);

#endif
