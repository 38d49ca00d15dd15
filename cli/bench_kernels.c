/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench --suite kernels: relighting and raycasting with every instruction set of this machine and with one and two
 * threads. Relighting is also held against the triad, which takes its turn among the rest; where the image fits into
 * caches, it may be faster than the triad. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench.h"
#include "bench_check.h"
#include "bench_pixels.h"
#include "bench_triad.h"
#include "bench_volume.h"

enum { ISA_MAX = 3, NAME_BYTES = 96, VARIANTS_MAX = ISA_MAX * 2 * BENCH_TRIAD_THREADS_MAX };

static const char *const columns[] = {"kernel",
                                      "width",
                                      "height",
                                      "lanes",
                                      "format",
                                      "isa",
                                      "threads",
                                      "postilluminate_ms",
                                      "gigabytes_per_s",
                                      "triad_gigabytes_per_s",
                                      "share_of_triad",
                                      "spectral_raycast_ms",
                                      NULL};

typedef struct workload {
    int width, height, dimension;
} workload;

static const workload workloads[] = {
    {512, 512, 3},   {512, 512, 7},   {512, 512, 15},   {512, 512, 83},
    {3840, 2160, 3}, {3840, 2160, 7}, {3840, 2160, 15}, {3840, 2160, 83},
};
enum { WORKLOADS = sizeof workloads / sizeof *workloads };

/* The instruction sets of this machine, from the lowest. */
typedef struct isa_list {
    int count;
    const char *names[ISA_MAX];
} isa_list;

static isa_list list_isas(void) {
    static const char *const known[ISA_MAX] = {"baseline", "x86-64-v3", "x86-64-v4"};
    isa_list list = {.count = 0};
    for (int i = 0; i < ISA_MAX; i++) {
        choose_isa(known[i]);
        if (strcmp(mtm_isa_name(), known[i]) == 0) list.names[list.count++] = known[i];
    }
    return list;
}

static int highest_thread_count(const bench_settings *settings) {
    return settings->thread_count < BENCH_TRIAD_THREADS_MAX ? settings->thread_count
                                                            : BENCH_TRIAD_THREADS_MAX;
}

/* One way to relight a workload. */
typedef struct relight_variant {
    const char *isa;
    bool is_half;
    int thread_count;
    bench_times times;
} relight_variant;

typedef struct relight_race {
    const workload *work;
    double *triad_arrays;
    int variant_count;
    relight_variant variants[VARIANTS_MAX];
    bench_times triad[BENCH_TRIAD_THREADS_MAX]; /* [threads - 1] */
} relight_race;

static void name_variant(const workload *work, const relight_variant *variant, char name[NAME_BYTES]) {
    (void)snprintf(name, NAME_BYTES, "relight %dx%d %d lanes %s %s %d", work->width, work->height,
                   mtm_lanes(work->dimension), variant->is_half ? "half" : "float", variant->isa,
                   variant->thread_count);
}

static void list_variants(const bench_settings *settings, relight_race *race) {
    const isa_list isas = list_isas();
    race->variant_count = 0;
    for (int threads = 1; threads <= highest_thread_count(settings); threads++)
        for (int isa = 0; isa < isas.count; isa++)
            for (int is_half = 0; is_half < 2; is_half++) {
                char name[NAME_BYTES];
                const relight_variant variant = {isas.names[isa], is_half == 1, threads, {.count = 0}};
                name_variant(race->work, &variant, name);
                if (is_row_wanted(settings, name)) race->variants[race->variant_count++] = variant;
            }
}

static void time_race(const bench_settings *settings, bench_pixels *pixels, const mtm_progress *progress,
                      relight_race *race) {
    for (int run = -1; run < settings->run_count; run++) {
        (void)progress->report(progress->user, (run + 1.0) / (settings->run_count + 1));
        for (int threads = 1; threads <= highest_thread_count(settings); threads++) {
            const double ms = time_triad(race->triad_arrays, threads);
            if (run >= 0) add_time(&race->triad[threads - 1], ms);
        }
        for (int turn = 0; turn < race->variant_count; turn++) {
            relight_variant *variant = &race->variants[(run + 1 + turn) % race->variant_count];
            choose_isa(variant->isa);
            const double ms = time_pixels(pixels, variant->is_half, variant->thread_count);
            if (run >= 0) add_time(&variant->times, ms);
        }
    }
}

