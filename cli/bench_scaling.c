/* SPDX-License-Identifier: BSD-3-Clause
 * metamer bench --suite scaling: a frame of the Marschner-Lobb signal with one thing varied at a time, and relighting
 * over the share of pixels that hold anything. */
#include <stdio.h>

#include "bench.h"
#include "bench_check.h"
#include "bench_pixels.h"
#include "bench_volume.h"

static const char *const columns[] = {
    "varied", "value",      "threads",           "picture_edge", "volume_edge",      "lanes",
    "fill",   "raycast_ms", "postilluminate_ms", "classify_ms",  "affine_r_squared", NULL};

/* What is varied; the columns above of the same names. */
enum { THREADS, PICTURE_EDGE, VOLUME_EDGE, LANES, DIRECTIONS };
static const char *const direction_names[DIRECTIONS] = {"threads", "picture_edge", "volume_edge", "lanes"};

typedef struct scaling_point {
    int at[DIRECTIONS];
} scaling_point;

enum { POINTS_MAX = 10, NAME_BYTES = 64 };

/* 1, 2, 4 … and all the threads there are. */
static int list_threads(int highest, int values[POINTS_MAX]) {
    int count = 0;
    for (int threads = 1; threads < highest; threads *= 2) values[count++] = threads;
    values[count++] = highest;
    return count;
}

static int list_values(const bench_settings *settings, int direction, int values[POINTS_MAX]) {
    static const int fixed[DIRECTIONS][POINTS_MAX] = {[PICTURE_EDGE] = {256, 512, 1024, 2048},
                                                      [VOLUME_EDGE] = {64, 96, 128, 192, 256},
                                                      [LANES] = {4, 8, 16, 84}};
    if (direction == THREADS) return list_threads(settings->thread_count, values);
    int count = 0;
    for (; count < POINTS_MAX && fixed[direction][count] > 0; count++)
        values[count] = fixed[direction][count];
    return count;
}

/* The points along one direction whose rows are wanted; the rest of each is the common frame. */
static int list_points(const bench_settings *settings, int direction, scaling_point points[POINTS_MAX]) {
    int values[POINTS_MAX];
    const int value_count = list_values(settings, direction, values);
    int count = 0;
    for (int i = 0; i < value_count; i++) {
        char name[NAME_BYTES];
        scaling_point point = {{[THREADS] = settings->thread_count,
                                [PICTURE_EDGE] = BENCH_PICTURE_EDGE,
                                [VOLUME_EDGE] = 128,
                                [LANES] = 8}};
        point.at[direction] = values[i];
        (void)snprintf(name, sizeof name, "%s %d", direction_names[direction], values[i]);
        if (is_row_wanted(settings, name)) points[count++] = point;
    }
    return count;
}

static mtm_status create_point_frame(const scaling_point *point, bench_subject *subject, bench_frame *frame,
                                     mtm_error *error) {
    const int lanes = point->at[LANES];
    const int material_count = lanes <= 8 ? 3 : lanes - 2; /* materials, white and alpha fill the lanes */
    const char *basis = lanes == 4 ? "rgb" : lanes == 8 ? "factors:7" : "materials";
    mtm_spectrum reflectances[MTM_MATERIALS_MAX];
    make_reflectances(material_count, reflectances);
    const mtm_status status = create_frame(subject, basis, material_count, reflectances,
                                           point->at[PICTURE_EDGE], point->at[PICTURE_EDGE], frame, error);
    frame->options.thread_count = point->at[THREADS];
    return status;
}

static void add_point_row(int direction, const scaling_point *point, const bench_frame *frame,
                          bench_rows *rows) {
    json_t *row = add_row(rows);
    set_text(row, "varied", direction_names[direction]);
    set_count(row, "value", point->at[direction]);
    for (int i = 0; i < DIRECTIONS; i++) set_count(row, direction_names[i], point->at[i]);
    set_number(row, "fill", frame->fill);
    set_times(row, "raycast_ms", &frame->project);
    set_times(row, "postilluminate_ms", &frame->relight);
    set_times(row, "classify_ms", &frame->classify);
}

/* The points of a direction with all that they need: a volume each where that is what varies, else one for all. */
typedef struct scaling_race {
    int direction, count;
    scaling_point points[POINTS_MAX];
    bench_points transfer;
    mtm_volume *volumes[POINTS_MAX];
    bench_subject subjects[POINTS_MAX];
    bench_frame frames[POINTS_MAX];
} scaling_race;

