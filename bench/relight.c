/* SPDX-License-Identifier: BSD-3-Clause
 * How fast a finished spectral image is lit to 8-bit sRGB: sizes, numbers of coefficients and fills; in each, float and
 * half coefficients, one and two threads and every instruction set take turns with each other and with a triad (J. D.
 * McCalpin, STREAM), so that a busy machine slows all of them. Minima and medians; asserts nothing.
 * Usage: relight [RUNS] */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "metamer/metamer.h"
#include "timing.h"

enum { RUNS_MAX = 1000, THREADS_MAX = 2, ISA_MAX = 3, TRIAD_COUNT = 1 << 23 /* doubles: 64 MiB an array */ };

typedef struct workload {
    int width, height, dimension;
    double fill;
} workload;

static const workload workloads[] = {
    {512, 512, 7, 1},     {512, 512, 7, 0.5}, {512, 512, 7, 0.25}, {512, 512, 7, 0.05},
    {512, 512, 3, 1},     {512, 512, 15, 1},  {512, 512, 83, 1},   {3840, 2160, 7, 1},
    {3840, 2160, 7, 0.5}, {3840, 2160, 3, 1}, {3840, 2160, 15, 1},
};
enum { WORKLOADS = sizeof workloads / sizeof *workloads };

typedef struct bench_data {
    mtm_image *image;
    mtm_half_image *half;
    unsigned char *rgba;
    double matrix[3 * MTM_DIMENSION_MAX];
} bench_data;

typedef struct bench_times {
    double relight_ms[ISA_MAX][2][THREADS_MAX][RUNS_MAX]; /* [isa][is_half][threads - 1] */
    double triad_ms[THREADS_MAX][RUNS_MAX];
} bench_times;

/* The pixels that hold anything are a band of rows in the middle; sums are between 0 and 1. */
static mtm_status make_data(const workload *work, bench_data *data, mtm_error *error) {
    mtm_status status = mtm_image_create(work->width, work->height, work->dimension, "materials", NULL, NULL,
                                         &data->image, error);
    if (status != MTM_OK) return status;
    const size_t lanes = (size_t)data->image->lanes;
    const int filled_rows = (int)(work->height * work->fill);
    const size_t row = (size_t)work->width * lanes;
    float *pixels = data->image->pixels + (size_t)((work->height - filled_rows) / 2) * row;
    uint32_t random = 1;
    for (size_t i = 0; i < (size_t)filled_rows * row; i++) {
        random = random * 1664525U + 1013904223U;
        if (i % lanes <= (size_t)work->dimension) pixels[i] = (float)(random >> 8) / 16777216.0F;
    }
    for (int i = 0; i < 3 * work->dimension; i++) data->matrix[i] = (1 + i % 5) / (3.0 * work->dimension);
    data->rgba = calloc((size_t)work->width * (size_t)work->height, 4);
    if (data->rgba == NULL) return MTM_MEMORY;
    return mtm_half_image_create(data->image, &data->half, error);
}

static double time_relight(const bench_data *data, bool is_half, int thread_count) {
    mtm_relight_options options = mtm_relight_defaults();
    options.thread_count = thread_count;
    const double begin = now_ms();
    if (is_half)
        mtm_relight_half_bytes(data->half, data->matrix, &options, data->rgba);
    else
        mtm_relight_bytes(data->image, data->matrix, &options, data->rgba);
    return now_ms() - begin;
}

typedef struct triad_part {
    double *a;
    size_t count;
} triad_part;

static void *run_triad(void *argument) {
    const triad_part *part = argument;
    double *a = part->a;
    const double *b = a + TRIAD_COUNT;
    const double *c = b + TRIAD_COUNT;
    for (size_t i = 0; i < part->count; i++) a[i] = b[i] + 3 * c[i];
    return NULL;
}

static double time_triad(double *arrays, int thread_count) {
    const size_t count = TRIAD_COUNT / (size_t)thread_count;
    triad_part parts[THREADS_MAX] = {{arrays, count}, {arrays + count, count}};
    pthread_t thread;
    const double begin = now_ms();
    const bool is_started = thread_count == 2 && pthread_create(&thread, NULL, run_triad, &parts[1]) == 0;
    (void)run_triad(&parts[0]);
    if (is_started) (void)pthread_join(thread, NULL);
    return now_ms() - begin;
}

