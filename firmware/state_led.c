// SPDX-License-Identifier: Apache-2.0
// What the board's LED says of its state.
#include "firmware/state_led.h"

bool state_led_level(can_board_state_t state, int64_t now_us)
{
    if (state == CAN_BOARD_RUNNING)
        return true;
    if (state == CAN_BOARD_FROZEN || state == CAN_BOARD_PATTERN)
        return now_us / 250000 % 4 != 0;
    const int64_t half_period_us = state == CAN_BOARD_FAULT ? 60000 : 250000;
    return now_us / half_period_us % 2 == 0;
}
