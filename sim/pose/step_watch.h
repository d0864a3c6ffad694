// SPDX-License-Identifier: Apache-2.0
// Do boards that say that they are in step show the same? Compares their Steps, refresh by refresh.
#ifndef SIM_POSE_STEP_WATCH_H
#define SIM_POSE_STEP_WATCH_H

#include <stdint.h>

#include "firmware/can_frame_clock.h"

enum {
    STEP_WATCH_KEPT = 32,        /**< refreshes: 3 s of them at 60 Hz */
    STEP_WATCH_OPEN_US = 1000000 /**< Steps farther apart are not of one refresh: numbers wrap */
};

/** One refresh, as the boards in step tell of it. */
typedef struct {
    uint64_t boards; /**< bit n: node n has; 0: none is kept here */
    int64_t time_us; /**< when the first did */
    can_step_t first;
    bool differs;
} step_watch_refresh_t;

/** All zero has heard nothing. */
typedef struct {
    int64_t compared;  /**< refreshes that two boards in step, or more, have told of */
    int64_t differing; /**< of them, those with another picture or pose on one board: there must be none */

    step_watch_refresh_t kept[STEP_WATCH_KEPT]; /**< the module's own from here on */
    int next;
} step_watch_t;

/** Take a Step; those out of step count for nothing. Of a node and a refresh the first one counts. */
void step_watch_take(step_watch_t *watch, const can_step_t *step, int64_t time_us);

#endif
