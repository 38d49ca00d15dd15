/* SPDX-License-Identifier: BSD-3-Clause
 * Fuzz target: the bytes are a scene document. What is read is written and read again, and must be the same. Files
 * that it names are looked for in a folder that does not exist; documents with "/" are left out, because an absolute
 * name would leave it. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "metamer/scene.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Ends the program where a document that was written is not read as the same scene. */
static void check_round_trip(const mtm_scene *scene) {
    mtm_error error;
    mtm_scene *again = NULL;
    char *text = mtm_scene_format(scene);
    if (text == NULL || mtm_scene_parse("again", text, "/nonexistent", &again, &error) != MTM_OK) abort();
    char *text_again = mtm_scene_format(again);
    if (text_again == NULL || strcmp(text, text_again) != 0) abort();
    mtm_text_free(text_again);
    mtm_scene_destroy(again);
    mtm_text_free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (memchr(data, '/', size) != NULL || memchr(data, '\\', size) != NULL) return 0;
    char *text = malloc(size + 1);
    if (text == NULL) return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    mtm_error error;
    mtm_scene *scene = NULL;
    if (mtm_scene_parse("fuzz.json", text, "/nonexistent", &scene, &error) == MTM_OK) {
        check_round_trip(scene);
        mtm_scene_destroy(scene);
    }
    free(text);
    return 0;
}
