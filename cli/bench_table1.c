/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench --suite table1: Table 1 of S. Bergner, T. Möller, M. Tory, M. S. Drew, "A Practical Approach to Spectral
 * Volume Rendering" (IEEE TVCG 11(2), 2005) with the scenes of examples/. The paper's frames per second (2.4 GHz Pentium
 * 4, GeForce 4, other cameras and transfer functions) stand beside the times; only ratios compare. */
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "bench_check.h"

static const char *const columns[] = {"volume",
                                      "fill",
                                      "spectral_raycast_ms",
                                      "rgb_raycast_ms",
                                      "postilluminate_ms",
                                      "transfer_change_ms",
                                      "classify_ms",
                                      "spectral_per_rgb",
                                      "relight_per_project",
                                      "relight_per_transfer_change",
                                      "relight_per_classify",
                                      "spectral_splat_ms",
                                      "rgb_splat_ms",
                                      "splat_relight_ms",
                                      "fourier_prepare_ms",
                                      "fourier_ms",
                                      "fourier_relight_ms",
                                      "rgb_fourier_ms",
                                      "paper_fill",
                                      "paper_spectral_raycast_fps",
                                      "paper_postilluminate_fps",
                                      "paper_rgb_raycast_fps",
                                      "paper_spectral_splat_fps",
                                      "paper_rgb_splat_fps",
                                      "paper_fourier_fps",
                                      "paper_fourier_relight_fps",
                                      "paper_fourier_prepare_s",
                                      NULL};

/* A row as the paper prints it, for the columns named below. */
enum { PAPER_COLUMNS = 9 };
typedef struct paper_row {
    const char *volume;
    int column_count; /* the rest is not available */
    double values[PAPER_COLUMNS];
} paper_row;

static const char *const paper_columns[PAPER_COLUMNS] = {"paper_fill",
                                                         "paper_spectral_raycast_fps",
                                                         "paper_postilluminate_fps",
                                                         "paper_rgb_raycast_fps",
                                                         "paper_spectral_splat_fps",
                                                         "paper_rgb_splat_fps",
                                                         "paper_fourier_fps",
                                                         "paper_fourier_relight_fps",
                                                         "paper_fourier_prepare_s"};

static const paper_row paper[] = {
    {"hipiph", 9, {0.97, 0.22, 9.2, 0.24, 18.5, 22.2, 50, 166, 1}},
    {"tomato", 9, {0.72, 0.15, 11.6, 0.17, 0.78, 1.7, 5.8, 34.5, 85}},
    {"uncbrain", 9, {0.62, 0.15, 13.3, 0.17, 0.3, 0.4, 15.8, 30.3, 85}},
    {"engine", 9, {0.79, 0.13, 10.7, 0.15, 0.5, 0.6, 8.7, 47.6, 85}},
    {"frog", 6, {0.69, 0.08, 12.0, 0.09, 0.31, 0.38}},
};
enum { PAPER_ROWS = sizeof paper / sizeof *paper };

/* What takes turns. */
enum { SPECTRAL, RGB, VARIANTS };

static mtm_status create_variants(const mtm_palette *palette, bench_subject *subject,
                                  bench_frame frames[VARIANTS], mtm_error *error) {
    static const char *const bases[VARIANTS] = {"factors:7", "rgb"};
    mtm_spectrum *reflectances = calloc((size_t)palette->material_count + 1, sizeof *reflectances);
    mtm_status status = reflectances == NULL ? MTM_MEMORY : MTM_OK;
    if (status == MTM_MEMORY)
        (void)snprintf(error->message, sizeof error->message, "out of memory for reflectances");
    for (int i = 0; i < palette->material_count && status == MTM_OK; i++)
        reflectances[i] = palette->materials[i].reflectance;
    for (int i = 0; i < VARIANTS && status == MTM_OK; i++)
        status = create_frame(subject, bases[i], palette->material_count, reflectances, BENCH_PICTURE_EDGE,
                              BENCH_PICTURE_EDGE, &frames[i], error);
    free(reflectances);
    return status;
}

