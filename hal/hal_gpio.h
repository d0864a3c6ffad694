// SPDX-License-Identifier: Apache-2.0
// Contract of the board's few digital lines, named by what they do.
#ifndef HAL_HAL_GPIO_H
#define HAL_HAL_GPIO_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_status.h"

typedef struct hal_gpio hal_gpio_t;

typedef enum {
    HAL_GPIO_LED,     /**< output: state of the board, for people */
    HAL_GPIO_STROBE,  /**< output: high while a new picture is being made, for a scope */
    HAL_GPIO_GENLOCK, /**< input: rising edge once per house frame */
    HAL_GPIO_LAMP, /**< output: high lets the projector light its lamp; low before the first picture, and at the end */
    HAL_GPIO_LINES
} hal_gpio_line_t;

/** @return What people call it. */
static inline const char *hal_gpio_line_name(hal_gpio_line_t line)
{
    static const char *const names[HAL_GPIO_LINES] = {"LED", "strobe", "genlock", "lamp"};
    return names[line];
}

/**
 * Drive an output.
 *
 * @return HAL_OK; HAL_BAD_CALL when the line is an input; HAL_IO when the driver fails (the level is then unknown).
 */
MUST_CHECK hal_status_t hal_gpio_set(hal_gpio_t *gpio, hal_gpio_line_t line, bool high);

/**
 * Take the oldest rising edge of an input, without blocking.
 *
 * At least 16 are kept. When more are waiting some are lost, the oldest or the newest, and the rest stay in order.
 *
 * @param[out] time_us  When it rose, on hal_time's clock; written only when HAL_OK is returned.
 * @return HAL_OK; HAL_EMPTY when none is waiting; HAL_BAD_CALL when the line is an output; HAL_IO.
 */
MUST_CHECK hal_status_t hal_gpio_take_edge(hal_gpio_t *gpio, hal_gpio_line_t line, int64_t *time_us);

#endif
