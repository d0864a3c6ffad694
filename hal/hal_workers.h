// SPDX-License-Identifier: Apache-2.0
// Contract of the workers: threads that are started once, pinned to their cores, and do the parts of a frame together.
#ifndef HAL_HAL_WORKERS_H
#define HAL_HAL_WORKERS_H

#include <stdint.h>

#include "hal/hal_status.h"

typedef struct hal_workers hal_workers_t;

enum { HAL_WORKERS_MAX = 4, HAL_WORKERS_ERROR_LENGTH = 256, HAL_WORKERS_ANY_CORE = -1 };

/** How many workers, and how they are scheduled. The first of them is the thread that opens them. */
typedef struct {
    int32_t count;      /**< 1 to HAL_WORKERS_MAX */
    int32_t first_core; /**< worker i runs on core first_core + i alone; or HAL_WORKERS_ANY_CORE */
    int32_t priority;   /**< real-time, first in first out, 1 to 99; 0 leaves the scheduler's own */
} hal_workers_settings_t;

/** One part of some work: part is 0 to parts - 1. It must not call hal_workers_run(). */
typedef void hal_work_fn(void *context, int32_t part, int32_t parts);

/**
 * Start the workers. The calling thread becomes one of them: pinned, and of that priority, for good.
 *
 * @param[out] workers  Written only when HAL_OK is returned.
 * @param[out] error    On failure: one line, what was refused, and what to do.
 * @return HAL_OK; HAL_BAD_CALL when a setting is out of range; HAL_IO when the system has no such core, or refuses
 *         threads, pinning or priority: none is left behind then.
 */
MUST_CHECK hal_status_t hal_workers_open(hal_workers_t **workers, const hal_workers_settings_t *settings,
                                         char error[HAL_WORKERS_ERROR_LENGTH]);

/**
 * Do every part of some work, each by its own worker at the same time, and return when all are done. Part 0 is done by
 * the calling thread, which must be the one that opened the workers. What a part has written, all parts of the next run
 * see. No heap.
 *
 * @param workers  NULL is one worker, the calling thread.
 */
void hal_workers_run(hal_workers_t *workers, hal_work_fn *work, void *context);

/** End the threads. NULL is allowed. */
void hal_workers_close(hal_workers_t *workers);

#endif
