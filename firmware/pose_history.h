// SPDX-License-Identifier: Apache-2.0
// The last second of one viewer's poses with the times they were captured at, oldest first.
#ifndef FIRMWARE_POSE_HISTORY_H
#define FIRMWARE_POSE_HISTORY_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_protocol.h"

enum {
    POSE_HISTORY_POSES = 256,         /**< a second at 240 Hz */
    POSE_HISTORY_SILENCE_US = 200000, /**< poses farther apart belong to different runs */
    POSE_HISTORY_SPEED_NM_US = 10000, /**< 10 m/s: who is faster has not walked: another run, */
    POSE_HISTORY_STEP_NM = 20000000,  /**< once farther by 20 mm than this speed explains */
    POSE_HISTORY_TURN_Q30_US = 37481, /**< the same for turning: 2000 degrees/s, */
    POSE_HISTORY_TURN_Q30 = 93700000  /**< and 5 degrees; radians in Q30 */
};

/** A pose and when it was true. */
typedef struct {
    int64_t time_us; /**< captured, on the clock that the caller uses everywhere */
    pose_t pose;     /**< its quaternion is of unit length */
    uint8_t counter; /**< as the tracker sent it */
    bool measured;   /**< not the tracker's own guess */
    bool begins_run; /**< the viewer did not get here from the pose before */
} pose_at_t;

/** All zero bytes is an empty history. No pointers inside. */
typedef struct {
    pose_at_t pose[POSE_HISTORY_POSES]; /**< a ring */
    int32_t newest;                     /**< its index */
    int32_t count;                      /**< poses in the ring */
} pose_history_t;

typedef enum {
    POSE_HISTORY_ADDED = 0,
    POSE_HISTORY_NEW_RUN,   /**< added; the first one, or after silence, or a jump: tracker lost and found, other person
                             */
    POSE_HISTORY_NEW_CLOCK, /**< added, all others forgotten: its time is older than the newest by a silence or more */
    POSE_HISTORY_IGNORED    /**< not newer than the newest, lost by the tracker, or without an orientation */
} pose_history_added_t;

/**
 * Add the newest pose.
 *
 * @param pose     Checked (pose_from_can.h): its position within 1000 m.
 * @param time_us  When it was captured; |time_us| < 2^62.
 */
pose_history_added_t pose_history_add(pose_history_t *history, const can_pose_t *pose, int64_t time_us);

/** @return The pose `back` poses before the newest; NULL when there is none. back >= 0. */
const pose_at_t *pose_history_back(const pose_history_t *history, int32_t back);

/**
 * Forget what was captured after a moment, so that all boards choose from the same poses.
 *
 * @param counters  The sender's counters go from 0 to one less: what a gap is.
 * @return Is the newest pose that is left certain to be the newest that was captured up to then? Not when one was lost
 *         behind it, or might still be under way: three quarters of the poses' interval have gone by without one.
 */
bool pose_history_until(pose_history_t *history, int64_t limit_us, int counters);

#endif
