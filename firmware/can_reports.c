// SPDX-License-Identifier: Apache-2.0
// Encoders and decoders of the boards' reports in wallwarp.dbc.
#include "firmware/can_classic.h"

/* The signals of wallwarp.dbc. */
static const can_field_t HEARTBEAT_STATE = {12, 4}, HEARTBEAT_FRAME = {16, 16}, HEARTBEAT_FAULTS = {32, 16},
                         HEARTBEAT_UPTIME = {48, 16};

static const can_field_t STATUS_WARP_TIME = {12, 10}, STATUS_POSE_AGE = {22, 10}, STATUS_STEP = {32, 14},
                         STATUS_FAULTS = {46, 10}, STATUS_POSE_COUNTER = {56, 8};

static const can_field_t STAGE_NUMBER = {12, 4}, STAGE_MEAN = {16, 16}, STAGE_WORST = {32, 16}, STAGE_SHOWN = {48, 8},
                         STAGE_LATE = {56, 8};

static const can_field_t QUALITY_STEP = {12, 4}, QUALITY_RESAMPLER = {16, 4}, QUALITY_FILTER = {20, 4},
                         QUALITY_CHANGES = {24, 16}, QUALITY_WANTED = {40, 16}, QUALITY_HOLD = {56, 8};

static const can_field_t TIME_STATE = {12, 4}, TIME_MASTER = {16, 6}, TIME_CHANGES = {22, 6}, TIME_RELOCKS = {28, 4},
                         TIME_DRIFT = {32, 14}, TIME_ERROR = {46, 10}, TIME_LOST = {56, 8};

enum { HOLD_UNIT_S = 4, DRIFT_UNIT_PPB = 100, DRIFT_LARGEST = 8191 };

bool can_heartbeat_encode(hal_can_frame_t *frame, const can_heartbeat_t *heartbeat)
{
    if (!can_classic_node_fits(heartbeat->node, heartbeat->counter) || (unsigned)heartbeat->state >= CAN_BOARD_STATES ||
        heartbeat->fault_flags > UINT16_MAX)
        return false;
    *frame = can_classic_frame(CAN_ID_HEARTBEAT + (uint32_t)heartbeat->node, heartbeat->counter);
    can_field_put(frame, HEARTBEAT_STATE, heartbeat->state);
    can_field_put(frame, HEARTBEAT_FRAME, heartbeat->frame_number);
    can_field_put(frame, HEARTBEAT_FAULTS, heartbeat->fault_flags);
    can_field_put(frame, HEARTBEAT_UPTIME, heartbeat->uptime_s);
    can_classic_protect(frame);
    return true;
}

can_check_t can_heartbeat_decode(can_heartbeat_t *heartbeat, const hal_can_frame_t *frame)
{
    const can_check_t check = can_classic_check_node(frame, CAN_ID_HEARTBEAT);
    if (check != CAN_CHECK_OK)
        return check;
    const uint32_t state = can_field_get(frame, HEARTBEAT_STATE);
    if (state >= CAN_BOARD_STATES)
        return CAN_CHECK_VALUE;
    *heartbeat = (can_heartbeat_t){
        .node = (uint8_t)(frame->id - CAN_ID_HEARTBEAT),
        .counter = can_classic_counter(frame),
        .state = (can_board_state_t)state,
        .fault_flags = can_field_get(frame, HEARTBEAT_FAULTS),
        .frame_number = can_field_get(frame, HEARTBEAT_FRAME),
        .uptime_s = can_field_get(frame, HEARTBEAT_UPTIME),
    };
    return CAN_CHECK_OK;
}

bool can_status_encode(hal_can_frame_t *frame, const can_status_t *status)
{
    if (!can_classic_node_fits(status->node, status->counter))
        return false;
    const uint32_t warp_time = (uint32_t)(((uint64_t)status->warp_time_us + 50) / 100);
    *frame = can_classic_frame(CAN_ID_STATUS + (uint32_t)status->node, status->counter);
    can_field_put(frame, STATUS_WARP_TIME, can_field_saturated(STATUS_WARP_TIME, warp_time));
    can_field_put(frame, STATUS_POSE_AGE, can_field_saturated(STATUS_POSE_AGE, status->pose_age_ms));
    can_field_put(frame, STATUS_STEP, can_field_saturated(STATUS_STEP, status->step_q8));
    can_field_put(frame, STATUS_FAULTS, status->can_faults);
    can_field_put(frame, STATUS_POSE_COUNTER, status->pose_counter);
    can_classic_protect(frame);
    return true;
}

