// SPDX-License-Identifier: Apache-2.0
// The board's lines with libgpiod 2, which Debian 12 does not have: what it is told, against one that only notes it.
#include "hal/linux/gpio_gpiod.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <errno.h>
#include <string.h>

#include "tests/hal/linux/fake_gpiod_v2.h"

static const hal_board_lines_t lines = {
    .chip = "gpiochip7",
    .line = {[HAL_GPIO_LED] = 10, [HAL_GPIO_STROBE] = 11, [HAL_GPIO_GENLOCK] = 12, [HAL_GPIO_LAMP] = 13}};

static int set_up(void **state)
{
    (void)state;
    fake_gpiod = (fake_gpiod_t){.refused = -1};
    return 0;
}

static hal_gpio_t *open_lines(void)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    hal_gpio_t *gpio;
    if (gpio_gpiod_open(&gpio, &lines, error) != HAL_OK)
        fail_msg("%s", error);
    return gpio;
}

static void assert_told(const char *told)
{
    assert_string_equal(fake_gpiod.log, told);
    fake_gpiod.log[0] = '\0';
}

static void lines_are_taken_driven_and_given_back(void **state)
{
    (void)state;
    hal_gpio_t *gpio = open_lines();
    assert_told("13 wallwarp output 0;11 wallwarp output 0;10 wallwarp output 0;12 wallwarp input edge 2;");
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LAMP, true), HAL_OK);
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LED, false), HAL_OK);
    assert_told("13 1;10 0;");
    fake_gpiod.broken = true;
    assert_int_equal(hal_gpio_set(gpio, HAL_GPIO_LAMP, true), HAL_IO);
    fake_gpiod.broken = false;
    gpio_gpiod_close(gpio);
    assert_told("13 0;11 0;10 0;10 release;11 release;12 release;13 release;");
    assert_int_equal(fake_gpiod.objects, 0);
}

static void edges_are_taken_in_order(void **state)
{
    (void)state;
    hal_gpio_t *gpio = open_lines();
    int64_t time_us = 42;
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_EMPTY);
    for (int i = 0; i < 40; i++)
        fake_gpiod.edge_ns[fake_gpiod.edges++] = 5000999 + 1000 * (uint64_t)i;
    for (int i = 0; i < 40; i++) {
        assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_OK);
        assert_int_equal(time_us, 5000 + i);
    }
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_EMPTY);
    fake_gpiod.broken = true;
    assert_int_equal(hal_gpio_take_edge(gpio, HAL_GPIO_GENLOCK, &time_us), HAL_IO);
    assert_int_equal(time_us, 5039);
    gpio_gpiod_close(gpio);
}

static void assert_refused(int offset, int failure, const char *holder, const char *line)
{
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    hal_gpio_t *gpio = NULL;
    fake_gpiod = (fake_gpiod_t){.refused = offset, .refused_with = failure, .holder = holder};
    assert_int_equal(gpio_gpiod_open(&gpio, &lines, error), HAL_IO);
    assert_null(gpio);
    assert_string_equal(error, line);
    assert_int_equal(fake_gpiod.objects, 0);
}

static void refused_lines_are_told(void **state)
{
    (void)state;
    assert_refused(11, EBUSY, "someone",
                   "gpio gpiochip7: line 11 (strobe) is held by \"someone\": end that, or choose a free one of "
                   "`gpioinfo`");
    assert_refused(
        13, EBUSY, NULL,
        "gpio gpiochip7: line 13 (lamp) is held by \"kernel\": end that, or choose a free one of `gpioinfo`");
    assert_refused(12, ENXIO, NULL,
                   "gpio gpiochip7: line 12 (genlock): No such device or address, expected an input with interrupts");
    assert_refused(10, EINVAL, NULL, "gpio gpiochip7: has no line 10 (LED), expected one of `gpioinfo`");
}

static void chips_are_looked_for(void **state)
{
    (void)state;
    char error[HAL_BOARD_ERROR_LENGTH] = "";
    hal_gpio_t *gpio;
    hal_board_lines_t others = lines;
    others.chip = "/dev/gpiochip7";
    assert_int_equal(gpio_gpiod_open(&gpio, &others, error), HAL_OK);
    gpio_gpiod_close(gpio);
    others.chip = "no-such-label";
    assert_int_equal(gpio_gpiod_open(&gpio, &others, error), HAL_IO);
    assert_string_equal(error, "gpio no-such-label: No such file or directory, expected the name or label of a chip of "
                               "`gpiodetect`");
    assert_int_equal(fake_gpiod.objects, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(lines_are_taken_driven_and_given_back, set_up),
        cmocka_unit_test_setup(edges_are_taken_in_order, set_up),
        cmocka_unit_test_setup(refused_lines_are_told, set_up),
        cmocka_unit_test_setup(chips_are_looked_for, set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
