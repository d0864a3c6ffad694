// SPDX-License-Identifier: Apache-2.0
// A board that runs Linux: hal_board_open() with its real devices.
#include <stddef.h>
#include <stdio.h>

#include "hal/hal_board.h"
#include "hal/linux/camera.h"
#include "hal/linux/can_socketcan.h"
#include "hal/linux/display_kms.h"
#include "hal/linux/gpio_gpiod.h"
#include "hal/linux/machine_linux.h"
#include "hal/linux/realtime_linux.h"
#include "hal/linux/service_systemd.h"
#include "hal/linux/time_linux.h"
#include "hal/linux/update_folder.h"
#include "hal/linux/watchdog_linux.h"

enum { HIGHEST_PRIORITY = 99 };

const char hal_board_help[] =
    "The bus is a CAN interface (can0), the camera v4l2: and a device or its name (v4l2:/dev/video0), or libcamera: "
    "and a camera's number or name, with a format before it where no other will do (nv12:libcamera:0), the display a "
    "connector (HDMI-A-1, card1:HDMI-A-1) or auto.";

_Static_assert(sizeof hal_board_help <= HAL_BOARD_HELP_LENGTH, "as hal_board.h says");

/* One step of opening. It leaves nothing behind when it fails. */
typedef hal_status_t open_fn(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                             char error[HAL_BOARD_ERROR_LENGTH]);
typedef void close_fn(hal_board_t *board);

static hal_status_t open_clock(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                               char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)table;
    (void)needs;
    return time_linux_open(&board->clock, error);
}

static void close_clock(hal_board_t *board)
{
    time_linux_close(board->clock);
}

static hal_status_t open_realtime(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                  char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)board;
    (void)needs;
    return realtime_linux_open(table->workers.priority, error);
}

static void close_realtime(hal_board_t *board)
{
    (void)board;
    realtime_linux_close();
}

static hal_status_t open_can(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                             char error[HAL_BOARD_ERROR_LENGTH])
{
    const can_socketcan_settings_t settings = {
        .interface = table->can,
        .bitrate = needs->bitrate,
        .data_bitrate = needs->data_bitrate,
        .fd = needs->fd,
    };
    return can_socketcan_open(&board->can, &settings, error);
}

static void close_can(hal_board_t *board)
{
    can_socketcan_close(board->can);
}

/* The camera's thread works for microseconds, and goes before the workers. */
static hal_status_t open_camera(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                char error[HAL_BOARD_ERROR_LENGTH])
{
    const int32_t workers = table->workers.priority;
    const camera_settings_t settings = {
        .name = table->camera,
        .width = needs->picture_width,
        .height = needs->picture_height,
        .rate_frames = needs->refresh_frames,
        .rate_seconds = needs->refresh_seconds,
        .priority = workers > 0 && workers < HIGHEST_PRIORITY ? workers + 1 : workers,
    };
    return camera_open(&board->camera, &settings, error);
}

static void close_camera(hal_board_t *board)
{
    camera_close(board->camera);
}

static hal_status_t open_display(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                 char error[HAL_BOARD_ERROR_LENGTH])
{
    const display_kms_settings_t settings = {
        .name = table->display,
        .width = needs->panel_width,
        .height = needs->panel_height,
        .refresh_frames = needs->refresh_frames,
        .refresh_seconds = needs->refresh_seconds,
    };
    return display_kms_open(&board->display, &settings, error);
}

static void close_display(hal_board_t *board)
{
    display_kms_close(board->display);
}

static hal_status_t open_lines(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                               char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)needs;
    return gpio_gpiod_open(&board->gpio, &table->lines, error);
}

static void close_lines(hal_board_t *board)
{
    gpio_gpiod_close(board->gpio);
}

static hal_status_t open_service(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                 char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)table;
    (void)needs;
    return service_systemd_open(&board->service, error);
}

static void close_service(hal_board_t *board)
{
    service_systemd_close(board->service);
}

static hal_status_t open_update(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)table;
    (void)needs;
    return update_folder_open(&board->update, update_folder_path, error);
}

