// SPDX-License-Identifier: Apache-2.0
// Wiring of a Raspberry Pi with a CAN FD hat: the header is the same on model 4 and 5.
#include "board/board_info.h"

const board_wire_t raspberry_pi_wires[] = {
    {1, BOARD_WIRE_FIXED, "3.3 V", "hat: supply of the controller"},
    {2, BOARD_WIRE_FIXED, "5 V", "hat: supply of the isolated transceiver"},
    {6, BOARD_WIRE_FIXED, "ground", "hat"},
    {19, BOARD_WIRE_FIXED, "GPIO10, SPI0 MOSI", "hat: SDI"},
    {21, BOARD_WIRE_FIXED, "GPIO9, SPI0 MISO", "hat: SDO"},
    {23, BOARD_WIRE_FIXED, "GPIO11, SPI0 SCLK", "hat: SCK"},
    {24, BOARD_WIRE_FIXED, "GPIO8, SPI0 CE0", "hat: nCS"},
    {22, BOARD_WIRE_FIXED, "GPIO25", "hat: nINT"},
    {11, HAL_GPIO_LED, NULL, "LED to ground through 1 kOhm"},
    {13, HAL_GPIO_STROBE, NULL, "oscilloscope"},
    {15, HAL_GPIO_GENLOCK, NULL, "house sync, 3.3 V, rising edge once per frame"},
    {16, HAL_GPIO_LAMP, NULL, "lamp enable of the projector, 10 kOhm to ground"},
    {14, BOARD_WIRE_FIXED, "ground", "of these four"},
    {.to = NULL},
};
