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

/* Empty but for a ball round the middle. */
static double ball(const double world[3]) {
    const double x = world[0] - 8;
    const double y = world[1] - 8;
    const double z = world[2] - 8;
    return fmax(0, 1 - sqrt(x * x + y * y + z * z) / 6);
}

static const mtm_transfer_point soft[] = {{0, 0, 0, false, 0}, {1, 0.2, 0, false, 1}};
static const mtm_transfer_point visible_above_03[] = {
    {0, 0, 0, false, 0}, {0.3, 0, 0, false, 1}, {1, 0.9, 0, false, 2}};

static void a_homogeneous_slab_is_its_closed_form(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(5, 5, 21);
    mtm_volume *volume = fixture_volume(&grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(3);
    const double depth = -log(1 - 0.1) / 2.5 * 20; /* opacity 0.1 at value ½, length 2.5, 20 units thick */
    for (double step = 0.1; step < 2.05; step += 0.1) {
        mtm_render_options options = fixture_plain_options();
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
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 3, 51);
    const mtm_transfer_point points[] = {
        {0.1, 0, 0, false, 0}, {0.5, 0.3, 0, false, 0}, {0.7, 0, 0, false, 0}};
    mtm_volume *volume = fixture_volume(&grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(1);
    const mtm_render_options options = fixture_plain_options();
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

static void a_ramp_converges_with_the_square_of_the_step(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(3, 3, 21);
    mtm_volume *volume = fixture_volume(&grid, ramp_z);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(1);
    const double expected = 1 - exp(-ramp_depth());
    double errors[3];
    const double steps[3] = {2, 1, 0.1};
    for (int i = 0; i < 3; i++) {
        mtm_render_options options = fixture_plain_options();
        options.step = steps[i];
        mtm_image *image = fixture_render(volume, 2, soft, 1, basis, &camera, &options);
        errors[i] = fabs(fixture_pixel(image, 4, 4)[4] - expected);
        mtm_image_destroy(image);
    }
    assert_true(errors[0] > 3.5 * errors[1]);
    assert_true(errors[2] < 1e-3 && errors[2] < errors[1] / 50 + 1e-6);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void without_opacity_an_orthographic_picture_is_the_ray_sum(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(9, 9, 17);
    const mtm_transfer_point xray[] = {{0, 0, 0, true, 0}, {1, 0, 1, true, 0}};
    mtm_volume *volume = fixture_volume(&grid, bumps);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(9); /* pixel centers on voxel columns */
    mtm_render_options options = fixture_plain_options();
    options.step = 1; /* samples half way between voxels: the trapezoid rule */
    mtm_image *image = fixture_render(volume, 2, xray, 4, basis, &camera, &options);
    for (int y = 0; y < 9; y++) {
        for (int x = 0; x < 9; x++) {
            double sum = 0;
            for (int k = 0; k < 17; k++)
                sum += mtm_volume_value(volume, x, 8 - y, k) * (k == 0 || k == 16 ? 0.5 : 1) / 4;
            assert_near(fixture_pixel(image, x, y)[0], sum, 2e-6);
            assert_near(fixture_pixel(image, x, y)[4], 0, 0);
        }
    }
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void sum_is_the_optical_depth_and_covers_nothing(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(5, 5, 21);
    mtm_volume *volume = fixture_volume(&grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(3);
    mtm_render_options options = fixture_plain_options();
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

static void spacing_is_world_length_along_every_axis(void **state) {
    (void)state;
    mtm_grid coarse = mtm_grid_defaults(5, 9, 9);
    mtm_grid fine = mtm_grid_defaults(17, 17, 17);
    coarse.axes[0][0] = 4;
    coarse.axes[1][1] = 2;
    coarse.axes[2][2] = 2;
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_volume *volumes[2] = {fixture_volume(&coarse, ramp_z), fixture_volume(&fine, ramp_z)};
    mtm_camera camera = mtm_camera_defaults();
    camera.distance = 40;
    mtm_image *images[2];
    for (int i = 0; i < 2; i++) {
        mtm_render_options options = fixture_plain_options();
        options.width = options.height = 33;
        options.shading = mtm_render_defaults().shading; /* gradients, too, are per world length */
        options.step = i == 0 ? 0.05 : 0.1;              /* in smallest spacings: the same samples */
        options.shading.gradient_threshold = 0;
        images[i] = fixture_render(volumes[i], 2, soft, 3, basis, &camera, &options);
    }
    /* A linear function is interpolated without error, so the two volumes are the same field. */
    assert_true(fixture_largest_difference(images[0], images[1]) < 2e-5);
    for (int i = 0; i < 2; i++) {
        mtm_image_destroy(images[i]);
        mtm_volume_destroy(volumes[i]);
    }
    mtm_basis_destroy(basis);
}

static void a_turned_camera_on_a_turned_volume_sees_the_same(void **state) {
    (void)state;
    mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *volume = fixture_volume(&grid, ball);
    /* The same voxels in a grid turned by 90° about y: x goes to -z, z to x. */
    mtm_grid turned = grid;
    memcpy(turned.axes, (const double[3][3]){{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, sizeof turned.axes);
    turned.origin[2] = 16;
    mtm_error error;
    mtm_volume *turned_volume = NULL;
    assert_ok(mtm_volume_create(&turned, MTM_VOXEL_FLOAT32, mtm_volume_voxels(volume), 1, 0, &turned_volume,
                                &error),
              error);
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_render_options options = mtm_render_defaults();
    options.width = options.height = 40;
    mtm_camera camera = mtm_camera_defaults();
    mtm_image *before = fixture_render(volume, 3, visible_above_03, 2, basis, &camera, &options);
    camera.azimuth += 90;
    mtm_image *after = fixture_render(turned_volume, 3, visible_above_03, 2, basis, &camera, &options);
    assert_true(fixture_pixel(before, 20, 20)[4] > 0.5f);
    assert_true(fixture_largest_difference(before, after) < 1e-5);
    mtm_image_destroy(before);
    mtm_image_destroy(after);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(turned_volume);
    mtm_volume_destroy(volume);
}

static void clipping_does_not_move_samples(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *volume = fixture_volume(&grid, bumps);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    options.width = options.height = 40;
    options.termination = 0;
    mtm_image *whole = fixture_render(volume, 2, soft, 2, basis, &camera, &options);
    /* The camera stands on the side of large z, so the near part lies over the far part: whole = near + T · far. */
    options.clip_low[2] = 0.37;
    mtm_image *near = fixture_render(volume, 2, soft, 2, basis, &camera, &options);
    options.clip_low[2] = 0;
    options.clip_high[2] = 0.37;
    mtm_image *far = fixture_render(volume, 2, soft, 2, basis, &camera, &options);
    for (int y = 0; y < 40; y++) {
        for (int x = 0; x < 40; x++) {
            const float *front = fixture_pixel(near, x, y);
            const float *back = fixture_pixel(far, x, y);
            for (int i = 0; i < 5; i++)
                assert_near(front[i] + (1 - front[4]) * back[i], fixture_pixel(whole, x, y)[i], 1e-6);
        }
    }
    mtm_image_destroy(whole);
    mtm_image_destroy(near);
    mtm_image_destroy(far);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

/* Its surface crosses many faces of blocks. */
static double big_ball(const double world[3]) {
    return 1 - 0.06 * sqrt(pow(world[0] - 16, 2) + pow(world[1] - 14, 2) + pow(world[2] - 20, 2));
}

/* An emission of 1e-30 makes every block count as visible without changing any value; the ball begins with a jump, so
 * that a sample skipped at its edge shows. */
static void skipping_empty_space_changes_nothing(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(33, 29, 41);
    const mtm_transfer_point never_empty[] = {
        {0, 0, 1e-30, true, 1}, {0.3, 0, 1e-30, true, 1}, {0.3, 0.9, 1, true, 2}};
    const mtm_transfer_point with_empty[] = {
        {0, 0, 0, true, 1}, {0.3, 0, 0, true, 1}, {0.3, 0.9, 1, true, 2}};
    mtm_volume *volume = fixture_volume(&grid, big_ball);
    mtm_basis *basis = fixture_basis("materials", NULL);
    for (int i = 0; i < 12; i++) {
        mtm_camera camera = mtm_camera_defaults();
        camera.azimuth = 30 * i;
        camera.elevation = 15 * i - 90;
        camera.fov = i % 3 == 0 ? 0 : 40;
        mtm_render_options options = mtm_render_defaults();
        options.width = options.height = 48;
        options.step = 0.1 + 0.13 * i;
        options.jitter = i % 2 == 1;
        mtm_image *skipped = fixture_render(volume, 3, with_empty, 2, basis, &camera, &options);
        mtm_image *walked = fixture_render(volume, 3, never_empty, 2, basis, &camera, &options);
        assert_true(fixture_largest_difference(skipped, walked) < 1e-7);
        mtm_image_destroy(skipped);
        mtm_image_destroy(walked);
    }
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static double ramp_xz(const double world[3]) {
    return (world[0] + world[2]) / 40;
}

static void gradients_are_those_of_a_linear_field_up_to_the_faces(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(9, 9, 9);
    const mtm_transfer_point constant[] = {{0, 0.2, 0, false, 0}};
    mtm_volume *volume = fixture_volume(&grid, ramp_xz);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(8); /* the outermost rays run just inside the faces */
    mtm_render_options options = fixture_plain_options();
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
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(21, 21, 21);
    mtm_volume *volume = fixture_volume(&grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_camera camera = fixture_front_camera(3);
    camera.distance = 4;
    camera.fov = 30;
    const mtm_render_options options = fixture_plain_options();
    mtm_image *image = fixture_render(volume, 2, soft, 2.5, basis, &camera, &options);
    assert_near(fixture_pixel(image, 4, 4)[4], 1 - pow(0.9, 14 / 2.5), 1e-5);
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void any_number_of_threads_gives_the_same_bits(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *volume = fixture_volume(&grid, bumps);
    mtm_basis *basis = fixture_basis("wavelengths", NULL);
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    options.width = 70;
    options.height = 50;
    options.jitter = true;
    options.thread_count = 1;
    mtm_image *one = fixture_render(volume, 2, soft, 2, basis, &camera, &options);
    const int counts[] = {2, 3, 7};
    for (int i = 0; i < 3; i++) {
        options.thread_count = counts[i];
        mtm_image *many = fixture_render(volume, 2, soft, 2, basis, &camera, &options);
        assert_memory_equal(one->pixels, many->pixels, 70U * 50U * (size_t)one->lanes * sizeof(float));
        mtm_image_destroy(many);
    }
    mtm_image_destroy(one);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static void a_ray_ends_where_little_is_left_to_see(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(5, 5, 101);
    mtm_volume *volume = fixture_volume(&grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = fixture_front_camera(3);
    mtm_render_options options = fixture_plain_options();
    options.termination = 0.01;
    mtm_image *image = fixture_render(volume, 2, soft, 1, basis, &camera, &options);
    const double alpha = fixture_pixel(image, 4, 4)[4];
    assert_true(alpha > 0.99 && alpha < 1 - 0.01 * 0.9); /* stopped within one step below the threshold */
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static double not_a_number_inside(const double world[3]) {
    return world[0] > 6 && world[0] < 10 ? NAN : ball(world);
}

static double smallest_inside(const double world[3]) {
    return world[0] > 6 && world[0] < 10 ? 0 : ball(world);
}

static void voxels_that_are_no_numbers_count_as_the_smallest_value(void **state) {
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *holes = fixture_volume(&grid, not_a_number_inside);
    mtm_volume *zeros = fixture_volume(&grid, smallest_inside);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    options.width = options.height = 40;
    mtm_image *a = fixture_render(holes, 3, visible_above_03, 2, basis, &camera, &options);
    mtm_image *b = fixture_render(zeros, 3, visible_above_03, 2, basis, &camera, &options);
    assert_true(fixture_largest_difference(a, b) == 0);
    mtm_image_destroy(a);
    mtm_image_destroy(b);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(holes);
    mtm_volume_destroy(zeros);
}

/* Every type holds the same values 0 … 100 here, one of them with slope and intercept. */
static void every_voxel_type_gives_the_same_picture(void **state) {
    (void)state;
    enum { EDGE = 12, COUNT = EDGE * EDGE * EDGE };
    const mtm_grid grid = mtm_grid_defaults(EDGE, EDGE, EDGE);
    const mtm_transfer_point points[] = {{20, 0, 0, false, 0}, {90, 0.3, 0, false, 1}};
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    options.width = options.height = 24;
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_image *first = NULL;
    for (int type = 0; type < MTM_VOXEL_TYPE_COUNT; type++) {
        _Alignas(8) unsigned char bytes[COUNT * 8];
        for (int n = 0; n < COUNT; n++) {
            const int value = (n * 37 + n / EDGE * 11) % 101;
            switch (type) {
            case MTM_VOXEL_INT8: ((int8_t *)bytes)[n] = (int8_t)value; break;
            case MTM_VOXEL_UINT8: ((uint8_t *)bytes)[n] = (uint8_t)value; break;
            case MTM_VOXEL_INT16: ((int16_t *)bytes)[n] = (int16_t)(2 * value - 1000); break;
            case MTM_VOXEL_UINT16: ((uint16_t *)bytes)[n] = (uint16_t)value; break;
            case MTM_VOXEL_INT32: ((int32_t *)bytes)[n] = value; break;
            case MTM_VOXEL_UINT32: ((uint32_t *)bytes)[n] = (uint32_t)value; break;
            case MTM_VOXEL_INT64: ((int64_t *)bytes)[n] = value; break;
            case MTM_VOXEL_UINT64: ((uint64_t *)bytes)[n] = (uint64_t)value; break;
            case MTM_VOXEL_FLOAT32: ((float *)bytes)[n] = (float)value; break;
            default: ((double *)bytes)[n] = value; break;
            }
        }
        const bool is_scaled = type == MTM_VOXEL_INT16;
        mtm_error error;
        mtm_volume *volume = NULL;
        assert_ok(mtm_volume_create(&grid, (mtm_voxel_type)type, bytes, is_scaled ? 0.5 : 1,
                                    is_scaled ? 500 : 0, &volume, &error),
                  error);
        mtm_image *image = fixture_render(volume, 2, points, 2, basis, &camera, &options);
        if (first == NULL) {
            first = image;
        } else {
            assert_true(fixture_largest_difference(first, image) == 0);
            mtm_image_destroy(image);
        }
        mtm_volume_destroy(volume);
    }
    mtm_image_destroy(first);
    mtm_basis_destroy(basis);
}

static void a_flat_volume_and_a_missed_one_are_empty_pictures(void **state) {
    (void)state;
    const mtm_grid flat = mtm_grid_defaults(9, 9, 1);
    const mtm_grid grid = mtm_grid_defaults(9, 9, 9);
    mtm_volume *volumes[2] = {fixture_volume(&flat, half), fixture_volume(&grid, half)};
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_render_options options = fixture_plain_options();
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
    (void)state;
    const mtm_grid grid = mtm_grid_defaults(9, 9, 9);
    mtm_volume *volume = fixture_volume(&grid, half);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_render_options options = fixture_plain_options();
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
        cmocka_unit_test(a_homogeneous_slab_is_its_closed_form),
        cmocka_unit_test(a_value_on_a_point_is_met_exactly),
        cmocka_unit_test(a_ramp_converges_with_the_square_of_the_step),
        cmocka_unit_test(without_opacity_an_orthographic_picture_is_the_ray_sum),
        cmocka_unit_test(sum_is_the_optical_depth_and_covers_nothing),
        cmocka_unit_test(maximum_classifies_the_largest_value_once),
        cmocka_unit_test(spacing_is_world_length_along_every_axis),
        cmocka_unit_test(a_turned_camera_on_a_turned_volume_sees_the_same),
        cmocka_unit_test(clipping_does_not_move_samples),
        cmocka_unit_test(skipping_empty_space_changes_nothing),
        cmocka_unit_test(gradients_are_those_of_a_linear_field_up_to_the_faces),
        cmocka_unit_test(an_eye_inside_sees_only_what_is_before_it),
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
        cmocka_unit_test(a_ray_ends_where_little_is_left_to_see),
        cmocka_unit_test(voxels_that_are_no_numbers_count_as_the_smallest_value),
        cmocka_unit_test(every_voxel_type_gives_the_same_picture),
        cmocka_unit_test(a_flat_volume_and_a_missed_one_are_empty_pictures),
        cmocka_unit_test(a_camera_beyond_all_numbers_sees_nothing),
        cmocka_unit_test(unknown_renderers_tiny_steps_and_cancelling_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
