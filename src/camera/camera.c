/* SPDX-License-Identifier: BSD-3-Clause
 * The camera: an orbit round a target. */
#include "metamer/camera.h"

#include <math.h>

static const double degree = 3.14159265358979323846 / 180;

mtm_camera mtm_camera_defaults(void) {
    return (mtm_camera){
        .azimuth = 30, /* a corner view from slightly above shows three sides of the box */
        .elevation = 20,
        .up = {0, 1, 0},
        .fov = 30, /* with the default distance the box fills most of the picture */
    };
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

/* The first and third axis of the frame: x and z turned by the shortest rotation that takes y to the unit vector
 * `up` (Rodrigues' formula; half a turn about x where up is -y). */
static void frame_axes(const double up[3], double first[3], double third[3]) {
    /* 1/(1 + y) = (1 - y)/(x² + z²) for a unit vector, without cancellation where y is near -1. */
    const double off_axis = up[0] * up[0] + up[2] * up[2];
    const bool is_upside_down = up[1] < 0 && off_axis == 0;
    const double factor = is_upside_down ? 0 : up[1] < 0 ? (1 - up[1]) / off_axis : 1 / (1 + up[1]);
    first[0] = 1 - up[0] * up[0] * factor;
    first[1] = is_upside_down ? 0 : -up[0];
    first[2] = -up[0] * up[2] * factor;
    cross(first, up, third);
}

static double longest_edge(const mtm_grid *grid) {
    double longest = 0;
    for (int axis = 0; axis < 3; axis++)
        longest = fmax(longest, (grid->size[axis] - 1) * mtm_grid_spacing(grid, axis));
    return longest > 0 ? longest : mtm_grid_smallest_spacing(grid);
}

mtm_view mtm_camera_view(const mtm_camera *camera, const mtm_grid *grid) {
    const double distance = camera->distance > 0 ? camera->distance : 1.75 * longest_edge(grid);
    double target[3] = {camera->target[0], camera->target[1], camera->target[2]};
    if (!camera->has_target) {
        const double center[3] = {(grid->size[0] - 1) / 2.0, (grid->size[1] - 1) / 2.0,
                                  (grid->size[2] - 1) / 2.0};
        mtm_grid_to_world(grid, center, target);
    }
    const double up_length = sqrt(dot(camera->up, camera->up));
    const double second[3] = {camera->up[0] / up_length, camera->up[1] / up_length,
                              camera->up[2] / up_length};
    double first[3];
    double third[3];
    frame_axes(second, first, third);

    const double azimuth = camera->azimuth * degree;
    const double elevation = camera->elevation * degree;
    const double outward[3] = {cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth)};
    mtm_view view = {.is_orthographic = camera->fov == 0};
    for (int i = 0; i < 3; i++) {
        const double direction = outward[0] * first[i] + outward[1] * second[i] + outward[2] * third[i];
        view.eye[i] = target[i] + distance * direction;
        view.forward[i] = -direction;
        view.right[i] =
            cos(azimuth) * first[i] - sin(azimuth) * third[i]; /* also straight above the target */
    }
    cross(view.right, view.forward, view.up);
    const double height = camera->height > 0 ? camera->height : 2 * distance * tan(15 * degree);
    view.half_height = view.is_orthographic ? height / 2 : tan(camera->fov / 2 * degree);
    return view;
}

void mtm_view_ray(const mtm_view *view, int width, int height, double x, double y, double origin[3],
                  double direction[3]) {
    const double across = (2 * x - width) / height * view->half_height;
    const double upward = (1 - 2 * y / height) * view->half_height;
    double length = 1;
    for (int i = 0; i < 3; i++) {
        const double offset = across * view->right[i] + upward * view->up[i];
        origin[i] = view->is_orthographic ? view->eye[i] + offset : view->eye[i];
        direction[i] = view->is_orthographic ? view->forward[i] : view->forward[i] + offset;
    }
    length = sqrt(dot(direction, direction));
    for (int i = 0; i < 3; i++) direction[i] /= length;
}
