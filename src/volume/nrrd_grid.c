/* SPDX-License-Identifier: BSD-3-Clause
 * The grid of a NRRD file: from space directions where it has them, else from spacings or axis ends. Anatomical
 * spaces are turned to LPS, in which +x is the patient's left, +y the back and +z the head. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "base/number.h"
#include "volume/grid.h"
#include "volume/nrrd.h"

enum { SPACE_AXES = 4 }; /* three and time */

typedef struct named_space {
    const char *name, *short_name;
    int dimension;
    bool is_anatomical, flips_x, flips_y;
} named_space;

static const named_space spaces[] = {
    {"right-anterior-superior", "RAS", 3, true, true, true},
    {"left-anterior-superior", "LAS", 3, true, false, true},
    {"left-posterior-superior", "LPS", 3, true, false, false},
    {"right-anterior-superior-time", "RAST", 4, true, true, true},
    {"left-anterior-superior-time", "LAST", 4, true, false, true},
    {"left-posterior-superior-time", "LPST", 4, true, false, false},
    {"scanner-xyz", "", 3, false, false, false},
    {"scanner-xyz-time", "", 4, false, false, false},
    {"3D-right-handed", "", 3, false, false, false},
    {"3D-left-handed", "", 3, false, false, false},
    {"3D-right-handed-time", "", 4, false, false, false},
    {"3D-left-handed-time", "", 4, false, false, false},
};

static const named_space plain_space = {"", "", 3, false, false, false};

static mtm_status find_space(const mtm_nrrd_header *header, const named_space **space, mtm_error *error) {
    *space = NULL;
    const char *name = header->values[MTM_NRRD_SPACE];
    const char *dimension_text = header->values[MTM_NRRD_SPACE_DIMENSION];
    if (dimension_text != NULL && name == NULL) {
        int dimension = 0;
        if (!mtm_integer_parse(dimension_text, &dimension) || dimension != 3)
            return mtm_fail(error, MTM_FORMAT, "%s: field 'space dimension' is '%.60s', volumes need 3",
                            header->path, dimension_text);
        *space = &plain_space;
    }
    if (name == NULL) return MTM_OK;
    for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++) {
        const bool is_short =
            spaces[i].short_name[0] != '\0' && mtm_nrrd_is_same_name(name, spaces[i].short_name);
        if (is_short || mtm_nrrd_is_same_name(name, spaces[i].name)) *space = &spaces[i];
    }
    if (*space != NULL) return MTM_OK;
    return mtm_fail(error, MTM_FORMAT,
                    "%s: field 'space' is '%.60s', expected a space such as 'left-posterior-superior'",
                    header->path, name);
}

static const char *skip_blanks(const char *text) {
    while (isspace((unsigned char)*text)) text++;
    return text;
}

/* "(1,0,0)" or "none", which "(nan,nan,nan)" means too. Returns what follows, NULL for anything else. */
static const char *scan_vector(const char *text, int dimension, double *vector, bool *is_none) {
    text = skip_blanks(text);
    *is_none = strncmp(text, "none", 4) == 0 && (text[4] == '\0' || isspace((unsigned char)text[4]));
    if (*is_none) return text + 4;
    int nan_count = 0;
    for (int i = 0; i < dimension; i++) {
        if (*text != (i == 0 ? '(' : ',')) return NULL;
        text = mtm_number_scan(text + 1, &vector[i]);
        if (text == NULL) return NULL;
        text = skip_blanks(text);
        nan_count += isnan(vector[i]);
        if (isinf(vector[i])) return NULL;
    }
    *is_none = nan_count == dimension;
    return *text != ')' || (nan_count > 0 && !*is_none) ? NULL : text + 1;
}

static mtm_status fail_vectors(const mtm_nrrd_header *header, mtm_nrrd_field field, int count, int dimension,
                               mtm_error *error) {
    return mtm_fail(error, MTM_FORMAT, "%s: field '%s' is '%.100s', expected %d times '(…)' of %d numbers",
                    header->path, mtm_nrrd_field_name(field), header->values[field], count, dimension);
}

