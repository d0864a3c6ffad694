// SPDX-License-Identifier: Apache-2.0
// The message by which a board says how its update stands.
#ifndef FIRMWARE_CAN_UPDATE_H
#define FIRMWARE_CAN_UPDATE_H

#include "firmware/can_protocol.h"
#include "firmware/update.h"

enum {
    CAN_ID_UPDATE = 0x680,      /**< + node */
    CAN_UPDATE_PERIOD_MS = 1000 /**< and at once when state or plan is another */
};

/** What the board's update agent does. */
typedef enum {
    CAN_UPDATE_NO_AGENT = 0,
    CAN_UPDATE_IDLE = 1,
    CAN_UPDATE_INSTALLING = 2,
    CAN_UPDATE_READY = 3,     /**< a version waits in the other slot */
    CAN_UPDATE_FAILED = 4,    /**< COMMAND_UPDATE_STATUS tells why */
    CAN_UPDATE_SWITCHING = 5, /**< the board is about to start anew */
    CAN_UPDATE_STATES
} can_update_state_t;

typedef struct {
    uint8_t node;    /**< 1 to CAN_MAX_NODE */
    uint8_t counter; /**< 0 to 14 */
    can_update_state_t state;
    uint8_t progress; /**< of the install, 0 to 100 % */
    uint8_t slot;     /**< 1: A, 2: B, 0: unknown */
    bool trial;       /**< the running version is not marked good yet */
    update_plan_t plan;
    uint16_t running, waiting; /**< can_update_fingerprint() of the versions */
} can_update_t;

/** @return In one word: "ready"; "unknown" when out of range. */
const char *can_update_state_name(can_update_state_t state);

/** @return What is to be said of a board. */
can_update_state_t can_update_state_of(const update_t *update);

/** @return 16 bits in which two versions hardly ever agree: the CRC of E2E profile 5 of its text, with data id 0; 0 for
 *          no version at all. @param version  Of HAL_UPDATE_VERSION_LENGTH. */
uint16_t can_update_fingerprint(const char *version);

/** @return false when node, counter, state, progress, slot or plan is out of range. */
bool can_update_encode(hal_can_frame_t *frame, const can_update_t *update);

can_check_t can_update_decode(can_update_t *update, const hal_can_frame_t *frame);

#endif
