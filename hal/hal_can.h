// SPDX-License-Identifier: Apache-2.0
// Contract of a CAN controller: classic CAN 2.0B and CAN FD frames (ISO 11898-1), without blocking.
#ifndef HAL_HAL_CAN_H
#define HAL_HAL_CAN_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_status.h"

typedef struct hal_can hal_can_t;

enum { HAL_CAN_MAX_LENGTH = 64 };

/** One data frame. Remote frames are never delivered. */
typedef struct {
    int64_t time_us; /**< received: when its last bit was seen, on hal_time's clock; ignored when sending */
    bool own;        /**< sending: hal_can_receive() shall hand it back once it is sent, stamped as a received one;
                          received: it is such a frame */
    uint32_t id;     /**< 11 bits, or 29 when extended */
    bool extended;
    bool fd;                          /**< a CAN FD frame; else a classic one */
    bool bit_rate_switch;             /**< FD only: the data phase runs at the data bit rate */
    uint8_t length;                   /**< classic 0..8; FD 0..8, 12, 16, 20, 24, 32, 48, 64 */
    uint8_t data[HAL_CAN_MAX_LENGTH]; /**< bytes from length on are unspecified */
} hal_can_frame_t;

/** Fault confinement state (ISO 11898-1). */
typedef enum {
    HAL_CAN_ERROR_ACTIVE,
    HAL_CAN_ERROR_PASSIVE,
    HAL_CAN_BUS_OFF /**< the controller neither sends nor receives until hal_can_restart() */
} hal_can_state_t;

/**
 * Take the oldest received frame, without blocking.
 *
 * At least 256 frames are kept; while so many are waiting, those that come are lost.
 *
 * @param      can    An open controller.
 * @param[out] frame  Written only when HAL_OK is returned. Must not be NULL.
 * @return HAL_OK     one frame was taken;
 *         HAL_EMPTY  none is waiting;
 *         HAL_IO     driver failure; the controller stays open, call again.
 */
MUST_CHECK hal_status_t hal_can_receive(hal_can_t *can, hal_can_frame_t *frame);

/**
 * Queue a frame for sending, without blocking.
 *
 * Frames of one identifier are sent in the order queued. Of others, which of the waiting ones goes first is the
 * implementation's: the one queued first, or the one that wins arbitration, lower identifiers first.
 *
 * @return HAL_OK        queued; it is sent when it wins arbitration on the bus;
 *         HAL_FULL      the queue is full, the frame was not taken;
 *         HAL_BAD_CALL  identifier or length is illegal, or FD on a classic bus;
 *         HAL_IO        bus off, or driver failure; the frame was not taken.
 */
MUST_CHECK hal_status_t hal_can_send(hal_can_t *can, const hal_can_frame_t *frame);

/**
 * Count the received frames that were lost, as the controller, its driver or the queue had no room for them.
 *
 * Frames lost on the wire are not among them. A loss may be counted only when hal_can_receive() has come to the frame
 * after it, and one that the controller reports without a number counts as one frame.
 *
 * @return How many since the controller was opened, modulo 2^32. Never blocks.
 */
uint32_t hal_can_lost(const hal_can_t *can);

/** @return The controller's fault confinement state. Never blocks. */
hal_can_state_t hal_can_state(const hal_can_t *can);

/**
 * Leave bus-off. The controller is back after it has seen 128 x 11 recessive bits (ISO 11898-1), not at once.
 *
 * Calling again while that goes on changes nothing.
 *
 * @return HAL_OK when started, or when not bus-off at all; HAL_IO when the driver refuses.
 */
MUST_CHECK hal_status_t hal_can_restart(hal_can_t *can);

#endif
