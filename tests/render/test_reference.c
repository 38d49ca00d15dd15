/* SPDX-License-Identifier: BSD-3-Clause
 * Postillumination against an educational renderer that lights every sample directly: no basis, no table of nodes, no
 * skipping, gradients by six extra interpolations. Paper eqs. 4 to 6. */
#include "fixture.h"

enum { WIDTH = 24, HEIGHT = 18 };

typedef struct reference_scene {
    const mtm_volume *volume;
    int point_count;
    const mtm_transfer_point *points;
    double opacity_length;
    mtm_camera camera;
    mtm_render_options options;
    mtm_illumination illumination;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
} reference_scene;

static double bumps(const double world[3]) {
    return 0.5 + 0.5 * sin(0.5 * world[0] + 0.3) * sin(0.35 * world[1]) * cos(0.4 * world[2]);
}

static double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

static double interpolate(const mtm_volume *volume, const double voxel[3]) {
    const mtm_grid *grid = mtm_volume_grid(volume);
    double value = 0;
    for (int corner = 0; corner < 8; corner++) {
        double weight = 1;
        int index[3];
        for (int axis = 0; axis < 3; axis++) {
            const double position = clamp(voxel[axis], 0, grid->size[axis] - 1);
            const int cell = (int)fmin(floor(position), grid->size[axis] - 2);
            const bool is_far = (corner >> axis & 1) == 1;
            index[axis] = cell + is_far;
            weight *= is_far ? position - cell : 1 - (position - cell);
        }
        value += weight * mtm_volume_value(volume, index[0], index[1], index[2]);
    }
    return value;
}

/* Differences of interpolated values a voxel before and behind; valid away from the faces. */
static void gradient(const mtm_volume *volume, const double voxel[3], double world_gradient[3]) {
    double inverse[3][3];
    mtm_grid_inverse_axes(mtm_volume_grid(volume), inverse);
    for (int i = 0; i < 3; i++) world_gradient[i] = 0;
    for (int axis = 0; axis < 3; axis++) {
        double before[3] = {voxel[0], voxel[1], voxel[2]};
        double behind[3] = {voxel[0], voxel[1], voxel[2]};
        before[axis] -= 1;
        behind[axis] += 1;
        const double slope = (interpolate(volume, behind) - interpolate(volume, before)) / 2;
        for (int i = 0; i < 3; i++) world_gradient[i] += slope * inverse[axis][i];
    }
}

typedef struct material {
    double extinction, emission; /* per world unit */
    mtm_spectrum reflectance;
} material;

