// SPDX-License-Identifier: Apache-2.0
// The message by which a board says how late it is, what makes it so, and why it is not in step.
#ifndef FIRMWARE_CAN_LATENCY_H
#define FIRMWARE_CAN_LATENCY_H

#include "firmware/can_protocol.h"

enum {
    CAN_ID_LATENCY = 0x540, /**< + node */
    CAN_LATENCY_PERIOD_MS = 1000,
    CAN_LATENCY_MOST_HELD = 7,
    CAN_LATENCY_LAG_UNIT_US = 64, /**< in which times are sent, see below */
    CAN_LATENCY_DISPLAY_UNIT_US = 500,
    CAN_LATENCY_PHOTON_UNIT_US = 250,
    CAN_LATENCY_OFF_UNIT_US = 128
};

/** What keeps a board from being in step: the first of these that is so. Values are never reused. */
typedef enum {
    CAN_STEP_OK = 0,      /**< nothing */
    CAN_STEP_NO_TIME = 1, /**< it has no bus time, or not exactly enough */
    CAN_STEP_NO_CLOCK,    /**< it hears no FrameClock, or as leader is not heard; or an epoch has just begun */
    CAN_STEP_PANEL,       /**< its panel begins refreshes more than a quarter of a period early or late */
    CAN_STEP_PICTURE,     /**< its camera did not deliver the picture that is due, or delivered it too late */
    CAN_STEP_POSE,        /**< the pose that is due has no capture time, was lost, or came too late */
    CAN_STEP_NOT_SHOWN    /**< its panel does not show the corrected picture, or got it too late; see Heartbeat */
} can_step_fault_t;

/** How late a board is, every CAN_LATENCY_PERIOD_MS. What is too large for its field is sent as the largest value. */
typedef struct {
    uint8_t node;    /**< 1 to CAN_MAX_NODE */
    uint8_t counter; /**< 0 to 14 */
    can_step_fault_t fault;
    uint8_t held;        /**< refreshes by which it shows pictures later, to be as late as the room; 0 to MOST_HELD */
    bool genlocked;      /**< it has a house signal */
    uint32_t lag_us;     /**< from capture to the refresh that can show the picture: what its camera takes; 0: it has no
                              pictures; sent in LAG_UNIT_US, rounded up, up to 65472 */
    uint32_t display_us; /**< what its projector takes after the board, as the room file says; sent in DISPLAY_UNIT_US,
                             up to 255500 */
    uint32_t wanted_ms;  /**< pose to photon that an operator wants of it; 0: the least; up to 255 */
    uint32_t photon_us;  /**< from the capture of the pose to the middle of the refresh as it is seen, mean of the last
                             second; sent in PHOTON_UNIT_US, up to 255750; 0: nothing was shown */
    int32_t off_us;      /**< by how much its blanks are later than the room's refreshes; sent in OFF_UNIT_US, up to
                             +-8064 */
} can_latency_t;

/** @return false when node, counter, fault or held is out of range. */
bool can_latency_encode(hal_can_frame_t *frame, const can_latency_t *latency);

can_check_t can_latency_decode(can_latency_t *latency, const hal_can_frame_t *frame);

#endif
