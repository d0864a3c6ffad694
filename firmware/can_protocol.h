// SPDX-License-Identifier: Apache-2.0
// The bytes on the bus: every message of wallwarp.dbc, encoded and decoded.
//
// Pure functions, integers only. Every message carries a counter and a CRC (can_e2e.h). The caller keeps the counters.
// An encoder writes its frame only when it returns true; a decoder writes its struct only when it returns CAN_CHECK_OK.
#ifndef FIRMWARE_CAN_PROTOCOL_H
#define FIRMWARE_CAN_PROTOCOL_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_e2e.h"
#include "firmware/degrade.h"
#include "firmware/stage_times.h"
#include "hal/hal_can.h"
#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/method.h"

/** Identifiers (11 bits) and cycle times. */
enum {
    CAN_ID_SYNC = 0x040,      /**< + number of the sender, which is also its rank: 0 a tracker, else a board's node */
    CAN_ID_FOLLOW_UP = 0x080, /**< + number of the sender */
    CAN_ID_POSE_FD = 0x100,   /**< + viewer: the pose as one CAN FD frame of 32 bytes */
    CAN_ID_POSE_SET = 0x110,  /**< + 4 * viewer + part: the pose as three classic frames */
    CAN_ID_STATUS = 0x400,    /**< + node */
    CAN_ID_STAGE = 0x440,     /**< + node */
    CAN_ID_QUALITY = 0x480,   /**< + node */
    CAN_ID_TIME = 0x4C0,      /**< + node */
    CAN_ID_HEARTBEAT = 0x700, /**< + node */
    CAN_VIEWERS = 4,          /**< there is room for viewers 0 to 3 */
    CAN_MAX_NODE = 63,        /**< node numbers are 1 to 63 */
    CAN_POSE_PARTS = 3,       /**< frames of a set: A, B, C */
    CAN_SYNC_PERIOD_MS = 125, /**< three may be lost before a master counts as silent; 0.4 % of a 500 kbit/s bus */
    CAN_STATUS_PERIOD_MS = 100,
    CAN_STAGE_PERIOD_MS = 250,
    CAN_QUALITY_PERIOD_MS = 1000,
    CAN_TIME_PERIOD_MS = 1000,
    CAN_HEARTBEAT_PERIOD_MS = 500
};

/** What a decoder found. */
typedef enum {
    CAN_CHECK_OK = 0,
    CAN_CHECK_OTHER,   /**< not this message: another identifier, or an extended one */
    CAN_CHECK_LENGTH,  /**< wrong length, or classic where FD is due, or the reverse */
    CAN_CHECK_CRC,     /**< damaged, or sent under a wrong identifier */
    CAN_CHECK_COUNTER, /**< the counter is 15, or the parts of a set are not of one set */
    CAN_CHECK_VALUE    /**< the CRC is right and yet a value is not a legal one */
} can_check_t;

/** How good a pose is. Other values are reserved. */
typedef enum {
    CAN_POSE_LOST = 0,     /**< the tracker does not see the viewer: the pose means nothing */
    CAN_POSE_TRACKED = 1,  /**< measured */
    CAN_POSE_PREDICTED = 2 /**< the tracker's own guess over a gap */
} can_pose_quality_t;

/** Capture times wrap: the FD frame carries 2^32 us, the set 2^16 x 100 us. */
static const uint64_t CAN_POSE_FD_WRAP_US = UINT64_C(1) << 32;
static const uint64_t CAN_POSE_SET_WRAP_US = UINT64_C(100) << 16;

/** A pose as it travels. */
typedef struct {
    pose_t pose;
    uint64_t capture_time_us; /**< in bus time; decoded: less than the message's wrap */
    can_pose_quality_t quality;
    uint8_t viewer;  /**< 0 to CAN_VIEWERS - 1 */
    uint8_t tracker; /**< which tracker measured it, 0 to 15; the set does not carry it: decoded as 0 */
    uint8_t counter; /**< FD frame 0 to 255, set 0 to 14 */
} can_pose_t;

/**
 * Pose -> three classic frames: A, B, C. They share the pose's counter.
 *
 * Positions are rounded to 0.01 mm and must lie within +-83.886 m; the quaternion's components are rounded to 1/32768
 * and must lie within [-1.01, 1.01]; +1 becomes 32767/32768, more makes all four 1 % smaller. The capture time is
 * rounded to 100 us.
 *
 * @param[out] part  Three frames.
 * @return false when a value does not fit: position, quaternion, viewer, counter or quality.
 */
bool can_pose_set_encode(hal_can_frame_t part[CAN_POSE_PARTS], const can_pose_t *pose);

/**
 * Check one frame of a viewer's set: identifier, length, CRC, counter.
 *
 * @param[out] part     0 to 2 for A to C.
 * @param[out] counter  Its set counter, 0 to 14.
 * @return CAN_CHECK_OK, or why not; CAN_CHECK_VALUE is not among them.
 */