static void close_update(hal_board_t *board)
{
    update_folder_close(board->update);
}

static hal_status_t open_workers(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                 char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)needs;
    return hal_workers_open(&board->workers, &table->workers, error);
}

static void close_workers(hal_board_t *board)
{
    hal_workers_close(board->workers);
}

static hal_status_t open_watchdog(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                  char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)needs;
    return watchdog_linux_open(&board->watchdog, table->watchdog, error);
}

static void close_watchdog(hal_board_t *board)
{
    watchdog_linux_close(board->watchdog);
}

/* Of what hal_board_open_some() opens: another one in its place. */
static hal_status_t open_any_display(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                     char error[HAL_BOARD_ERROR_LENGTH])
{
    board_table_t any = *table;
    any.display = "auto";
    return open_display(board, &any, needs, error);
}

static hal_status_t open_no_lines(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                  char error[HAL_BOARD_ERROR_LENGTH])
{
    const board_table_t none = {.name = table->name};
    return open_lines(board, &none, needs, error);
}

static hal_status_t open_no_watchdog(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                                     char error[HAL_BOARD_ERROR_LENGTH])
{
    const board_table_t none = {.name = table->name};
    return open_watchdog(board, &none, needs, error);
}

/* In order. The lines come after the display, so that the lamp is off before the wall shows the former picture; the
   watchdog is last, as it runs from open on. */
static const struct {
    open_fn *open;
    close_fn *close;
    bool some;         /* hal_board_open_some() opens it, */
    open_fn *in_place; /* or that in its place */
} devices[] = {
    {open_clock, close_clock, true, NULL},
    {open_realtime, close_realtime, false, NULL},
    {open_can, close_can, true, NULL},
    {open_camera, close_camera, false, NULL},
    {open_display, close_display, true, open_any_display},
    {open_lines, close_lines, true, open_no_lines},
    {open_service, close_service, true, NULL},
    {open_update, close_update, true, NULL},
    {open_workers, close_workers, false, NULL},
    {open_watchdog, close_watchdog, true, open_no_watchdog},
};

enum { DEVICES = sizeof devices / sizeof *devices };

_Static_assert((int)HAL_WORKERS_ERROR_LENGTH <= (int)HAL_BOARD_ERROR_LENGTH, "what the workers say must fit");

static void close_first(hal_board_t *board, int count)
{
    while (count-- > 0)
        devices[count].close(board);
}

hal_status_t hal_board_open(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                            char error[HAL_BOARD_ERROR_LENGTH])
{
    hal_board_t opened = {0};
    if (machine_linux_open("", table, error) != HAL_OK)
        return HAL_IO;
    for (int i = 0; i < DEVICES; i++)
        if (devices[i].open(&opened, table, needs, error) != HAL_OK) {
            close_first(&opened, i);
            return HAL_IO;
        }
    *board = opened;
    return HAL_OK;
}

hal_status_t hal_board_open_some(hal_board_t *board, const board_table_t *table, char error[HAL_BOARD_ERROR_LENGTH])
{
    const hal_board_needs_t any = {.fd = false};
    const board_table_t foreign = {.name = table->name, .display = table->display};
    const bool own = machine_linux_open("", table, error) == HAL_OK;
    const board_table_t *safe = own ? table : &foreign; /* of another board, lines and watchdog are who knows what */
    hal_board_t opened = {0};
    for (int i = 0; i < DEVICES; i++) {
        if (!devices[i].some || (devices[i].open == open_can && safe->can == NULL) ||
            devices[i].open(&opened, safe, &any, error) == HAL_OK)
            continue;
        fprintf(stderr, "wallwarp: %s\n", error);
        if (devices[i].in_place != NULL && devices[i].in_place(&opened, safe, &any, error) != HAL_OK)
            fprintf(stderr, "wallwarp: %s\n", error);
    }
    if (opened.clock == NULL || opened.gpio == NULL || opened.watchdog == NULL) {
        hal_board_close(&opened);
        return HAL_IO;
    }
    *board = opened;
    return HAL_OK;
}

void hal_board_close(hal_board_t *board)
{
    close_first(board, DEVICES);
}
