/* SPDX-License-Identifier: BSD-3-Clause
 * What the readers of a scene document's parts share. */
#ifndef METAMER_SCENE_READ_H
#define METAMER_SCENE_READ_H

#include "base/json.h"
#include "scene/scene.h"

typedef struct mtm_scene_reader {
    mtm_json_reader *json;
    mtm_scene *scene;
    bool is_embedded; /* the document stands alone: it may name no file but its volume */
} mtm_scene_reader;

/* An array of known keys and how many they are, as two arguments. */
#define KEYS(array) (array), sizeof(array) / sizeof *(array)

/* Steps into an object of the document and checks its keys; NULL where it is missing or wrong. *place is for
 * mtm_json_leave in every case. */
const json_t *mtm_scene_enter_object(mtm_json_reader *json, const json_t *parent, const char *key,
                                     const char *const *keys, size_t key_count, size_t *place);

/* The key "observer" of the document. */
void mtm_scene_read_observer(mtm_scene_reader *reader, const json_t *document);

/* The key "lights" of the document, after the palette. */
void mtm_scene_read_lights(mtm_scene_reader *reader, const json_t *document);

#endif
