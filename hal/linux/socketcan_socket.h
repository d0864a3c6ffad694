// SPDX-License-Identifier: Apache-2.0
// A raw CAN socket: made, bound, and read with everything that the kernel tells of a frame.
#ifndef HAL_LINUX_SOCKETCAN_SOCKET_H
#define HAL_LINUX_SOCKETCAN_SOCKET_H

#include <linux/can.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hal/linux/can_socketcan.h"
#include "hal/linux/socketcan_stamp.h"

/** What was received. */
typedef struct {
    struct canfd_frame frame;
    size_t size; /**< CAN_MTU or CANFD_MTU */
    bool own;    /**< sent by the same socket */
    socketcan_stamps_t stamps;
    uint32_t dropped; /**< frames so far that found the queue full; wraps */
} socketcan_heard_t;

/**
 * Make a socket whose queue holds 256 frames.
 *
 * @param[out] made  Written only when HAL_OK is returned. Not bound.
 * @return HAL_OK; HAL_IO with the reason in error.
 */
MUST_CHECK hal_status_t socketcan_socket_open(int *made, const can_socketcan_settings_t *settings,
                                              char error[HAL_BOARD_ERROR_LENGTH]);

/**
 * Bind it to an interface, again when that has been gone: from now on it hears all data frames, its own too, and the
 * error frames that tell states.
 *
 * @return 0, or an errno.
 */
int socketcan_socket_bind(int socket, int32_t index);

/**
 * Take the oldest frame, without blocking.
 *
 * @param[out] heard  Written only when 0 is returned. dropped is left as it was when the kernel tells nothing new.
 * @return 0, or an errno: EAGAIN when none is waiting, ENETDOWN or ENODEV once when the interface went.
 */
int socketcan_socket_receive(int socket, socketcan_heard_t *heard);

#endif
