// SPDX-License-Identifier: Apache-2.0
// Open and close of the projector's display: card, CRTC, buffers, formats, mode.
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hal/linux/board_error.h"
#include "hal/linux/display_kms.h"
#include "hal/linux/display_kms_state.h"

enum { MODES_LENGTH = 130 };

__attribute__((format(printf, 3, 4))) static hal_status_t refuse(char error[HAL_BOARD_ERROR_LENGTH],
                                                                 const hal_display_t *display, const char *format, ...)
{
    char what[HAL_BOARD_ERROR_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return board_error(error, "display: card%d:%s: %s", display->card.number, display->card.connector_name, what);
}

static double hertz(const kms_mode_wanted_t *wanted)
{
    return (double)wanted->refresh_frames / wanted->refresh_seconds;
}

/* Luma and chroma: every format that a plane shows, and that the driver takes for whole pictures of this size. */
static void add_formats(hal_display_t *display)
{
    static const picture_format_t offered[] = {PICTURE_NV12, PICTURE_YUYV};
    for (size_t i = 0; i < sizeof offered / sizeof *offered; i++) {
        const picture_format_t format = offered[i];
        const picture_t picture = kms_buffers_picture(&display->buffers, 0, format);
        if (display->pipe.plane[format].id == 0 || !picture_is_valid(&picture) ||
            kms_buffers_add_format(&display->buffers, display->card.file, format) != 0)
            continue;
        const kms_scan_t scan = {display->buffers.buffer[0].framebuffer[format], format, PICTURE_BT709};
        if (kms_pipe_try(&display->pipe, &scan) != 0)
            kms_buffers_drop_format(&display->buffers, display->card.file, format);
    }
}

static void tell(const hal_display_t *display)
{
    fprintf(stderr, "display: card%d:%s (%s), %dx%d at %.2f Hz%s, xrgb8888%s%s\n", display->card.number,
            display->card.connector_name, display->card.driver, display->wanted.width, display->wanted.height,
            1e9 / (double)display->blank.nominal_ns, display->by_clock ? " by the clock" : "",
            hal_display_takes(display, PICTURE_NV12) ? " nv12" : "",
            hal_display_takes(display, PICTURE_YUYV) ? " yuyv" : "");
}

/* With the pipe and the buffers there: show black. */
static hal_status_t light(hal_display_t *display, const drmModeConnector *connector, char error[HAL_BOARD_ERROR_LENGTH])
{
    const kms_mode_wanted_t *wanted = &display->wanted;
    const int failure = kms_state_light(display, connector);
    if (failure == ENOENT) {
        char modes[MODES_LENGTH];
        kms_mode_list(modes, sizeof modes, connector->modes, connector->count_modes, wanted);
        return refuse(error, display, "the projector offers no %dx%d at %.2f Hz; expected in the room file one of: %s",
                      wanted->width, wanted->height, hertz(wanted), modes[0] == '\0' ? "(none)" : modes);
    }
    if (failure != 0)
        return refuse(error, display, "driver %s refuses %dx%d at %.2f Hz: %s; expected a mode that it can do",
                      display->card.driver, wanted->width, wanted->height, hertz(wanted), strerror(failure));
    add_formats(display);
    tell(display);
    return HAL_OK;
}

static hal_status_t make_ready(hal_display_t *display, const drmModeConnector *connector,
                               char error[HAL_BOARD_ERROR_LENGTH])
{
    const kms_mode_wanted_t *wanted = &display->wanted;
    int failure = kms_state_watch(display);
    if (failure != 0)
        return refuse(error, display, "can't read its state under /sys/class/drm: %s; expected /sys to be mounted",
                      strerror(failure));
    hal_status_t status = kms_card_own(&display->card, error);
    if (status == HAL_OK)
        status = kms_pipe_open(&display->pipe, &display->card, connector, wanted->width, wanted->height, error);
    if (status != HAL_OK)
        return status;
    failure = kms_buffers_open(&display->buffers, display->card.file, wanted->width, wanted->height);
    if (failure != 0)
        return refuse(error, display,
                      "can't have %d pictures of %dx%d: %s; expected more contiguous memory (cma=256M "
                      "in the kernel's command line)",
                      KMS_BUFFERS, wanted->width, wanted->height, strerror(failure));
    return light(display, connector, error);
}

hal_status_t display_kms_open(hal_display_t **display, const display_kms_settings_t *settings,
                              char error[HAL_BOARD_ERROR_LENGTH])
{
    kms_name_t name;
    if (!kms_name_parse(&name, settings->name, error))
        return HAL_BAD_CALL;
    hal_display_t *opened = malloc(sizeof *opened);
    if (opened == NULL)
        return board_error(error, "display: out of memory");
    *opened = (hal_display_t){
        .wanted = {settings->width, settings->height, settings->refresh_frames, settings->refresh_seconds},
        .shown = 0,
        .flying = KMS_NO_BUFFER,
        .waiting = KMS_NO_BUFFER,
        .borrowed = KMS_NO_BUFFER,
        .status = KMS_NO_FILE,
    };
    drmModeConnector *connector;
    hal_status_t status = kms_card_find(&opened->card, &connector, &name, error);
    if (status != HAL_OK) {
        free(opened);
        return status;
    }
    if (settings->width == 0)
        opened->wanted = kms_mode_preferred(connector->modes, connector->count_modes);
    status = make_ready(opened, connector, error);
    drmModeFreeConnector(connector);
    if (status != HAL_OK) {
        display_kms_close(opened);
        return status;
    }
    *display = opened;
    return HAL_OK;
}

void display_kms_close(hal_display_t *display)
{
    if (display == NULL)
        return;
    if (display->pipe.connector != 0)
        kms_pipe_close(&display->pipe);
    kms_buffers_close(&display->buffers, display->card.file);
    if (display->status != KMS_NO_FILE)
        close(display->status);
    kms_card_close(&display->card);
    free(display);
}
