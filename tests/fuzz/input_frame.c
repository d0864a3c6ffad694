// SPDX-License-Identifier: Apache-2.0
// A CAN frame out of a fuzzer's input.
#include "tests/fuzz/input_frame.h"

#include "firmware/can_protocol.h"

enum { ANY_IDENTIFIER = 1, ANY_LENGTH = 2, WRONG_CRC = 4, IS_FD = 8, IS_EXTENDED = 16 };

static void repair_crc(hal_can_frame_t *frame)
{
    if (frame->fd && frame->length >= 3) {
        const uint16_t crc = can_e2e_p05_crc((uint16_t)frame->id, frame->data, frame->length);
        frame->data[0] = (uint8_t)crc;
        frame->data[1] = (uint8_t)(crc >> 8);
    } else if (!frame->fd && frame->length >= 1) {
        frame->data[0] = can_e2e_p01_crc((uint16_t)frame->id, frame->data, frame->length);
    }
}

hal_can_frame_t input_frame(input_t *input)
{
    static const uint8_t lengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    const uint8_t kind = input_byte(input);
    const bool fd = (kind & IS_FD) != 0;
    static const uint16_t classic_ids[] = {CAN_ID_POSE_SET,     CAN_ID_POSE_SET + 1, CAN_ID_POSE_SET + 2,
                                           CAN_ID_POSE_SET + 4, CAN_ID_STATUS,       CAN_ID_HEARTBEAT,
                                           CAN_ID_SYNC,         CAN_ID_FOLLOW_UP,    CAN_ID_TIME};
    enum { CLASSIC_IDS = sizeof classic_ids / sizeof classic_ids[0] };
    hal_can_frame_t frame = {.fd = fd, .bit_rate_switch = fd, .length = fd ? 32 : 8};
    if (kind & ANY_IDENTIFIER)
        frame.id = (uint32_t)input_bits(input, 4) & 0x1FFFFFFF;
    else if (fd)
        frame.id = CAN_ID_POSE_FD + input_byte(input) % CAN_VIEWERS;
    else
        frame.id = classic_ids[input_byte(input) % CLASSIC_IDS] + (uint32_t)(kind >> 5);
    frame.extended = (kind & IS_EXTENDED) != 0 || frame.id > 0x7FF;
    if (kind & ANY_LENGTH)
        frame.length = lengths[input_byte(input) % (fd ? 16 : 9)];
    for (int i = 0; i < frame.length; i++)
        frame.data[i] = input_byte(input);
    if (!(kind & WRONG_CRC))
        repair_crc(&frame);
    return frame;
}
