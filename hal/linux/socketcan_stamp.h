// SPDX-License-Identifier: Apache-2.0
// When a frame was received, on CLOCK_MONOTONIC, from stamps that the kernel and the controller make on other clocks.
//
// The kernel stamps a frame on CLOCK_REALTIME, which may be set at any time. Both clocks are read together when the
// frame is taken; their distance changes only when CLOCK_REALTIME is set. A frame lies between the last moment when
// none was waiting and now: a stamp that the clocks' distance of now puts elsewhere was made before the clock was set,
// and is put right with the distance of that earlier moment. So a set clock can move a stamp only within that interval,
// and only for the frames in it.
//
// The controller stamps on its own oscillator, which nothing else reads. Of each frame, the kernel's stamp less the
// controller's is their clocks' distance plus some latency, which is never negative. The distance is taken as the least
// of these, each raised by SOCKETCAN_STAMP_DRIFT_PPM of the time since then. As the oscillator is off by less than
// that, the result is never before the true moment, never after the kernel's stamp, and as good as the luckiest frame
// of late. Controllers that stamp a frame's first bit (MCP2518FD under Linux) are so put right by the shortest frame
// heard: a longer one's stamp is early by what it is longer.
#ifndef HAL_LINUX_SOCKETCAN_STAMP_H
#define HAL_LINUX_SOCKETCAN_STAMP_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/linux/clocks.h"

enum {
    SOCKETCAN_STAMP_DRIFT_PPM = 100,
    SOCKETCAN_STAMP_QUEUE_NS = 10000000, /**< from the kernel's stamp to the queue at most, on a busy system */
    SOCKETCAN_STAMP_JUMP_NS = 50000000   /**< more latency than this: the controller's clock has begun anew */
};

/** All zero but for empty at first. */
typedef struct {
    clock_pair_t empty;  /**< when no frame was waiting last */
    int64_t last_ns;     /**< of the frame before, CLOCK_MONOTONIC */
    bool distance_known; /**< of the controller's clock */
    int64_t distance_ns; /**< CLOCK_MONOTONIC less the controller's, at distance_at_ns */
    int64_t distance_at_ns;
} socketcan_stamp_t;

/** The stamps of one frame; 0: none. */
typedef struct {
    int64_t kernel_ns;     /**< CLOCK_REALTIME */
    int64_t controller_ns; /**< the controller's clock, from any moment */
} socketcan_stamps_t;

/** @return CLOCK_MONOTONIC, ns: never after now, never before the last one returned. */
int64_t socketcan_stamp_ns(socketcan_stamp_t *stamp, const socketcan_stamps_t *of, const clock_pair_t *now);

#endif
