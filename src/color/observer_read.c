/* SPDX-License-Identifier: BSD-3-Clause
 * Observers from tables: the color matching functions of an eye or the spectral sensitivities of a camera. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/fail.h"
#include "base/file.h"
#include "base/json.h"
#include "color/observer.h"

enum { CURVES = 3 };

/* The ways to name the three columns; a table has all of one row. */
static const struct {
    const char *columns[CURVES];
    bool is_camera;
} forms[] = {
    {{"x_bar", "y_bar", "z_bar"}, false},
    {{"x", "y", "z"}, false},
    {{"R", "G", "B"}, true},
    {{"red", "green", "blue"}, true},
};
enum { FORM_COUNT = sizeof forms / sizeof *forms };

static double sum_of(const mtm_spectrum *curve) {
    double sum = 0;
    for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) sum += curve->value[i];
    return sum;
}

mtm_status mtm_observer_check(const mtm_observer *observer, const char *document, mtm_error *error) {
    const mtm_spectrum *const curves[CURVES] = {&observer->x, &observer->y, &observer->z};
    const char *letters = observer->is_camera ? "rgb" : "xyz";
    const double scale = sum_of(&observer->y);
    for (int k = 0; k < CURVES; k++)
        if (!(sum_of(curves[k]) > 0))
            return mtm_fail(error, MTM_FORMAT,
                            "%s: curve %c has the sum %g over 380 to 780 nm, expected a positive one",
                            document, letters[k], sum_of(curves[k]));
    if (!(scale >= 1e-30 && scale <= 1e30))
        return mtm_fail(error, MTM_FORMAT,
                        "%s: curve %c has the sum %g over 380 to 780 nm, expected 1e-30 to 1e30", document,
                        letters[1], scale);
    for (int k = 0; k < CURVES; k++)
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++)
            if (!(fabs(curves[k]->value[i]) <= 1e6 * scale))
                return mtm_fail(
                    error, MTM_FORMAT,
                    "%s: curve %c is %g at %d nm, expected at most a million times the sum of %c, %g",
                    document, letters[k], curves[k]->value[i],
                    MTM_WAVELENGTH_FIRST_NM + MTM_WAVELENGTH_STEP_NM * i, letters[1], scale);
    return MTM_OK;
}

/* The table's own spelling of a column, or NULL. */
static const char *find_column(const mtm_spectrum_table *table, const char *name) {
    for (int i = 0; i < table->column_count; i++)
        if (strcasecmp(table->names[i], name) == 0) return table->names[i];
    return NULL;
}

/* The form that has all the table's columns, or -1. Three different names found among three columns are all of them. */
static int find_form(const mtm_spectrum_table *table, const char *found[CURVES]) {
    for (int form = 0; form < FORM_COUNT && table->column_count == CURVES; form++) {
        int found_count = 0;
        for (int k = 0; k < CURVES; k++) {
            found[k] = find_column(table, forms[form].columns[k]);
            found_count += found[k] != NULL;
        }
        if (found_count == CURVES) return form;
    }
    return -1;
}

static mtm_status fail_columns(const mtm_spectrum_table *table, const char *path, mtm_error *error) {
    char names[256] = "";
    size_t length = 0;
    for (int i = 0; i < table->column_count && length + 1 < sizeof names; i++)
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%.24s", i == 0 ? "" : ", ",
                                   table->names[i]);
    return mtm_fail(
        error, MTM_FORMAT,
        "%s: its %d columns beside wavelength_nm are %s, expected three: x_bar, y_bar, z_bar of an "
        "observer or R, G, B of a camera",
        path, table->column_count, names);
}

static mtm_status take_curves(const mtm_spectrum_table *table, const char *path, mtm_observer *observer,
                              mtm_error *error) {
    mtm_spectrum *const curves[CURVES] = {&observer->x, &observer->y, &observer->z};
    const char *columns[CURVES];
    const int form = find_form(table, columns);
    if (form < 0) return fail_columns(table, path, error);
    observer->is_camera = forms[form].is_camera;
    mtm_status status = MTM_OK;
    for (int k = 0; k < CURVES && status == MTM_OK; k++)
        status = mtm_spectrum_table_column(table, path, columns[k], MTM_KIND_OBSERVER, curves[k], error);
    return status;
}

/* The file's name without folder and ".csv", as much as a document can hold. */
static void set_name(const char *path, mtm_observer *observer) {
    const char *name = mtm_path_name(path);
    const size_t stem = strlen(name) - (mtm_path_has_extension(name, ".csv") ? strlen(".csv") : 0);
    const size_t room = sizeof observer->name - 1;
    const size_t length = mtm_json_prefix(name, stem < room ? stem : room);
    (void)snprintf(observer->name, sizeof observer->name, "%.*s", length > 0 ? (int)length : (int)room,
                   length > 0 ? name : "observer");
}

mtm_status mtm_observer_read(const char *path, mtm_observer *observer, mtm_error *error) {
    mtm_spectrum_table table;
    mtm_observer read = {.is_camera = false};
    mtm_status status = mtm_spectrum_table_read(path, &table, error);
    if (status != MTM_OK) return status;
    status = take_curves(&table, path, &read, error);
    mtm_spectrum_table_free(&table);
    if (status == MTM_OK) status = mtm_observer_check(&read, path, error);
    if (status != MTM_OK) return status;
    set_name(path, &read);
    *observer = read;
    return MTM_OK;
}
