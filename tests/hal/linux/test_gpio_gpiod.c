// SPDX-License-Identifier: Apache-2.0
// Lines of a board that has none, and a chip that is not there. What lines do is seen on the virtual board.
#include "hal/linux/gpio_gpiod.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

static void a_board_without_lines_does_nothing(void **state)
{
    (void)state;
    static const hal_board_lines_t cases[] = {
        {.chip = NULL, .line = {1, 2, 3, 4}},
        {.chip = NULL, .line = {HAL_BOARD_NO_LINE, HAL_BOARD_NO_LINE, HAL_BOARD_NO_LINE, HAL_BOARD_NO_LINE}},
    };
    for (int i = 0; i < 2; i++) {
        char error[HAL_BOARD_ERROR_LENGTH];
        int64_t time_us = 42;
        hal_gpio_t *gpio;
        assert_int_equal(gpio_gpiod_open(&gpio, &cases[i], error), HAL_OK);
        assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LED, true), HAL_OK);
        assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_STROBE, true), HAL_OK);
        assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LAMP, true), HAL_OK);
        assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_GENLOCK, true), HAL_BAD_CALL);
        assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LINES, true), HAL_BAD_CALL);
        assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_EMPTY);
        assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_LED, &time_us), HAL_BAD_CALL);
        assert_int_equal(time_us, 42);
        gpio_gpiod_close(gpio);
    }
    gpio_gpiod_close(NULL);
}

static void a_missing_chip_is_told(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    hal_gpio_t *gpio = NULL;
    const hal_board_lines_t lines = {.chip = "no-such-chip", .line = {1, 2, 3, 4}};
    assert_int_equal(gpio_gpiod_open(&gpio, &lines, error), HAL_IO);
    assert_null(gpio);
    assert_string_equal(error, "gpio no-such-chip: No such file or directory, expected the name or label of a chip of "
                               "`gpiodetect`");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_board_without_lines_does_nothing),
        cmocka_unit_test(a_missing_chip_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