static mtm_status set_up_race(const bench_settings *settings, scaling_race *race, mtm_error *error) {
    mtm_status status = MTM_OK;
    race->transfer = points_of("smoke");
    for (int i = 0; i < race->count && status == MTM_OK; i++) {
        const int own = race->direction == VOLUME_EDGE ? i : 0;
        bench_subject *subject = &race->subjects[own];
        if (own == i) {
            status = make_marschner_lobb(race->points[i].at[VOLUME_EDGE], &race->volumes[i], error);
            if (status == MTM_OK)
                status = describe_subject(race->volumes[i], &race->transfer, settings->thread_count, subject,
                                          error);
            if (status == MTM_OK) status = prepare_subject(race->volumes[i], 1, subject, error);
        }
        if (status == MTM_OK) status = create_point_frame(&race->points[i], subject, &race->frames[i], error);
    }
    return status;
}

static void tear_down_race(scaling_race *race) {
    for (int i = 0; i < race->count; i++) {
        release_frame(&race->frames[i]);
        release_subject(&race->subjects[i]);
        mtm_volume_destroy(race->volumes[i]);
    }
}

static mtm_status run_direction(const bench_settings *settings, int direction, bench_rows *rows,
                                mtm_error *error) {
    scaling_race race = {.direction = direction};
    race.count = list_points(settings, direction, race.points);
    mtm_status status = set_up_race(settings, &race, error);
    if (status == MTM_OK) status = check_frames("Marschner-Lobb", race.count, race.frames, error);
    if (status == MTM_OK) {
        const mtm_progress progress = start_progress(settings->bar, direction_names[direction]);
        status = time_frames(race.count, race.frames, settings->run_count, &progress, error);
        end_progress(settings->bar);
    }
    for (int i = 0; i < race.count && status == MTM_OK; i++)
        add_point_row(direction, &race.points[i], &race.frames[i], rows);
    tear_down_race(&race);
    return status;
}

enum { FILL_EDGE = 1024, FILL_DIMENSION = 7, FILLS = 6, FILL_REPEATS = 4 /* a relighting is short */ };
static const double fills[FILLS] = {0.05, 0.1, 0.25, 0.5, 0.75, 1};

typedef struct fill_race {
    int count;
    double fills[FILLS];
    bench_pixels pixels[FILLS];
    bench_times times[FILLS];
} fill_race;

static mtm_status set_up_fills(const bench_settings *settings, fill_race *race, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int i = 0; i < FILLS && status == MTM_OK; i++) {
        char name[NAME_BYTES];
        (void)snprintf(name, sizeof name, "fill %g", fills[i]);
        if (!is_row_wanted(settings, name)) continue;
        race->fills[race->count] = fills[i];
        status =
            make_pixels(FILL_EDGE, FILL_EDGE, FILL_DIMENSION, fills[i], &race->pixels[race->count++], error);
    }
    return status;
}

static void time_fills(const bench_settings *settings, fill_race *race) {
    const int wanted = FILL_REPEATS * settings->run_count;
    const int run_count = wanted < BENCH_RUNS_MAX ? wanted : BENCH_RUNS_MAX;
    for (int run = -1; run < run_count; run++)
        for (int turn = 0; turn < race->count; turn++) {
            const int i = (run + 1 + turn) % race->count;
            (void)time_pixels(&race->pixels[i], false, settings->thread_count); /* as frames do */
            const double ms = time_pixels(&race->pixels[i], false, settings->thread_count);
            if (run >= 0) add_time(&race->times[i], ms);
        }
}

static void add_fill_rows(const bench_settings *settings, const fill_race *race, bench_rows *rows) {
    double medians[FILLS];
    for (int i = 0; i < race->count; i++) medians[i] = median_ms(&race->times[i]);
    for (int i = 0; i < race->count; i++) {
        json_t *row = add_row(rows);
        set_text(row, "varied", "fill");
        set_number(row, "value", race->fills[i]);
        set_number(row, "fill", race->fills[i]);
        set_count(row, "threads", settings->thread_count);
        set_count(row, "picture_edge", FILL_EDGE);
        set_count(row, "lanes", mtm_lanes(FILL_DIMENSION));
        set_times(row, "postilluminate_ms", &race->times[i]);
        if (race->count > 2) /* two points are always on a line */
            set_number(row, "affine_r_squared", fit_line_quality(race->count, race->fills, medians));
    }
}

static mtm_status run_fills(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    fill_race race = {.count = 0};
    mtm_status status = set_up_fills(settings, &race, error);
    if (status == MTM_OK && race.count > 0)
        status = check_pixels(FILL_DIMENSION, mtm_isa_name(), settings->thread_count, error);
    if (status == MTM_OK) {
        time_fills(settings, &race);
        add_fill_rows(settings, &race, rows);
    }
    for (int i = 0; i < race.count; i++) free_pixels(&race.pixels[i]);
    return status;
}

static mtm_status run(const bench_settings *settings, bench_rows *rows, mtm_error *error) {
    mtm_status status = MTM_OK;
    for (int direction = 0; direction < DIRECTIONS && status == MTM_OK; direction++)
        status = run_direction(settings, direction, rows, error);
    return status == MTM_OK ? run_fills(settings, rows, error) : status;
}

const bench_suite scaling_suite = {.name = "scaling", .columns = columns, .run = run};
