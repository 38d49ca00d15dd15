/* SPDX-License-Identifier: BSD-3-Clause
 * Observers and tristimulus sums (CIE 015:2018, Colorimetry). */
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "metamer/color.h"
#include "spectrum/embedded.h"

/* A further observer is a further row; its table has the columns x_bar, y_bar and z_bar. */
static const struct {
    const char *name;
    const char *table;
} observers[] = {
    {"cie1931", "cie_observer_1931_2deg"},
    {"cie1964", "cie_observer_1964_10deg"},
    {"cie2015", "cie_observer_2015_2deg"},
    {"cie2015_10deg", "cie_observer_2015_10deg"},
};
enum { OBSERVER_COUNT = sizeof observers / sizeof *observers };

static mtm_status fail_unknown(const char *name, mtm_error *error) {
    char known[256] = "";
    size_t length = 0;
    for (int i = 0; i < OBSERVER_COUNT && length < sizeof known; i++)
        length += (size_t)snprintf(known + length, sizeof known - length, "%s%s", i == 0 ? "" : ", ",
                                   observers[i].name);
    return mtm_fail(error, MTM_ARGUMENT, "unknown observer '%.64s', expected one of: %s", name, known);
}

mtm_status mtm_observer_get(const char *name, mtm_observer *observer, mtm_error *error) {
    assert(name != NULL);
    int found = 0;
    while (found < OBSERVER_COUNT && strcmp(observers[found].name, name) != 0) found++;
    if (found == OBSERVER_COUNT) return fail_unknown(name, error);
    const char *name_of_table = observers[found].table;
    mtm_spectrum_table table;
    mtm_status status = mtm_embedded_table_read(name_of_table, &table, error);
    if (status != MTM_OK) return status;
    mtm_observer made = {.is_camera = false};
    (void)snprintf(made.name, sizeof made.name, "%s", observers[found].name);
    const char *const columns[] = {"x_bar", "y_bar", "z_bar"};
    mtm_spectrum *const curves[] = {&made.x, &made.y, &made.z};
    for (int i = 0; i < 3 && status == MTM_OK; i++)
        status =
            mtm_spectrum_table_column(&table, name_of_table, columns[i], MTM_KIND_OBSERVER, curves[i], error);
    mtm_spectrum_table_free(&table);
    if (status == MTM_OK) *observer = made;
    return status;
}

mtm_xyz mtm_xyz_of(const mtm_spectrum *stimulus, const mtm_observer *observer) {
    mtm_xyz sum = {0, 0, 0};
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
        sum.x += stimulus->value[i] * observer->x.value[i];
        sum.y += stimulus->value[i] * observer->y.value[i];
        sum.z += stimulus->value[i] * observer->z.value[i];
    }
    return sum;
}

mtm_status mtm_light_normalize(const mtm_spectrum *light, const mtm_observer *observer,
                               mtm_spectrum *normalized, mtm_error *error) {
    const double luminance = mtm_xyz_of(light, observer).y;
    if (!(luminance > 0) || !isfinite(luminance) || !isfinite(1 / luminance))
        return mtm_fail(error, MTM_NUMERIC, "a light's luminance is %g, expected a positive finite number",
                        luminance);
    *normalized = mtm_spectrum_scale(light, 1 / luminance);
    return MTM_OK;
}
