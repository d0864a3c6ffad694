// SPDX-License-Identifier: Apache-2.0
// Is this bus healthy? Judges what was watched: `wallwarp-pose check`.
#ifndef SIM_POSE_BUS_CHECK_H
#define SIM_POSE_BUS_CHECK_H

#include <stdio.h>

#include "sim/pose/bus_watch.h"

enum {
    BUS_CHECK_LEAST_US = 1500000, /**< of watching: three heartbeats, one whole window of load */
    BUS_CHECK_NO_DELAY = -1
};

/**
 * Print one line for each thing looked at: "ok   what" or "BAD  what: what is wrong; what to do".
 *
 * Bad are: a bus with no frame; poses that come less often than 20 a second, with gaps above 100 ms, with lost,
 * repeated, damaged or insane ones, or captured at times that go back; viewers on both kinds of message; capture times
 * without a tracker's bus time, bus time with gaps or from changing masters; boards whose heartbeats stay away, that
 * have started anew, that are not running (an operator's freeze or pattern too) or report faults, that have no good bus
 * time or are not in step, or that differ though they are; no board; damaged reports; bus errors; a load above 70 %.
 *
 * @param watch          Of BUS_CHECK_LEAST_US or more, unless it has heard nothing.
 * @param pose_delay_us  Of the room: bad too is one that is less than the longest delay of a viewer's poses and a
 *                       quarter of the time between two, and a delay that cannot be known. BUS_CHECK_NO_DELAY: not
 *                       looked at.
 * @return Bad things found.
 */
int bus_check_print(FILE *file, const bus_watch_t *watch, int64_t pose_delay_us);

#endif
