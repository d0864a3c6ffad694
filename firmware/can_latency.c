// SPDX-License-Identifier: Apache-2.0
// Encoder and decoder of Latency.
#include "firmware/can_latency.h"

#include "firmware/can_classic.h"

/* The signals of wallwarp.dbc. */
static const can_field_t LATENCY_FAULT = {12, 4}, LATENCY_LAG = {16, 10}, LATENCY_DISPLAY = {26, 9},
                         LATENCY_WANTED = {35, 8}, LATENCY_HELD = {43, 3}, LATENCY_PHOTON = {46, 10},
                         LATENCY_OFF = {56, 7}, LATENCY_GENLOCKED = {63, 1};

enum { OFF_LARGEST = 63 };

static int32_t off_in_units(int32_t off_us)
{
    const int32_t half_us = off_us < 0 ? -CAN_LATENCY_OFF_UNIT_US / 2 : CAN_LATENCY_OFF_UNIT_US / 2;
    const int32_t units = (off_us / 2 + half_us / 2) / (CAN_LATENCY_OFF_UNIT_US / 2); /* no sum passes 2^31 */
    return units > OFF_LARGEST ? OFF_LARGEST : units < -OFF_LARGEST ? -OFF_LARGEST : units;
}

bool can_latency_encode(hal_can_frame_t *frame, const can_latency_t *latency)
{
    if (!can_classic_node_fits(latency->node, latency->counter) || (unsigned)latency->fault > CAN_STEP_NOT_SHOWN ||
        latency->held > CAN_LATENCY_MOST_HELD)
        return false;
    const uint32_t lag = latency->lag_us / CAN_LATENCY_LAG_UNIT_US + (latency->lag_us % CAN_LATENCY_LAG_UNIT_US != 0),
                   photon = (uint32_t)(((uint64_t)latency->photon_us + CAN_LATENCY_PHOTON_UNIT_US / 2) /
                                       CAN_LATENCY_PHOTON_UNIT_US);
    *frame = can_classic_frame(CAN_ID_LATENCY + (uint32_t)latency->node, latency->counter);
    can_field_put(frame, LATENCY_FAULT, latency->fault);
    can_field_put(frame, LATENCY_LAG, can_field_saturated(LATENCY_LAG, lag));
    can_field_put(frame, LATENCY_DISPLAY,
                  can_field_saturated(LATENCY_DISPLAY, latency->display_us / CAN_LATENCY_DISPLAY_UNIT_US));
    can_field_put(frame, LATENCY_WANTED, can_field_saturated(LATENCY_WANTED, latency->wanted_ms));
    can_field_put(frame, LATENCY_HELD, latency->held);
    can_field_put(frame, LATENCY_PHOTON, can_field_saturated(LATENCY_PHOTON, photon));
    can_field_put(frame, LATENCY_OFF, off_in_units(latency->off_us));
    can_field_put(frame, LATENCY_GENLOCKED, latency->genlocked);
    can_classic_protect(frame);
    return true;
}

can_check_t can_latency_decode(can_latency_t *latency, const hal_can_frame_t *frame)
{
    const can_check_t check = can_classic_check_node(frame, CAN_ID_LATENCY);
    if (check != CAN_CHECK_OK)
        return check;
    const uint32_t fault = can_field_get(frame, LATENCY_FAULT);
    const int32_t off = can_field_get_signed(frame, LATENCY_OFF);
    if (fault > CAN_STEP_NOT_SHOWN || off < -OFF_LARGEST)
        return CAN_CHECK_VALUE;
    *latency = (can_latency_t){
        .node = (uint8_t)(frame->id - CAN_ID_LATENCY),
        .counter = can_classic_counter(frame),
        .fault = (can_step_fault_t)fault,
        .held = (uint8_t)can_field_get(frame, LATENCY_HELD),
        .genlocked = can_field_get(frame, LATENCY_GENLOCKED) == 1,
        .lag_us = can_field_get(frame, LATENCY_LAG) * CAN_LATENCY_LAG_UNIT_US,
        .display_us = can_field_get(frame, LATENCY_DISPLAY) * CAN_LATENCY_DISPLAY_UNIT_US,
        .wanted_ms = can_field_get(frame, LATENCY_WANTED),
        .photon_us = can_field_get(frame, LATENCY_PHOTON) * CAN_LATENCY_PHOTON_UNIT_US,
        .off_us = off * CAN_LATENCY_OFF_UNIT_US,
    };
    return CAN_CHECK_OK;
}
