// SPDX-License-Identifier: Apache-2.0
// Two controllers alone on one bus, for what every HAL's hal_can.h must do: simulated ones here, a Linux board's in
// tests/board/virtual/check_hal_can.c.
#ifndef TESTS_SUPPORT_CAN_PAIR_H
#define TESTS_SUPPORT_CAN_PAIR_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_can.h"

typedef struct can_pair can_pair_t;

/**
 * Open both; the test fails when that fails.
 *
 * @param names  On a board: the interfaces; not used by the simulator.
 * @param fd     The bus carries CAN FD; 500 kbit/s, data at 2 Mbit/s.
 */
can_pair_t *can_pair_open(const char *const names[2], bool fd);

void can_pair_close(can_pair_t *pair);

/** @param number  0 or 1. */
hal_can_t *can_pair_controller(can_pair_t *pair, int number);

/** Let time pass on the bus. */
void can_pair_wait(can_pair_t *pair, int64_t time_us);

/** @return Now on the clock that frames are stamped on. */
int64_t can_pair_now_us(const can_pair_t *pair);

#endif
