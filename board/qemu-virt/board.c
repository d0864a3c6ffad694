// SPDX-License-Identifier: Apache-2.0
// The board "qemu-virt": the virtual board of the tests. Its devices: README.md.
#include "hal/hal_board.h"

const board_table_t board_table = {
    .name = "qemu-virt",
    .machine = "linux,dummy-virt",
    .can = "can2",
    .camera = "v4l2:vivid",
    .display = "Virtual-1",
    .lines = {.chip = "wallwarp",
              .line = {[HAL_GPIO_LED] = 0, [HAL_GPIO_STROBE] = 1, [HAL_GPIO_GENLOCK] = 2, [HAL_GPIO_LAMP] = 3}},
    .watchdog = "/dev/watchdog0",
    .workers = {.count = 1, .first_core = 1, .priority = 40},
};
