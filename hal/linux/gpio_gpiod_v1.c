// SPDX-License-Identifier: Apache-2.0
// The lines of gpiod_lines.h with libgpiod 1.
#include "hal/linux/gpiod_lines.h"

#include <errno.h>
#include <fcntl.h>
#include <gpiod.h>
#include <stdio.h>
#include <stdlib.h>

struct gpiod_lines {
    struct gpiod_chip *chip;
    struct gpiod_line *line[HAL_GPIO_LINES];
};

gpiod_lines_t *gpiod_lines_open(const char *name)
{
    gpiod_lines_t *lines = calloc(1, sizeof *lines);
    if (lines == NULL)
        return NULL;
    errno = 0;
    lines->chip = gpiod_chip_open_lookup(name);
    if (lines->chip != NULL)
        return lines;
    const int failure = errno == 0 ? ENOENT : errno;
    free(lines);
    errno = failure;
    return NULL;
}

/* Closing the chip gives its lines back. */
void gpiod_lines_close(gpiod_lines_t *lines)
{
    gpiod_chip_close(lines->chip);
    free(lines);
}

int gpiod_lines_take_output(gpiod_lines_t *lines, hal_gpio_line_t line, int32_t offset)
{
    lines->line[line] = gpiod_chip_get_line(lines->chip, (unsigned)offset);
    return lines->line[line] != NULL && gpiod_line_request_output(lines->line[line], gpiod_lines_consumer, 0) == 0
               ? 0
               : errno;
}

int gpiod_lines_take_input(gpiod_lines_t *lines, hal_gpio_line_t line, int32_t offset)
{
    lines->line[line] = gpiod_chip_get_line(lines->chip, (unsigned)offset);
    if (lines->line[line] == NULL ||
        gpiod_line_request_rising_edge_events(lines->line[line], gpiod_lines_consumer) != 0)
        return errno;
    const int file = gpiod_line_event_get_fd(lines->line[line]);
    const int flags = fcntl(file, F_GETFL);
    return flags != -1 && fcntl(file, F_SETFL, flags | O_NONBLOCK) == 0 ? 0 : errno;
}

void gpiod_lines_holder(gpiod_lines_t *lines, int32_t offset, char name[GPIOD_LINES_NAME_LENGTH])
{
    struct gpiod_line *line = gpiod_chip_get_line(lines->chip, (unsigned)offset);
    const char *holder = line == NULL || gpiod_line_update(line) != 0 ? NULL : gpiod_line_consumer(line);
    snprintf(name, GPIOD_LINES_NAME_LENGTH, "%s", holder == NULL ? "" : holder);
}

bool gpiod_lines_set(gpiod_lines_t *lines, hal_gpio_line_t line, bool high)
{
    return gpiod_line_set_value(lines->line[line], high) == 0;
}

int gpiod_lines_read(gpiod_lines_t *lines, hal_gpio_line_t line, int64_t time_us[GPIOD_LINES_EDGES])
{
    struct gpiod_line_event events[GPIOD_LINES_EDGES];
    const int file = gpiod_line_event_get_fd(lines->line[line]);
    const int count = gpiod_line_event_read_fd_multiple(file, events, GPIOD_LINES_EDGES);
    if (count < 0)
        return errno == EAGAIN ? 0 : -1;
    for (int i = 0; i < count; i++)
        time_us[i] = (int64_t)events[i].ts.tv_sec * 1000000 + events[i].ts.tv_nsec / 1000;
    return count;
}