static double gigabytes_per_s(double bytes, const bench_times *times) {
    return 1e-6 * bytes / median_ms(times);
}

/* A variant without times leaves its row without times. */
static void add_relight_row(const relight_race *race, const relight_variant *variant, bench_rows *rows) {
    const workload *work = race->work;
    const int lanes = mtm_lanes(work->dimension);
    const double pixel_bytes = lanes * (variant->is_half ? 2.0 : 4.0) + 4;
    json_t *row = add_row(rows);
    set_text(row, "kernel", "relight");
    set_count(row, "width", work->width);
    set_count(row, "height", work->height);
    set_count(row, "lanes", lanes);
    set_text(row, "format", variant->is_half ? "half" : "float");
    set_text(row, "isa", variant->isa);
    set_count(row, "threads", variant->thread_count);
    if (variant->times.count == 0) return;
    const bench_times *triad = &race->triad[variant->thread_count - 1];
    const double speed = gigabytes_per_s(pixel_bytes * work->width * work->height, &variant->times);
    const double triad_speed = gigabytes_per_s(triad_bytes(), triad);
    set_times(row, "postilluminate_ms", &variant->times);
    set_number(row, "gigabytes_per_s", speed);
    set_number(row, "triad_gigabytes_per_s", triad_speed);
    set_number(row, "share_of_triad", speed / triad_speed);
}

static mtm_status check_race(const relight_race *race, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < race->variant_count && status == MTM_OK; i++)
        status =
            check_pixels(race->work->dimension, race->variants[i].isa, race->variants[i].thread_count, error);
    return status;
}

/* Whether the images take at most a quarter of the machine's memory; else a note says that their rows stay empty. */
static bool is_memory_enough(const workload *work) {
    const double bytes = 6.0 * mtm_lanes(work->dimension) * work->width * work->height;
    const double memory = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    if (bytes <= 0.25 * memory) return true;
    (void)fprintf(stderr,
                  "metamer bench: note: %dx%d with %d lanes takes %.1f GB, more than a quarter of this "
                  "machine's memory, so its rows stay empty\n",
                  work->width, work->height, mtm_lanes(work->dimension), 1e-9 * bytes);
    return false;
}

static mtm_status run_workload(const bench_settings *settings, const workload *work, double *triad_arrays,
                               bench_rows *rows, mtm_error *error) {
    relight_race race = {.work = work, .triad_arrays = triad_arrays};
    bench_pixels pixels = {.image = NULL};
    mtm_status status = MTM_OK;
    list_variants(settings, &race);
    if (race.variant_count > 0 && is_memory_enough(work)) {
        status = check_race(&race, error);
        if (status == MTM_OK)
            status = make_pixels(work->width, work->height, work->dimension, 1, &pixels, error);
        if (status == MTM_OK) {
            const mtm_progress progress = start_progress(settings->bar, "relight");
            time_race(settings, &pixels, &progress, &race);
            end_progress(settings->bar);
        }
    }
    for (int i = 0; i < race.variant_count && status == MTM_OK; i++)
        add_relight_row(&race, &race.variants[i], rows);
    free_pixels(&pixels);
    return status;
}

static mtm_status run_relight(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    mtm_status status = MTM_OK;
    double *triad_arrays = create_triad();
    if (triad_arrays == NULL) {
        (void)snprintf(error->message, sizeof error->message, "out of memory for the triad");
        return MTM_MEMORY;
    }
    for (int i = 0; i < WORKLOADS && status == MTM_OK; i++)
        status = run_workload(settings, &workloads[i], triad_arrays, rows, error);
    free(triad_arrays);
    return status;
}

