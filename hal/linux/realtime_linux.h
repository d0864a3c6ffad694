// SPDX-License-Identifier: Apache-2.0
// What Linux must grant so that the loop keeps its time: memory that stays in memory, and real-time priority.
#ifndef HAL_LINUX_REALTIME_LINUX_H
#define HAL_LINUX_REALTIME_LINUX_H

#include <stdint.h>

#include "hal/hal_board.h"

/**
 * See whether the process may have that priority, and lock its memory.
 *
 * Pages are locked when they are first touched (MCL_ONFAULT), so that a small room does not fill the memory with
 * buffers for the largest panel; after the first frames none is fetched again. Pinning and the priority itself are
 * hal_workers_open()'s.
 *
 * @param      priority  1 to 99, or 0: the process asks for none, and its memory stays as it is.
 * @param[out] error     On failure: one line, with the setting that mends it.
 * @return HAL_OK; HAL_IO when a limit forbids it: nothing is locked then.
 */
MUST_CHECK hal_status_t realtime_linux_open(int32_t priority, char error[HAL_BOARD_ERROR_LENGTH]);

/** Unlock. */
void realtime_linux_close(void);

#endif
