/* SPDX-License-Identifier: BSD-3-Clause
 * What must not change a picture: another grid for the same field, a turned world, a clip box, skipped space, threads,
 * other voxel types. */
#include "fixture.h"

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

static void spacing_is_world_length_along_every_axis(void **state) {
    const fixture_way way = fixture_way_of(state);
    mtm_grid coarse = mtm_grid_defaults(5, 9, 9);
    mtm_grid fine = mtm_grid_defaults(17, 17, 17);
    coarse.axes[0][0] = 4;
    coarse.axes[1][1] = 2;
    coarse.axes[2][2] = 2;
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_volume *volumes[2] = {fixture_volume_for(way, &coarse, ramp_z),
                              fixture_volume_for(way, &fine, ramp_z)};
    mtm_camera camera = mtm_camera_defaults();
    camera.distance = 40;
    mtm_image *images[2];
    for (int i = 0; i < 2; i++) {
        mtm_render_options options = fixture_plain_options();
        fixture_set_way(way, &options);
        options.width = options.height = 33;
        options.shading = mtm_render_defaults().shading; /* gradients, too, are per world length */
        options.step = i == 0 ? 0.05 : 0.1;              /* in smallest spacings: the same samples */
        options.shading.gradient_threshold = 0;
        images[i] = fixture_render(volumes[i], 2, soft, 3, basis, &camera, &options);
    }
    /* A linear function is interpolated without error, so the two volumes are the same field. Packets may take another
     * of two neighboring rows of their table where a value lies half way between. */
    const double tolerance = fixture_is_plain(way) ? 1e-7 : 1e-4;
    assert_near(fixture_largest_difference(images[0], images[1]), 0, tolerance);
    for (int i = 0; i < 2; i++) {
        mtm_image_destroy(images[i]);
        mtm_volume_destroy(volumes[i]);
    }
    mtm_basis_destroy(basis);
}

