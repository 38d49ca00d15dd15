/* SPDX-License-Identifier: BSD-3-Clause
 * The one way to run work on several threads: a fork-join loop over tasks claimed from one atomic counter. */
#define _GNU_SOURCE /* sched_getaffinity */
#include "base/parallel.h"

#include <assert.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <unistd.h>

enum { THREAD_LIMIT = 256 };

typedef struct parallel_job {
    mtm_parallel_function function;
    void *context;
    int task_count;
    atomic_int next_task;
    atomic_bool is_cancelled;
} parallel_job;

int mtm_default_thread_count(void) {
#if defined(__linux__)
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0 && CPU_COUNT(&allowed) > 0)
        return CPU_COUNT(&allowed);
#endif
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}

static bool run_next_task(parallel_job *job) {
    if (atomic_load_explicit(&job->is_cancelled, memory_order_relaxed)) return false;
    const int task = atomic_fetch_add_explicit(&job->next_task, 1, memory_order_relaxed);
    if (task >= job->task_count) return false;
    job->function(job->context, task);
    return true;
}

static void *run_worker(void *argument) {
    parallel_job *job = argument;
    while (run_next_task(job)) {
    }
    return NULL;
}

/* The calling thread works too, and alone talks to the progress callback. */
static void run_reporting(parallel_job *job, const mtm_progress *progress) {
    while (run_next_task(job)) {
        if (progress == NULL || progress->report == NULL) continue;
        const int begun = atomic_load_explicit(&job->next_task, memory_order_relaxed);
        const double fraction = begun < job->task_count ? (double)begun / job->task_count : 1.0;
        if (!progress->report(progress->user, fraction)) atomic_store(&job->is_cancelled, true);
    }
}

mtm_status mtm_parallel_for(int thread_count, int task_count, mtm_parallel_function function, void *context,
                            const mtm_progress *progress) {
    assert(thread_count >= 0 && task_count >= 0 && function != NULL);
    parallel_job job = {.function = function, .context = context, .task_count = task_count};
    atomic_init(&job.next_task, 0);
    atomic_init(&job.is_cancelled, false);

    if (thread_count == 0) thread_count = mtm_default_thread_count();
    if (thread_count > THREAD_LIMIT) thread_count = THREAD_LIMIT;
    if (thread_count > task_count) thread_count = task_count;
    pthread_t threads[THREAD_LIMIT];
    int started = 0;
    while (started + 1 < thread_count && pthread_create(&threads[started], NULL, run_worker, &job) == 0)
        started++;

    run_reporting(&job, progress);
    for (int i = 0; i < started; i++) (void)pthread_join(threads[i], NULL);
    return atomic_load(&job.is_cancelled) ? MTM_CANCELLED : MTM_OK;
}
