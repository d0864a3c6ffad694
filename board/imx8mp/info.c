// SPDX-License-Identifier: Apache-2.0
// The board "imx8mp": wiring and set-up. The reasons are in README.md.
#include "board/board_info.h"

const board_info_t board_info = {
    .machine = "NXP i.MX8M Plus EVK with Debian 12 on a kernel of its maker; CAN FD is on the board",
    .header = "pin",
    .line_prefix = "GPIO5_IO",
    .wire =
        (const board_wire_t[]){
            {BOARD_NO_PIN, BOARD_WIRE_FIXED, "pads SPDIF_TX and SPDIF_RX, FlexCAN1", "transceiver on the board"},
            {BOARD_NO_PIN, BOARD_WIRE_FIXED, "GPIO5_IO5, standby of the transceiver", "driven by the kernel"},
            {BOARD_NO_PIN, HAL_GPIO_LED, NULL, "pad ECSPI1_SCLK: LED to ground through 1 kOhm"},
            {BOARD_NO_PIN, HAL_GPIO_STROBE, NULL, "pad ECSPI1_MOSI: oscilloscope"},
            {BOARD_NO_PIN, HAL_GPIO_GENLOCK, NULL,
             "pad ECSPI1_MISO: house sync, at the level of that pad, rising edge once per frame"},
            {BOARD_NO_PIN, HAL_GPIO_LAMP, NULL, "pad ECSPI1_SS0: lamp enable of the projector, 10 kOhm to ground"},
            {.to = NULL},
        },
    .step =
        {
            {"device tree", "&flexcan1 { status = \"okay\"; };\n"
                            "&uart3 { status = \"disabled\"; }; /* has the four pads of the lines */\n"},
            {"command line of the kernel, in the boot loader",
             "isolcpus=domain,managed_irq,1-3 rcu_nocbs=1-3 irqaffinity=0 consoleblank=0\n"},
            {"a shell, once", "sudo apt install can-utils v4l-utils gpiod libcyaml1 libmbedcrypto7 libmnl0 libgpiod2 "
                              "libdrm2 libcamera0.0.3 liblo7 libjansson4 libcbor0.8\n"},
        },
};
