// SPDX-License-Identifier: Apache-2.0
// Frames of SocketCAN and those of hal/hal_can.h, and what error frames say. Pure functions.
#ifndef HAL_LINUX_SOCKETCAN_FRAME_H
#define HAL_LINUX_SOCKETCAN_FRAME_H

#include <linux/can.h>
#include <stdbool.h>
#include <stddef.h>

#include "hal/hal_can.h"

/**
 * @param      fd   The bus carries CAN FD frames.
 * @param[out] raw  Written only when the frame is legal; a classic frame is the first CAN_MTU bytes.
 * @return Its size: CAN_MTU or CANFD_MTU; or 0 when identifier or length is illegal, or the frame is FD on a classic
 *         bus.
 */
size_t socketcan_frame_pack(struct canfd_frame *raw, const hal_can_frame_t *frame, bool fd);

/**
 * @param[out] frame  Written only when true is returned, but for time_us and own.
 * @param      size   As received.
 * @return false when it is no data frame: an error frame, a remote frame, or none at all.
 */
bool socketcan_frame_unpack(hal_can_frame_t *frame, const struct canfd_frame *raw, size_t size);

/** What an error frame says (linux/can/error.h). */
typedef struct {
    bool any_state;        /**< it tells a state */
    hal_can_state_t state; /**< if any_state */
    bool overrun;          /**< the controller has lost a received frame */
} socketcan_error_t;

/** @return What it says: nothing at all when it is no error frame. */
socketcan_error_t socketcan_frame_error(const struct canfd_frame *raw, size_t size);

#endif
