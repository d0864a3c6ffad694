// SPDX-License-Identifier: Apache-2.0
// Frames of SocketCAN and those of hal/hal_can.h, and what error frames say. Pure functions.
#include "hal/linux/socketcan_frame.h"

#include <linux/can/error.h>
#include <stdint.h>
#include <string.h>

static bool is_length(uint8_t length, bool fd)
{
    if (length <= CAN_MAX_DLEN)
        return true;
    if (!fd || length > CANFD_MAX_DLEN)
        return false;
    return length <= 24 ? length % 4 == 0 : length % 16 == 0;
}

size_t socketcan_frame_pack(struct canfd_frame *raw, const hal_can_frame_t *frame, bool fd)
{
    if (frame->id > (frame->extended ? CAN_EFF_MASK : CAN_SFF_MASK) || !is_length(frame->length, frame->fd) ||
        (frame->fd && !fd))
        return 0;
    *raw = (struct canfd_frame){.can_id = frame->extended ? frame->id | CAN_EFF_FLAG : frame->id,
                                .len = frame->length,
                                .flags = frame->fd && frame->bit_rate_switch ? CANFD_BRS : 0};
    memcpy(raw->data, frame->data, frame->length);
    return frame->fd ? CANFD_MTU : CAN_MTU;
}

bool socketcan_frame_unpack(hal_can_frame_t *frame, const struct canfd_frame *raw, size_t size)
{
    const bool fd = size == CANFD_MTU;
    if ((!fd && size != CAN_MTU) || (raw->can_id & (CAN_ERR_FLAG | CAN_RTR_FLAG)) != 0 || !is_length(raw->len, fd))
        return false;
    frame->extended = (raw->can_id & CAN_EFF_FLAG) != 0;
    frame->id = raw->can_id & (frame->extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    frame->fd = fd;
    frame->bit_rate_switch = fd && (raw->flags & CANFD_BRS) != 0;
    frame->length = raw->len;
    memcpy(frame->data, raw->data, raw->len);
    return true;
}

socketcan_error_t socketcan_frame_error(const struct canfd_frame *raw, size_t size)
{
    socketcan_error_t said = {.any_state = false};
    if (size != CAN_MTU || (raw->can_id & CAN_ERR_FLAG) == 0)
        return said;
    const uint8_t detail = (raw->can_id & CAN_ERR_CRTL) != 0 ? raw->data[1] : 0;
    const uint8_t passive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
    const uint8_t active = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING | CAN_ERR_CRTL_ACTIVE;
    said.overrun = (detail & CAN_ERR_CRTL_RX_OVERFLOW) != 0;
    said.any_state = true;
    if ((raw->can_id & CAN_ERR_BUSOFF) != 0)
        said.state = HAL_CAN_BUS_OFF;
    else if ((raw->can_id & CAN_ERR_RESTARTED) != 0)
        said.state = HAL_CAN_ERROR_ACTIVE;
    else if ((detail & passive) != 0)
        said.state = HAL_CAN_ERROR_PASSIVE;
    else if ((detail & active) != 0)
        said.state = HAL_CAN_ERROR_ACTIVE;
    else
        said.any_state = false;
    return said;
}
