/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench --suite ablation: what each device of the raycaster is worth. Each row leaves one out; its time stands
 * beside how far the picture is from the plain renderer's, one ray at a time and never ended early, at the same step. */
#include <stdio.h>
#include <string.h>

#include "bench.h"
#include "bench_check.h"
#include "bench_volume.h"

static const char *const columns[] = {
    "frame",       "device",  "isa", "spectral_raycast_ms", "per_everything", "prepare_ms",
    "classify_ms", "psnr_db", NULL};

/* What differs from everything. */
typedef struct ablation {
    const char *name;
    int without;                                        /* of MTM_WITHOUT_… */
    const char *isa;                                    /* NULL: the one that is chosen */
    bool is_never_ended, is_classified_last, is_native; /* no termination, pre-integration, derived layout */
} ablation;

static const ablation devices[] = {
    {.name = "everything"},
    {.name = "without packets", .without = MTM_WITHOUT_PACKETS},
    {.name = "without skipping", .without = MTM_WITHOUT_SKIPPING},
    {.name = "without prefetch", .without = MTM_WITHOUT_PREFETCH},
    {.name = "without termination", .is_never_ended = true},
    {.name = "without pre-integration", .is_classified_last = true},
    {.name = "without derived layout", .is_native = true},
    {.name = "with x86-64-v3", .isa = "x86-64-v3"},
    {.name = "with baseline", .isa = "baseline"},
};
enum { EVERYTHING, DEVICES = sizeof devices / sizeof *devices, NAME_BYTES = 64 };

typedef struct named_volume {
    const char *frame, *file;
} named_volume;

static const named_volume named_volumes[] = {{"engine smoke", "engine.nrrd"},
                                             {"bonsai smoke", "bonsai.nrrd"}};
enum { NAMED_VOLUMES = sizeof named_volumes / sizeof *named_volumes };

/* The devices of a frame that take turns, on one prepared volume but for the native voxels, which are another. */
typedef struct ablation_race {
    const char *frame;
    bench_points points;
    int count;
    const ablation *devices[DEVICES];
    bench_subject derived, native;
    bench_frame frames[DEVICES];
    double psnr_db[DEVICES];
} ablation_race;

/* Whether this machine can run with it, and it is not what runs anyway. */
static bool is_another_isa(const char *isa) {
    const char *chosen = mtm_isa_name();
    choose_isa(isa);
    const bool is_another = strcmp(mtm_isa_name(), isa) == 0 && strcmp(isa, chosen) != 0;
    choose_isa(chosen);
    return is_another;
}

static void list_devices(const bench_settings *settings, ablation_race *race) {
    for (int i = 0; i < DEVICES; i++) {
        char name[NAME_BYTES];
        (void)snprintf(name, sizeof name, "%s %s", race->frame, devices[i].name);
        const bool is_possible = devices[i].isa == NULL || is_another_isa(devices[i].isa);
        if (is_possible && is_row_wanted(settings, name)) race->devices[race->count++] = &devices[i];
    }
}

static mtm_status prepare_both(const bench_settings *settings, const mtm_volume *volume, ablation_race *race,
                               mtm_error *error) {
    mtm_status status =
        describe_subject(volume, &race->points, settings->thread_count, &race->derived, error);
    race->native = race->derived;
    race->native.options.memory_bytes = 1; /* in which no layout fits */
    if (status == MTM_OK) status = prepare_subject(volume, settings->run_count, &race->derived, error);
    if (status == MTM_OK) status = prepare_subject(volume, settings->run_count, &race->native, error);
    return status;
}

static mtm_status create_device(const ablation *device, bench_subject *subject, bench_frame *frame,
                                mtm_error *error) {
    mtm_spectrum reflectances[3];
    make_reflectances(3, reflectances);
    const mtm_status status = create_frame(subject, "factors:7", 3, reflectances, BENCH_PICTURE_EDGE,
                                           BENCH_PICTURE_EDGE, frame, error);
    frame->options.without = device->without;
    if (device->is_never_ended) frame->options.termination = 0;
    if (device->is_classified_last) frame->options.is_preintegrated = false;
    if (device->isa != NULL) frame->isa = device->isa;
    return status;
}

