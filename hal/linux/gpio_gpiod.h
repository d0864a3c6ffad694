// SPDX-License-Identifier: Apache-2.0
// The board's digital lines (hal/hal_gpio.h) through libgpiod, of its API 1 or 2 as the build finds it.
//
// Outputs are low from open on. On close they are driven low, the lamp first, and released. A crash only releases them:
// the kernel drives nothing then, and what the pin does is the driver's choice. On a BCM2711 (Raspberry Pi 4) it
// becomes an input, in gpio-sim it takes its pull. So the lamp's wire needs a pull-down resistor, and the board is dark
// however the firmware ends; with it, no other program needs to do anything.
//
// Edges are stamped by the kernel in the interrupt, on CLOCK_MONOTONIC (Linux 5.7 or newer). The kernel keeps 16; the
// 17th drops the oldest with API 2, but is itself dropped with API 1, whose kernel interface knows no better.
#ifndef HAL_LINUX_GPIO_GPIOD_H
#define HAL_LINUX_GPIO_GPIOD_H

#include "hal/hal_board.h"

/**
 * Take the board's lines, for nobody else to use.
 *
 * @param[out] gpio   Written only when HAL_OK is returned.
 * @param      lines  Only read here.
 * @param[out] error  On failure: one line, with who holds the line if anybody does.
 * @return HAL_OK; HAL_IO when chip or line is not there, is held by another program, or can't do what it is for: no
 *         line is left taken then.
 */
MUST_CHECK hal_status_t gpio_gpiod_open(hal_gpio_t **gpio, const hal_board_lines_t *lines,
                                        char error[HAL_BOARD_ERROR_LENGTH]);

/** Outputs low, the lamp first; then give the lines back. NULL is allowed. */
void gpio_gpiod_close(hal_gpio_t *gpio);

#endif
