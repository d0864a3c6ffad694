// SPDX-License-Identifier: Apache-2.0
// What test_hal_gpio needs of the virtual board: its lines (gpio-sim), and their other ends in sysfs.
#include "tests/support/gpio_rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "hal/linux/gpio_gpiod.h"
#include "hal/linux/time_linux.h"

/* The kernel takes an edge in a thread of its own, and sees one where there are two before that runs. */
enum { REST_US = 10000 };

static const hal_board_lines_t lines = {.chip = "wallwarp", .line = {0, 1, 2, 3}};

struct gpio_rig {
    hal_time_t *clock;
    hal_gpio_t *gpio;
};

static FILE *open_end(hal_gpio_line_t line, const char *end, const char *mode)
{
    char path[128];
    snprintf(path, sizeof path, "/sys/devices/platform/gpio-sim.0/gpiochip1/sim_gpio%d/%s", lines.line[line], end);
    FILE *file = fopen(path, mode);
    if (file == NULL)
        fail_msg("%s: can't be opened", path);
    return file;
}

gpio_rig_t *gpio_rig_open(void)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    gpio_rig_t *rig = calloc(1, sizeof *rig);
    assert_non_null(rig);
    if (time_linux_open(&rig->clock, error) != HAL_OK || gpio_gpiod_open(&rig->gpio, &lines, error) != HAL_OK)
        fail_msg("%s", error);
    return rig;
}

void gpio_rig_close(gpio_rig_t *rig)
{
    gpio_gpiod_close(rig->gpio);
    time_linux_close(rig->clock);
    free(rig);
}

hal_gpio_t *gpio_rig_lines(gpio_rig_t *rig)
{
    return rig->gpio;
}

bool gpio_rig_level(const gpio_rig_t *rig, hal_gpio_line_t line)
{
    (void)rig;
    FILE *value = open_end(line, "value", "r");
    const int level = fgetc(value);
    fclose(value);
    assert_true(level == '0' || level == '1');
    return level == '1';
}

void gpio_rig_pulse(gpio_rig_t *rig)
{
    (void)rig;
    static const char *const pulls[] = {"pull-up", "pull-down"};
    for (int i = 0; i < 2; i++) {
        FILE *pull = open_end(HAL_GPIO_GENLOCK, "pull", "w");
        assert_true(fputs(pulls[i], pull) >= 0);
        assert_int_equal(fclose(pull), 0);
    }
    usleep(REST_US);
}

int64_t gpio_rig_now_us(gpio_rig_t *rig)
{
    const int64_t before_us = hal_time_now_us(rig->clock);
    int64_t now_us = before_us;
    while (now_us == before_us)
        now_us = hal_time_now_us(rig->clock);
    return now_us;
}
