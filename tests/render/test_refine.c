/* SPDX-License-Identifier: BSD-3-Clause
 * A picture that comes coarse first and then finer, against the same picture at once. */
#include "fixture.h"

static double bumps(const double world[3]) {
    return 0.5 + 0.5 * sin(0.9 * world[0] + 0.3) * sin(0.7 * world[1]) * cos(0.8 * world[2]);
}

static const mtm_transfer_point visible_above_03[] = {
    {0, 0, 0, false, 0}, {0.3, 0, 0, false, 1}, {1, 0.9, 0, false, 2}};

typedef struct fixture {
    mtm_volume *volume;
    mtm_basis *basis;
    mtm_transfer *transfer;
    mtm_projector *projector;
    mtm_camera camera;
} fixture;

static int set_up(void **state) {
    mtm_error error;
    fixture *made = calloc(1, sizeof *made);
    assert_non_null(made);
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    const mtm_render_options options = mtm_render_defaults();
    made->volume = fixture_volume(&grid, bumps);
    made->basis = fixture_basis("materials", NULL);
    made->camera = mtm_camera_defaults();
    assert_ok(mtm_transfer_create(3, visible_above_03, 2, made->basis, &made->transfer, &error), error);
    assert_ok(mtm_projector_create("raycast", made->volume, &options, NULL, &made->projector, &error), error);
    assert_ok(mtm_projector_set_transfer(made->projector, made->transfer, &error), error);
    *state = made;
    return 0;
}

static int tear_down(void **state) {
    fixture *made = *state;
    mtm_projector_destroy(made->projector);
    mtm_transfer_destroy(made->transfer);
    mtm_basis_destroy(made->basis);
    mtm_volume_destroy(made->volume);
    free(made);
    return 0;
}

static mtm_render_options options_of_size(int width, int height) {
    mtm_render_options options = mtm_render_defaults();
    options.width = width;
    options.height = height;
    options.jitter = true; /* every pixel has a random number of its own */
    return options;
}

static size_t pixel_bytes(const mtm_image *image) {
    return (size_t)image->lanes * sizeof *image->pixels;
}

/* An image full of what no renderer writes. */
static mtm_image *make_image(const fixture *made, const mtm_render_options *options) {
    mtm_error error;
    mtm_image *image = NULL;
    assert_ok(mtm_image_create(options->width, options->height, mtm_basis_dimension(made->basis),
                               mtm_basis_name(made->basis), NULL, NULL, &image, &error),
              error);
    memset(image->pixels, 0xA5, (size_t)options->width * (size_t)options->height * pixel_bytes(image));
    return image;
}

static mtm_image *render_at_once(const fixture *made, const mtm_render_options *options) {
    mtm_error error;
    mtm_image *image = make_image(made, options);
    assert_ok(mtm_projector_render(made->projector, &made->camera, options, NULL, image, &error), error);
    return image;
}

/* Whether the pixel (x, y) holds what belongs to its pixel of a stride. */
static bool is_of_stride(const mtm_image *image, const mtm_image *whole, int x, int y, int stride) {
    const float *coarse = fixture_pixel(whole, x - x % stride, y - y % stride);
    return memcmp(fixture_pixel(image, x, y), coarse, pixel_bytes(whole)) == 0;
}

static void assert_stage(const mtm_image *image, const mtm_image *whole, int stride) {
    for (int y = 0; y < whole->height; y++)
        for (int x = 0; x < whole->width; x++)
            if (!is_of_stride(image, whole, x, y, stride))
                fail_msg("%d x %d, stride %d: pixel (%d, %d) is another", whole->width, whole->height, stride,
                         x, y);
}

/* What the callbacks are told, and when they answer that it is enough. */
typedef struct listener {
    const mtm_image *image, *whole;
    int strides[8];
    int stage_count, report_count;
    double fraction;
    int last_stride; /* the stage after which `refined` ends the work; 0: none */
    int reports_max; /* in the second stage; 0: any */
} listener;

static bool note_stage(void *user, int stride) {
    listener *heard = user;
    assert_true(heard->stage_count < 8);
    heard->strides[heard->stage_count++] = stride;
    heard->report_count = heard->reports_max > 0 ? 0 : heard->report_count;
    assert_stage(heard->image, heard->whole, stride);
    return stride != heard->last_stride;
}

static bool note_progress(void *user, double fraction) {
    listener *heard = user;
    assert_true(fraction >= heard->fraction && fraction <= 1);
    heard->fraction = fraction;
    heard->report_count++;
    return heard->reports_max == 0 || heard->stage_count == 0 || heard->report_count < heard->reports_max;
}

static mtm_status refine(const fixture *made, const mtm_render_options *options, int coarsest,
                         listener *heard, mtm_image *image, mtm_error *error) {
    const mtm_refinement refinement = {coarsest, note_stage, heard};
    const mtm_progress progress = {note_progress, heard};
    return mtm_projector_refine(made->projector, &made->camera, options, &refinement, &progress, image,
                                error);
}

