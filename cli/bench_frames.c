/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench --suite frames: common volumes under common transfer functions, before light in 8 and 16 lanes, as a
 * plain renderer of colors would, and relit. */
#include "bench.h"
#include "bench_check.h"
#include "bench_volume.h"

static const char *const columns[] = {"frame",
                                      "fill",
                                      "spectral_raycast_ms",
                                      "rgb_raycast_ms",
                                      "spectral15_raycast_ms",
                                      "postilluminate_ms",
                                      "spectral_per_rgb",
                                      "spectral15_per_rgb",
                                      "project_per_relight",
                                      "prepare_ms",
                                      "classify_ms",
                                      NULL};

typedef struct named_frame {
    const char *name, *file; /* NULL: made here */
    const char *transfer;
} named_frame;

static const named_frame named_frames[] = {
    {"engine smoke", "engine.nrrd", "smoke"}, {"engine solid", "engine.nrrd", "solid"},
    {"neghip", "neghip.nrrd", "smoke"},       {"uncbrain", "uncbrain.nrrd", "smoke"},
    {"bonsai", "bonsai.nrrd", "smoke"},       {"aneurism", "aneurism.nrrd", "smoke"},
    {"frog", "frog_gray.nrrd", "smoke"},      {"Marschner-Lobb", NULL, "smoke"},
};
enum { NAMED_FRAMES = sizeof named_frames / sizeof *named_frames, MARSCHNER_LOBB_EDGE = 256 };

/* What takes turns. */
enum { SPECTRAL, RGB, SPECTRAL15, VARIANTS };

static mtm_status create_variants(const bench_settings *settings, bench_subject *subject,
                                  bench_frame frames[VARIANTS], mtm_error *error) {
    static const char *const bases[VARIANTS] = {"factors:7", "rgb", "materials"};
    static const int material_counts[VARIANTS] = {3, 3, 14};
    mtm_status status = MTM_OK;
    for (int i = 0; i < VARIANTS && status == MTM_OK; i++) {
        mtm_spectrum reflectances[14];
        make_reflectances(material_counts[i], reflectances);
        status = create_frame(subject, bases[i], material_counts[i], reflectances, settings->width,
                              settings->height, &frames[i], error);
    }
    return status;
}

static void fill_row(const bench_subject *subject, const bench_frame frames[VARIANTS], json_t *row) {
    set_number(row, "fill", frames[SPECTRAL].fill);
    set_times(row, "spectral_raycast_ms", &frames[SPECTRAL].project);
    set_times(row, "rgb_raycast_ms", &frames[RGB].project);
    set_times(row, "spectral15_raycast_ms", &frames[SPECTRAL15].project);
    set_times(row, "postilluminate_ms", &frames[SPECTRAL].relight);
    set_ratio(row, "spectral_per_rgb", &frames[SPECTRAL].project, &frames[RGB].project);
    set_ratio(row, "spectral15_per_rgb", &frames[SPECTRAL15].project, &frames[RGB].project);
    set_ratio(row, "project_per_relight", &frames[SPECTRAL].project, &frames[SPECTRAL].relight);
    set_times(row, "prepare_ms", &subject->prepare);
    set_times(row, "classify_ms", &frames[SPECTRAL].classify);
}

static mtm_status time_volume(const bench_settings *settings, const named_frame *named,
                              const mtm_volume *volume, json_t *row, mtm_error *error) {
    const bench_points points = points_of(named->transfer);
    bench_frame frames[VARIANTS] = {{.subject = NULL}};
    bench_subject subject;
    mtm_status status = describe_subject(volume, &points, settings->thread_count, &subject, error);
    subject.options.is_preintegrated = !settings->is_post_classified;
    if (status == MTM_OK) status = prepare_subject(volume, settings->run_count, &subject, error);
    if (status == MTM_OK) status = create_variants(settings, &subject, frames, error);
    if (status == MTM_OK) status = check_frames(named->name, VARIANTS, frames, error);
    if (status == MTM_OK) {
        const mtm_progress progress = start_progress(settings->bar, named->name);
        status = time_frames(VARIANTS, frames, settings->run_count, &progress, error);
        end_progress(settings->bar);
    }
    if (status == MTM_OK) fill_row(&subject, frames, row);
    release_subject(&subject);
    for (int i = 0; i < VARIANTS; i++) release_frame(&frames[i]);
    return status;
}

static mtm_status run_frame(const bench_settings *settings, const named_frame *named, bench_rows *rows,
                            mtm_error *error) {
    mtm_volume *volume = NULL;
    json_t *row = add_row(rows);
    set_text(row, "frame", named->name);
    mtm_status status = named->file == NULL ? make_marschner_lobb(MARSCHNER_LOBB_EDGE, &volume, error)
                                            : find_volume(named->file, &volume, error);
    if (status == MTM_OK && volume != NULL) status = time_volume(settings, named, volume, row, error);
    mtm_volume_destroy(volume);
    return status;
}

static mtm_status run(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < NAMED_FRAMES && status == MTM_OK; i++)
        if (is_row_wanted(settings, named_frames[i].name))
            status = run_frame(settings, &named_frames[i], rows, error);
    return status;
}

const bench_suite frames_suite = {.name = "frames", .columns = columns, .run = run};
