// SPDX-License-Identifier: Apache-2.0
// How a board's update stands, as bytes: the reply to every COMMAND_UPDATE that was done.
//
// | byte     |                                                                                                     |
// |----------|-----------------------------------------------------------------------------------------------------|
// | 0        | can_update_state_t                                                                                  |
// | 1        | progress of the install, 0 to 100 %                                                                 |
// | 2        | slot: 'A', 'B' or '?'                                                                               |
// | 3        | bit 0: on trial; bit 1: bus time is known within 1 ms; bits 4 and 5: update_plan_t                  |
// | 4 to 11  | bus time now, us                                                                                    |
// | 12 to 19 | moment of the planned switch in bus time, us; 0: none                                               |
// | 20 on    | versions running, waiting and in the other slot, then the agent's message: each its length, its text |
#ifndef FIRMWARE_UPDATE_STATUS_H
#define FIRMWARE_UPDATE_STATUS_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_update.h"
#include "firmware/update.h"

enum { UPDATE_STATUS_BYTES = 256 };

typedef struct {
    can_update_state_t state;
    int32_t progress;
    char slot;
    bool trial, knows_time;
    update_plan_t plan;
    uint64_t bus_time_us, switch_bus_us;
    char running[HAL_UPDATE_VERSION_LENGTH], waiting[HAL_UPDATE_VERSION_LENGTH], other[HAL_UPDATE_VERSION_LENGTH];
    char message[HAL_UPDATE_MESSAGE_LENGTH];
} update_status_t;

/** @return What is to be said of the board now. */
update_status_t update_status_of(const projector_t *projector, int64_t now_us);

/** @return Bytes. @param status  Its numbers in their ranges, its texts with a zero at their end. */
int update_status_encode(uint8_t bytes[UPDATE_STATUS_BYTES], const update_status_t *status);

/**
 * @param[out] status  Written only when true is returned. What is not printable ASCII in its texts is '?'.
 * @return false when the bytes are too few, or a number is out of its range. More bytes behind are passed over.
 */
bool update_status_decode(update_status_t *status, const uint8_t *bytes, int length);

#endif
