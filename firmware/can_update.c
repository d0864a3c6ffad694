// SPDX-License-Identifier: Apache-2.0
// Encoder and decoder of Update.
#include "firmware/can_update.h"

#include <string.h>

#include "firmware/can_classic.h"

/* The signals of wallwarp.dbc. */
static const can_field_t UPDATE_STATE = {12, 4}, UPDATE_PROGRESS = {16, 7}, UPDATE_TRIAL = {23, 1},
                         UPDATE_SLOT = {24, 2}, UPDATE_PLAN = {26, 2}, UPDATE_RUNNING = {32, 16},
                         UPDATE_WAITING = {48, 16};

enum { MOST_PERCENT = 100, MOST_SLOT = 2 };

const char *can_update_state_name(can_update_state_t state)
{
    static const char *const names[CAN_UPDATE_STATES] = {"no agent", "idle",   "installing",
                                                         "ready",    "failed", "switching"};
    return (unsigned)state < CAN_UPDATE_STATES ? names[state] : "unknown";
}

can_update_state_t can_update_state_of(const update_t *update)
{
    _Static_assert((int)CAN_UPDATE_IDLE == (int)HAL_UPDATE_IDLE + 1 &&
                       (int)CAN_UPDATE_STATES == (int)HAL_UPDATE_DOINGS + 1,
                   "the agent's states follow one another as they do on the bus");
    return update->agent ? (can_update_state_t)(update->said.doing + 1) : CAN_UPDATE_NO_AGENT;
}

uint16_t can_update_fingerprint(const char *version)
{
    enum { PLACE_OF_CRC = 2 };
    uint8_t bytes[PLACE_OF_CRC + HAL_UPDATE_VERSION_LENGTH] = {0};
    const size_t length = strlen(version);
    memcpy(bytes + PLACE_OF_CRC, version, length);
    return length == 0 ? 0 : can_e2e_p05_crc(0, bytes, PLACE_OF_CRC + (int)length);
}

bool can_update_encode(hal_can_frame_t *frame, const can_update_t *update)
{
    if (!can_classic_node_fits(update->node, update->counter) || (unsigned)update->state >= CAN_UPDATE_STATES ||
        update->progress > MOST_PERCENT || update->slot > MOST_SLOT || (unsigned)update->plan >= UPDATE_PLANS)
        return false;
    *frame = can_classic_frame(CAN_ID_UPDATE + (uint32_t)update->node, update->counter);
    can_field_put(frame, UPDATE_STATE, update->state);
    can_field_put(frame, UPDATE_PROGRESS, update->progress);
    can_field_put(frame, UPDATE_TRIAL, update->trial);
    can_field_put(frame, UPDATE_SLOT, update->slot);
    can_field_put(frame, UPDATE_PLAN, update->plan);
    can_field_put(frame, UPDATE_RUNNING, update->running);
    can_field_put(frame, UPDATE_WAITING, update->waiting);
    can_classic_protect(frame);
    return true;
}

can_check_t can_update_decode(can_update_t *update, const hal_can_frame_t *frame)
{
    const can_check_t check = can_classic_check_node(frame, CAN_ID_UPDATE);
    if (check != CAN_CHECK_OK)
        return check;
    const can_update_t read = {
        .node = (uint8_t)(frame->id - CAN_ID_UPDATE),
        .counter = can_classic_counter(frame),
        .state = (can_update_state_t)can_field_get(frame, UPDATE_STATE),
        .progress = (uint8_t)can_field_get(frame, UPDATE_PROGRESS),
        .slot = (uint8_t)can_field_get(frame, UPDATE_SLOT),
        .trial = can_field_get(frame, UPDATE_TRIAL) != 0,
        .plan = (update_plan_t)can_field_get(frame, UPDATE_PLAN),
        .running = (uint16_t)can_field_get(frame, UPDATE_RUNNING),
        .waiting = (uint16_t)can_field_get(frame, UPDATE_WAITING),
    };
    if (read.state >= CAN_UPDATE_STATES || read.progress > MOST_PERCENT || read.slot > MOST_SLOT ||
        read.plan >= UPDATE_PLANS)
        return CAN_CHECK_VALUE;
    *update = read;
    return CAN_CHECK_OK;
}
