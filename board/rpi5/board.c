// SPDX-License-Identifier: Apache-2.0
// The board "rpi5": Raspberry Pi 5 with a CAN FD hat. Wiring and the reasons: README.md.
#include "hal/hal_board.h"

const board_table_t board_table = {
    .name = "rpi5",
    .machine = "brcm,bcm2712",
    .can = "can0",
    .camera = "v4l2:/dev/video0+tc358743 11-000f",
    .display = "HDMI-A-1",
    .lines = {.chip = "pinctrl-rp1",
              .line = {[HAL_GPIO_LED] = 17, [HAL_GPIO_STROBE] = 27, [HAL_GPIO_GENLOCK] = 22, [HAL_GPIO_LAMP] = 23}},
    .watchdog = "/dev/watchdog0",
    .workers = {.count = 3, .first_core = 1, .priority = 40},
};
