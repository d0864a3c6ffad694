// SPDX-License-Identifier: Apache-2.0
// This machine's clocks: one, or two at one moment.
#ifndef HAL_LINUX_CLOCKS_H
#define HAL_LINUX_CLOCKS_H

#include <stdint.h>

/** Both clocks at one moment, ns. */
typedef struct {
    int64_t monotonic_ns; /**< CLOCK_MONOTONIC */
    int64_t realtime_ns;  /**< CLOCK_REALTIME, which may be set at any time */
} clock_pair_t;

/** @return CLOCK_MONOTONIC, ns. */
int64_t clock_monotonic_ns(void);

/** @return Both clocks, read within few microseconds unless the thread is interrupted three times. */
clock_pair_t clock_pair(void);

#endif