/* Reads exactly `count` vectors of the space; those that are "none" are left alone. */
static mtm_status read_vectors(const mtm_nrrd_header *header, mtm_nrrd_field field, const named_space *space,
                               int count, double (*vectors)[SPACE_AXES], bool *has_vector, mtm_error *error) {
    const char *text = header->values[field];
    if (text == NULL) return MTM_OK;
    if (space == NULL)
        return mtm_fail(error, MTM_FORMAT, "%s: field '%s' needs a field 'space' or 'space dimension'",
                        header->path, mtm_nrrd_field_name(field));
    for (int i = 0; i < count; i++) {
        bool is_none = false;
        double vector[SPACE_AXES] = {0};
        text = scan_vector(text, space->dimension, vector, &is_none);
        if (text == NULL) return fail_vectors(header, field, count, space->dimension, error);
        has_vector[i] = !is_none;
        for (int j = 0; j < SPACE_AXES && !is_none; j++) vectors[i][j] = vector[j];
    }
    if (*skip_blanks(text) != '\0') return fail_vectors(header, field, count, space->dimension, error);
    return MTM_OK;
}

/* 0 − v instead of −v, so that no axis gets a component −0. */
static void turn_to_lps(const named_space *space, double vector[3]) {
    if (space->flips_x) vector[0] = 0.0 - vector[0];
    if (space->flips_y) vector[1] = 0.0 - vector[1];
}

/* What the fields along axes say of one axis that has no direction. */
typedef struct axis_scale {
    double spacing; /* NaN: not given */
    double center;  /* position of the first voxel's center; NaN: not given */
} axis_scale;

typedef struct axis_fields {
    double spacings[MTM_NRRD_AXES], mins[MTM_NRRD_AXES], maxs[MTM_NRRD_AXES];
    bool is_node[MTM_NRRD_AXES]; /* samples sit on the ends min and max, not half a spacing inside */
} axis_fields;

static mtm_status read_axis_numbers(const mtm_nrrd_header *header, mtm_nrrd_field field, double *numbers,
                                    mtm_error *error) {
    for (int axis = 0; axis < header->dimension; axis++) numbers[axis] = NAN;
    bool is_present = false;
    return mtm_nrrd_numbers(header, field, header->dimension, numbers, &is_present, error);
}

static mtm_status read_axis_fields(const mtm_nrrd_header *header, axis_fields *fields, mtm_error *error) {
    mtm_status status = read_axis_numbers(header, MTM_NRRD_SPACINGS, fields->spacings, error);
    if (status == MTM_OK) status = read_axis_numbers(header, MTM_NRRD_AXIS_MINS, fields->mins, error);
    if (status == MTM_OK) status = read_axis_numbers(header, MTM_NRRD_AXIS_MAXS, fields->maxs, error);
    const char *text = header->values[MTM_NRRD_CENTERINGS];
    for (int axis = 0; axis < header->dimension; axis++) {
        char word[MTM_NRRD_NAME_TEXT] = "";
        if (text != NULL) text = mtm_nrrd_next_word(text, word);
        fields->is_node[axis] = mtm_nrrd_is_same_name(word, "node");
    }
    return status;
}

static axis_scale scale_of(const axis_fields *fields, int axis, int size) {
    axis_scale scale = {fields->spacings[axis], NAN};
    const double min = fields->mins[axis];
    const int steps = fields->is_node[axis] ? size - 1 : size;
    if (isnan(scale.spacing) && steps > 0) scale.spacing = (fields->maxs[axis] - min) / steps;
    if (fields->is_node[axis])
        scale.center = min;
    else if (!isnan(scale.spacing))
        scale.center = min + 0.5 * scale.spacing;
    return scale;
}

static mtm_status check_spacing(const mtm_nrrd_header *header, int axis, double spacing, mtm_error *error) {
    if (isfinite(spacing) && spacing != 0.0) return MTM_OK;
    const bool has_spacings = header->values[MTM_NRRD_SPACINGS] != NULL;
    return mtm_fail(
        error, MTM_FORMAT,
        "%s: field '%s' gives axis %d a spacing of %g, expected a number that is not 0 (or nan for "
        "every axis: not known)",
        header->path, has_spacings ? "spacings" : "axis maxs", axis, spacing);
}

/* A grid along x, y, z. Spacings that are missing on every axis are 1. */
static mtm_status grid_from_spacings(const mtm_nrrd_header *header, const int axes[3], mtm_grid *grid,
                                     mtm_error *error) {
    axis_fields fields;
    mtm_status status = read_axis_fields(header, &fields, error);
    if (status != MTM_OK) return status;
    axis_scale scales[3];
    int missing_count = 0;
    for (int i = 0; i < 3; i++) {
        scales[i] = scale_of(&fields, axes[i], header->sizes[axes[i]]);
        missing_count += isnan(scales[i].spacing);
    }
    for (int i = 0; i < 3; i++) {
        if (missing_count == 3) scales[i].spacing = 1.0;
        status = check_spacing(header, axes[i], scales[i].spacing, error);
        if (status != MTM_OK) return status;
        grid->axes[i][i] = scales[i].spacing;
        if (isfinite(scales[i].center)) grid->origin[i] = scales[i].center;
    }
    return MTM_OK;
}

