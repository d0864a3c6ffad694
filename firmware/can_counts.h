// SPDX-License-Identifier: Apache-2.0
// The message by which a board says what it has counted since its start, beside Status and Time.
#ifndef FIRMWARE_CAN_COUNTS_H
#define FIRMWARE_CAN_COUNTS_H

#include "firmware/can_protocol.h"

enum {
    CAN_ID_COUNTS = 0x5C0, /**< + node */
    CAN_COUNTS_PERIOD_MS = 1000
};

/** All count up from 0 at the board's start, and are sent modulo what their fields hold. */
typedef struct {
    uint8_t node;            /**< 1 to CAN_MAX_NODE */
    uint8_t counter;         /**< 0 to 14 */
    uint32_t tags_lost;      /**< pictures whose code could not be read, where codes are expected; modulo 4096 */
    uint32_t guessed;        /**< pictures shown for another pose than the rule asks for: its code was lost, or the pose
                                  is not known; modulo 4096 */
    uint32_t leaders;        /**< changes of the board that leads the frame clock; modulo 256 */
    uint32_t epochs_missed;  /**< changes of its epoch that were noticed too late; modulo 256 */
    uint32_t command_faults; /**< messages of operators that did not come whole, or replies that did not get out; modulo
                                  4096 */
} can_counts_t;

/** @return false when node or counter is out of range. */
bool can_counts_encode(hal_can_frame_t *frame, const can_counts_t *counts);

can_check_t can_counts_decode(can_counts_t *counts, const hal_can_frame_t *frame);

#endif
