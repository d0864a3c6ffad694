// SPDX-License-Identifier: Apache-2.0
// The board "qemu-virt": it has no wires, and the tests set it up.
#include "board/board_info.h"

const board_info_t board_info = {
    .machine = "qemu-system-aarch64 -M virt with two Cortex-A72, started by `make test-board`",
    .header = "pin",
    .line_prefix = "line ",
    .wire =
        (const board_wire_t[]){
            {BOARD_NO_PIN, HAL_GPIO_LED, NULL, "gpio-sim"},
            {BOARD_NO_PIN, HAL_GPIO_STROBE, NULL, "gpio-sim"},
            {BOARD_NO_PIN, HAL_GPIO_GENLOCK, NULL, "gpio-sim"},
            {BOARD_NO_PIN, HAL_GPIO_LAMP, NULL, "gpio-sim"},
            {.to = NULL},
        },
    .step =
        {
            {"command line of the kernel, in an image",
             "isolcpus=domain,managed_irq,1 rcu_nocbs=1 irqaffinity=0 consoleblank=0\n"},
        },
};