can_check_t can_status_decode(can_status_t *status, const hal_can_frame_t *frame)
{
    const can_check_t check = can_classic_check_node(frame, CAN_ID_STATUS);
    if (check != CAN_CHECK_OK)
        return check;
    *status = (can_status_t){
        .node = (uint8_t)(frame->id - CAN_ID_STATUS),
        .counter = can_classic_counter(frame),
        .pose_counter = (uint8_t)can_field_get(frame, STATUS_POSE_COUNTER),
        .pose_age_ms = can_field_get(frame, STATUS_POSE_AGE),
        .step_q8 = can_field_get(frame, STATUS_STEP),
        .warp_time_us = can_field_get(frame, STATUS_WARP_TIME) * 100,
        .can_faults = can_field_get(frame, STATUS_FAULTS),
    };
    return CAN_CHECK_OK;
}

bool can_stage_encode(hal_can_frame_t *frame, const can_stage_t *stage)
{
    if (!can_classic_node_fits(stage->node, stage->counter) || (unsigned)stage->stage >= STAGES)
        return false;
    *frame = can_classic_frame(CAN_ID_STAGE + (uint32_t)stage->node, stage->counter);
    can_field_put(frame, STAGE_NUMBER, stage->stage);
    can_field_put(frame, STAGE_MEAN, can_field_saturated(STAGE_MEAN, stage->mean_us));
    can_field_put(frame, STAGE_WORST, can_field_saturated(STAGE_WORST, stage->worst_us));
    can_field_put(frame, STAGE_SHOWN, can_field_saturated(STAGE_SHOWN, stage->shown));
    can_field_put(frame, STAGE_LATE, can_field_saturated(STAGE_LATE, stage->late));
    can_classic_protect(frame);
    return true;
}

can_check_t can_stage_decode(can_stage_t *stage, const hal_can_frame_t *frame)
{
    const can_check_t check = can_classic_check_node(frame, CAN_ID_STAGE);
    if (check != CAN_CHECK_OK)
        return check;
    const uint32_t number = can_field_get(frame, STAGE_NUMBER);
    if (number >= STAGES)
        return CAN_CHECK_VALUE;
    *stage = (can_stage_t){
        .node = (uint8_t)(frame->id - CAN_ID_STAGE),
        .counter = can_classic_counter(frame),
        .stage = (stage_t)number,
        .mean_us = can_field_get(frame, STAGE_MEAN),
        .worst_us = can_field_get(frame, STAGE_WORST),
        .shown = can_field_get(frame, STAGE_SHOWN),
        .late = can_field_get(frame, STAGE_LATE),
    };
    return CAN_CHECK_OK;
}

bool can_quality_encode(hal_can_frame_t *frame, const can_quality_t *quality)
{
    if (!can_classic_node_fits(quality->node, quality->counter) || quality->step >= DEGRADE_MAX_STEPS ||
        (unsigned)quality->filter > WARP_FILTER_BUTTER || (unsigned)quality->resampler > WARP_AUTO)
        return false;
    *frame = can_classic_frame(CAN_ID_QUALITY + (uint32_t)quality->node, quality->counter);
    can_field_put(frame, QUALITY_STEP, quality->step);
    can_field_put(frame, QUALITY_RESAMPLER, quality->resampler);
    can_field_put(frame, QUALITY_FILTER, quality->filter);
    can_field_put(frame, QUALITY_CHANGES, quality->changes);
    can_field_put(frame, QUALITY_WANTED, can_field_saturated(QUALITY_WANTED, quality->wanted_us));
    can_field_put(frame, QUALITY_HOLD, can_field_saturated(QUALITY_HOLD, quality->hold_s / HOLD_UNIT_S));
    can_classic_protect(frame);
    return true;
}

