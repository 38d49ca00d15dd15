/* SPDX-License-Identifier: BSD-3-Clause
 * Reading the observer of a scene document: a name, a table beside the document, or the curves themselves. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/file.h"
#include "color/observer.h"
#include "scene/read.h"

/* Fails at the key with the status of what went wrong behind it; a bad name or curve is a fault of the document. */
static void fail_with(mtm_json_reader *json, const char *key, mtm_status status, const mtm_error *reason) {
    mtm_json_fail(json, key, "is not usable: %s", reason->message);
    if (status != MTM_ARGUMENT) json->status = status;
}

static void read_named(mtm_scene_reader *reader, const json_t *document) {
    const char *name = NULL;
    mtm_error reason;
    if (!mtm_json_text(reader->json, document, "observer", &name)) return;
    const mtm_status status = mtm_observer_get(name, &reader->scene->observer, &reason);
    if (status != MTM_OK) fail_with(reader->json, "observer", status, &reason);
}

static void read_file(mtm_scene_reader *reader, const json_t *object) {
    static const char *const keys[] = {"file"};
    mtm_json_reader *json = reader->json;
    const char *file = NULL;
    mtm_error reason;
    if (!mtm_json_expect_object(json, object, KEYS(keys)) || !mtm_json_text(json, object, "file", &file))
        return;
    if (reader->is_embedded) {
        mtm_json_fail(json, "file", "names a file, but an embedded document stands alone");
        return;
    }
    char *path = mtm_path_join(reader->scene->folder, file);
    const mtm_status status = path == NULL ? mtm_fail_memory(&reason, "the scene", strlen(file))
                                           : mtm_observer_read(path, &reader->scene->observer, &reason);
    if (status != MTM_OK) fail_with(json, "file", status, &reason);
    free(path);
}

static void read_curve(mtm_json_reader *json, const json_t *object, const char *key, mtm_spectrum *curve) {
    if (mtm_json_required(json, object, key) != NULL)
        (void)mtm_json_numbers(json, object, key, MTM_SPECTRUM_SAMPLES, mtm_json_any, curve->value);
}

/* `keys` are "name" and those of the three curves. */
static void read_curves(mtm_json_reader *json, const json_t *object, const char *const keys[4],
                        mtm_observer *observer) {
    const char *name = NULL;
    mtm_error reason;
    if (!mtm_json_expect_object(json, object, keys, 4) || mtm_json_required(json, object, "name") == NULL ||
        !mtm_json_text(json, object, "name", &name))
        return;
    if (strlen(name) >= sizeof observer->name)
        mtm_json_fail(json, "name", "has %zu bytes, at most %zu are allowed", strlen(name),
                      sizeof observer->name - 1);
    (void)snprintf(observer->name, sizeof observer->name, "%s", name);
    read_curve(json, object, keys[1], &observer->x);
    read_curve(json, object, keys[2], &observer->y);
    read_curve(json, object, keys[3], &observer->z);
    if (json->status != MTM_OK) return;
    const mtm_status status = mtm_observer_check(observer, name, &reason);
    if (status != MTM_OK) fail_with(json, NULL, status, &reason);
}

void mtm_scene_read_observer(mtm_scene_reader *reader, const json_t *document) {
    static const char *const keys[] = {"file", "name", "x", "y", "z", "r", "g", "b"};
    static const char *const eye_keys[] = {"name", "x", "y", "z"};
    static const char *const camera_keys[] = {"name", "r", "g", "b"};
    mtm_json_reader *json = reader->json;
    size_t place = 0;
    const json_t *value = json_object_get(document, "observer");
    if (value != NULL && !json_is_string(value) && !json_is_object(value)) {
        char preview[64];
        mtm_json_fail(json, "observer", "is %s, must be a name or an object",
                      mtm_json_preview(value, preview));
    }
    if (!json_is_object(value)) {
        read_named(reader, document);
        return;
    }
    const json_t *object = mtm_scene_enter_object(json, document, "observer", KEYS(keys), &place);
    mtm_observer *observer = &reader->scene->observer;
    if (object != NULL && json_object_get(object, "file") != NULL) {
        read_file(reader, object);
    } else if (object != NULL) {
        observer->is_camera = json_object_get(object, "r") != NULL;
        read_curves(json, object, observer->is_camera ? camera_keys : eye_keys, observer);
    }
    mtm_json_leave(json, place);
}
