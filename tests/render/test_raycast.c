/* SPDX-License-Identifier: BSD-3-Clause
 * The raycaster against closed forms (Max, "Optical models for direct volume rendering", TVCG 1(2), 1995). */
#include "fixture.h"

static double half(const double world[3]) {
    (void)world;
    return 0.5;
}

static double ramp_z(const double world[3]) {
    return world[2] / 20;
}

static double bumps(const double world[3]) {
    return 0.5 + 0.5 * sin(0.9 * world[0] + 0.3) * sin(0.7 * world[1]) * cos(0.8 * world[2]);
}

static const mtm_transfer_point soft[] = {{0, 0, 0, false, 0}, {1, 0.2, 0, false, 1}};

static void a_homogeneous_slab_is_its_closed_form(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(5, 5, 21);
    mtm_volume *volume = fixture_volume_for(way, &grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(3);
    const double depth = -log(1 - 0.1) / 2.5 * 20; /* opacity 0.1 at value ½, length 2.5, 20 units thick */
    for (double step = 0.1; step < 2.05; step += 0.1) {
        mtm_render_options options = fixture_plain_options();
        fixture_set_way(way, &options);
        options.step = step;
        mtm_image *image = fixture_render(volume, 2, soft, 2.5, basis, &camera, &options);
        const float *pixel = fixture_pixel(image, 4, 4);
        assert_near(pixel[4], 1 - exp(-depth), 1e-5);
        assert_near(pixel[0], 0.5 * (1 - exp(-depth)), 1e-5);
        assert_near(pixel[1], 0.5 * (1 - exp(-depth)), 1e-5);
        assert_near(pixel[2], 0, 0);
        mtm_image_destroy(image);
    }
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void a_value_on_a_point_is_met_exactly(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(3, 3, 51);
    const mtm_transfer_point points[] = {
        {0.1, 0, 0, false, 0}, {0.5, 0.3, 0, false, 0}, {0.7, 0, 0, false, 0}};
    mtm_volume *volume = fixture_volume_for(way, &grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(1);
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    mtm_image *image = fixture_render(volume, 3, points, 40, basis, &camera, &options);
    assert_near(fixture_pixel(image, 4, 4)[4], 1 - pow(0.7, 50 / 40.0), 1e-5);
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

/* Optical depth of a ray through the ramp, by Simpson's rule on 10⁴ intervals. */
static double ramp_depth(void) {
    double sum = 0;
    for (int i = 0; i <= 10000; i++) {
        const double depth = -log(1 - 0.2 * i / 10000.0);
        sum += depth * (i == 0 || i == 10000 ? 1 : i % 2 == 1 ? 4 : 2);
    }
    return sum * 20 / 10000.0 / 3;
}

/* Rows of the table that packets classify with are at most 1/200 of the points' range apart (integers have more), and a
 * sample takes the nearest one: this is how far a value is off where all samples of a ray round to the same side. */
static const double half_a_row = 0.5 / 200;

/* Means are exact at any step, because the ramp has no kink. */
static void a_ramp_converges_with_the_square_of_the_step(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(3, 3, 21);
    mtm_volume *volume = fixture_volume_for(way, &grid, ramp_z);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(1);
    const double expected = 1 - exp(-ramp_depth());
    const double slope = (1 - expected) * 20 * -log(1 - 0.2); /* of alpha over value, at most */
    double errors[3];
    const double steps[3] = {2, 1, 0.1};
    for (int i = 0; i < 3; i++) {
        mtm_render_options options = fixture_plain_options();
        fixture_set_way(way, &options);
        options.step = steps[i];
        mtm_image *image = fixture_render(volume, 2, soft, 1, basis, &camera, &options);
        errors[i] = fabs(fixture_pixel(image, 4, 4)[4] - expected);
        mtm_image_destroy(image);
    }
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
    if (way == PLAIN) {
        assert_true(errors[0] > 3.5 * errors[1]);
        assert_true(errors[2] < 1e-3 && errors[2] < errors[1] / 50 + 1e-6);
        return;
    }
    for (int i = 0; i < 3; i++) assert_true(errors[i] < (fixture_has_means(way) ? 1e-5 : half_a_row * slope));
}

static void without_opacity_an_orthographic_picture_is_the_ray_sum(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(9, 9, 17);
    const mtm_transfer_point xray[] = {{0, 0, 0, true, 0}, {1, 0, 1, true, 0}};
    mtm_volume *volume = fixture_volume_for(way, &grid, bumps);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(9); /* pixel centers on voxel columns */
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    options.step = 1; /* samples half way between voxels: the trapezoid rule */
    const double tolerance = fixture_is_plain(way) ? 2e-6 : 16 * half_a_row / 4;
    mtm_image *image = fixture_render(volume, 2, xray, 4, basis, &camera, &options);
    for (int y = 0; y < 9; y++) {
        for (int x = 0; x < 9; x++) {
            double sum = 0;
            for (int k = 0; k < 17; k++)
                sum += mtm_volume_value(volume, x, 8 - y, k) * (k == 0 || k == 16 ? 0.5 : 1) / 4;
            assert_near(fixture_pixel(image, x, y)[0], sum, tolerance);
            assert_near(fixture_pixel(image, x, y)[4], 0, 0);
        }
    }
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void sum_is_the_optical_depth_and_covers_nothing(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(5, 5, 21);
    mtm_volume *volume = fixture_volume_for(way, &grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(3);
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    options.blend = MTM_BLEND_SUM;
    mtm_image *image = fixture_render(volume, 2, soft, 2.5, basis, &camera, &options);
    const double depth = -log(1 - 0.1) / 2.5 * 20;
    assert_near(fixture_pixel(image, 4, 4)[0] + fixture_pixel(image, 4, 4)[1], depth, 1e-5);
    assert_near(fixture_pixel(image, 4, 4)[4], 0, 0);
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void maximum_classifies_the_largest_value_once(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 3, 21);
    mtm_volume *volume = fixture_volume(&grid, ramp_z);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(1);
    mtm_render_options options = fixture_plain_options();
    options.blend = MTM_BLEND_MAXIMUM;
    options.step = 1;
    mtm_image *image = fixture_render(volume, 2, soft, 3, basis, &camera, &options);
    const double largest = 19.5 / 20; /* samples lie half way between the voxels */
    assert_near(fixture_pixel(image, 4, 4)[4], 0.2 * largest, 1e-6);
    assert_near(fixture_pixel(image, 4, 4)[1], 0.2 * largest * largest, 1e-6);
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static double ramp_xz(const double world[3]) {
    return (world[0] + world[2]) / 40;
}

static void gradients_are_those_of_a_linear_field_up_to_the_faces(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(9, 9, 9);
    const mtm_transfer_point constant[] = {{0, 0.2, 0, false, 0}};
    mtm_volume *volume = fixture_volume_for(way, &grid, ramp_xz);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(8); /* the outermost rays run just inside the faces */
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    options.shading.ambient = 0.3;
    options.shading.diffuse = 0.7;
    mtm_image *image = fixture_render(volume, 1, constant, 1, basis, &camera, &options);
    for (int y = 0; y < 9; y++)
        for (int x = 0; x < 9; x++)
            assert_near(fixture_pixel(image, x, y)[0] / fixture_pixel(image, x, y)[4], 0.3 + 0.7 * sqrt(0.5),
                        1e-5);
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void an_eye_inside_sees_only_what_is_before_it(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(21, 21, 21);
    mtm_volume *volume = fixture_volume_for(way, &grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_camera camera = fixture_front_camera(3);
    camera.distance = 4;
    camera.fov = 30;
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    mtm_image *image = fixture_render(volume, 2, soft, 2.5, basis, &camera, &options);
    assert_near(fixture_pixel(image, 4, 4)[4], 1 - pow(0.9, 14 / 2.5), 1e-5);
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void a_ray_ends_where_little_is_left_to_see(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(5, 5, 101);
    mtm_volume *volume = fixture_volume_for(way, &grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(3);
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    options.termination = 0.01;
    mtm_image *image = fixture_render(volume, 2, soft, 1, basis, &camera, &options);
    const double alpha = fixture_pixel(image, 4, 4)[4];
    assert_true(alpha > 0.99 && alpha < 1 - 0.01 * 0.9); /* stopped within one step below the threshold */
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void a_flat_volume_and_a_missed_one_are_empty_pictures(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid flat = mtm_grid_defaults(9, 9, 1);
    const mtm_grid grid = mtm_grid_defaults(9, 9, 9);
    mtm_volume *volumes[2] = {fixture_volume_for(way, &flat, half), fixture_volume_for(way, &grid, half)};
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    for (int i = 0; i < 2; i++) {
        mtm_camera camera = fixture_front_camera(3);
        camera.has_target = i == 1;
        camera.target[0] = 1000;
        mtm_image *image = fixture_render(volumes[i], 2, soft, 1, basis, &camera, &options);
        for (int n = 0; n < 9 * 9 * image->lanes; n++) assert_true(image->pixels[n] == 0);
        mtm_image_destroy(image);
        mtm_volume_destroy(volumes[i]);
    }
    mtm_basis_destroy(basis);
}

/* Numbers that overflow on the way to the box must end as a missed volume, not as undefined conversions. */
static void a_camera_beyond_all_numbers_sees_nothing(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(9, 9, 9);
    mtm_volume *volume = fixture_volume_for(way, &grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    for (int i = 0; i < 2; i++) {
        mtm_camera camera = mtm_camera_defaults();
        camera.fov = i * 30;
        camera.distance = 1.5e308;
        camera.has_target = true;
        camera.target[0] = camera.target[1] = camera.target[2] = 1.5e308;
        mtm_image *image = fixture_render(volume, 2, soft, 1, basis, &camera, &options);
        for (int n = 0; n < 9 * 9 * image->lanes; n++) assert_true(image->pixels[n] == 0);
        mtm_image_destroy(image);
    }
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static bool stop_at_once(void *user, double fraction) {
    (void)fraction;
    ++*(int *)user;
    return false;
}

static void unknown_renderers_tiny_steps_and_cancelling_are_told(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(9, 9, 9);
    mtm_volume *volume = fixture_volume(&grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_transfer *transfer = NULL;
    mtm_image *image = NULL;
    mtm_error error;
    int reports = 0;
    const mtm_progress progress = {stop_at_once, &reports};
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = fixture_plain_options();
    options.width = options.height = 100;
    options.thread_count = 1;
    assert_ok(mtm_transfer_create(2, soft, 1, basis, &transfer, &error), error);
    assert_ok(mtm_image_create(100, 100, 4, "materials", NULL, NULL, &image, &error), error);
    assert_fails(mtm_render("raytrace", volume, transfer, &camera, &options, NULL, image, &error),
                 MTM_ARGUMENT, error, "raycast");
    assert_fails(mtm_render("raycast", volume, transfer, &camera, &options, &progress, image, &error),
                 MTM_CANCELLED, error, "cancelled");
    assert_int_equal(reports, 1);
    options.step = 1e-6;
    assert_fails(mtm_render("raycast", volume, transfer, &camera, &options, NULL, image, &error), MTM_LIMIT,
                 error, "1e-06");
    mtm_image_destroy(image);
    mtm_transfer_destroy(transfer);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        FIXTURE_WAYS(a_homogeneous_slab_is_its_closed_form),
        FIXTURE_WAYS(a_value_on_a_point_is_met_exactly),
        FIXTURE_WAYS(a_ramp_converges_with_the_square_of_the_step),
        FIXTURE_WAYS(without_opacity_an_orthographic_picture_is_the_ray_sum),
        FIXTURE_WAYS(sum_is_the_optical_depth_and_covers_nothing),
        cmocka_unit_test(maximum_classifies_the_largest_value_once),
        FIXTURE_WAYS(gradients_are_those_of_a_linear_field_up_to_the_faces),
        FIXTURE_WAYS(an_eye_inside_sees_only_what_is_before_it),
        FIXTURE_WAYS(a_ray_ends_where_little_is_left_to_see),
        FIXTURE_WAYS(a_flat_volume_and_a_missed_one_are_empty_pictures),
        FIXTURE_WAYS(a_camera_beyond_all_numbers_sees_nothing),
        cmocka_unit_test(unknown_renderers_tiny_steps_and_cancelling_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
