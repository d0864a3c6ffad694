// SPDX-License-Identifier: Apache-2.0
// Encoders and decoders of FrameClock and Step.
#include "firmware/can_frame_clock.h"

#include "firmware/can_classic.h"

/* The signals of wallwarp.dbc. */
static const can_field_t CLOCK_EPOCH = {12, 4}, CLOCK_FROM = {16, 12}, CLOCK_TARGET = {28, 8}, CLOCK_PHASE = {36, 13},
                         CLOCK_LAG = {49, 12}, CLOCK_SURE = {61, 1}, CLOCK_TO_COME = {62, 1}, CLOCK_CHANGES = {63, 1};
static const can_field_t STEP_IN_STEP = {12, 1}, STEP_TAGGED = {13, 1}, STEP_REFRESH = {16, 16},
                         STEP_PICTURE = {32, 16}, STEP_POSE = {48, 16};

enum { POSE_UNIT_US = 100 };
enum { MOST_PHASE_US = 8191 * CAN_FRAME_CLOCK_PHASE_UNIT_US, MOST_LAG_US = 4095 * CAN_FRAME_CLOCK_LAG_UNIT_US };

bool can_frame_clock_encode(hal_can_frame_t *frame, const can_frame_clock_t *clock)
{
    if (!can_classic_node_fits(clock->node, clock->counter) || clock->epoch >= CAN_EPOCHS ||
        clock->from >= CAN_FRAME_CLOCK_NUMBERS || clock->phase_us > MOST_PHASE_US || clock->lag_us > MOST_LAG_US)
        return false;
    *frame = can_classic_frame(CAN_ID_FRAME_CLOCK + (uint32_t)clock->node, clock->counter);
    can_field_put(frame, CLOCK_EPOCH, clock->epoch);
    can_field_put(frame, CLOCK_FROM, clock->from);
    can_field_put(frame, CLOCK_TARGET, clock->target_ms);
    can_field_put(frame, CLOCK_PHASE, clock->phase_us / CAN_FRAME_CLOCK_PHASE_UNIT_US);
    can_field_put(frame, CLOCK_LAG, clock->lag_us / CAN_FRAME_CLOCK_LAG_UNIT_US);
    can_field_put(frame, CLOCK_SURE, clock->sure);
    can_field_put(frame, CLOCK_TO_COME, clock->to_come);
    can_field_put(frame, CLOCK_CHANGES, clock->changes);
    can_classic_protect(frame);
    return true;
}

can_check_t can_frame_clock_decode(can_frame_clock_t *clock, const hal_can_frame_t *frame)
{
    const can_check_t found = can_classic_check_node(frame, CAN_ID_FRAME_CLOCK);
    if (found != CAN_CHECK_OK)
        return found;
    *clock = (can_frame_clock_t){
        .node = (uint8_t)(frame->id - CAN_ID_FRAME_CLOCK),
        .counter = can_classic_counter(frame),
        .epoch = (uint8_t)can_field_get(frame, CLOCK_EPOCH),
        .from = (uint16_t)can_field_get(frame, CLOCK_FROM),
        .phase_us = (uint16_t)(can_field_get(frame, CLOCK_PHASE) * CAN_FRAME_CLOCK_PHASE_UNIT_US),
        .lag_us = (uint16_t)(can_field_get(frame, CLOCK_LAG) * CAN_FRAME_CLOCK_LAG_UNIT_US),
        .target_ms = (uint8_t)can_field_get(frame, CLOCK_TARGET),
        .sure = can_field_get(frame, CLOCK_SURE) == 1,
        .to_come = can_field_get(frame, CLOCK_TO_COME) == 1,
        .changes = can_field_get(frame, CLOCK_CHANGES) == 1,
    };
    return CAN_CHECK_OK;
}

bool can_step_encode(hal_can_frame_t *frame, const can_step_t *step)
{
    if (!can_classic_node_fits(step->node, step->counter))
        return false;
    *frame = can_classic_frame(CAN_ID_STEP + (uint32_t)step->node, step->counter);
    can_field_put(frame, STEP_IN_STEP, step->in_step);
    can_field_put(frame, STEP_TAGGED, step->tagged);
    can_field_put(frame, STEP_REFRESH, step->refresh);
    can_field_put(frame, STEP_PICTURE, step->picture);
    can_field_put(frame, STEP_POSE, (int64_t)(step->pose_us / POSE_UNIT_US));
    can_classic_protect(frame);
    return true;
}

can_check_t can_step_decode(can_step_t *step, const hal_can_frame_t *frame)
{
    const can_check_t found = can_classic_check_node(frame, CAN_ID_STEP);
    if (found != CAN_CHECK_OK)
        return found;
    *step = (can_step_t){
        .node = (uint8_t)(frame->id - CAN_ID_STEP),
        .counter = can_classic_counter(frame),
        .in_step = can_field_get(frame, STEP_IN_STEP) == 1,
        .tagged = can_field_get(frame, STEP_TAGGED) == 1,
        .refresh = can_field_get(frame, STEP_REFRESH),
        .picture = can_field_get(frame, STEP_PICTURE),
        .pose_us = (uint64_t)can_field_get(frame, STEP_POSE) * POSE_UNIT_US,
    };
    return CAN_CHECK_OK;
}