/* Reads a text in double quotes into `quoted`, cut to its size. Returns what follows it, NULL where none begins. */
static const char *scan_quoted(const char *text, char *quoted, size_t size) {
    text = skip_blanks(text);
    if (*text != '"') return NULL;
    size_t length = 0;
    for (text++; *text != '"' && *text != '\0'; text++) {
        if (*text == '\\' && text[1] != '\0') text++;
        if (length + 1 < size) quoted[length++] = *text;
    }
    quoted[length] = '\0';
    return *text == '"' ? text + 1 : NULL;
}

/* The unit, where all three axes have the same and it fits. */
static mtm_status read_unit(const mtm_nrrd_header *header, mtm_nrrd_field field, int count, const int axes[3],
                            mtm_grid *grid, mtm_error *error) {
    const char *text = header->values[field];
    if (text == NULL) return MTM_OK;
    char units[MTM_NRRD_AXES][sizeof grid->unit + 1];
    for (int i = 0; i < count; i++) {
        text = scan_quoted(text, units[i], sizeof units[i]);
        if (text == NULL)
            return mtm_fail(error, MTM_FORMAT,
                            "%s: field '%s' is '%.60s', expected %d texts in double quotes", header->path,
                            mtm_nrrd_field_name(field), header->values[field], count);
    }
    const char *unit = units[axes[0]];
    const bool is_common = strcmp(unit, units[axes[1]]) == 0 && strcmp(unit, units[axes[2]]) == 0;
    if (is_common && strlen(unit) < sizeof grid->unit) memcpy(grid->unit, unit, strlen(unit) + 1);
    return MTM_OK;
}

static mtm_status check_grid(const mtm_nrrd_header *header, const mtm_grid *grid, bool has_directions,
                             mtm_error *error) {
    const char *fault = mtm_grid_fault(grid);
    if (fault == NULL) return MTM_OK;
    const mtm_nrrd_field field = has_directions ? MTM_NRRD_SPACE_DIRECTIONS : MTM_NRRD_SPACINGS;
    const char *value = header->values[field] != NULL ? header->values[field] : "";
    return mtm_fail(error, MTM_FORMAT, "%s: the grid of field '%s' (\"%.100s\") %s", header->path,
                    mtm_nrrd_field_name(field), value, fault);
}

mtm_status mtm_nrrd_grid(const mtm_nrrd_header *header, mtm_grid *grid, mtm_error *error) {
    const named_space *space = NULL;
    double directions[MTM_NRRD_AXES][SPACE_AXES] = {0};
    double origin[1][SPACE_AXES] = {0};
    bool has_direction[MTM_NRRD_AXES] = {0};
    bool has_origin = false;
    int axes[3];
    mtm_status status = find_space(header, &space, error);
    if (status == MTM_OK)
        status = read_vectors(header, MTM_NRRD_SPACE_DIRECTIONS, space, header->dimension, directions,
                              has_direction, error);
    if (status == MTM_OK)
        status = read_vectors(header, MTM_NRRD_SPACE_ORIGIN, space, 1, origin, &has_origin, error);
    if (status == MTM_OK) status = mtm_nrrd_choose_axes(header, has_direction, axes, error);
    if (status != MTM_OK) return status;

    *grid = mtm_grid_defaults(header->sizes[axes[0]], header->sizes[axes[1]], header->sizes[axes[2]]);
    const bool has_directions = has_direction[axes[0]]; /* then on all three */
    grid->is_oriented = has_directions && space->is_anatomical;
    if (!has_directions) status = grid_from_spacings(header, axes, grid, error);
    for (int i = 0; i < 3 && has_directions; i++) {
        memcpy(grid->axes[i], directions[axes[i]], sizeof grid->axes[i]);
        turn_to_lps(space, grid->axes[i]);
    }
    if (has_origin) memcpy(grid->origin, origin[0], sizeof grid->origin);
    if (has_origin && has_directions) turn_to_lps(space, grid->origin);

    const int space_axes[3] = {0, 1, 2};
    if (status == MTM_OK) status = read_unit(header, MTM_NRRD_UNITS, header->dimension, axes, grid, error);
    if (status == MTM_OK && space != NULL)
        status = read_unit(header, MTM_NRRD_SPACE_UNITS, space->dimension, space_axes, grid, error);
    return status == MTM_OK ? check_grid(header, grid, has_directions, error) : status;
}
