/* SPDX-License-Identifier: BSD-3-Clause
 * Which three axes of a NRRD file are the volume's: those in space; any further ones must have size 1. */
#include <math.h>
#include <stddef.h>

#include "base/fail.h"
#include "volume/nrrd.h"

typedef enum axis_role {
    ROLE_OPEN, /* the header does not say */
    ROLE_SPACE,
    ROLE_OTHER, /* components, time, a list */
} axis_role;

typedef struct axis_facts {
    axis_role role;
    char kind[MTM_NRRD_NAME_TEXT]; /* "" where not given */
} axis_facts;

static mtm_status read_kinds(const mtm_nrrd_header *header, axis_facts *facts, mtm_error *error) {
    const char *text = header->values[MTM_NRRD_KINDS];
    if (text == NULL) return MTM_OK;
    for (int axis = 0; axis < header->dimension; axis++) {
        char *kind = facts[axis].kind;
        text = mtm_nrrd_next_word(text, kind);
        if (text == NULL)
            return mtm_fail(error, MTM_FORMAT, "%s: field 'kinds' has %d kinds, dimension %d needs %d",
                            header->path, axis, header->dimension, header->dimension);
        if (mtm_nrrd_is_same_name(kind, "domain") || mtm_nrrd_is_same_name(kind, "space"))
            facts[axis].role = ROLE_SPACE;
        else if (mtm_nrrd_is_same_name(kind, "none") || mtm_nrrd_is_same_name(kind, "???"))
            kind[0] = '\0';
        else
            facts[axis].role = ROLE_OTHER;
    }
    return MTM_OK;
}

/* A direction, or a spacing beside axes that have none, says more than the kind does. */
static mtm_status find_roles(const mtm_nrrd_header *header, const bool *has_direction, axis_facts *facts,
                             mtm_error *error) {
    mtm_status status = read_kinds(header, facts, error);
    if (status != MTM_OK) return status;
    double spacings[MTM_NRRD_AXES];
    bool has_spacings = false;
    status = mtm_nrrd_numbers(header, MTM_NRRD_SPACINGS, header->dimension, spacings, &has_spacings, error);
    if (status != MTM_OK) return status;

    int spacing_count = 0;
    int direction_count = 0;
    for (int axis = 0; axis < header->dimension; axis++) {
        spacing_count += has_spacings && !isnan(spacings[axis]);
        direction_count += has_direction[axis];
    }
    for (int axis = 0; axis < header->dimension; axis++) {
        axis_role *role = &facts[axis].role;
        if (direction_count > 0)
            *role = has_direction[axis] ? ROLE_SPACE : ROLE_OTHER;
        else if (header->dimension > 3 && spacing_count > 0 && *role == ROLE_OPEN && isnan(spacings[axis]))
            *role = ROLE_OTHER;
    }
    return MTM_OK;
}

static mtm_status check_components(const mtm_nrrd_header *header, const axis_facts *facts, mtm_error *error) {
    for (int axis = 0; axis < header->dimension; axis++) {
        if (facts[axis].role != ROLE_OTHER || header->sizes[axis] == 1) continue;
        const char *kind = facts[axis].kind[0] != '\0' ? facts[axis].kind : "not given";
        return mtm_fail(
            error, MTM_FORMAT,
            "%s: axis %d holds %d components per voxel (kind %s); volumes have one value per voxel",
            header->path, axis, header->sizes[axis], kind);
    }
    return MTM_OK;
}

/* Of axes that say nothing about themselves, the slowest of size 1 go first. */
static int drop_axes(const mtm_nrrd_header *header, axis_facts *facts, int count) {
    for (int axis = header->dimension - 1; axis >= 0 && count > 3; axis--) {
        if (facts[axis].role == ROLE_OTHER || header->sizes[axis] > 1) continue;
        facts[axis].role = ROLE_OTHER;
        count--;
    }
    return count;
}

mtm_status mtm_nrrd_choose_axes(const mtm_nrrd_header *header, const bool *has_direction, int axes[3],
                                mtm_error *error) {
    axis_facts facts[MTM_NRRD_AXES] = {0};
    mtm_status status = find_roles(header, has_direction, facts, error);
    if (status == MTM_OK) status = check_components(header, facts, error);
    if (status != MTM_OK) return status;

    int count = 0;
    for (int axis = 0; axis < header->dimension; axis++) count += facts[axis].role != ROLE_OTHER;
    count = drop_axes(header, facts, count);
    if (count != 3)
        return mtm_fail(error, MTM_FORMAT,
                        "%s: field 'sizes' (\"%.60s\") has %d axes in space, volumes have 3", header->path,
                        header->values[MTM_NRRD_SIZES], count);
    for (int axis = 0, chosen = 0; axis < header->dimension; axis++)
        if (facts[axis].role != ROLE_OTHER) axes[chosen++] = axis;
    return MTM_OK;
}
