// SPDX-License-Identifier: Apache-2.0
// The watchdog (hal/hal_watchdog.h) behind /dev/watchdogN of Linux.
//
// It runs from open on. Closing it is the one clean end: the driver is told to stop ("magic close"), unless it was
// built or loaded with nowayout, which keeps it running: such a board resets whenever the firmware ends. A program that
// is killed or crashes says nothing, so the watchdog runs on and resets the board.
#ifndef HAL_LINUX_WATCHDOG_LINUX_H
#define HAL_LINUX_WATCHDOG_LINUX_H

#include <stdint.h>

#include "hal/hal_board.h"

enum { WATCHDOG_LINUX_PERIOD_S = 2, WATCHDOG_LINUX_LONGEST_S = 64 };

/**
 * Open and start it, with a period of 2 s; or, on a device that refuses that, with the next that it takes of 4, 8, ...
 * 64 s; or with the device's own if that can't be set.
 *
 * @param      device    /dev/watchdog0; NULL: the board has none, and feeding does nothing.
 * @param[out] watchdog  Written only when HAL_OK is returned.
 * @param[out] error     On failure: one line.
 * @return HAL_OK; HAL_IO when there is no such device, it is no watchdog, or another program has it: nothing has been
 *         started then.
 */
MUST_CHECK hal_status_t watchdog_linux_open(hal_watchdog_t **watchdog, const char *device,
                                            char error[HAL_BOARD_ERROR_LENGTH]);

/** Stop it and close it. NULL is allowed. */
void watchdog_linux_close(hal_watchdog_t *watchdog);

/** @return After how many seconds without food it resets the board; 0: never. */
int32_t watchdog_linux_period_s(const hal_watchdog_t *watchdog);

#endif
