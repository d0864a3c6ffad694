// SPDX-License-Identifier: Apache-2.0
// The board's digital lines (hal/hal_gpio.h) through libgpiod, of its API 1 or 2 as the build finds it.
#include "hal/linux/gpio_gpiod.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/board_error.h"
#include "hal/linux/gpiod_lines.h"

struct hal_gpio {
    gpiod_lines_t *lines; /* NULL: the board has none */
    bool taken[HAL_GPIO_LINES];
    int64_t edge_us[GPIOD_LINES_EDGES]; /* of genlock: [first_edge, edges) are not taken yet */
    int first_edge, edges;
};

/* The lamp is the first to be held low. */
static const hal_gpio_line_t order[HAL_GPIO_LINES] = {HAL_GPIO_LAMP, HAL_GPIO_STROBE, HAL_GPIO_LED, HAL_GPIO_GENLOCK};

static hal_status_t explain_chip(const char *chip, int failure, char error[HAL_BOARD_ERROR_LENGTH])
{
    if (failure == EACCES || failure == EPERM)
        return board_error(error, "gpio %.60s: %s, expected the right to use it: be in the group of /dev/gpiochip*",
                           chip, strerror(failure));
    return board_error(error, "gpio %.60s: %s, expected the name or label of a chip of `gpiodetect`", chip,
                       strerror(failure));
}

static hal_status_t explain_line(hal_gpio_t *gpio, const hal_board_lines_t *lines, hal_gpio_line_t line, int failure,
                                 char error[HAL_BOARD_ERROR_LENGTH])
{
    const int32_t offset = lines->line[line];
    char holder[GPIOD_LINES_NAME_LENGTH];
    if (failure == EBUSY) {
        gpiod_lines_holder(gpio->lines, offset, holder);
        return board_error(error,
                           "gpio %.60s: line %d (%s) is held by \"%s\": end that, or choose a free one of `gpioinfo`",
                           lines->chip, offset, hal_gpio_line_name(line), holder[0] == '\0' ? "kernel" : holder);
    }
    if (failure == EINVAL)
        return board_error(error, "gpio %.60s: has no line %d (%s), expected one of `gpioinfo`", lines->chip, offset,
                           hal_gpio_line_name(line));
    if (line == HAL_GPIO_GENLOCK)
        return board_error(error, "gpio %.60s: line %d (%s): %s, expected an input with interrupts", lines->chip,
                           offset, hal_gpio_line_name(line), strerror(failure));
    return board_error(error, "gpio %.60s: line %d (%s): %s, expected an output", lines->chip, offset,
                       hal_gpio_line_name(line), strerror(failure));
}

static hal_status_t take_lines(hal_gpio_t *gpio, const hal_board_lines_t *lines, char error[HAL_BOARD_ERROR_LENGTH])
{
    for (int i = 0; i < HAL_GPIO_LINES; i++) {
        const hal_gpio_line_t line = order[i];
        const int32_t offset = lines->line[line];
        if (offset == HAL_BOARD_NO_LINE)
            continue;
        int failure = EINVAL;
        if (offset >= 0 && line == HAL_GPIO_GENLOCK)
            failure = gpiod_lines_take_input(gpio->lines, line, offset);
        else if (offset >= 0)
            failure = gpiod_lines_take_output(gpio->lines, line, offset);
        if (failure != 0)
            return explain_line(gpio, lines, line, failure, error);
        gpio->taken[line] = true;
    }
    return HAL_OK;
}

hal_status_t gpio_gpiod_open(hal_gpio_t **gpio, const hal_board_lines_t *lines, char error[HAL_BOARD_ERROR_LENGTH])
{
    hal_status_t status = HAL_OK;
    hal_gpio_t *made = calloc(1, sizeof *made);
    if (made == NULL)
        return board_error(error, "gpio: out of memory");
    if (lines->chip != NULL) {
        made->lines = gpiod_lines_open(lines->chip);
        status = made->lines == NULL ? explain_chip(lines->chip, errno, error) : take_lines(made, lines, error);
    }
    if (status == HAL_OK)
        *gpio = made;
    else
        gpio_gpiod_close(made);
    return status;
}

void gpio_gpiod_close(hal_gpio_t *gpio)
{
    if (gpio == NULL)
        return;
    for (int i = 0; i < HAL_GPIO_LINES; i++)
        if (gpio->taken[order[i]] && order[i] != HAL_GPIO_GENLOCK)
            (void)gpiod_lines_set(gpio->lines, order[i], false);
    if (gpio->lines != NULL)
        gpiod_lines_close(gpio->lines);
    free(gpio);
}

hal_status_t hal_gpio_set(hal_gpio_t *gpio, hal_gpio_line_t line, bool high)
{
    if (line == HAL_GPIO_GENLOCK || line >= HAL_GPIO_LINES)
        return HAL_BAD_CALL;
    return !gpio->taken[line] || gpiod_lines_set(gpio->lines, line, high) ? HAL_OK : HAL_IO;
}

hal_status_t hal_gpio_take_edge(hal_gpio_t *gpio, hal_gpio_line_t line, int64_t *time_us)
{
    if (line != HAL_GPIO_GENLOCK)
        return HAL_BAD_CALL;
    if (!gpio->taken[line])
        return HAL_EMPTY;
    if (gpio->first_edge == gpio->edges) {
        const int edges = gpiod_lines_read(gpio->lines, line, gpio->edge_us);
        gpio->first_edge = 0;
        gpio->edges = edges < 0 ? 0 : edges;
        if (edges < 0)
            return HAL_IO;
        if (edges == 0)
            return HAL_EMPTY;
    }
    *time_us = gpio->edge_us[gpio->first_edge++];
    return HAL_OK;
}
