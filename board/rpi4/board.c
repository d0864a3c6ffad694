// SPDX-License-Identifier: Apache-2.0
// The board "rpi4": Raspberry Pi 4 Model B with a CAN FD hat. Wiring and the reasons: README.md.
#include "hal/hal_board.h"

const board_table_t board_table = {
    .name = "rpi4",
    .machine = "brcm,bcm2711",
    .can = "can0",
    .camera = "v4l2:/dev/video0",
    .display = "HDMI-A-1",
    .lines = {.chip = "pinctrl-bcm2711",
              .line = {[HAL_GPIO_LED] = 17, [HAL_GPIO_STROBE] = 27, [HAL_GPIO_GENLOCK] = 22, [HAL_GPIO_LAMP] = 23}},
    .watchdog = "/dev/watchdog0",
    .workers = {.count = 3, .first_core = 1, .priority = 40},
};
