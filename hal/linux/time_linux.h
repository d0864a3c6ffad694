// SPDX-License-Identifier: Apache-2.0
// The board's clock (hal/hal_time.h) on Linux: CLOCK_MONOTONIC.
#ifndef HAL_LINUX_TIME_LINUX_H
#define HAL_LINUX_TIME_LINUX_H

#include "hal/hal_board.h"

/**
 * Open the clock: one vDSO call a reading, no system call. NTP sets its rate, never its value.
 *
 * @param[out] clock  Written only when HAL_OK is returned.
 * @param[out] error  On failure: one line.
 * @return HAL_OK; HAL_IO when the system's clock has steps of more than a microsecond.
 */
MUST_CHECK hal_status_t time_linux_open(hal_time_t **clock, char error[HAL_BOARD_ERROR_LENGTH]);

/** NULL is allowed. */
void time_linux_close(hal_time_t *clock);

#endif
