/* SPDX-License-Identifier: BSD-3-Clause
 * Frames: a volume under a transfer function from the views of an orbit, projected in some basis and lit. */
#include "bench_frame.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bench_points points_of(const char *transfer) {
    static const bench_points smoke = {6,
                                       {{.value = 0, .opacity = 0, .material = 0},
                                        {.value = 80, .opacity = 0, .material = 0},
                                        {.value = 110, .opacity = 0.02, .material = 0},
                                        {.value = 180, .opacity = 0.05, .material = 1},
                                        {.value = 200, .opacity = 0.6, .material = 2},
                                        {.value = 255, .opacity = 0.9, .material = 2}}};
    static const bench_points solid = {4,
                                       {{.value = 0, .opacity = 0, .material = 0},
                                        {.value = 80, .opacity = 0, .material = 0},
                                        {.value = 110, .opacity = 0.6, .material = 1},
                                        {.value = 255, .opacity = 0.95, .material = 2}}};
    return strcmp(transfer, "solid") == 0 ? solid : smoke;
}

static mtm_status describe_daylight(mtm_illumination *illumination, mtm_error *error) {
    mtm_observer observer;
    mtm_spectrum daylight;
    mtm_spectrum light;
    mtm_status status = mtm_observer_get("cie1931", &observer, error);
    if (status == MTM_OK) status = mtm_illuminant("D65", &daylight, error);
    if (status == MTM_OK) status = mtm_light_normalize(&daylight, &observer, &light, error);
    if (status == MTM_OK) *illumination = mtm_illumination_of(&light, &observer, 0);
    return status;
}

mtm_status describe_subject(const mtm_volume *volume, const bench_points *points, int thread_count,
                            bench_subject *subject, mtm_error *error) {
    const int *size = mtm_volume_grid(volume)->size;
    const int longest = size[0] > size[1] ? size[0] : size[1];
    *subject = (bench_subject){.point_count = points->count,
                               .points = points->points,
                               .opacity_length = 1,
                               .camera = mtm_camera_defaults(),
                               .options = mtm_render_defaults()};
    subject->camera.azimuth = 15;
    subject->camera.elevation = 20;
    subject->camera.distance = 1.75 * (longest > size[2] ? longest : size[2]);
    subject->camera.fov = 30;
    subject->options.width = 512;
    subject->options.height = 512;
    subject->options.step = 1;
    subject->options.termination = 0.01;
    subject->options.shading.ambient = 0.3;
    subject->options.shading.diffuse = 0.6;
    subject->options.shading.specular = 0.3;
    subject->options.shading.shininess = 20;
    subject->options.shading.is_headlight = true;
    subject->options.thread_count = thread_count;
    return describe_daylight(&subject->illumination, error);
}

mtm_status prepare_subject(const mtm_volume *volume, int run_count, bench_subject *subject,
                           mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int run = 0; run < run_count && status == MTM_OK; run++) {
        release_subject(subject);
        const double begin = now_ms();
        status = mtm_projector_create("raycast", volume, &subject->options, NULL, &subject->projector, error);
        add_time(&subject->prepare, now_ms() - begin);
    }
    return status;
}

void release_subject(bench_subject *subject) {
    mtm_projector_destroy(subject->projector);
    subject->projector = NULL;
}

void make_reflectances(int count, mtm_spectrum *reflectances) {
    static const double first_nm = 430;
    static const double last_nm = 650;
    static const double width_nm = 50;
    for (int material = 0; material < count; material++) {
        const double peak_nm = first_nm + (last_nm - first_nm) * material / (count > 1 ? count - 1 : 1);
        for (int i = 0; i < MTM_SPECTRUM_SAMPLES; i++) {
            const double wavelength_nm = MTM_WAVELENGTH_FIRST_NM + i * MTM_WAVELENGTH_STEP_NM;
            const double widths = (wavelength_nm - peak_nm) / width_nm;
            reflectances[material].value[i] = 0.1 + 0.8 * exp(-0.5 * widths * widths);
        }
    }
}

