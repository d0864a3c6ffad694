// SPDX-License-Identifier: Apache-2.0
// From a tracker's clock to this machine's: when was a pose captured?
#include "sim/trackers/tracker_clock.h"

#include <stdlib.h>

int64_t tracker_clock_local_us(tracker_clock_t *clock, int64_t captured_us, int64_t arrived_us)
{
    const int64_t way_us = arrived_us - captured_us;
    if (!clock->running || llabs(way_us - clock->least_us[0]) > TRACKER_CLOCK_JUMP_US) {
        *clock = (tracker_clock_t){.running = true, .span_start_us = arrived_us, .least_us = {way_us, way_us}};
    } else if (arrived_us - clock->span_start_us >= TRACKER_CLOCK_SPAN_US) {
        clock->span_start_us = arrived_us;
        clock->least_us[1] = clock->least_us[0];
        clock->least_us[0] = way_us;
    } else if (way_us < clock->least_us[0]) {
        clock->least_us[0] = way_us;
    }
    const int64_t least_us = clock->least_us[0] < clock->least_us[1] ? clock->least_us[0] : clock->least_us[1];
    return captured_us + least_us;
}