/* The instruction sets of this machine, from the lowest. */
static int list_isas(const char *names[ISA_MAX]) {
    static const char *const known[ISA_MAX] = {"baseline", "x86-64-v3", "x86-64-v4"};
    int count = 0;
    for (int i = 0; i < ISA_MAX; i++) {
        (void)setenv("METAMER_ISA", known[i], 1);
        if (strcmp(mtm_isa_name(), known[i]) == 0) names[count++] = known[i];
    }
    return count;
}

static void measure(const bench_data *data, int isa_count, const char *const *isas, double *arrays,
                    int run_count, bench_times *times) {
    for (int run = -1; run < run_count; run++) { /* the first warms up */
        const int kept = run < 0 ? 0 : run;
        for (int threads = 1; threads <= THREADS_MAX; threads++) {
            times->triad_ms[threads - 1][kept] = time_triad(arrays, threads);
            for (int isa = 0; isa < isa_count; isa++) {
                (void)setenv("METAMER_ISA", isas[isa], 1);
                for (int is_half = 0; is_half < 2; is_half++)
                    times->relight_ms[isa][is_half][threads - 1][kept] =
                        time_relight(data, is_half == 1, threads);
            }
        }
    }
}

/* Sorts the times. */
static void print_times(const char *label, int thread_count, double megabytes, int run_count,
                        double *times_ms) {
    const double middle = median(run_count, times_ms);
    (void)printf("  %-16s %d thread%s %9.3f %9.3f ms %7.1f GB/s\n", label, thread_count,
                 thread_count == 1 ? " " : "s", times_ms[0], middle, megabytes / times_ms[0]);
}

static void print_workload(const workload *work, const bench_data *data, int isa_count,
                           const char *const *isas, int run_count, bench_times *times) {
    const double megapixels = 1e-6 * work->width * work->height;
    (void)printf("%d x %d, %d lanes, fill %.2f: minimum, median, bandwidth at the minimum\n", work->width,
                 work->height, data->image->lanes, work->fill);
    for (int threads = 1; threads <= THREADS_MAX; threads++) {
        print_times("triad", threads, 24e-6 * TRIAD_COUNT, run_count, times->triad_ms[threads - 1]);
        for (int isa = 0; isa < isa_count; isa++) {
            for (int is_half = 0; is_half < 2; is_half++) {
                char label[32];
                const int bytes = data->image->lanes * (is_half == 1 ? 2 : 4) + 4;
                (void)snprintf(label, sizeof label, "%s %s", isas[isa], is_half == 1 ? "half" : "float");
                print_times(label, threads, megapixels * bytes, run_count,
                            times->relight_ms[isa][is_half][threads - 1]);
            }
        }
    }
}

static mtm_status run_workload(const workload *work, double *arrays, int run_count, bench_times *times,
                               mtm_error *error) {
    const char *isas[ISA_MAX];
    const int isa_count = list_isas(isas);
    bench_data data = {.image = NULL};
    const mtm_status status = make_data(work, &data, error);
    if (status == MTM_OK) {
        measure(&data, isa_count, isas, arrays, run_count, times);
        print_workload(work, &data, isa_count, isas, run_count, times);
    }
    mtm_image_destroy(data.image);
    mtm_half_image_destroy(data.half);
    free(data.rgba);
    return status;
}

int main(int argc, char **argv) {
    const int run_count = argc > 1 ? atoi(argv[1]) : 21;
    if (argc > 2 || run_count < 1 || run_count > RUNS_MAX) {
        (void)fprintf(stderr, "usage: relight [RUNS], RUNS from 1 to %d\n", RUNS_MAX);
        return 2;
    }
    mtm_error error = {"out of memory"};
    double *arrays = calloc(3 * (size_t)TRIAD_COUNT, sizeof *arrays);
    bench_times *times = malloc(sizeof *times);
    mtm_status status = arrays == NULL || times == NULL ? MTM_MEMORY : MTM_OK;
    for (int i = 0; i < WORKLOADS && status == MTM_OK; i++)
        status = run_workload(&workloads[i], arrays, run_count, times, &error);
    if (status != MTM_OK) (void)fprintf(stderr, "relight: %s\n", error.message);
    free(times);
    free(arrays);
    return status == MTM_OK ? 0 : 1;
}
