/* SPDX-License-Identifier: BSD-3-Clause */
#include "metamer/camera.h"

#include "fixture.h"

static void assert_vector(const double a[3], double x, double y, double z) {
    assert_near(a[0], x, 1e-12);
    assert_near(a[1], y, 1e-12);
    assert_near(a[2], z, 1e-12);
}

static const double radians = 3.14159265358979323846 / 180;

static void the_eye_orbits_the_center_of_the_box(void **state) {
    (void)state;
    mtm_grid grid = mtm_grid_defaults(11, 21, 5);
    grid.axes[1][1] = 0.5;
    mtm_camera camera = mtm_camera_defaults();
    camera.distance = 100;
    const mtm_view view = mtm_camera_view(&camera, &grid);
    assert_vector(view.eye, 5 + 100 * cos(20 * radians) * sin(30 * radians), 5 + 100 * sin(20 * radians),
                  2 + 100 * cos(20 * radians) * cos(30 * radians));
    assert_near(view.half_height, tan(15 * radians), 1e-12);
}

static void the_default_distance_is_175_percent_of_the_longest_edge(void **state) {
    (void)state;
    mtm_grid grid = mtm_grid_defaults(11, 21, 5);
    grid.axes[2][2] = 10;
    mtm_camera camera = mtm_camera_defaults();
    camera.azimuth = camera.elevation = 0;
    assert_vector(mtm_camera_view(&camera, &grid).eye, 5, 10, 20 + 1.75 * 40);
}

static void up_turns_the_whole_frame_the_shortest_way(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 3, 3);
    mtm_camera camera = mtm_camera_defaults();
    camera.azimuth = camera.elevation = 0;
    camera.distance = 10;
    memcpy(camera.up, (const double[3]){0, 0, 2},
           sizeof camera.up); /* a patient, seen from the front (LPS) */
    mtm_view view = mtm_camera_view(&camera, &grid);
    assert_vector(view.eye, 1, 1 - 10, 1);
    assert_vector(view.up, 0, 0, 1);
    assert_vector(view.right, 1, 0, 0);
    memcpy(camera.up, (const double[3]){1, 0, 0}, sizeof camera.up);
    view = mtm_camera_view(&camera, &grid);
    assert_vector(view.eye, 1, 1, 11);
    assert_vector(view.up, 1, 0, 0);
    assert_vector(view.right, 0, -1, 0);
    memcpy(camera.up, (const double[3]){0, -1, 0}, sizeof camera.up);
    view = mtm_camera_view(&camera, &grid);
    assert_vector(view.eye, 1, 1, 1 - 10);
    assert_vector(view.up, 0, -1, 0);
    assert_vector(view.right, 1, 0, 0);
}

static void straight_above_the_picture_is_still_upright(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 3, 3);
    mtm_camera camera = mtm_camera_defaults();
    camera.azimuth = 0;
    camera.elevation = 90;
    const mtm_view view = mtm_camera_view(&camera, &grid);
    assert_vector(view.forward, 0, -1, 0);
    assert_vector(view.right, 1, 0, 0);
    assert_vector(view.up, 0, 0, -1);
}

static void rays_pass_pixel_centers_with_row_0_on_top(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 3, 3);
    mtm_camera camera = fixture_front_camera(4);
    camera.distance = 10;
    double origin[3];
    double direction[3];
    mtm_view view = mtm_camera_view(&camera, &grid);
    mtm_view_ray(&view, 8, 4, 0.5, 0.5, origin, direction); /* pixels of size 1 */
    assert_vector(origin, 1 - 3.5, 1 + 1.5, 11);
    assert_vector(direction, 0, 0, -1);
    camera.fov = 90;
    view = mtm_camera_view(&camera, &grid);
    mtm_view_ray(&view, 2, 2, 2, 1, origin, direction); /* the middle of the right edge */
    assert_vector(origin, 1, 1, 11);
    assert_vector(direction, sqrt(0.5), 0, -sqrt(0.5));
}

static void an_orthographic_view_shows_what_30_degrees_show_at_the_target(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 3, 3);
    mtm_camera camera = fixture_front_camera(0);
    camera.distance = 10;
    const mtm_view view = mtm_camera_view(&camera, &grid);
    assert_true(view.is_orthographic);
    assert_near(view.half_height, 10 * tan(15 * radians), 1e-12);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_eye_orbits_the_center_of_the_box),
        cmocka_unit_test(the_default_distance_is_175_percent_of_the_longest_edge),
        cmocka_unit_test(up_turns_the_whole_frame_the_shortest_way),
        cmocka_unit_test(straight_above_the_picture_is_still_upright),
        cmocka_unit_test(rays_pass_pixel_centers_with_row_0_on_top),
        cmocka_unit_test(an_orthographic_view_shows_what_30_degrees_show_at_the_target),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
