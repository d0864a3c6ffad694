// SPDX-License-Identifier: Apache-2.0
// A board's lines and what is on their other ends, for what every HAL's hal_gpio.h must do: simulated ones here, a
// Linux board's in tests/board/virtual/check_hal_gpio.c.
#ifndef TESTS_SUPPORT_GPIO_RIG_H
#define TESTS_SUPPORT_GPIO_RIG_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_gpio.h"

typedef struct gpio_rig gpio_rig_t;

/** Open all lines; the test fails when that fails. */
gpio_rig_t *gpio_rig_open(void);

void gpio_rig_close(gpio_rig_t *rig);

hal_gpio_t *gpio_rig_lines(gpio_rig_t *rig);

/** @return The level of an output, as seen from outside. */
bool gpio_rig_level(const gpio_rig_t *rig, hal_gpio_line_t line);

/** Let genlock rise and fall once. */
void gpio_rig_pulse(gpio_rig_t *rig);

/** @return Now on the clock that edges are stamped on; never the same twice. */
int64_t gpio_rig_now_us(gpio_rig_t *rig);

#endif
