// SPDX-License-Identifier: Apache-2.0
// CAN frames -> the checked poses of one viewer.
#ifndef FIRMWARE_POSE_FROM_CAN_H
#define FIRMWARE_POSE_FROM_CAN_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/bus_master.h"
#include "firmware/can_protocol.h"
#include "firmware/pose_history.h"
#include "hal/hal_can.h"

enum {
    /** The three frames of a set must arrive within this time. Frames 15 sets apart, which have the same counter, are
     *  never joined as long as the sender makes fewer than 1500 sets a second. */
    POSE_FROM_CAN_SET_US = 10000,
    /** After this long without a frame the sender's counter is taken as it comes. */
    POSE_FROM_CAN_SILENCE_US = 200000,
    /** A capture time is believed when it is at most so much before the pose was received, or after it: the wrapped one
     *  of a set says no more, and more than that would be of no use. */
    POSE_FROM_CAN_OLDEST_US = 1000000,
    POSE_FROM_CAN_AHEAD_US = 5000
};

/** What went wrong on the bus, counted since start. Every counter wraps at 2^32. */
typedef struct {
    uint32_t length;          /**< pose and time frames of a wrong length, or classic where FD is due, or the reverse */
    uint32_t crc;             /**< pose and time frames whose CRC is wrong */
    uint32_t counter_invalid; /**< pose and time frames whose CRC is right but whose counter is 15 */
    uint32_t counter_lost;    /**< poses that never came, by their counters */
    uint32_t duplicate;       /**< pose frames that came again: dropped */
    uint32_t stale;           /**< pose frames older than the newest: dropped */
    uint32_t sender_restart;  /**< the counter jumped far back, or the sender had been silent */
    uint32_t incomplete_set;  /**< sets given up because a newer one began or their time was over */
    uint32_t
        bad_pose; /**< unknown quality or origin, position beyond 1000 m, quaternion not within 1 % of unit length */
    uint32_t tracking_lost; /**< good frames in which the tracker says that it has lost the viewer */
    uint32_t io;            /**< failures of the CAN driver */
    uint32_t overrun;       /**< calls that took BUS_RECEIVE_FRAMES: the rest has to wait for the next call */
    uint32_t lost;          /**< frames that there was no room for: hal_can_lost(), since the controller was opened */
    uint32_t auth_lost;     /**< with a key: messages whose code was lost, as the next one's counter shows */
    uint32_t auth_unsigned; /**< messages that came without a code: refused */
    uint32_t auth_forged;   /**< whose code is not of this key and session */
    uint32_t auth_replayed; /**< whose code is right, and which had come before, or newer ones */
    uint32_t auth_stale;    /**< which were held back */
    uint32_t auth_early;    /**< which say that they were made later than now */
    uint32_t auth_commands; /**< commands whose code is missing or wrong */
    uint32_t bus_off;       /**< calls that found the controller bus-off; each orders a restart */
} can_faults_t;

/** A sequence of counters of one kind of message. */
typedef struct {
    bool any;        /**< newest and last_us mean something */
    int newest;      /**< the newest counter */
    int64_t last_us; /**< when the counter was last looked at: an FD frame, or a frame that was to begin a set */
} can_sequence_t;

/** Newest pose and receiver. All zero bytes is a receiver for viewer 0 that has heard nothing. No pointers inside. */
typedef struct {
    uint8_t viewer;         /**< whose poses to take, 0 to CAN_VIEWERS - 1; set it before the first call */
    bool any;               /**< a pose has come; newest and received_us mean something */
    can_pose_t newest;      /**< checked; its quality is not CAN_POSE_LOST; its quaternion only nearly of unit length */
    int64_t received_us;    /**< when its last bit was seen, on hal_time's clock */
    bool captured;          /**< its capture time is known: */
    int64_t capture_bus_us; /**< in bus time, unwrapped; else 0 */
    int counters;           /**< of its kind of message: counters go from 0 to one less */
    pose_history_t
        history; /**< the last second of them: when captured, or else received, in bus time as it was known */

    can_sequence_t fd, set;               /**< the receiver's own from here on */
    hal_can_frame_t part[CAN_POSE_PARTS]; /**< of the set being collected */
    bool part_here[CAN_POSE_PARTS];
    bool collecting;
    int64_t set_began_us;
} can_poses_t;

/**
 * Take one frame from the bus.
 *
 * The pose of an FD frame counts at once; a classic set counts when its three frames are here, in any order, all with
 * one counter and within POSE_FROM_CAN_SET_US; a frame of a newer set ends the collecting of an older one. Anything
 * wrong is counted and changes nothing else.
 *
 * A pose's capture time is known when bus time is, began on a tracker's clock, and puts it not long before now.
 *
 * @param[in,out] poses   The receiver.
 * @param         time    Bus time; NULL: there is none.
 * @param[in,out] faults  Counted up.
 * @return Was it one of this viewer's, good or bad?
 */
bool pose_from_frame(can_poses_t *poses, const bus_master_t *time, const hal_can_frame_t *frame, can_faults_t *faults);

/** Count what a decoder has found. */
void can_faults_count(can_faults_t *faults, can_check_t check);

/** @return The sum of the counters auth_..., modulo 2^32. */
uint32_t can_faults_refused(const can_faults_t *faults);

/** @return The sum of all counters but tracking_lost, modulo 2^32: the figure of the status message. */
uint32_t can_faults_total(const can_faults_t *faults);

#endif
