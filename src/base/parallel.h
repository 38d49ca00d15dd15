/* SPDX-License-Identifier: BSD-3-Clause
 * The one way to run work on several threads. */
#ifndef METAMER_BASE_PARALLEL_H
#define METAMER_BASE_PARALLEL_H

#include "metamer/base.h"

/* One task of `task_count`. Tasks must write to disjoint memory and may not depend on each other, on the worker
 * or on the order, so that results are the same bits for every thread count. */
typedef void (*mtm_parallel_function)(void *context, int task);

/* Runs function(context, task) once for every task 0 … task_count-1 on up to `thread_count` threads (0: the
 * default), the calling one included, and returns when all are done. Tasks are claimed in rising order.
 * `progress` (NULL: none) is asked from the calling thread between its tasks; when it answers false no further
 * task is begun and the result is MTM_CANCELLED, else MTM_OK. Threads that cannot be created are done without. */
MTM_CHECK mtm_status mtm_parallel_for(int thread_count, int task_count, mtm_parallel_function function,
                                      void *context, const mtm_progress *progress);

#endif
