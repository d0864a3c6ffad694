// SPDX-License-Identifier: Apache-2.0
// Encoders and decoders of the messages in wallwarp.dbc that carry bus time.
#include "firmware/can_classic.h"

/* The signals of wallwarp.dbc. */
static const can_field_t SYNC_ORIGIN = {12, 8};

/* One signal in the DBC file; a field here holds 32 bits at most. */
static const can_field_t FOLLOW_UP_TIME_LOW = {16, 32}, FOLLOW_UP_TIME_HIGH = {48, 16};

static bool header_fits(uint8_t number, uint8_t counter)
{
    return number <= CAN_MAX_NODE && counter < CAN_E2E_P01_COUNTERS;
}

/* Is it the message whose identifier is base + number, and whole? */
static can_check_t check_message(const hal_can_frame_t *frame, uint32_t base)
{
    if (frame->extended || frame->id < base || frame->id - base > CAN_MAX_NODE)
        return CAN_CHECK_OTHER;
    return can_classic_check(frame);
}

bool can_sync_encode(hal_can_frame_t *frame, const can_sync_t *sync)
{
    if (!header_fits(sync->number, sync->counter) || sync->origin > CAN_MAX_NODE)
        return false;
    *frame = can_classic_frame(CAN_ID_SYNC + (uint32_t)sync->number, sync->counter);
    can_field_put(frame, SYNC_ORIGIN, sync->origin);
    can_classic_protect(frame);
    return true;
}

can_check_t can_sync_decode(can_sync_t *sync, const hal_can_frame_t *frame)
{
    const can_check_t check = check_message(frame, CAN_ID_SYNC);
    if (check != CAN_CHECK_OK)
        return check;
    const uint32_t origin = can_field_get(frame, SYNC_ORIGIN);
    if (origin > CAN_MAX_NODE)
        return CAN_CHECK_VALUE;
    *sync = (can_sync_t){
        .number = (uint8_t)(frame->id - CAN_ID_SYNC), .counter = can_classic_counter(frame), .origin = (uint8_t)origin};
    return CAN_CHECK_OK;
}

bool can_follow_up_encode(hal_can_frame_t *frame, const can_follow_up_t *follow_up)
{
    if (!header_fits(follow_up->number, follow_up->counter) || follow_up->time_us >> 48 != 0)
        return false;
    *frame = can_classic_frame(CAN_ID_FOLLOW_UP + (uint32_t)follow_up->number, follow_up->counter);
    can_field_put(frame, FOLLOW_UP_TIME_LOW, (int64_t)follow_up->time_us);
    can_field_put(frame, FOLLOW_UP_TIME_HIGH, (int64_t)(follow_up->time_us >> FOLLOW_UP_TIME_LOW.length));
    can_classic_protect(frame);
    return true;
}

can_check_t can_follow_up_decode(can_follow_up_t *follow_up, const hal_can_frame_t *frame)
{
    const can_check_t check = check_message(frame, CAN_ID_FOLLOW_UP);
    if (check != CAN_CHECK_OK)
        return check;
    const uint64_t high = can_field_get(frame, FOLLOW_UP_TIME_HIGH);
    *follow_up = (can_follow_up_t){
        .number = (uint8_t)(frame->id - CAN_ID_FOLLOW_UP),
        .counter = can_classic_counter(frame),
        .time_us = high << FOLLOW_UP_TIME_LOW.length | can_field_get(frame, FOLLOW_UP_TIME_LOW),
    };
    return CAN_CHECK_OK;
}