static bench_subject subject_of(const mtm_scene *scene, const mtm_volume *volume, int thread_count) {
    bench_subject subject = {.point_count = scene->point_count,
                             .points = scene->points,
                             .opacity_length = scene->opacity_length,
                             .camera = scene->camera,
                             .options = scene->render,
                             .illumination = mtm_scene_illumination(scene)};
    if (subject.opacity_length == 0)
        subject.opacity_length = mtm_grid_smallest_spacing(mtm_volume_grid(volume));
    subject.options.width = BENCH_PICTURE_EDGE;
    subject.options.height = BENCH_PICTURE_EDGE;
    subject.options.thread_count = thread_count;
    return subject;
}

static void fill_row(const bench_frame frames[VARIANTS], json_t *row) {
    const bench_frame *spectral = &frames[SPECTRAL];
    set_number(row, "fill", spectral->fill);
    set_times(row, "spectral_raycast_ms", &spectral->project);
    set_times(row, "rgb_raycast_ms", &frames[RGB].project);
    set_times(row, "postilluminate_ms", &spectral->relight);
    set_times(row, "transfer_change_ms", &spectral->change);
    set_times(row, "classify_ms", &spectral->classify);
    set_ratio(row, "spectral_per_rgb", &spectral->project, &frames[RGB].project);
    set_ratio(row, "relight_per_project", &spectral->relight, &spectral->project);
    set_ratio(row, "relight_per_transfer_change", &spectral->relight, &spectral->change);
    set_ratio(row, "relight_per_classify", &spectral->relight, &spectral->classify);
}

static mtm_status time_scene(const bench_settings *settings, const char *name, const mtm_scene *scene,
                             const mtm_volume *volume, json_t *row, mtm_error *error) {
    bench_frame frames[VARIANTS] = {{.subject = NULL}};
    bench_subject subject = subject_of(scene, volume, settings->thread_count);
    mtm_status status = prepare_subject(volume, 1, &subject, error);
    if (status == MTM_OK) status = create_variants(&scene->palette, &subject, frames, error);
    if (status == MTM_OK) status = check_frames(name, VARIANTS, frames, error);
    if (status == MTM_OK) {
        const mtm_progress progress = start_progress(settings->bar, name);
        status = time_frames(VARIANTS, frames, settings->run_count, &progress, error);
        end_progress(settings->bar);
    }
    if (status == MTM_OK) fill_row(frames, row);
    release_subject(&subject);
    for (int i = 0; i < VARIANTS; i++) release_frame(&frames[i]);
    return status;
}

/* The scene with its volume; both NULL, and a note on standard error, where either cannot be had. */
static void open_example(const char *name, mtm_scene **scene, mtm_volume **volume) {
    char path[128];
    mtm_error error = {""};
    (void)snprintf(path, sizeof path, "examples/%s/%s.json", name, name);
    mtm_status status = mtm_scene_read(path, scene, &error);
    if (status == MTM_OK) status = mtm_scene_load_volume(*scene, NULL, volume, &error);
    if (status == MTM_OK) return;
    (void)fprintf(stderr, "metamer bench: note: the row %s stays without times: ", name);
    print_plainly(stderr, error.message);
    (void)fprintf(stderr, "\n");
    mtm_scene_destroy(*scene);
    *scene = NULL;
}

static mtm_status run_row(const bench_settings *settings, const paper_row *printed, bench_rows *rows,
                          mtm_error *error) {
    mtm_scene *scene = NULL;
    mtm_volume *volume = NULL;
    mtm_status status = MTM_OK;
    json_t *row = add_row(rows);
    set_text(row, "volume", printed->volume);
    for (int i = 0; i < printed->column_count; i++) set_number(row, paper_columns[i], printed->values[i]);
    open_example(printed->volume, &scene, &volume);
    if (scene != NULL) status = time_scene(settings, printed->volume, scene, volume, row, error);
    mtm_volume_destroy(volume);
    mtm_scene_destroy(scene);
    return status;
}

static mtm_status run(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < PAPER_ROWS && status == MTM_OK; i++)
        if (is_row_wanted(settings, paper[i].volume)) status = run_row(settings, &paper[i], rows, error);
    return status;
}

const bench_suite table1_suite = {.name = "table1", .columns = columns, .run = run};
