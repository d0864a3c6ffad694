// SPDX-License-Identifier: Apache-2.0
// What the boards of a room have said of their latency, and what that asks of the room.
#include "firmware/room_latency.h"

void room_latency_note(room_latency_t *room, const can_latency_t *latency, int64_t now_us)
{
    room->board[latency->node] = (room_latency_board_t){
        .any = true,
        .heard_us = now_us,
        .lag_us = (int32_t)latency->lag_us,
        .display_us = (int32_t)latency->display_us,
        .wanted_ms = (int32_t)latency->wanted_ms,
    };
}

static int32_t larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

room_latency_sum_t room_latency_sum(const room_latency_t *room, int64_t now_us)
{
    room_latency_sum_t sum = {.least_display_us = INT32_MAX};
    for (int node = 1; node <= CAN_MAX_NODE; node++) {
        const room_latency_board_t *board = &room->board[node];
        if (!board->any || now_us - board->heard_us >= ROOM_LATENCY_FORGET_US)
            continue;
        sum.lag_us = larger(sum.lag_us, board->lag_us);
        sum.most_display_us = larger(sum.most_display_us, board->display_us);
        sum.wanted_ms = larger(sum.wanted_ms, board->wanted_ms);
        if (board->display_us < sum.least_display_us)
            sum.least_display_us = board->display_us;
    }
    if (sum.least_display_us > sum.most_display_us)
        sum.least_display_us = 0;
    return sum;
}