can_check_t can_pose_part_check(const hal_can_frame_t *frame, uint8_t viewer, int *part, uint8_t *counter);

/**
 * Three frames of one set -> pose. Checks each of them, and that they are A, B and C, in this order, of one counter.
 *
 * That the frames are of one set and not 15 sets apart, the counter cannot tell: their times must (pose_from_can.h).
 */
can_check_t can_pose_set_decode(can_pose_t *pose, const hal_can_frame_t part[CAN_POSE_PARTS], uint8_t viewer);

/**
 * Pose -> one CAN FD frame of 32 bytes, with bit rate switch.
 *
 * Positions are rounded to 1 um and must lie within +-2147 m; quaternion components are rounded to 2^-22.
 *
 * @return false when a value does not fit: position, quaternion, viewer, tracker or quality.
 */
bool can_pose_fd_encode(hal_can_frame_t *frame, const can_pose_t *pose);

can_check_t can_pose_fd_decode(can_pose_t *pose, const hal_can_frame_t *frame, uint8_t viewer);

/** The first message of a pair that carries bus time (bus_time.h): the moment of its last bit is the one meant. */
typedef struct {
    uint8_t number;  /**< of the sender, 0 to CAN_MAX_NODE */
    uint8_t counter; /**< 0 to 14 */
    uint8_t origin;  /**< number of the node on whose clock this bus time began, 0 to CAN_MAX_NODE */
} can_sync_t;

/** @return false when number, counter or origin is out of range. */
bool can_sync_encode(hal_can_frame_t *frame, const can_sync_t *sync);

can_check_t can_sync_decode(can_sync_t *sync, const hal_can_frame_t *frame);

/** The second message: what bus time it was at that moment. */
typedef struct {
    uint8_t number;   /**< of the sender, 0 to CAN_MAX_NODE */
    uint8_t counter;  /**< that of the Sync, 0 to 14 */
    uint64_t time_us; /**< less than 2^48, which is 8.9 years */
} can_follow_up_t;

/** @return false when number, counter or time is out of range. */
bool can_follow_up_encode(hal_can_frame_t *frame, const can_follow_up_t *follow_up);

can_check_t can_follow_up_decode(can_follow_up_t *follow_up, const hal_can_frame_t *frame);

/** What a board is doing. */
typedef enum {
    CAN_BOARD_WAITING = 0, /**< no pose has come yet */
    CAN_BOARD_RUNNING = 1,
    CAN_BOARD_HOLDING = 2, /**< poses have stopped; the wall keeps the last one for a while */
    CAN_BOARD_SAFE = 3,    /**< poses have been away for long: the safe picture is on */
    CAN_BOARD_FAULT = 4,   /**< something of the board itself has failed, see the fault flags */
    CAN_BOARD_FROZEN = 5,  /**< an operator has stopped the picture: the wall keeps its last one */
    CAN_BOARD_PATTERN = 6, /**< an operator wants a picture for setting up the projector */
    CAN_BOARD_STATES
} can_board_state_t;

/** @return In one word: "running"; "unknown" when out of range. */
const char *can_board_state_name(can_board_state_t state);

/** Faults of the board: the camera's, the session's and the configuration's as they are at the moment of sending, the
 *  others since the last heartbeat. Bits are never reused for something else. */
typedef enum {
    CAN_FAULT_BUS = 1 << 0,      /**< frames were refused or lost */
    CAN_FAULT_BUS_OFF = 1 << 1,  /**< the controller was bus-off */
    CAN_FAULT_CAMERA = 1 << 2,   /**< no new picture */
    CAN_FAULT_DISPLAY = 1 << 3,  /**< the panel refused a picture */
    CAN_FAULT_GPIO = 1 << 4,     /**< a line could not be driven */
    CAN_FAULT_WATCHDOG = 1 << 5, /**< the watchdog could not be fed */
    CAN_FAULT_DEADLINE = 1 << 6, /**< a picture was not ready at its vertical blank */
    CAN_FAULT_REFUSED = 1 << 7,  /**< messages or commands were not authentic (bus_auth.h) */
    CAN_FAULT_SESSION = 1 << 8,  /**< the board has a key, and wants to be told a session */
    CAN_FAULT_CONFIG = 1 << 9    /**< the board can't do its work: configuration, room, key or a device (notice.h) */
} can_fault_flag_t;

/** A board's sign of life, every CAN_HEARTBEAT_PERIOD_MS. */
typedef struct {
    uint8_t node;    /**< 1 to CAN_MAX_NODE */
    uint8_t counter; /**< 0 to 14 */
    can_board_state_t state;
    uint32_t fault_flags;  /**< of can_fault_flag_t; 16 bits are sent */
    uint32_t frame_number; /**< pictures shown; sent modulo 2^16 */
    uint32_t uptime_s;     /**< sent modulo 2^16 */
} can_heartbeat_t;