static material classify(const reference_scene *scene, double value) {
    const mtm_transfer_point *a = &scene->points[0];
    const mtm_transfer_point *b = a;
    for (int i = 1; i < scene->point_count && value >= a->value; i++) {
        b = &scene->points[i];
        if (value < b->value) break;
        a = b;
    }
    const double share =
        b->value > a->value && value > a->value ? (value - a->value) / (b->value - a->value) : 0;
    const double opacity = a->opacity + share * (b->opacity - a->opacity);
    material result = {.extinction = -log(1 - fmin(opacity, 0.9999)) / scene->opacity_length};
    const double from = a->has_emission ? a->emission : -log(1 - a->opacity);
    const double to = b->has_emission ? b->emission : -log(1 - b->opacity);
    result.emission = a->has_emission || b->has_emission
                          ? (from + share * (to - from)) / scene->opacity_length
                          : result.extinction;
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
        result.reflectance.value[k] =
            scene->reflectances[a->material].value[k] +
            share * (scene->reflectances[b->material].value[k] - scene->reflectances[a->material].value[k]);
    return result;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Spectrum that leaves a sample for unit light: ρ · (ambient + diffuse) and the white highlight of what absorbs. */
static mtm_spectrum shade(const reference_scene *scene, const double voxel[3], const double direction[3],
                          const material *sample) {
    const mtm_shading *shading = &scene->options.shading;
    double normal[3];
    double material_factor = shading->ambient;
    double white_factor = 0;
    gradient(scene->volume, voxel, normal);
    const double length = sqrt(dot(normal, normal));
    double smallest = 0;
    double largest = 0;
    mtm_volume_range(scene->volume, &smallest, &largest);
    const double strength =
        length * mtm_grid_smallest_spacing(mtm_volume_grid(scene->volume)) / (largest - smallest);
    const double t = clamp(strength / shading->gradient_threshold - 1, 0, 1);
    if (t > 0) {
        const double view[3] = {-direction[0], -direction[1], -direction[2]};
        double light[3] = {view[0], view[1], view[2]};
        const double light_length = sqrt(dot(shading->direction, shading->direction));
        for (int i = 0; i < 3 && !shading->is_headlight; i++) light[i] = shading->direction[i] / light_length;
        const double sign = dot(normal, view) < 0 ? -1 : 1;
        double middle[3];
        for (int i = 0; i < 3; i++) {
            normal[i] *= sign / length;
            middle[i] = light[i] + view[i];
        }
        const double fade = t * t * (3 - 2 * t);
        const double facing = dot(normal, light);
        material_factor += fade * shading->diffuse * fmax(facing, 0);
        if (facing > 0)
            white_factor = fade * shading->specular *
                           pow(fmax(dot(normal, middle) / sqrt(dot(middle, middle)), 0), shading->shininess);
    }
    const double matter = sample->emission > 0 ? fmin(sample->extinction / sample->emission, 1) : 0;
    mtm_spectrum spectrum;
    for (int k = 0; k < MTM_SPECTRUM_SAMPLES; k++)
        spectrum.value[k] = material_factor * sample->reflectance.value[k] + white_factor * matter;
    return spectrum;
}

/* Distances at which the ray is in the volume's box. */
static bool find_span(const mtm_grid *grid, const double origin[3], const double direction[3],
                      double span[2]) {
    double from[3];
    double to[3];
    const double ahead[3] = {origin[0] + direction[0], origin[1] + direction[1], origin[2] + direction[2]};
    mtm_grid_to_voxel(grid, origin, from);
    mtm_grid_to_voxel(grid, ahead, to);
    span[0] = 0;
    span[1] = 1e9;
    for (int axis = 0; axis < 3; axis++) {
        const double slope = to[axis] - from[axis];
        const double a = (0 - from[axis]) / slope;
        const double b = (grid->size[axis] - 1 - from[axis]) / slope;
        span[0] = fmax(span[0], fmin(a, b));
        span[1] = fmin(span[1], fmax(a, b));
    }
    return span[0] < span[1];
}

/* Linear sRGB and alpha of a pixel, every sample lit on its own. */
static void light_pixel(const reference_scene *scene, int x, int y, double rgba[4]) {
    const mtm_grid *grid = mtm_volume_grid(scene->volume);
    const mtm_view view = mtm_camera_view(&scene->camera, grid);
    const double step = scene->options.step * mtm_grid_smallest_spacing(grid);
    double origin[3];
    double direction[3];
    double span[2];
    double transmittance = 1;
    memset(rgba, 0, 4 * sizeof *rgba);
    mtm_view_ray(&view, WIDTH, HEIGHT, x + 0.5, y + 0.5, origin, direction);
    if (!find_span(grid, origin, direction, span)) return;
    for (int k = 0; span[0] + k * step < span[1]; k++) {
        const double distance = span[0] + (k + 0.5) * step;
        const double length = fmin(step, span[1] - span[0] - k * step);
        double voxel[3];
        const double world[3] = {origin[0] + distance * direction[0], origin[1] + distance * direction[1],
                                 origin[2] + distance * direction[2]};
        mtm_grid_to_voxel(grid, world, voxel);
        const material sample = classify(scene, interpolate(scene->volume, voxel));
        const double passed = exp(-sample.extinction * length);
        const double gathered = sample.extinction > 0 ? sample.emission * (1 - passed) / sample.extinction
                                                      : sample.emission * length;
        const mtm_spectrum spectrum = shade(scene, voxel, direction, &sample);
        const mtm_rgb color = mtm_illuminate(&scene->illumination, &spectrum);
        rgba[0] += transmittance * gathered * color.r;
        rgba[1] += transmittance * gathered * color.g;
        rgba[2] += transmittance * gathered * color.b;
        transmittance *= passed;
    }
    rgba[3] = 1 - transmittance;
}

/* A volume whose outermost voxels are invisible, because the reference's gradient is not that of the faces. */
static double padded_bumps(const double world[3]) {
    for (int axis = 0; axis < 3; axis++)
        if (world[axis] < 3 || world[axis] > 13) return 0;
    return bumps(world);
}

static const mtm_transfer_point points[] = {{0.05, 0, 0, false, 0},   {0.3, 0.2, 0, false, 1},
                                            {0.5, 0.05, 0, false, 1}, {0.5, 0.4, 0.3, true, 2},
                                            {0.8, 0, 0.7, true, 0},   {0.9, 0.9, 0, false, 2}};

/* Without jumps: there a sample that packets round to the other side of one is as wrong as the jump is high. */
static const mtm_transfer_point steady[] = {{0.05, 0, 0, false, 0},
                                            {0.3, 0.2, 0, false, 1},
                                            {0.5, 0.05, 0.1, true, 1},
                                            {0.8, 0, 0.7, true, 0},
                                            {0.9, 0.6, 0, false, 2}};

static reference_scene make_scene(fixture_way way, const mtm_volume *volume, const char *light) {
    reference_scene scene = {.volume = volume,
                             .point_count = fixture_is_plain(way) ? sizeof points / sizeof *points
                                                                  : sizeof steady / sizeof *steady,
                             .points = fixture_is_plain(way) ? points : steady,
                             .opacity_length = 3,
                             .camera = mtm_camera_defaults(),
                             .options = mtm_render_defaults(),
                             .illumination = fixture_illumination(light)};
    scene.options.width = WIDTH;
    scene.options.height = HEIGHT;
    scene.options.termination = 0;
    fixture_set_way(way, &scene.options);
    fixture_reflectances(scene.reflectances);
    return scene;
}

/* Packets classify with rows of a table: as many as there are levels of 16 bits, but few of floats. */
static double tolerance_of(fixture_way way) {
    return fixture_is_plain(way) ? 1e-5 : way == PACKED ? 1e-4 : 6e-3;
}

/* Renders once in a basis, then compares under a light with the sample-by-sample picture. */
static double largest_difference(const reference_scene *scene, const char *basis_name) {
    mtm_error error;
    double matrix[3 * MTM_DIMENSION_MAX];
    mtm_picture *picture = NULL;
    mtm_relight_options plain = mtm_relight_defaults();
    plain.has_background = false;
    mtm_basis *basis = fixture_basis(basis_name, &scene->illumination);
    mtm_image *image = fixture_render(scene->volume, scene->point_count, scene->points, scene->opacity_length,
                                      basis, &scene->camera, &scene->options);
    assert_ok(mtm_basis_matrix(basis, &scene->illumination, matrix, &error), error);
    assert_ok(mtm_relight(image, matrix, &plain, &picture, &error), error);
    double largest = 0;
    double brightest = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            double expected[4];
            light_pixel(scene, x, y, expected);
            for (int i = 0; i < 4; i++) {
                const double found = picture->rgba[(y * WIDTH + x) * 4 + i];
                largest = fmax(largest, fabs(found - expected[i]));
                brightest = fmax(brightest, expected[i]);
            }
        }
    }
    assert_true(brightest > 0.3);
    mtm_picture_destroy(picture);
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    return largest;
}

