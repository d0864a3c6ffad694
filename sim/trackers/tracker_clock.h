// SPDX-License-Identifier: Apache-2.0
// From a tracker's clock to this machine's: when was a pose captured?
#ifndef SIM_TRACKERS_TRACKER_CLOCK_H
#define SIM_TRACKERS_TRACKER_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

enum { TRACKER_CLOCK_SPAN_US = 5000000, TRACKER_CLOCK_JUMP_US = 1000000 };

/**
 * The packet that took least time to come tells how the two clocks stand: what others came later is jitter, and is
 * taken off. That least time itself is not known, and stays in. Two spans of 5 s follow the clocks' drift.
 *
 * Zero before the first packet; its fields are the clock's own.
 */
typedef struct {
    bool running;
    int64_t span_start_us;
    int64_t least_us[2]; /**< arrival - capture: of this span and the one before */
} tracker_clock_t;

/**
 * @param captured_us  On the tracker's clock. When it jumps by more than a second (a restart, midnight), all begins
 * anew.
 * @param arrived_us   On this machine's.
 * @return Captured, on this machine's clock: arrived_us at the latest.
 */
int64_t tracker_clock_local_us(tracker_clock_t *clock, int64_t captured_us, int64_t arrived_us);

#endif
