// SPDX-License-Identifier: Apache-2.0
// The board "rpi4": wiring and set-up. The reasons are in README.md.
#include "board/board_info.h"

const board_info_t board_info = {
    .machine =
        "Raspberry Pi 4 Model B with 64-bit Raspberry Pi OS Lite (Bookworm), and a CAN FD hat with one MCP2518FD",
    .header = "pin of the 40-pin header",
    .line_prefix = "GPIO",
    .wire = raspberry_pi_wires,
    .step =
        {
            {"/boot/firmware/config.txt", "dtparam=spi=on\n"
                                          "dtoverlay=mcp251xfd,spi0-0,interrupt=25,oscillator=40000000\n"
                                          "dtoverlay=vc4-kms-v3d\n"
                                          "dtoverlay=tc358743\n"
                                          "camera_auto_detect=0\n"},
            {"/boot/firmware/cmdline.txt, at the end of its one line",
             "isolcpus=domain,managed_irq,1-3 rcu_nocbs=1-3 irqaffinity=0 consoleblank=0\n"},
            {"a shell, once", "sudo apt install can-utils v4l-utils gpiod libcyaml1 libmbedcrypto7 libmnl0 libgpiod2 "
                              "libdrm2 libcamera0.0.3 liblo7 libjansson4 libcbor0.8\n"},
        },
};
