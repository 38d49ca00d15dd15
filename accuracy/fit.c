/* SPDX-License-Identifier: BSD-3-Clause
 * Makes the tables of data/bases: the curves of the basis `factors` for every dimension and the principal components
 * that `sharpened` starts from. Usage: fit [--threads N] [--dimension D] SOURCE_FOLDER OUT_FOLDER, where SOURCE_FOLDER
 * has data/spectra and accuracy/split.csv; with --dimension only the curves of that dimension. The files are the same
 * bytes for every number of threads, since a thread fits a dimension alone. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "collection.h"
#include "factors.h"
#include "fail.h"
#include "principal.h"
#include "table_write.h"
#include "training.h"

enum { EXIT_FAILED = 1, EXIT_USAGE = 2, THREADS_MAX = 64, PRINCIPAL_FIRST_NM = 400 };

/* The dimensions still to fit, shared by the threads. */
typedef struct fit_queue {
    pthread_mutex_t mutex;
    int next, last; /* fitted from the largest, which takes longest, to the smallest */
    const training_set *training;
    const char *out_folder;
    mtm_status status; /* the first failure */
    mtm_error error;
} fit_queue;

static double now_seconds(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static mtm_status write_factors(const char *out_folder, const factor_curves *curves, mtm_error *error) {
    const table_columns groups[] = {
        {"encode", curves->dimension, curves->encode[0], MTM_SPECTRUM_SAMPLES},
        {"spectrum", curves->dimension, curves->spectrum[0], MTM_SPECTRUM_SAMPLES},
    };
    char name[32];
    (void)snprintf(name, sizeof name, "factors_%d.csv", curves->dimension);
    return table_write(out_folder, name, MTM_WAVELENGTH_FIRST_NM, MTM_SPECTRUM_SAMPLES, 2, groups, error);
}

static mtm_status fit_dimension(const fit_queue *queue, int dimension, mtm_error *error) {
    factor_curves curves;
    minimize_result result;
    const double begin = now_seconds();
    mtm_status status = factor_fit(queue->training, dimension, &curves, &result, error);
    if (status == MTM_OK) status = write_factors(queue->out_folder, &curves, error);
    if (status == MTM_OK)
        (void)fprintf(stderr, "fit: factors:%d: training error %.4f, %d iterations, %d evaluations, %.1f s\n",
                      dimension, result.value, result.iterations, result.evaluations, now_seconds() - begin);
    return status;
}

/* The next dimension to fit; 0 where nothing is left, or something failed. */
static int take_dimension(fit_queue *queue) {
    (void)pthread_mutex_lock(&queue->mutex);
    const bool is_left = queue->status == MTM_OK && queue->next >= queue->last;
    const int dimension = is_left ? queue->next-- : 0;
    (void)pthread_mutex_unlock(&queue->mutex);
    return dimension;
}

static void *work(void *user) {
    fit_queue *queue = user;
    for (int dimension = take_dimension(queue); dimension > 0; dimension = take_dimension(queue)) {
        mtm_error error;
        const mtm_status status = fit_dimension(queue, dimension, &error);
        if (status == MTM_OK) continue;
        (void)pthread_mutex_lock(&queue->mutex);
        if (queue->status == MTM_OK) {
            queue->status = status;
            queue->error = error;
        }
        (void)pthread_mutex_unlock(&queue->mutex);
    }
    return NULL;
}

/* Threads that cannot be started are done without. */
static mtm_status fit_factors(fit_queue *queue, int thread_count, mtm_error *error) {
    pthread_t threads[THREADS_MAX];
    int started = 0;
    while (started < thread_count - 1 && pthread_create(&threads[started], NULL, work, queue) == 0) started++;
    (void)work(queue);
    for (int i = 0; i < started; i++) (void)pthread_join(threads[i], NULL);
    if (queue->status != MTM_OK) *error = queue->error;
    return queue->status;
}

static mtm_status fit_principal(const char *source_folder, const collection *spectra, const char *out_folder,
                                mtm_error *error) {
    collection_list list;
    mtm_status status = training_read_principal(source_folder, spectra, &list, error);
    if (status != MTM_OK) return status;
    double(*rows)[PRINCIPAL_SAMPLES] = calloc((size_t)list.count, sizeof *rows);
    if (rows == NULL) {
        collection_list_free(&list);
        return fail_memory(error, "principal components");
    }
    const int first = (PRINCIPAL_FIRST_NM - MTM_WAVELENGTH_FIRST_NM) / MTM_WAVELENGTH_STEP_NM;
    for (int i = 0; i < list.count; i++) memcpy(rows[i], &list.items[i].spectrum.value[first], sizeof *rows);
    double components[PRINCIPAL_COMPONENTS][PRINCIPAL_SAMPLES];
    principal_components(list.count, (const double(*)[PRINCIPAL_SAMPLES])rows, components, NULL);
    free(rows);
    collection_list_free(&list);
    const table_columns group = {"u", PRINCIPAL_COMPONENTS, components[0], PRINCIPAL_SAMPLES};
    return table_write(out_folder, "reflectance_pca.csv", PRINCIPAL_FIRST_NM, PRINCIPAL_SAMPLES, 1, &group,
                       error);
}

static mtm_status run(const char *source_folder, const char *out_folder, int thread_count, int dimension,
                      mtm_error *error) {
    collection spectra;
    training_set training = {0};
    mtm_status status = collection_read(source_folder, NULL, &spectra, error);
    if (status != MTM_OK) return status;
    if (dimension == 0) status = fit_principal(source_folder, &spectra, out_folder, error);
    if (status == MTM_OK) status = training_create(source_folder, &spectra, &training, error);
    if (status == MTM_OK) {
        fit_queue queue = {.mutex = PTHREAD_MUTEX_INITIALIZER,
                           .next = dimension == 0 ? FACTORS_MAX : dimension,
                           .last = dimension == 0 ? FACTORS_MIN : dimension,
                           .training = &training,
                           .out_folder = out_folder};
        status = fit_factors(&queue, thread_count, error);
    }
    training_free(&training);
    collection_free(&spectra);
    return status;
}

/* The number after an option, or -1. */
static int option_number(const char *text, int low, int high) {
    char *end = NULL;
    const long number = text == NULL ? -1 : strtol(text, &end, 10);
    return text == NULL || end == text || *end != '\0' || number < low || number > high ? -1 : (int)number;
}

int main(int argc, char **argv) {
    int thread_count = mtm_default_thread_count();
    int dimension = 0;
    int next = 1;
    for (; next + 1 < argc && argv[next][0] == '-'; next += 2) {
        if (strcmp(argv[next], "--threads") == 0)
            thread_count = option_number(argv[next + 1], 1, THREADS_MAX);
        else if (strcmp(argv[next], "--dimension") == 0)
            dimension = option_number(argv[next + 1], FACTORS_MIN, FACTORS_MAX);
        else
            thread_count = -1;
    }
    if (argc - next != 2 || thread_count < 0 || dimension < 0) {
        (void)fprintf(stderr,
                      "usage: fit [--threads N] [--dimension D] SOURCE_FOLDER OUT_FOLDER, N from 1 to %d, D "
                      "from %d to %d\n",
                      THREADS_MAX, FACTORS_MIN, FACTORS_MAX);
        return EXIT_USAGE;
    }
    if (thread_count > THREADS_MAX) thread_count = THREADS_MAX;
    mtm_error error;
    if (run(argv[next], argv[next + 1], thread_count, dimension, &error) == MTM_OK) return 0;
    (void)fprintf(stderr, "fit: %s\n", error.message);
    return EXIT_FAILED;
}