static void postillumination_is_lighting_every_sample(void **state) {
    const fixture_way way = fixture_way_of(state);
    static const char *const bases[] = {"materials", "wavelengths", "rgb"};
    static const char *const lights[] = {"D65", "A", "FL11"};
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *volume = fixture_volume_for(way, &grid, padded_bumps);
    for (int light = 0; light < 3; light++) {
        for (int basis = 0; basis < 3; basis++) {
            reference_scene scene = make_scene(way, volume, lights[light]);
            assert_near(largest_difference(&scene, bases[basis]), 0, tolerance_of(way));
        }
    }
    mtm_volume_destroy(volume);
}

static void a_light_from_the_side_and_a_sheared_grid_agree_too(void **state) {
    const fixture_way way = fixture_way_of(state);
    mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *straight = fixture_volume_for(way, &grid, padded_bumps);
    memcpy(grid.axes, (const double[3][3]){{1, 0.3, 0}, {-0.2, 0.8, 0.1}, {0, 0.4, -1.5}}, sizeof grid.axes);
    memcpy(grid.origin, (const double[3]){5, -3, 40}, sizeof grid.origin);
    mtm_error error;
    mtm_volume *sheared = NULL;
    assert_ok(mtm_volume_create(&grid, mtm_volume_type(straight), mtm_volume_voxels(straight),
                                mtm_volume_slope(straight), 0, &sheared, &error),
              error);
    reference_scene scene = make_scene(way, sheared, "FL11");
    scene.options.shading.is_headlight = false;
    memcpy(scene.options.shading.direction, (const double[3]){2, 1, 0.5},
           sizeof scene.options.shading.direction);
    scene.camera.up[0] = 1;
    scene.options.step = 0.7;
    assert_near(largest_difference(&scene, "materials"), 0, tolerance_of(way));
    mtm_volume_destroy(sheared);
    mtm_volume_destroy(straight);
}

