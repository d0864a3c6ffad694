// SPDX-License-Identifier: Apache-2.0
// How late the walls of a room are, and how late they can be made: from a pose's capture to the wall.
//
//   latency = pose_delay + period + period / 2 + display + held periods
//
// the middle of the refresh that is drawn after the blank at which the pose was chosen. `display` is what the projector
// takes. Without a wish, held is 0 on every board. With one, the target is what the slowest projector takes, or what
// the longest wish leaves for `display` when that is more, and each board holds pictures for as many whole refreshes as
// bring its own nearest to the target. What is left of the difference is half a period at most.
#ifndef FIRMWARE_FRAME_LATENCY_H
#define FIRMWARE_FRAME_LATENCY_H

#include "firmware/frame_clock.h"

/** @return Refreshes by which this board holds pictures, 0 to FRAME_CLOCK_MOST_HELD. @param target_ms  0: no target. */
int32_t frame_latency_held(const frame_clock_t *clock, int32_t target_ms);

/** @return The target that this room needs; 0 unless somebody wants something. */
int32_t frame_latency_target_ms(const frame_clock_t *clock, const room_latency_sum_t *sum);

/** What comes of a wish. */
typedef struct {
    int32_t will_us;  /**< this board's latency, once the epoch is there that has the target */
    int32_t least_us; /**< of the slowest board: all boards can be made as late */
    int32_t most_us;  /**< up to here the fastest board comes within half a period, holding all that it can */
    bool possible;    /**< the target is not later than that */
} frame_latency_t;

/**
 * What comes of a wish of this board, beside those of the others that it has heard: the longest one counts. From 1 ms
 * up to the least, all boards become as late as the slowest; 0 is no wish.
 */
frame_latency_t frame_latency_of_wish(const frame_clock_t *clock, int32_t wanted_ms, int64_t now_us);

#endif
