// SPDX-License-Identifier: Apache-2.0
// The steps of a planned frame, done by all workers together.
#ifndef FIRMWARE_WARP_STEPS_H
#define FIRMWARE_WARP_STEPS_H

#include "hal/hal_workers.h"
#include "warp_fixed/warp.h"

/**
 * Do all that warp_plan() has left to do.
 *
 * @param warp     After warp_plan().
 * @param workers  NULL is one worker, the calling thread.
 */
void warp_steps_run(warp_t *warp, hal_workers_t *workers);

#endif
