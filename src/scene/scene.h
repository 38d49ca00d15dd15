/* SPDX-License-Identifier: BSD-3-Clause
 * What the files of this stage share. */
#ifndef METAMER_SCENE_SCENE_H
#define METAMER_SCENE_SCENE_H

#include "metamer/scene.h"

/* The words for mtm_blend in documents. */
enum { MTM_BLEND_COUNT = MTM_BLEND_MAXIMUM + 1 };
extern const char *const mtm_blend_names[MTM_BLEND_COUNT];

/* A scene with every default and nothing that has none; document and folder are copied. */
MTM_CHECK mtm_status mtm_scene_create(const char *document, const char *folder, mtm_scene **scene,
                                      mtm_error *error);

/* A mix of `light_count` lights where only the first shines. */
MTM_CHECK mtm_status mtm_light_mix_create(int light_count, mtm_light_mix *mix, mtm_error *error);
MTM_CHECK mtm_status mtm_light_mix_copy(const mtm_light_mix *mix, int light_count, mtm_light_mix *copy,
                                        mtm_error *error);
void mtm_light_mix_free(mtm_light_mix *mix);

/* The basis `name` for the scene's materials under its light. */
MTM_CHECK mtm_status mtm_scene_make_basis(const mtm_scene *scene, const char *name, mtm_basis **basis,
                                          mtm_error *error);

/* Makes the scene state the volume it is rendered from: name, size and hash. */
MTM_CHECK mtm_status mtm_scene_state_volume(mtm_scene *scene, const mtm_volume *volume, const char *path,
                                            const char *sha256, mtm_error *error);

#endif
