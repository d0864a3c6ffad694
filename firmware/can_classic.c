// SPDX-License-Identifier: Apache-2.0
// What all classic messages of wallwarp.dbc share: 8 bytes, a counter, and the CRC of E2E profile 1.
#include "firmware/can_classic.h"

enum { LENGTH = 8 };

static const can_field_t COUNTER = {8, 4};

hal_can_frame_t can_classic_frame(uint32_t id, uint8_t counter)
{
    hal_can_frame_t frame = {.id = id, .length = LENGTH};
    can_field_put(&frame, COUNTER, counter);
    return frame;
}

void can_classic_protect(hal_can_frame_t *frame)
{
    frame->data[0] = can_e2e_p01_crc((uint16_t)frame->id, frame->data, LENGTH);
}

can_check_t can_classic_check(const hal_can_frame_t *frame)
{
    if (frame->fd || frame->length != LENGTH)
        return CAN_CHECK_LENGTH;
    if (frame->data[0] != can_e2e_p01_crc((uint16_t)frame->id, frame->data, LENGTH))
        return CAN_CHECK_CRC;
    return can_classic_counter(frame) < CAN_E2E_P01_COUNTERS ? CAN_CHECK_OK : CAN_CHECK_COUNTER;
}

bool can_classic_node_fits(uint8_t node, uint8_t counter)
{
    return node >= 1 && node <= CAN_MAX_NODE && counter < CAN_E2E_P01_COUNTERS;
}

can_check_t can_classic_check_node(const hal_can_frame_t *frame, uint32_t base)
{
    if (frame->extended || frame->id <= base || frame->id > base + CAN_MAX_NODE)
        return CAN_CHECK_OTHER;
    return can_classic_check(frame);
}

uint8_t can_classic_counter(const hal_can_frame_t *frame)
{
    return (uint8_t)can_field_get(frame, COUNTER);
}