/* Refines from every coarsest stride, and looks at the picture after each stage. */
static void check_stages(const fixture *made, const mtm_render_options *options) {
    mtm_error error;
    mtm_image *whole = render_at_once(made, options);
    for (int coarsest = 1; coarsest <= 16; coarsest *= 2) {
        mtm_image *image = make_image(made, options);
        listener heard = {.image = image, .whole = whole};
        assert_ok(refine(made, options, coarsest, &heard, image, &error), error);
        if (options->thread_count == 1) assert_near(heard.fraction, 1, 1e-12); /* else others may come last */
        int stage = 0;
        for (int stride = coarsest; stride >= 1; stride /= 2)
            assert_int_equal(heard.strides[stage++], stride);
        assert_int_equal(heard.stage_count, stage);
        assert_stage(image, whole, 1);
        mtm_image_destroy(image);
    }
    mtm_image_destroy(whole);
}

static void every_stage_is_right_and_the_last_has_the_same_bits(void **state) {
    const int sizes[][2] = {{1, 1}, {3, 5}, {33, 17}, {70, 50}};
    for (int i = 0; i < 4; i++) {
        for (int threads = 1; threads <= 3; threads++) {
            mtm_render_options options = options_of_size(sizes[i][0], sizes[i][1]);
            options.thread_count = threads;
            check_stages(*state, &options);
        }
    }
}

static void so_it_is_with_every_blend_and_with_plain_rays(void **state) {
    mtm_render_options options = options_of_size(33, 17);
    options.blend = MTM_BLEND_MAXIMUM;
    check_stages(*state, &options);
    options.blend = MTM_BLEND_SUM;
    check_stages(*state, &options);
    options.without = MTM_WITHOUT_PACKETS;
    check_stages(*state, &options);
}

/* Lattices of this size have whole tiles only, and one thread asks once for each. */
static void no_pixel_is_computed_twice(void **state) {
    mtm_error error;
    mtm_render_options options = options_of_size(64, 64);
    options.thread_count = 1;
    mtm_image *whole = render_at_once(*state, &options);
    mtm_image *image = make_image(*state, &options);
    for (int coarsest = 1; coarsest <= 4; coarsest *= 2) {
        listener heard = {.image = image, .whole = whole};
        assert_ok(refine(*state, &options, coarsest, &heard, image, &error), error);
        assert_int_equal(heard.report_count, 16);
    }
    mtm_image_destroy(image);
    mtm_image_destroy(whole);
}

static void nobody_needs_to_listen(void **state) {
    const fixture *made = *state;
    mtm_error error;
    const mtm_render_options options = options_of_size(33, 17);
    const mtm_refinement refinement = {.coarsest = 8};
    mtm_image *whole = render_at_once(made, &options);
    mtm_image *image = make_image(made, &options);
    assert_ok(
        mtm_projector_refine(made->projector, &made->camera, &options, &refinement, NULL, image, &error),
        error);
    assert_stage(image, whole, 1);
    mtm_image_destroy(image);
    mtm_image_destroy(whole);
}

static void a_picture_that_ends_after_a_stage_keeps_it(void **state) {
    mtm_error error;
    const mtm_render_options options = options_of_size(70, 50);
    mtm_image *whole = render_at_once(*state, &options);
    mtm_image *image = make_image(*state, &options);
    for (int last = 8; last >= 1; last /= 2) {
        listener heard = {.image = image, .whole = whole, .last_stride = last};
        assert_fails(refine(*state, &options, 8, &heard, image, &error), MTM_CANCELLED, error, "cancelled");
        assert_int_equal(heard.strides[heard.stage_count - 1], last);
        assert_stage(image, whole, last);
    }
    mtm_image_destroy(image);
    mtm_image_destroy(whole);
}

static void a_picture_cancelled_within_a_stage_stays_complete(void **state) {
    mtm_error error;
    mtm_render_options options = options_of_size(70, 50);
    options.thread_count = 1; /* which is asked after every tile: 6 in each of the stage's 3 lattices */
    mtm_image *whole = render_at_once(*state, &options);
    for (int reports = 1; reports <= 18; reports++) {
        mtm_image *image = make_image(*state, &options);
        listener heard = {.image = image, .whole = whole, .reports_max = reports};
        const mtm_status status = refine(*state, &options, 2, &heard, image, &error);
        assert_int_equal(status, MTM_CANCELLED);
        assert_int_equal(heard.stage_count, 1);
        assert_int_equal(heard.report_count, reports); /* nothing more was begun */
        for (int y = 0; y < whole->height; y++)
            for (int x = 0; x < whole->width; x++)
                assert_true(is_of_stride(image, whole, x, y, 2) || is_of_stride(image, whole, x, y, 1));
        mtm_image_destroy(image);
    }
    mtm_image_destroy(whole);
}

static void a_picture_cancelled_in_its_first_stage_is_no_stage(void **state) {
    mtm_error error;
    mtm_render_options options = options_of_size(70, 50);
    options.thread_count = 1;
    mtm_image *image = make_image(*state, &options);
    listener heard = {.reports_max = 1, .stage_count = 1}; /* as if a stage were over: it ends at once */
    assert_fails(refine(*state, &options, 4, &heard, image, &error), MTM_CANCELLED, error, "cancelled");
    assert_int_equal(heard.stage_count, 1);
    mtm_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_stage_is_right_and_the_last_has_the_same_bits),
        cmocka_unit_test(so_it_is_with_every_blend_and_with_plain_rays),
        cmocka_unit_test(no_pixel_is_computed_twice),
        cmocka_unit_test(nobody_needs_to_listen),
        cmocka_unit_test(a_picture_that_ends_after_a_stage_keeps_it),
        cmocka_unit_test(a_picture_cancelled_within_a_stage_stays_complete),
        cmocka_unit_test(a_picture_cancelled_in_its_first_stage_is_no_stage),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
