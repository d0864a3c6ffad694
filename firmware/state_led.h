// SPDX-License-Identifier: Apache-2.0
// What the board's LED says of its state.
#ifndef FIRMWARE_STATE_LED_H
#define FIRMWARE_STATE_LED_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_protocol.h"

/** @return Is it lit now? Steady: running. Steady with gaps: frozen, pattern. Slow blinking: waiting, holding or safe.
 *          Fast blinking: fault. */
bool state_led_level(can_board_state_t state, int64_t now_us);

#endif