/* The X-ray material is the paper's: it scatters and does not absorb. */
static void a_black_xray_material_disappears_and_a_black_absorber_does_not(void **state) {
    const fixture_way way = fixture_way_of(state);
    const mtm_grid grid = mtm_grid_defaults(17, 17, 17);
    mtm_volume *volume = fixture_volume_for(way, &grid, padded_bumps);
    const mtm_transfer_point without[] = {
        {0.1, 0, 0, false, 0}, {0.6, 0, 0, false, 0}, {0.9, 0.5, 0, false, 1}};
    mtm_transfer_point with[] = {{0.1, 0, 0.2, true, 2},
                                 {0.5, 0, 0.2, true, 2},
                                 {0.5, 0, 0, false, 0},
                                 {0.6, 0, 0, false, 0},
                                 {0.9, 0.5, 0, false, 1}};
    const mtm_camera camera = mtm_camera_defaults();
    mtm_render_options options = mtm_render_defaults();
    fixture_set_way(way, &options);
    options.width = options.height = 32;
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    fixture_reflectances(reflectances);
    reflectances[2] = mtm_spectrum_constant(0); /* made black */
    const mtm_illumination light = fixture_illumination("D65");
    mtm_error error;
    mtm_basis *basis = NULL;
    double matrix[3 * MTM_DIMENSION_MAX];
    assert_ok(mtm_basis_create("materials", FIXTURE_MATERIALS, reflectances, NULL, &basis, &error), error);
    assert_ok(mtm_basis_matrix(basis, &light, matrix, &error), error);
    mtm_picture *pictures[3];
    for (int i = 0; i < 3; i++) {
        if (i == 2) with[0].opacity = with[1].opacity = 0.2;
        mtm_image *image = i == 0 ? fixture_render(volume, 3, without, 2, basis, &camera, &options)
                                  : fixture_render(volume, 5, with, 2, basis, &camera, &options);
        const mtm_relight_options plain = mtm_relight_defaults();
        assert_ok(mtm_relight(image, matrix, &plain, &pictures[i], &error), error);
        mtm_image_destroy(image);
    }
    double black_xray = 0;
    double black_absorber = 0;
    for (int n = 0; n < 32 * 32 * 4; n++) {
        black_xray = fmax(black_xray, fabs((double)pictures[1]->rgba[n] - pictures[0]->rgba[n]));
        black_absorber = fmax(black_absorber, fabs((double)pictures[2]->rgba[n] - pictures[0]->rgba[n]));
    }
    assert_near(black_xray, 0, fixture_is_plain(way) ? 1e-6 : 1e-5); /* sums are rounded in other steps */
    assert_true(black_absorber > 0.05);
    for (int i = 0; i < 3; i++) mtm_picture_destroy(pictures[i]);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

static double half(const double world[3]) {
    (void)world;
    return 0.5;
}

static void a_background_material_shows_through_a_slab_under_every_light(void **state) {
    const fixture_way way = fixture_way_of(state);
    static const char *const lights[] = {"D65", "A", "FL11", "LED-B1"};
    const mtm_grid grid = mtm_grid_defaults(5, 5, 21);
    const mtm_transfer_point absorbing[] = {{0, 0.1, 0, true, 0}}; /* absorbs and scatters nothing */
    mtm_volume *volume = fixture_volume_for(way, &grid, half);
    mtm_basis *basis = fixture_basis("wavelengths", NULL);
    mtm_spectrum reflectances[FIXTURE_MATERIALS];
    fixture_reflectances(reflectances);
    const mtm_camera camera = fixture_front_camera(3);
    mtm_render_options options = fixture_plain_options();
    fixture_set_way(way, &options);
    mtm_image *image = fixture_render(volume, 1, absorbing, 2.5, basis, &camera, &options);
    float card[MTM_DIMENSION_MAX];
    mtm_basis_encode_material(basis, 1, card);
    mtm_image_put_background(image, card);
    for (int i = 0; i < 4; i++) {
        mtm_error error;
        double matrix[3 * MTM_DIMENSION_MAX];
        mtm_picture *picture = NULL;
        const mtm_relight_options plain = mtm_relight_defaults();
        const mtm_illumination light = fixture_illumination(lights[i]);
        const mtm_rgb color = mtm_illuminate(&light, &reflectances[1]);
        const double transmittance = pow(0.9, 20 / 2.5);
        assert_ok(mtm_basis_matrix(basis, &light, matrix, &error), error);
        assert_ok(mtm_relight(image, matrix, &plain, &picture, &error), error);
        const float *pixel = picture->rgba + ((size_t)4 * 9 + 4) * 4;
        assert_near(pixel[0], transmittance * color.r, 1e-5);
        assert_near(pixel[1], transmittance * color.g, 1e-5);
        assert_near(pixel[2], transmittance * color.b, 1e-5);
        assert_near(pixel[3], 1, 0);
        mtm_picture_destroy(picture);
    }
    mtm_image_destroy(image);
    mtm_basis_destroy(basis);
    mtm_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        FIXTURE_WAY(postillumination_is_lighting_every_sample, PLAIN),
        FIXTURE_WAY(postillumination_is_lighting_every_sample, NATIVE),
        FIXTURE_WAY(postillumination_is_lighting_every_sample, PACKED),
        FIXTURE_WAY(a_light_from_the_side_and_a_sheared_grid_agree_too, PLAIN),
        FIXTURE_WAY(a_light_from_the_side_and_a_sheared_grid_agree_too, NATIVE),
        FIXTURE_WAY(a_light_from_the_side_and_a_sheared_grid_agree_too, PACKED),
        FIXTURE_WAYS(a_black_xray_material_disappears_and_a_black_absorber_does_not),
        FIXTURE_WAYS(a_background_material_shows_through_a_slab_under_every_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
