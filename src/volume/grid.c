/* SPDX-License-Identifier: BSD-3-Clause
 * Where voxels are: world = origin + Σ voxel[a]·axes[a] and its inverse. */
#include "volume/grid.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Axes shorter than this have no inverse in double; directions closer to a plane than the second are as good as
 * dependent: positions computed from them would lose most of their digits. */
static const double SPACING_LEAST = 1e-300;
static const double VOLUME_LEAST = 1e-9;

mtm_grid mtm_grid_defaults(int size_x, int size_y, int size_z) {
    return (mtm_grid){
        .size = {size_x, size_y, size_z},
        .axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    };
}

static double length_of(const double vector[3]) {
    return hypot(hypot(vector[0], vector[1]), vector[2]);
}

double mtm_grid_spacing(const mtm_grid *grid, int axis) {
    assert(axis >= 0 && axis < 3);
    return length_of(grid->axes[axis]);
}

double mtm_grid_smallest_spacing(const mtm_grid *grid) {
    const double x = mtm_grid_spacing(grid, 0);
    const double y = mtm_grid_spacing(grid, 1);
    const double z = mtm_grid_spacing(grid, 2);
    return fmin(fmin(x, y), z);
}

void mtm_grid_to_world(const mtm_grid *grid, const double voxel[3], double world[3]) {
    double position[3]; /* so that both arguments may be the same array */
    for (int i = 0; i < 3; i++) {
        position[i] = grid->origin[i];
        for (int axis = 0; axis < 3; axis++) position[i] += voxel[axis] * grid->axes[axis][i];
    }
    memcpy(world, position, sizeof position);
}

void mtm_grid_to_voxel(const mtm_grid *grid, const double world[3], double voxel[3]) {
    double inverse[3][3];
    mtm_grid_inverse_axes(grid, inverse);
    double position[3];
    for (int axis = 0; axis < 3; axis++) {
        position[axis] = 0.0;
        for (int i = 0; i < 3; i++) position[axis] += inverse[axis][i] * (world[i] - grid->origin[i]);
    }
    memcpy(voxel, position, sizeof position);
}

static void cross(const double a[3], const double b[3], double product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Axes of length 1, so that products of very small or large spacings neither vanish nor overflow. */
static void unit_axes(const mtm_grid *grid, double directions[3][3], double lengths[3]) {
    for (int axis = 0; axis < 3; axis++) {
        lengths[axis] = mtm_grid_spacing(grid, axis);
        for (int i = 0; i < 3; i++) directions[axis][i] = grid->axes[axis][i] / lengths[axis];
    }
}

/* Cramer's rule: row a of the inverse is the cross product of the other two axes over the determinant. */
void mtm_grid_inverse_axes(const mtm_grid *grid, double inverse[3][3]) {
    double directions[3][3];
    double lengths[3];
    unit_axes(grid, directions, lengths);
    for (int axis = 0; axis < 3; axis++) {
        double normal[3];
        cross(directions[(axis + 1) % 3], directions[(axis + 2) % 3], normal);
        const double determinant = dot(directions[axis], normal);
        for (int i = 0; i < 3; i++) inverse[axis][i] = normal[i] / determinant / lengths[axis];
    }
}

const char *mtm_grid_fault(const mtm_grid *grid) {
    for (int axis = 0; axis < 3; axis++) {
        if (grid->size[axis] < 1) return "has an axis with less than 1 voxel";
        if (!isfinite(grid->origin[axis])) return "has an origin that is not finite";
        const double length = mtm_grid_spacing(grid, axis);
        if (!isfinite(length)) return "has an axis whose length is not finite";
        if (length < SPACING_LEAST) return "has an axis of length 0";
    }
    if (memchr(grid->unit, '\0', sizeof grid->unit) == NULL) return "has a unit of more than 15 bytes";

    double directions[3][3];
    double lengths[3];
    double normal[3];
    unit_axes(grid, directions, lengths);
    cross(directions[1], directions[2], normal);
    if (!(fabs(dot(directions[0], normal)) >= VOLUME_LEAST)) return "has linearly dependent axes";
    return NULL;
}
