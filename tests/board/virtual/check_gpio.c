// SPDX-License-Identifier: Apache-2.0
// What else libgpiod's lines must do on the virtual board: chips by any name, lines that others hold, the lamp's end.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "hal/linux/gpio_gpiod.h"

enum { LED = 0, STROBE = 1, GENLOCK = 2, LAMP = 3 };

static hal_board_lines_t lines_of(const char *chip)
{
    return (hal_board_lines_t){.chip = chip, .line = {LED, STROBE, GENLOCK, LAMP}};
}

static hal_gpio_t *open_lines(const char *chip)
{
    const hal_board_lines_t lines = lines_of(chip);
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_gpio_t *gpio;
    if (gpio_gpiod_open(&gpio, &lines, error) != HAL_OK)
        fail_msg("%s", error);
    return gpio;
}

static int level(int offset)
{
    char path[128];
    snprintf(path, sizeof path, "/sys/devices/platform/gpio-sim.0/gpiochip1/sim_gpio%d/value", offset);
    FILE *value = fopen(path, "r");
    assert_non_null(value);
    const int read = fgetc(value);
    fclose(value);
    return read - '0';
}

static void chips_have_names_and_labels(void **state)
{
    (void)state;
    static const char *const names[] = {"wallwarp", "gpiochip1", "/dev/gpiochip1"};
    for (int i = 0; i < 3; i++) {
        hal_gpio_t *gpio = open_lines(names[i]);
        assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LAMP, true), HAL_OK);
        assert_int_equal(level(LAMP), 1);
        gpio_gpiod_close(gpio);
    }
}

static void assert_refused(const hal_board_lines_t *lines, const char *line)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    hal_gpio_t *gpio = NULL;
    assert_int_equal(gpio_gpiod_open(&gpio, lines, error), HAL_IO);
    assert_null(gpio);
    assert_string_equal(error, line);
}

/* What was taken before the failure is given back: the next one gets it. */
static void held_lines_are_told_with_their_holder(void **state)
{
    (void)state;
    const hal_board_lines_t lines = lines_of("wallwarp");
    hal_gpio_t *gpio = open_lines("wallwarp");
    assert_refused(&lines, "gpio wallwarp: line 3 (lamp) is held by \"wallwarp\": end that, or choose a free one of "
                           "`gpioinfo`");
    gpio_gpiod_close(gpio);
    assert_int_equal(system("gpiomon wallwarp 2 >/dev/null & echo $! >/tmp/holder; until gpioinfo wallwarp | grep "
                            "-q gpiomon; do sleep 0.1; done"),
                     0);
    assert_refused(&lines, "gpio wallwarp: line 2 (genlock) is held by \"gpiomon\": end that, or choose a free one of "
                           "`gpioinfo`");
    assert_int_equal(system("kill $(cat /tmp/holder); while gpioinfo wallwarp | grep -q gpiomon; do sleep 0.1; done"),
                     0);
    gpio_gpiod_close(open_lines("wallwarp"));
}

static void wrong_lines_are_told(void **state)
{
    (void)state;
    hal_board_lines_t lines = lines_of("wallwarp");
    lines.line[HAL_GPIO_STROBE] = 8;
    assert_refused(&lines, "gpio wallwarp: has no line 8 (strobe), expected one of `gpioinfo`");
    lines.line[HAL_GPIO_STROBE] = -2;
    assert_refused(&lines, "gpio wallwarp: has no line -2 (strobe), expected one of `gpioinfo`");
    lines.line[HAL_GPIO_STROBE] = HAL_BOARD_NO_LINE;
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_gpio_t *gpio;
    assert_int_equal(gpio_gpiod_open(&gpio, &lines, error), HAL_OK);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_STROBE, true), HAL_OK);
    assert_int_equal(level(STROBE), 0);
    gpio_gpiod_close(gpio);
}

static void all_is_low_at_the_end(void **state)
{
    (void)state;
    hal_gpio_t *gpio = open_lines("wallwarp");
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LED, true), HAL_OK);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_STROBE, true), HAL_OK);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LAMP, true), HAL_OK);
    assert_true(level(LED) && level(STROBE) && level(LAMP));
    gpio_gpiod_close(gpio);
    assert_false(level(LED) || level(STROBE) || level(LAMP));
}

/* The lines have a pull-down, as the lamp's wire must have. */
static void the_lamp_is_low_after_a_crash(void **state)
{
    (void)state;
    int ready[2], status;
    char byte;
    assert_int_equal(pipe(ready), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        hal_gpio_t *gpio = open_lines("wallwarp");
        if (hal_gpio_set(gpio, HAL_GPIO_LAMP, true) != HAL_OK || write(ready[1], "r", 1) != 1)
            _exit(1);
        pause();
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    assert_int_equal(level(LAMP), 1);
    assert_int_equal(kill(child, SIGKILL), 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(level(LAMP), 0);
    close(ready[0]);
    close(ready[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chips_have_names_and_labels),   cmocka_unit_test(held_lines_are_told_with_their_holder),
        cmocka_unit_test(wrong_lines_are_told),          cmocka_unit_test(all_is_low_at_the_end),
        cmocka_unit_test(the_lamp_is_low_after_a_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
