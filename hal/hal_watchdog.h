// SPDX-License-Identifier: Apache-2.0
// Contract of the watchdog: unfed for its period (2 s), it resets the board.
#ifndef HAL_HAL_WATCHDOG_H
#define HAL_HAL_WATCHDOG_H

#include "hal/hal_status.h"

typedef struct hal_watchdog hal_watchdog_t;

/**
 * Start the period anew. Call it only when the loop is known to be healthy: this is the proof of life.
 *
 * @return HAL_OK; HAL_IO when the driver refuses; the period then runs on.
 */
MUST_CHECK hal_status_t hal_watchdog_feed(hal_watchdog_t *watchdog);

#endif
