// SPDX-License-Identifier: Apache-2.0
// A CAN controller (hal/hal_can.h) behind an interface of Linux: SocketCAN, classic and FD.
//
// Sending: the interface's queue is sent in the order queued, whatever the identifiers. It holds `txqueuelen` frames.
// Frames of other programs of this board are received like those of other nodes, and they hear this one's.
//
// Time stamps are the controller's when it makes any (MCP2518FD), else the kernel's: see socketcan_stamp.h.
//
// Lost frames: those that the socket's queue dropped, and one for each overrun that an error frame tells of.
//
// Fault confinement state: from error frames, taken while receiving, and from what the kernel tells of the interface.
// Leaving bus-off: with `restart-ms` the kernel does it after that time and hal_can_restart() has nothing to do;
// without, hal_can_restart() asks for it, which only CAP_NET_ADMIN may. One of the two is asked for at open.
//
// An interface that goes down, vanishes, or comes up with other settings than the room's: receive and send give HAL_IO
// until it is up with the right ones, then they work again.
//
// ISO-TP is the firmware's own (firmware/isotp.h), over these frames: the kernel's can-isotp has a socket and a timer
// of its own for each link, and no simulated bus can carry it, so that bench and board would run different code.
#ifndef HAL_LINUX_CAN_SOCKETCAN_H
#define HAL_LINUX_CAN_SOCKETCAN_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_board.h"

/** What the room file and the board's table ask of the bus. */
typedef struct {
    const char *interface; /**< can0; must live as long as the controller is open */
    int32_t bitrate;       /**< bit/s; 0: as the interface is set up */
    int32_t data_bitrate;  /**< bit/s, or 0 likewise; of no meaning unless fd */
    bool fd;               /**< CAN FD frames, too */
} can_socketcan_settings_t;

/**
 * Open an interface that is up already: who sets it up is the system, by the command that the error line gives.
 *
 * Bit rates may be off by 1/200, as controllers divide their clocks; interfaces that have none (vcan) are not asked.
 * An interface with FD may serve a classic room.
 *
 * @param[out] can    Written only when HAL_OK is returned.
 * @param[out] error  On failure: one line, with the command that mends it.
 * @return HAL_OK; HAL_IO when there is no such interface, it is down, or has other settings.
 */
MUST_CHECK hal_status_t can_socketcan_open(hal_can_t **can, const can_socketcan_settings_t *settings,
                                           char error[HAL_BOARD_ERROR_LENGTH]);

/** NULL is allowed. The interface stays up. */
void can_socketcan_close(hal_can_t *can);

#endif
