// SPDX-License-Identifier: Apache-2.0
// What the boards of a room have said of their latency, and what that asks of the room.
//
// Integers only, no pointers inside, O(CAN_MAX_NODE).
#ifndef FIRMWARE_ROOM_LATENCY_H
#define FIRMWARE_ROOM_LATENCY_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_latency.h"

enum { ROOM_LATENCY_FORGET_US = 5000000 /**< a board that is silent for so long asks for nothing */ };

/** What one board asks for. */
typedef struct {
    bool any;
    int64_t heard_us;   /**< on this board's clock */
    int32_t lag_us;     /**< 0: it has no pictures */
    int32_t display_us; /**< what its projector takes */
    int32_t wanted_ms;  /**< 0: nothing */
} room_latency_board_t;

/** All zero bytes has heard nothing. */
typedef struct {
    room_latency_board_t board[CAN_MAX_NODE + 1]; /**< by node, this board among them */
} room_latency_t;

/** What all boards together ask for. */
typedef struct {
    int32_t lag_us;                            /**< of the slowest camera; 0: nobody has pictures */
    int32_t least_display_us, most_display_us; /**< of the fastest and of the slowest projector */
    int32_t wanted_ms;                         /**< the longest that is wanted; 0: nobody wants anything */
} room_latency_sum_t;

/** Note what a board asks for: one that was heard, or this one. */
void room_latency_note(room_latency_t *room, const can_latency_t *latency, int64_t now_us);

/** @return What those ask for that were heard lately; all 0 when nobody was. */
room_latency_sum_t room_latency_sum(const room_latency_t *room, int64_t now_us);

#endif
