// SPDX-License-Identifier: Apache-2.0
// A libgpiod 2 of one chip that is not there: it notes what it is told, and answers what the test wants.
#include "tests/hal/linux/fake_gpiod_v2.h"

#include <errno.h>
#include <gpiod.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

fake_gpiod_t fake_gpiod;

struct gpiod_chip {
    int unused;
};
struct gpiod_line_info {
    unsigned offset;
};
struct gpiod_line_settings {
    enum gpiod_line_direction direction;
    enum gpiod_line_edge edge;
    enum gpiod_line_value value;
};
struct gpiod_line_config {
    unsigned offset;
    struct gpiod_line_settings settings;
};
struct gpiod_request_config {
    char consumer[32];
};
struct gpiod_line_request {
    unsigned offset;
};
struct gpiod_edge_event {
    uint64_t ns;
};
struct gpiod_edge_event_buffer {
    struct gpiod_edge_event event[FAKE_EDGES];
};

static void *make(size_t size)
{
    fake_gpiod.objects++;
    return calloc(1, size);
}

static void destroy(void *object)
{
    fake_gpiod.objects -= object != NULL;
    free(object);
}

static void note(const char *format, ...) __attribute__((format(printf, 1, 2)));

static void note(const char *format, ...)
{
    const size_t length = strlen(fake_gpiod.log);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fake_gpiod.log + length, sizeof fake_gpiod.log - length, format, arguments);
    va_end(arguments);
}

bool gpiod_is_gpiochip_device(const char *path)
{
    return strcmp(path, "/dev/gpiochip7") == 0;
}

struct gpiod_chip *gpiod_chip_open(const char *path)
{
    if (gpiod_is_gpiochip_device(path))
        return make(sizeof(struct gpiod_chip));
    errno = ENOENT;
    return NULL;
}

void gpiod_chip_close(struct gpiod_chip *chip)
{
    destroy(chip);
}

struct gpiod_chip_info *gpiod_chip_get_info(struct gpiod_chip *chip)
{
    (void)chip;
    return NULL;
}

const char *gpiod_chip_info_get_label(struct gpiod_chip_info *info)
{
    (void)info;
    return "";
}

void gpiod_chip_info_free(struct gpiod_chip_info *info)
{
    (void)info;
}

struct gpiod_line_info *gpiod_chip_get_line_info(struct gpiod_chip *chip, unsigned int offset)
{
    (void)chip;
    struct gpiod_line_info *info = make(sizeof *info);
    info->offset = offset;
    return info;
}

const char *gpiod_line_info_get_consumer(struct gpiod_line_info *info)
{
    return (int)info->offset == fake_gpiod.refused ? fake_gpiod.holder : NULL;
}

void gpiod_line_info_free(struct gpiod_line_info *info)
{
    destroy(info);
}

struct gpiod_line_settings *gpiod_line_settings_new(void)
{
    return make(sizeof(struct gpiod_line_settings));
}

void gpiod_line_settings_free(struct gpiod_line_settings *settings)
{
    destroy(settings);
}

int gpiod_line_settings_set_direction(struct gpiod_line_settings *settings, enum gpiod_line_direction direction)
{
    settings->direction = direction;
    return 0;
}

int gpiod_line_settings_set_edge_detection(struct gpiod_line_settings *settings, enum gpiod_line_edge edge)
{
    settings->edge = edge;
    return 0;
}

int gpiod_line_settings_set_output_value(struct gpiod_line_settings *settings, enum gpiod_line_value value)
{
    settings->value = value;
    return 0;
}

struct gpiod_line_config *gpiod_line_config_new(void)
{
    return make(sizeof(struct gpiod_line_config));
}

void gpiod_line_config_free(struct gpiod_line_config *config)
{
    destroy(config);
}

int gpiod_line_config_add_line_settings(struct gpiod_line_config *config, const unsigned int *offsets,
                                        size_t num_offsets, struct gpiod_line_settings *settings)
{
    if (num_offsets != 1)
        return -1;
    config->offset = offsets[0];
    config->settings = *settings;
    return 0;
}

struct gpiod_request_config *gpiod_request_config_new(void)
{
    return make(sizeof(struct gpiod_request_config));
}

void gpiod_request_config_free(struct gpiod_request_config *config)
{
    destroy(config);
}

void gpiod_request_config_set_consumer(struct gpiod_request_config *config, const char *consumer)
{
    snprintf(config->consumer, sizeof config->consumer, "%s", consumer);
}

struct gpiod_line_request *gpiod_chip_request_lines(struct gpiod_chip *chip, struct gpiod_request_config *req_cfg,
                                                    struct gpiod_line_config *line_cfg)
{
    (void)chip;
    const struct gpiod_line_settings *settings = &line_cfg->settings;
    if ((int)line_cfg->offset == fake_gpiod.refused) {
        errno = fake_gpiod.refused_with;
        return NULL;
    }
    if (settings->direction == GPIOD_LINE_DIRECTION_OUTPUT)
        note("%u %s output %d;", line_cfg->offset, req_cfg->consumer, (int)settings->value);
    else
        note("%u %s input edge %d;", line_cfg->offset, req_cfg->consumer, (int)settings->edge);
    struct gpiod_line_request *request = make(sizeof *request);
    request->offset = line_cfg->offset;
    return request;
}

void gpiod_line_request_release(struct gpiod_line_request *request)
{
    note("%u release;", request->offset);
    destroy(request);
}

int gpiod_line_request_set_value(struct gpiod_line_request *request, unsigned int offset, enum gpiod_line_value value)
{
    if (fake_gpiod.broken || offset != request->offset)
        return -1;
    note("%u %d;", offset, (int)value);
    return 0;
}

int gpiod_line_request_wait_edge_events(struct gpiod_line_request *request, int64_t timeout_ns)
{
    (void)request;
    if (fake_gpiod.broken || timeout_ns != 0)
        return -1;
    return fake_gpiod.first_edge < fake_gpiod.edges;
}

int gpiod_line_request_read_edge_events(struct gpiod_line_request *request, struct gpiod_edge_event_buffer *buffer,
                                        size_t max_events)
{
    (void)request;
    int count = 0;
    while (fake_gpiod.first_edge < fake_gpiod.edges && count < (int)max_events)
        buffer->event[count++].ns = fake_gpiod.edge_ns[fake_gpiod.first_edge++];
    return count;
}

struct gpiod_edge_event_buffer *gpiod_edge_event_buffer_new(size_t capacity)
{
    return capacity <= FAKE_EDGES ? make(sizeof(struct gpiod_edge_event_buffer)) : NULL;
}

void gpiod_edge_event_buffer_free(struct gpiod_edge_event_buffer *buffer)
{
    destroy(buffer);
}

struct gpiod_edge_event *gpiod_edge_event_buffer_get_event(struct gpiod_edge_event_buffer *buffer, unsigned long index)
{
    return &buffer->event[index];
}

uint64_t gpiod_edge_event_get_timestamp_ns(struct gpiod_edge_event *event)
{
    return event->ns;
}
