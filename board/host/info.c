// SPDX-License-Identifier: Apache-2.0
// The board "host": nothing to wire.
#include "board/board_info.h"

const board_info_t board_info = {
    .machine = "a PC with the simulator's devices",
    .step = {{"a shell, once", "board/setup.sh test\n"}},
};
