// SPDX-License-Identifier: Apache-2.0
// The board "host": this machine, with the simulator's devices.
#include "hal/hal_board.h"

const board_table_t board_table = {
    .name = "host",
    .can = "29536", /* the port that socketcand has by custom */
    .camera = "pattern",
    .display = "none",
    .workers = {.count = 1, .first_core = HAL_WORKERS_ANY_CORE},
};