can_check_t can_quality_decode(can_quality_t *quality, const hal_can_frame_t *frame)
{
    const can_check_t check = can_classic_check_node(frame, CAN_ID_QUALITY);
    if (check != CAN_CHECK_OK)
        return check;
    const uint32_t step = can_field_get(frame, QUALITY_STEP), filter = can_field_get(frame, QUALITY_FILTER),
                   resampler = can_field_get(frame, QUALITY_RESAMPLER);
    if (step >= DEGRADE_MAX_STEPS || filter > WARP_FILTER_BUTTER || resampler > WARP_AUTO)
        return CAN_CHECK_VALUE;
    *quality = (can_quality_t){
        .node = (uint8_t)(frame->id - CAN_ID_QUALITY),
        .counter = can_classic_counter(frame),
        .step = (uint8_t)step,
        .filter = (warp_filter_t)filter,
        .resampler = (warp_resampler_t)resampler,
        .changes = can_field_get(frame, QUALITY_CHANGES),
        .wanted_us = can_field_get(frame, QUALITY_WANTED),
        .hold_s = can_field_get(frame, QUALITY_HOLD) * HOLD_UNIT_S,
    };
    return CAN_CHECK_OK;
}

static int32_t drift_in_units(int32_t drift_ppb)
{
    const int64_t half = drift_ppb < 0 ? -DRIFT_UNIT_PPB / 2 : DRIFT_UNIT_PPB / 2;
    const int32_t units = (int32_t)((drift_ppb + half) / DRIFT_UNIT_PPB);
    return units > DRIFT_LARGEST ? DRIFT_LARGEST : units < -DRIFT_LARGEST ? -DRIFT_LARGEST : units;
}

bool can_time_encode(hal_can_frame_t *frame, const can_time_t *time)
{
    if (!can_classic_node_fits(time->node, time->counter) || (unsigned)time->state > CAN_TIME_HOLDOVER ||
        time->master > CAN_MAX_NODE)
        return false;
    *frame = can_classic_frame(CAN_ID_TIME + (uint32_t)time->node, time->counter);
    can_field_put(frame, TIME_STATE, time->state);
    can_field_put(frame, TIME_MASTER, time->master);
    can_field_put(frame, TIME_CHANGES, time->changes);
    can_field_put(frame, TIME_RELOCKS, time->relocks);
    can_field_put(frame, TIME_DRIFT, drift_in_units(time->drift_ppb));
    can_field_put(frame, TIME_ERROR, can_field_saturated(TIME_ERROR, time->error_us));
    can_field_put(frame, TIME_LOST, time->lost);
    can_classic_protect(frame);
    return true;
}

can_check_t can_time_decode(can_time_t *time, const hal_can_frame_t *frame)
{
    const can_check_t check = can_classic_check_node(frame, CAN_ID_TIME);
    if (check != CAN_CHECK_OK)
        return check;
    const uint32_t state = can_field_get(frame, TIME_STATE);
    const int32_t drift = can_field_get_signed(frame, TIME_DRIFT);
    if (state > CAN_TIME_HOLDOVER || drift < -DRIFT_LARGEST)
        return CAN_CHECK_VALUE;
    *time = (can_time_t){
        .node = (uint8_t)(frame->id - CAN_ID_TIME),
        .counter = can_classic_counter(frame),
        .state = (can_time_state_t)state,
        .master = (uint8_t)can_field_get(frame, TIME_MASTER),
        .drift_ppb = drift * DRIFT_UNIT_PPB,
        .error_us = can_field_get(frame, TIME_ERROR),
        .changes = can_field_get(frame, TIME_CHANGES),
        .relocks = can_field_get(frame, TIME_RELOCKS),
        .lost = can_field_get(frame, TIME_LOST),
    };
    return CAN_CHECK_OK;
}

const char *can_board_state_name(can_board_state_t state)
{
    switch (state) {
    case CAN_BOARD_WAITING:
        return "waiting";
    case CAN_BOARD_RUNNING:
        return "running";
    case CAN_BOARD_HOLDING:
        return "holding";
    case CAN_BOARD_SAFE:
        return "safe";
    case CAN_BOARD_FAULT:
        return "fault";
    case CAN_BOARD_FROZEN:
        return "frozen";
    case CAN_BOARD_PATTERN:
        return "pattern";
    case CAN_BOARD_STATES:
        break;
    }
    return "unknown";
}
