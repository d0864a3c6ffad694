// SPDX-License-Identifier: Apache-2.0
// Contract of the board's clock.
#ifndef HAL_HAL_TIME_H
#define HAL_HAL_TIME_H

#include <stdint.h>

typedef struct hal_time hal_time_t;

/**
 * @return Microseconds since some moment before start. Never steps, never goes back, is not set from outside
 *         (CLOCK_MONOTONIC). Every time stamp of every HAL device is on this clock.
 */
int64_t hal_time_now_us(const hal_time_t *clock);

#endif
