// SPDX-License-Identifier: Apache-2.0
// The two messages by which boards agree on frames: FrameClock tells the numbers, Step proves what was shown.
#ifndef FIRMWARE_CAN_FRAME_CLOCK_H
#define FIRMWARE_CAN_FRAME_CLOCK_H

#include "firmware/can_protocol.h"

enum {
    CAN_ID_FRAME_CLOCK = 0x140, /**< + node */
    CAN_ID_STEP = 0x500,        /**< + node */
    CAN_EPOCHS = 16,
    CAN_FRAME_CLOCK_NUMBERS = 4096,
    CAN_FRAME_CLOCK_PHASE_UNIT_US = 8,
    CAN_FRAME_CLOCK_LAG_UNIT_US = 16,
    CAN_FRAME_CLOCK_PERIOD_MS = 25, /**< at the least, for it is sent at blanks: 30 a second at 60 Hz */
    CAN_STEP_EVERY = 6,             /**< refreshes: reported are those whose number is a multiple of it */
    CAN_STEP_PERIOD_MS = 100        /**< which that is at 60 Hz */
};

/** Which refresh has which number, and what belongs to it: see frame_clock.h. */
typedef struct {
    uint8_t node;      /**< of the board that leads, 1 to CAN_MAX_NODE */
    uint8_t counter;   /**< 0 to 14 */
    uint8_t epoch;     /**< one more with every change, modulo CAN_EPOCHS */
    bool sure;         /**< the leader is in step; else it has just begun, or come back */
    bool to_come;      /**< it does not hold yet */
    bool changes;      /**< one that does not hold yet is announced beside this one */
    uint16_t from;     /**< a refresh from which on it holds, modulo CAN_FRAME_CLOCK_NUMBERS: just past, or to come */
    uint16_t phase_us; /**< bus time of refresh number 0, less than a period, up to 65528; sent in PHASE_UNIT_US */
    uint16_t lag_us;   /**< by how much pictures are captured before the refresh whose they are, up to 65520; sent in
                            LAG_UNIT_US */
    uint8_t target_ms; /**< the display delay that every board imitates by holding pictures back; 0: none does */
} can_frame_clock_t;

/** @return false when node, counter, epoch, from, phase or lag is out of range. Phase and lag are rounded down. */
bool can_frame_clock_encode(hal_can_frame_t *frame, const can_frame_clock_t *clock);

can_check_t can_frame_clock_decode(can_frame_clock_t *clock, const hal_can_frame_t *frame);

/** What a board showed at one refresh; of all boards in step these are the same. */
typedef struct {
    uint8_t node;     /**< 1 to CAN_MAX_NODE */
    uint8_t counter;  /**< 0 to 14 */
    bool in_step;     /**< picture and pose are those that the rule asks for, and that is certain */
    bool tagged;      /**< `picture` is the picture's own number */
    uint32_t refresh; /**< number of the refresh; sent modulo 2^16 */
    uint32_t picture; /**< number of the picture; sent modulo 2^16 */
    uint64_t pose_us; /**< capture time of the pose sample, bus time; sent in 100 us modulo 2^16 */
} can_step_t;

/** @return false when node or counter is out of range. */
bool can_step_encode(hal_can_frame_t *frame, const can_step_t *step);

can_check_t can_step_decode(can_step_t *step, const hal_can_frame_t *frame);

#endif