static void a_turned_camera_on_a_turned_volume_sees_the_same(void **state) {
    const fixture_way way = fixture_way_of(state);
    mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *volume = fixture_volume_for(way, &grid, ball);
    /* The same voxels in a grid turned by 90° about y: x goes to -z, z to x. */
    mtm_grid turned = grid;
    memcpy(turned.axes, (const double[3][3]){{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, sizeof turned.axes);
    turned.origin[2] = 16;
    mtm_error error;
    mtm_volume *turned_volume = NULL;
    assert_ok(mtm_volume_create(&turned, mtm_volume_type(volume), mtm_volume_voxels(volume),
                                mtm_volume_slope(volume), 0, &turned_volume, &error),
              error);
    mtm_basis *basis = fixture_basis("materials", NULL);
    mtm_render_options options = mtm_render_defaults();
    fixture_set_way(way, &options);
    options.width = options.height = 40;
    mtm_camera camera = mtm_camera_defaults();
    mtm_image *before = fixture_render(volume, 3, visible_above_03, 2, basis, &camera, &options);
    camera.azimuth += 90;
    mtm_image *after = fixture_render(turned_volume, 3, visible_above_03, 2, basis, &camera, &options);
    assert_true(fixture_pixel(before, 20, 20)[4] > 0.5f);
    /* Packed gradients are rounded, and halves of a level not to the same side where an axis points the other way. */
    assert_near(fixture_largest_difference(before, after), 0, way < PACKED ? 1e-5 : 1e-4);
    mtm_image_destroy(before);
    mtm_image_destroy(after);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(turned_volume);
    mtm_volume_destroy(volume);
}

/* Means are over the values up to the clip box and lit with the gradients there: then the step that is cut differs. */
static void clipping_does_not_move_samples(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *volume = fixture_volume_for(way, &grid, bumps);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    fixture_set_way(way, &options);
    options.width = options.height = 40;
    options.termination = 0;
    const double tolerance = fixture_has_means(way) ? 0.01 : 1e-6;
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
                assert_near(front[i] + (1 - front[4]) * back[i], fixture_pixel(whole, x, y)[i], tolerance);
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
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(33, 29, 41);
    const mtm_transfer_point never_empty[] = {
        {0, 0, 1e-30, true, 1}, {0.3, 0, 1e-30, true, 1}, {0.3, 0.9, 1, true, 2}};
    const mtm_transfer_point with_empty[] = {
        {0, 0, 0, true, 1}, {0.3, 0, 0, true, 1}, {0.3, 0.9, 1, true, 2}};
    mtm_volume *volume = fixture_volume_for(way, &grid, big_ball);
    mtm_basis *basis = fixture_basis("materials", NULL);
    for (int i = 0; i < 12; i++) {
        mtm_camera camera = mtm_camera_defaults();
        camera.azimuth = 30 * i;
        camera.elevation = 15 * i - 90;
        camera.fov = i % 3 == 0 ? 0 : 40;
        mtm_render_options options = mtm_render_defaults();
        fixture_set_way(way, &options);
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

static void any_number_of_threads_gives_the_same_bits(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *volume = fixture_volume_for(way, &grid, bumps);
    mtm_basis *basis = fixture_basis("wavelengths", NULL);
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    fixture_set_way(way, &options);
    options.width = 70;
    options.height = 50;
    options.jitter = true;
    options.thread_count = 1;
    mtm_image *one = fixture_render(volume, 2, soft, 2, basis, &camera, &options);
    const int counts[] = {2, 3, 5, 7};
    for (int i = 0; i < 4; i++) {
        options.thread_count = counts[i];
        mtm_image *many = fixture_render(volume, 2, soft, 2, basis, &camera, &options);
        assert_memory_equal(one->pixels, many->pixels, 70U * 50U * (size_t)one->lanes * sizeof(float));
        mtm_image_destroy(many);
    }
    mtm_image_destroy(one);
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
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *holes = fixture_volume_for(way, &grid, not_a_number_inside);
    mtm_volume *zeros = fixture_volume_for(way, &grid, smallest_inside);
    mtm_basis *basis = fixture_basis("materials", NULL);
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    fixture_set_way(way, &options);
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
    const fixture_way way = fixture_way_of(state);
    enum { EDGE = 12, COUNT = EDGE * EDGE * EDGE };
    const mtm_grid grid = mtm_grid_defaults(EDGE, EDGE, EDGE);
    const mtm_transfer_point points[] = {{20, 0, 0, false, 0}, {90, 0.3, 0, false, 1}};
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    fixture_set_way(way, &options);
    options.width = options.height = 24;
    options.memory_bytes = way < PACKED ? 1 : 0;
    /* Gradients in 8 bits are off by 1/254 of the range; at the faces of so rough a volume, where one-sided differences
     * are larger than what they hold, they saturate. Rows of the table lie on integers, but anywhere for floats. */
    const double tolerance = fixture_is_plain(way) ? 0 : way < PACKED ? 0.002 : 0.03;
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
            assert_near(fixture_largest_difference(first, image), 0, tolerance);
            mtm_image_destroy(image);
        }
        mtm_volume_destroy(volume);
    }
    mtm_image_destroy(first);
    mtm_basis_destroy(basis);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        FIXTURE_WAYS(spacing_is_world_length_along_every_axis),
        FIXTURE_WAYS(a_turned_camera_on_a_turned_volume_sees_the_same),
        FIXTURE_WAYS(clipping_does_not_move_samples),
        FIXTURE_WAYS(skipping_empty_space_changes_nothing),
        FIXTURE_WAYS(any_number_of_threads_gives_the_same_bits),
        FIXTURE_WAY(voxels_that_are_no_numbers_count_as_the_smallest_value, PLAIN),
        FIXTURE_WAY(voxels_that_are_no_numbers_count_as_the_smallest_value, PLAIN_MEANS),
        FIXTURE_WAY(voxels_that_are_no_numbers_count_as_the_smallest_value, NATIVE),
        FIXTURE_WAY(voxels_that_are_no_numbers_count_as_the_smallest_value, NATIVE_MEANS),
        FIXTURE_WAYS(every_voxel_type_gives_the_same_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