/* One way to raycast the engine. */
typedef struct raycast_variant {
    const char *isa;
    int thread_count;
} raycast_variant;

static int list_raycasts(const bench_settings *settings, raycast_variant variants[VARIANTS_MAX]) {
    const isa_list isas = list_isas();
    int count = 0;
    for (int threads = 1; threads <= highest_thread_count(settings); threads++)
        for (int isa = 0; isa < isas.count; isa++) {
            char name[NAME_BYTES];
            (void)snprintf(name, sizeof name, "raycast engine smoke %s %d", isas.names[isa], threads);
            if (is_row_wanted(settings, name))
                variants[count++] = (raycast_variant){isas.names[isa], threads};
        }
    return count;
}

static mtm_status create_raycasts(bench_subject *subject, int count, const raycast_variant *variants,
                                  bench_frame *frames, mtm_error *error) {
    mtm_spectrum reflectances[3];
    mtm_status status = MTM_OK;
    make_reflectances(3, reflectances);
    for (int i = 0; i < count && status == MTM_OK; i++) {
        status = create_frame(subject, "factors:7", 3, reflectances, BENCH_PICTURE_EDGE, BENCH_PICTURE_EDGE,
                              &frames[i], error);
        frames[i].isa = variants[i].isa;
        frames[i].options.thread_count = variants[i].thread_count;
    }
    return status;
}

static mtm_status time_raycasts(const bench_settings *settings, const mtm_volume *volume, int count,
                                const raycast_variant *variants, bench_frame *frames, mtm_error *error) {
    const bench_points points = points_of("smoke");
    bench_subject subject;
    mtm_status status = describe_subject(volume, &points, settings->thread_count, &subject, error);
    if (status == MTM_OK) status = prepare_subject(volume, 1, &subject, error);
    if (status == MTM_OK) status = create_raycasts(&subject, count, variants, frames, error);
    if (status == MTM_OK) status = check_frames("engine smoke", count, frames, error);
    if (status == MTM_OK) {
        const mtm_progress progress = start_progress(settings->bar, "raycast");
        status = time_frames(count, frames, settings->run_count, &progress, error);
        end_progress(settings->bar);
    }
    release_subject(&subject);
    return status;
}

static void add_raycast_row(const raycast_variant *variant, const bench_frame *frame, bench_rows *rows) {
    json_t *row = add_row(rows);
    set_text(row, "kernel", "raycast engine smoke");
    set_count(row, "width", BENCH_PICTURE_EDGE);
    set_count(row, "height", BENCH_PICTURE_EDGE);
    set_count(row, "lanes", mtm_lanes(7));
    set_text(row, "isa", variant->isa);
    set_count(row, "threads", variant->thread_count);
    set_times(row, "spectral_raycast_ms", &frame->project);
    set_times(row, "postilluminate_ms", &frame->relight);
}

static mtm_status run_raycasts(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    raycast_variant variants[VARIANTS_MAX];
    bench_frame frames[VARIANTS_MAX] = {{.subject = NULL}};
    mtm_volume *volume = NULL;
    const int count = list_raycasts(settings, variants);
    mtm_status status = count == 0 ? MTM_OK : find_volume("engine.nrrd", &volume, error);
    if (status == MTM_OK && volume != NULL)
        status = time_raycasts(settings, volume, count, variants, frames, error);
    for (int i = 0; i < count && status == MTM_OK; i++) add_raycast_row(&variants[i], &frames[i], rows);
    for (int i = 0; i < count; i++) release_frame(&frames[i]);
    mtm_volume_destroy(volume);
    return status;
}

static mtm_status run(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    const char *chosen = mtm_isa_name();
    mtm_status status = run_relight(settings, rows, error);
    if (status == MTM_OK) status = run_raycasts(settings, rows, error);
    choose_isa(chosen);
    return status;
}

const bench_suite kernels_suite = {.name = "kernels", .columns = columns, .run = run};
