// SPDX-License-Identifier: Apache-2.0
// The lines of gpiod_lines.h with libgpiod 2.
#include "hal/linux/gpiod_lines.h"

#include <dirent.h>
#include <errno.h>
#include <gpiod.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct gpiod_lines {
    struct gpiod_chip *chip;
    struct gpiod_line_request *request[HAL_GPIO_LINES];
    unsigned offset[HAL_GPIO_LINES];
    struct gpiod_edge_event_buffer *edges;
};

static bool has_label(struct gpiod_chip *chip, const char *label)
{
    struct gpiod_chip_info *info = gpiod_chip_get_info(chip);
    const bool same = info != NULL && strcmp(gpiod_chip_info_get_label(info), label) == 0;
    if (info != NULL)
        gpiod_chip_info_free(info);
    return same;
}

/* NULL with errno set. */
static struct gpiod_chip *open_labelled(const char *label)
{
    struct gpiod_chip *found = NULL;
    int failure = ENOENT;
    DIR *folder = opendir("/dev");
    if (folder == NULL)
        return NULL;
    for (struct dirent *entry = readdir(folder); entry != NULL && found == NULL; entry = readdir(folder)) {
        char path[sizeof "/dev/" + sizeof entry->d_name];
        snprintf(path, sizeof path, "/dev/%s", entry->d_name);
        if (strncmp(entry->d_name, "gpiochip", 8) != 0 || !gpiod_is_gpiochip_device(path))
            continue;
        found = gpiod_chip_open(path);
        if (found == NULL) {
            failure = errno;
        } else if (!has_label(found, label)) {
            gpiod_chip_close(found);
            found = NULL;
        }
    }
    closedir(folder);
    errno = failure;
    return found;
}

static struct gpiod_chip *open_chip(const char *name)
{
    char path[64];
    snprintf(path, sizeof path, name[0] == '/' ? "%s" : "/dev/%s", name);
    return gpiod_is_gpiochip_device(path) ? gpiod_chip_open(path) : open_labelled(name);
}

gpiod_lines_t *gpiod_lines_open(const char *name)
{
    gpiod_lines_t *lines = calloc(1, sizeof *lines);
    if (lines == NULL)
        return NULL;
    lines->edges = gpiod_edge_event_buffer_new(GPIOD_LINES_EDGES);
    lines->chip = lines->edges == NULL ? NULL : open_chip(name);
    if (lines->chip != NULL)
        return lines;
    const int failure = errno;
    gpiod_lines_close(lines);
    errno = failure;
    return NULL;
}

void gpiod_lines_close(gpiod_lines_t *lines)
{
    for (int i = 0; i < HAL_GPIO_LINES; i++)
        if (lines->request[i] != NULL)
            gpiod_line_request_release(lines->request[i]);
    if (lines->chip != NULL)
        gpiod_chip_close(lines->chip);
    if (lines->edges != NULL)
        gpiod_edge_event_buffer_free(lines->edges);
    free(lines);
}

/* Edges are stamped on CLOCK_MONOTONIC, and 16 are kept, unless one asks for others. */
static int take(gpiod_lines_t *lines, hal_gpio_line_t line, int32_t offset, bool output)
{
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    struct gpiod_line_config *config = gpiod_line_config_new();
    struct gpiod_request_config *request = gpiod_request_config_new();
    int failure = ENOMEM;
    lines->offset[line] = (unsigned)offset;
    if (settings != NULL && config != NULL && request != NULL) {
        gpiod_request_config_set_consumer(request, gpiod_lines_consumer);
        const bool legal = output ? gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT) == 0 &&
                                        gpiod_line_settings_set_output_value(settings, GPIOD_LINE_VALUE_INACTIVE) == 0
                                  : gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT) == 0 &&
                                        gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_RISING) == 0;
        if (legal && gpiod_line_config_add_line_settings(config, &lines->offset[line], 1, settings) == 0)
            lines->request[line] = gpiod_chip_request_lines(lines->chip, request, config);
        failure = lines->request[line] != NULL ? 0 : errno;
    }
    gpiod_request_config_free(request);
    gpiod_line_config_free(config);
    gpiod_line_settings_free(settings);
    return failure;
}

int gpiod_lines_take_output(gpiod_lines_t *lines, hal_gpio_line_t line, int32_t offset)
{
    return take(lines, line, offset, true);
}

int gpiod_lines_take_input(gpiod_lines_t *lines, hal_gpio_line_t line, int32_t offset)
{
    return take(lines, line, offset, false);
}

void gpiod_lines_holder(gpiod_lines_t *lines, int32_t offset, char name[GPIOD_LINES_NAME_LENGTH])
{
    struct gpiod_line_info *info = gpiod_chip_get_line_info(lines->chip, (unsigned)offset);
    const char *holder = info == NULL ? NULL : gpiod_line_info_get_consumer(info);
    snprintf(name, GPIOD_LINES_NAME_LENGTH, "%s", holder == NULL ? "" : holder);
    if (info != NULL)
        gpiod_line_info_free(info);
}

bool gpiod_lines_set(gpiod_lines_t *lines, hal_gpio_line_t line, bool high)
{
    return gpiod_line_request_set_value(lines->request[line], lines->offset[line],
                                        high ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE) == 0;
}

int gpiod_lines_read(gpiod_lines_t *lines, hal_gpio_line_t line, int64_t time_us[GPIOD_LINES_EDGES])
{
    const int any = gpiod_line_request_wait_edge_events(lines->request[line], 0);
    if (any <= 0)
        return any;
    const int count = gpiod_line_request_read_edge_events(lines->request[line], lines->edges, GPIOD_LINES_EDGES);
    for (int i = 0; i < count; i++)
        time_us[i] = (int64_t)(gpiod_edge_event_get_timestamp_ns(
                                   gpiod_edge_event_buffer_get_event(lines->edges, (unsigned long)i)) /
                               1000);
    return count;
}