mtm_status create_frame(bench_subject *subject, const char *basis, int material_count,
                        const mtm_spectrum *reflectances, int width, int height, bench_frame *frame,
                        mtm_error *error) {
    *frame = (bench_frame){.subject = subject, .options = subject->options, .isa = mtm_isa_name()};
    frame->options.width = width;
    frame->options.height = height;
    mtm_status status =
        mtm_basis_create(basis, material_count, reflectances, &subject->illumination, &frame->basis, error);
    if (status != MTM_OK) return status;
    const int dimension = mtm_basis_dimension(frame->basis);
    status = mtm_basis_matrix(frame->basis, &subject->illumination, frame->matrix, error);
    if (status == MTM_OK)
        status = mtm_image_create(width, height, dimension, mtm_basis_name(frame->basis), NULL, NULL,
                                  &frame->image, error);
    frame->rgba = calloc((size_t)width * (size_t)height, 4);
    if (status == MTM_OK && frame->rgba == NULL) {
        (void)snprintf(error->message, sizeof error->message, "out of memory for a picture");
        status = MTM_MEMORY;
    }
    return status;
}

void release_frame(bench_frame *frame) {
    mtm_transfer_destroy(frame->transfer);
    mtm_basis_destroy(frame->basis);
    mtm_image_destroy(frame->image);
    free(frame->rgba);
    *frame = (bench_frame){.subject = NULL};
}

mtm_camera view_of(const bench_subject *subject, int view) {
    mtm_camera camera = subject->camera;
    camera.azimuth += 360.0 * (view % BENCH_VIEWS) / BENCH_VIEWS;
    return camera;
}

mtm_status classify_frame(bench_frame *frame, mtm_error *error) {
    const bench_subject *subject = frame->subject;
    mtm_transfer *transfer = NULL;
    mtm_status status = mtm_transfer_create(subject->point_count, subject->points, subject->opacity_length,
                                            frame->basis, &transfer, error);
    if (status != MTM_OK) return status;
    status = mtm_projector_set_transfer(subject->projector, transfer, error);
    mtm_transfer_destroy(frame->transfer); /* which no projector uses any more */
    frame->transfer = transfer;
    return status;
}

static double fill_of(const mtm_image *image) {
    const size_t pixel_count = (size_t)image->width * (size_t)image->height;
    size_t filled = 0;
    for (size_t i = 0; i < pixel_count; i++) {
        const float *pixel = image->pixels + i * (size_t)image->lanes;
        bool is_filled = false;
        for (int lane = 0; lane < image->lanes && !is_filled; lane++) is_filled = pixel[lane] != 0;
        filled += is_filled;
    }
    return (double)filled / (double)pixel_count;
}

static mtm_status time_frame(bench_frame *frame, int view, bool is_kept, mtm_error *error) {
    const mtm_camera camera = view_of(frame->subject, view);
    mtm_relight_options relight = mtm_relight_defaults();
    relight.thread_count = frame->options.thread_count;
    choose_isa(frame->isa);
    const double begin = now_ms();
    mtm_status status = classify_frame(frame, error);
    const double classified = now_ms();
    if (status == MTM_OK)
        status = mtm_projector_render(frame->subject->projector, &camera, &frame->options, NULL, frame->image,
                                      error);
    const double projected = now_ms();
    if (status != MTM_OK) return status;
    mtm_relight_bytes(frame->image, frame->matrix, &relight, frame->rgba);
    const double first_relit = now_ms(); /* whoever turns a light sees one picture many times */
    mtm_relight_bytes(frame->image, frame->matrix, &relight, frame->rgba);
    const double relit = now_ms();
    if (!is_kept) return MTM_OK;
    add_time(&frame->classify, classified - begin);
    add_time(&frame->project, projected - classified);
    add_time(&frame->change, projected - begin);
    add_time(&frame->relight, relit - first_relit);
    frame->fill += (fill_of(frame->image) - frame->fill) / frame->project.count;
    return MTM_OK;
}

mtm_status time_frames(int count, bench_frame *frames, int run_count, const mtm_progress *progress,
                       mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int run = -1; run < run_count; run++)
        for (int turn = 0; turn < count && status == MTM_OK; turn++) {
            const double done = (double)(run + 1) / (run_count + 1);
            if (progress->report != NULL) (void)progress->report(progress->user, done);
            const int view = run < 0 ? 0 : run;
            status = time_frame(&frames[(view + turn) % count], view, run >= 0, error);
        }
    return status;
}

void choose_isa(const char *name) {
    (void)setenv("METAMER_ISA", name, 1);
}
