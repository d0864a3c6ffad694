// SPDX-License-Identifier: Apache-2.0
// The board "imx8mp": NXP i.MX8M Plus EVK, with its own CAN FD. Wiring and the reasons: README.md.
#include "hal/hal_board.h"

const board_table_t board_table = {
    .name = "imx8mp",
    .machine = "fsl,imx8mp",
    .can = "can0",
    .camera = "v4l2:/dev/video0",
    .display = "HDMI-A-1",
    .lines = {.chip = "30240000.gpio", /* GPIO5 */
              .line = {[HAL_GPIO_LED] = 6, [HAL_GPIO_STROBE] = 7, [HAL_GPIO_GENLOCK] = 8, [HAL_GPIO_LAMP] = 9}},
    .watchdog = "/dev/watchdog0",
    .workers = {.count = 3, .first_core = 1, .priority = 40},
};
