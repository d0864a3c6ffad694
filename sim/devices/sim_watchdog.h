// SPDX-License-Identifier: Apache-2.0
// The watchdog in the simulator (hal/hal_watchdog.h): says when it would have reset the board.
#ifndef SIM_DEVICES_SIM_WATCHDOG_H
#define SIM_DEVICES_SIM_WATCHDOG_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_time.h"
#include "hal/hal_watchdog.h"
#include "sim/files/file_io.h"

typedef struct {
    bool io; /**< feeding fails with HAL_IO, and does not feed */
} sim_watchdog_faults_t;

/**
 * @param clock      The board's; must outlive the watchdog. The first period starts now.
 * @param period_us  1 or more.
 * @return NULL with the reason in error: bad period, or no memory. Uses the heap.
 */
hal_watchdog_t *sim_watchdog_create(const hal_time_t *clock, int64_t period_us, char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. */
void sim_watchdog_destroy(hal_watchdog_t *watchdog);

/** @return The faults, to be set and cleared at any time between the firmware's steps. */
sim_watchdog_faults_t *sim_watchdog_faults(hal_watchdog_t *watchdog);

/**
 * @param now_us  On the board's clock.
 * @return Whether the watchdog has ever been left unfed for period_us or longer. Feeding too late does not undo it:
 *         the board would have been reset.
 */
bool sim_watchdog_expired(const hal_watchdog_t *watchdog, int64_t now_us);

/** @return How often it was fed. */
uint64_t sim_watchdog_feeds(const hal_watchdog_t *watchdog);

#endif
