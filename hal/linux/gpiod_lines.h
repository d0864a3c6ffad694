// SPDX-License-Identifier: Apache-2.0
// What gpio_gpiod.c needs of libgpiod: gpio_gpiod_v1.c and gpio_gpiod_v2.c do it with either API, one is built.
#ifndef HAL_LINUX_GPIOD_LINES_H
#define HAL_LINUX_GPIOD_LINES_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/hal_gpio.h"

enum { GPIOD_LINES_EDGES = 16, GPIOD_LINES_NAME_LENGTH = 32 };

/** What lines are taken as: the name that others see. */
static const char gpiod_lines_consumer[] = "wallwarp";

/** A chip, and those of its lines that were taken, each under the number of what it is for. */
typedef struct gpiod_lines gpiod_lines_t;

/**
 * Open a chip.
 *
 * @param name  gpiochip0, or its path, or its label.
 * @return NULL with errno set.
 */
gpiod_lines_t *gpiod_lines_open(const char *name);

/** Give all lines back and close the chip. */
void gpiod_lines_close(gpiod_lines_t *lines);

/**
 * Take a line: as an output that is low, or as an input whose rising edges are kept. No heap from then on.
 *
 * @return 0, or an errno: EBUSY when somebody holds it, EINVAL when the chip has none of that offset.
 */
int gpiod_lines_take_output(gpiod_lines_t *lines, hal_gpio_line_t line, int32_t offset);
int gpiod_lines_take_input(gpiod_lines_t *lines, hal_gpio_line_t line, int32_t offset);

/** The name that the holder of a line gave: "" when there is none. */
void gpiod_lines_holder(gpiod_lines_t *lines, int32_t offset, char name[GPIOD_LINES_NAME_LENGTH]);

/** Drive an output that was taken. @return Did it work? */
bool gpiod_lines_set(gpiod_lines_t *lines, hal_gpio_line_t line, bool high);

/**
 * Take the oldest edges of an input that was taken, without blocking.
 *
 * @param[out] time_us  The first so many are written: CLOCK_MONOTONIC.
 * @return How many; -1 on failure.
 */
int gpiod_lines_read(gpiod_lines_t *lines, hal_gpio_line_t line, int64_t time_us[GPIOD_LINES_EDGES]);

#endif