/** @return false when node, counter, state or fault flags are out of range. */
bool can_heartbeat_encode(hal_can_frame_t *frame, const can_heartbeat_t *heartbeat);

can_check_t can_heartbeat_decode(can_heartbeat_t *heartbeat, const hal_can_frame_t *frame);

/** A board's measurements, every CAN_STATUS_PERIOD_MS. What is too large for its field is sent as the largest value. */
typedef struct {
    uint8_t node;          /**< 1 to CAN_MAX_NODE */
    uint8_t counter;       /**< 0 to 14 */
    uint8_t pose_counter;  /**< of the pose in the newest corrected picture */
    uint32_t pose_age_ms;  /**< of the newest pose since it was received, when the step began; up to 1023 */
    uint32_t step_q8;      /**< step k of the newest corrected picture (eq 4, 5), in 1/256; up to 16383, nearly 64 */
    uint32_t warp_time_us; /**< what the newest picture took to make; rounded to 100 us, up to 102300 */
    uint32_t can_faults;   /**< sum of all CAN fault counters; sent modulo 1024 */
} can_status_t;

/** @return false when node or counter is out of range. */
bool can_status_encode(hal_can_frame_t *frame, const can_status_t *status);

can_check_t can_status_decode(can_status_t *status, const hal_can_frame_t *frame);

/** Where a board's time goes: one stage every CAN_STAGE_PERIOD_MS, in turn, all of one second. What is too large for
 * its field is sent as the largest value. */
typedef struct {
    uint8_t node;     /**< 1 to CAN_MAX_NODE */
    uint8_t counter;  /**< 0 to 14 */
    stage_t stage;    /**< whose times these are */
    uint32_t mean_us; /**< of the second's steps; up to 65535 */
    uint32_t worst_us;
    uint32_t shown; /**< pictures shown in the second, up to 255 */
    uint32_t late;  /**< of them after the vertical blank that they were made for */
} can_stage_t;

/** @return false when node, counter or stage is out of range. */
bool can_stage_encode(hal_can_frame_t *frame, const can_stage_t *stage);

can_check_t can_stage_decode(can_stage_t *stage, const hal_can_frame_t *frame);

/** What a board corrects with, every CAN_QUALITY_PERIOD_MS. What is too large for its field is sent as the largest. */
typedef struct {
    uint8_t node;    /**< 1 to CAN_MAX_NODE */
    uint8_t counter; /**< 0 to 14 */
    uint8_t step;    /**< down from the method that is wanted, 0 to DEGRADE_MAX_STEPS - 1 */
    warp_filter_t filter;
    warp_resampler_t resampler;
    uint32_t changes;   /**< of the step since start; sent modulo 2^16 */
    uint32_t wanted_us; /**< what step 0 is expected to take, all stages but the wait; up to 65535 */
    uint32_t hold_s;    /**< how long a better step must be within reach before it is taken; in units of 4 s */
} can_quality_t;

/** @return false when node, counter, step or method is out of range. */
bool can_quality_encode(hal_can_frame_t *frame, const can_quality_t *quality);

can_check_t can_quality_decode(can_quality_t *quality, const hal_can_frame_t *frame);

/** How a board stands to bus time. */
typedef enum {
    CAN_TIME_NONE = 0,    /**< it has none, or is still finding it */
    CAN_TIME_OWN = 1,     /**< it is the master */
    CAN_TIME_LOCKED = 2,  /**< it follows the master */
    CAN_TIME_HOLDOVER = 3 /**< the master is silent: it goes on with what it knows */
} can_time_state_t;

/** What a board makes of bus time, every CAN_TIME_PERIOD_MS. What is too large is sent as the largest. */
typedef struct {
    uint8_t node;    /**< 1 to CAN_MAX_NODE */
    uint8_t counter; /**< 0 to 14 */
    can_time_state_t state;
    uint8_t master;    /**< whom it follows or followed last, 0 to CAN_MAX_NODE; its own node when it is the master */
    int32_t drift_ppb; /**< by how much the board's clock is faster than bus time; rounded to 100, up to +-819100 */
    uint32_t error_us; /**< within which its bus time is right, by its own estimate; up to 1023 */
    uint32_t changes;  /**< of the master since start; sent modulo 64 */
    uint32_t relocks;  /**< times it found bus time anew after a jump or a long silence; sent modulo 16 */
    uint32_t lost;     /**< pairs of Sync and FollowUp that did not come whole since start; sent modulo 256 */
} can_time_t;

/** @return false when node, counter, state or master is out of range. */
bool can_time_encode(hal_can_frame_t *frame, const can_time_t *time);

can_check_t can_time_decode(can_time_t *time, const hal_can_frame_t *frame);

#endif
