// SPDX-License-Identifier: Apache-2.0
// What all classic messages of wallwarp.dbc share: 8 bytes, a counter, and the CRC of E2E profile 1.
#ifndef FIRMWARE_CAN_CLASSIC_H
#define FIRMWARE_CAN_CLASSIC_H

#include "firmware/can_fields.h"
#include "firmware/can_protocol.h"

/** @return An empty message; put its signals in, from bit CAN_E2E_P01_HEADER_BITS on. */
hal_can_frame_t can_classic_frame(uint32_t id, uint8_t counter);

/** The last step of an encoder: set the CRC. */
void can_classic_protect(hal_can_frame_t *frame);

/**
 * The first step of a decoder, once the identifier has been seen to be right.
 *
 * @return CAN_CHECK_OK, CAN_CHECK_LENGTH, CAN_CHECK_CRC or CAN_CHECK_COUNTER.
 */
can_check_t can_classic_check(const hal_can_frame_t *frame);

/** @return Can a board of that node send a message with this counter? */
bool can_classic_node_fits(uint8_t node, uint8_t counter);

/**
 * The first step of a decoder of what boards send: the identifier is base + node.
 *
 * @return As can_classic_check(), or CAN_CHECK_OTHER when the identifier is not one of 1 to CAN_MAX_NODE nodes.
 */
can_check_t can_classic_check_node(const hal_can_frame_t *frame, uint32_t base);

/** @return The counter of a checked message. */
uint8_t can_classic_counter(const hal_can_frame_t *frame);

#endif