static mtm_status set_up_race(const bench_settings *settings, const mtm_volume *volume, ablation_race *race,
                              mtm_error *error) {
    mtm_status status = prepare_both(settings, volume, race, error);
    for (int i = 0; i < race->count && status == MTM_OK; i++) {
        const ablation *device = race->devices[i];
        status = create_device(device, device->is_native ? &race->native : &race->derived, &race->frames[i],
                               error);
    }
    return status;
}

/* How far the first view is from the plain renderer's without an end of rays, with each device. */
static mtm_status compare_devices(ablation_race *race, mtm_error *error) {
    mtm_picture *reference = NULL;
    mtm_render_options plain = plain_options(&race->derived.options);
    plain.width = plain.height = BENCH_PICTURE_EDGE;
    plain.termination = 0;
    mtm_status status = render_first_view(&race->frames[0], &plain, &reference, error);
    for (int i = 0; i < race->count && status == MTM_OK; i++) {
        mtm_picture *picture = NULL;
        mtm_comparison comparison = {0};
        status = render_first_view(&race->frames[i], &race->frames[i].options, &picture, error);
        if (status == MTM_OK) status = mtm_picture_compare(picture, reference, &comparison, error);
        race->psnr_db[i] = comparison.psnr_db;
        mtm_picture_destroy(picture);
    }
    mtm_picture_destroy(reference);
    return status;
}

static void add_device_row(const ablation_race *race, int index, bench_rows *rows) {
    const bench_frame *frame = &race->frames[index];
    json_t *row = add_row(rows);
    set_text(row, "frame", race->frame);
    set_text(row, "device", race->devices[index]->name);
    if (frame->project.count == 0) return;
    set_text(row, "isa", frame->isa);
    set_times(row, "spectral_raycast_ms", &frame->project);
    if (race->devices[0] == &devices[EVERYTHING])
        set_ratio(row, "per_everything", &frame->project, &race->frames[0].project);
    set_times(row, "prepare_ms", &frame->subject->prepare);
    set_times(row, "classify_ms", &frame->classify);
    set_number(row, "psnr_db", race->psnr_db[index]);
}

static mtm_status time_race(const bench_settings *settings, const mtm_volume *volume, ablation_race *race,
                            mtm_error *error) {
    mtm_status status = set_up_race(settings, volume, race, error);
    if (status == MTM_OK) status = check_frames(race->frame, race->count, race->frames, error);
    if (status == MTM_OK) status = compare_devices(race, error);
    if (status == MTM_OK) {
        const mtm_progress progress = start_progress(settings->bar, race->frame);
        status = time_frames(race->count, race->frames, settings->run_count, &progress, error);
        end_progress(settings->bar);
    }
    return status;
}

static mtm_status run_volume(const bench_settings *settings, const named_volume *named, bench_rows *rows,
                             mtm_error *error) {
    ablation_race race = {.frame = named->frame, .points = points_of("smoke")};
    mtm_volume *volume = NULL;
    list_devices(settings, &race);
    mtm_status status = race.count == 0 ? MTM_OK : find_volume(named->file, &volume, error);
    if (volume != NULL) status = time_race(settings, volume, &race, error);
    for (int i = 0; i < race.count && status == MTM_OK; i++) add_device_row(&race, i, rows);
    release_subject(&race.derived);
    release_subject(&race.native);
    for (int i = 0; i < race.count; i++) release_frame(&race.frames[i]);
    mtm_volume_destroy(volume);
    return status;
}

static mtm_status run(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    const char *chosen = mtm_isa_name();
    mtm_status status = MTM_OK;
    for (int i = 0; i < NAMED_VOLUMES && status == MTM_OK; i++)
        status = run_volume(settings, &named_volumes[i], rows, error);
    choose_isa(chosen);
    return status;
}

const bench_suite ablation_suite = {.name = "ablation", .columns = columns, .run = run};
