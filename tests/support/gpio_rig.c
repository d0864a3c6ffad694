// SPDX-License-Identifier: Apache-2.0
// A simulated board's lines and what is on their other ends.
#include "tests/support/gpio_rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>

#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_gpio.h"

struct gpio_rig {
    hal_time_t *clock;
    hal_gpio_t *gpio;
    int64_t time_us;
};

gpio_rig_t *gpio_rig_open(void)
{
    static const sim_clock_settings_t virtual_time = {.real = false};
    char error[FILE_ERROR_LENGTH];
    gpio_rig_t *rig = calloc(1, sizeof *rig);
    assert_non_null(rig);
    rig->clock = sim_clock_create(&virtual_time, error);
    assert_non_null(rig->clock);
    rig->gpio = sim_gpio_create(rig->clock, error);
    assert_non_null(rig->gpio);
    return rig;
}

void gpio_rig_close(gpio_rig_t *rig)
{
    sim_gpio_destroy(rig->gpio);
    sim_clock_destroy(rig->clock);
    free(rig);
}

hal_gpio_t *gpio_rig_lines(gpio_rig_t *rig)
{
    return rig->gpio;
}

bool gpio_rig_level(const gpio_rig_t *rig, hal_gpio_line_t line)
{
    return sim_gpio_level(rig->gpio, line);
}

void gpio_rig_pulse(gpio_rig_t *rig)
{
    sim_gpio_genlock(rig->gpio, gpio_rig_now_us(rig));
}

int64_t gpio_rig_now_us(gpio_rig_t *rig)
{
    sim_clock_set_us(rig->clock, ++rig->time_us);
    return rig->time_us;
}
