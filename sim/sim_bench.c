// SPDX-License-Identifier: Apache-2.0
// One board on the bench: hal_board_open() for a firmware that runs by itself on this machine, in real time.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal/hal_board.h"
#include "sim/bus/sim_bus.h"
#include "sim/bus/socketcand_server.h"
#include "sim/devices/sim_picture.h"
#include "sim/devices/sim_camera.h"
#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_display.h"
#include "sim/devices/sim_gpio.h"
#include "sim/devices/sim_service.h"
#include "sim/devices/sim_watchdog.h"
#include "sim/files/folder.h"
#include "sim/files/png_file.h"

enum { WATCHDOG_US = 2000000, PICTURE_PERIOD_US = 1000000, LAST_PORT = 65535 };

_Static_assert((int)HAL_BOARD_ERROR_LENGTH >= (int)FILE_ERROR_LENGTH &&
                   (int)HAL_BOARD_ERROR_LENGTH >= (int)SOCKETCAND_ERROR_LENGTH &&
                   (int)HAL_BOARD_ERROR_LENGTH >= (int)HAL_WORKERS_ERROR_LENGTH,
               "what the devices say of a failure must fit what hal_board_open() is given");

const char hal_board_help[] =
    "The bus is a port of 127.0.0.1 (socketcand protocol, channel can0), the camera a picture or video file or "
    "\"pattern\", the display a folder for PNGs or \"none\"; nv12: or another format may be before either, for "
    "pictures that are not XRGB.";

_Static_assert(sizeof hal_board_help <= HAL_BOARD_HELP_LENGTH, "as hal_board.h says");

typedef struct {
    hal_board_t devices;
    sim_bus_t *bus;
    socketcand_server_t *server;
    video_t *video;
    const char *folder; /**< for pictures; NULL for none */
    int64_t picture_due_us;
    bool camera_failed;  /**< and that has been told */
    bool display_failed; /**< likewise: the newest picture could not be written */
} bench_t;

static void write_picture(bench_t *b, int64_t now_us)
{
    if (b->folder == NULL || now_us < b->picture_due_us)
        return;
    const image_t *shown = sim_display_shown(b->devices.display);
    if (shown == NULL)
        return;
    char path[4096];
    char error[FILE_ERROR_LENGTH];
    b->picture_due_us = now_us + PICTURE_PERIOD_US;
    const int length = snprintf(path, sizeof path, "%s/display.png", b->folder);
    const bool written = length >= 0 && (size_t)length < sizeof path
                             ? png_file_write(path, shown, error)
                             : file_error(error, b->folder, "the folder's name is too long");
    if (!written && !b->display_failed)
        fprintf(stderr, "wallwarp: display: %s\n", error);
    b->display_failed = !written;
}

/* Between two steps of the firmware: let the world around the board go on. */
static void move_world(void *context)
{
    bench_t *b = context;
    const int64_t now_us = hal_time_now_us(b->devices.clock);
    char error[FILE_ERROR_LENGTH];
    if (b->server != NULL) {
        socketcand_server_poll(b->server);
        sim_bus_advance(b->bus, now_us);
        socketcand_server_poll(b->server);
    }
    const bool camera_ok = b->devices.camera == NULL || sim_camera_advance(b->devices.camera, now_us, error);
    if (!camera_ok && !b->camera_failed)
        fprintf(stderr, "wallwarp: camera: %s\n", error);
    b->camera_failed = !camera_ok;
    write_picture(b, now_us);
}

static bool open_bus(bench_t *b, const board_table_t *table, const hal_board_needs_t *needs,
                     char error[HAL_BOARD_ERROR_LENGTH])
{
    char *end;
    const long port = strtol(table->can, &end, 10);
    if (end == table->can || *end != '\0' || port < 0 || port > LAST_PORT)
        return file_error(error, "can", "found \"%s\", expected a port of 127.0.0.1, 0 for any free one", table->can);
    const sim_bus_config_t config = {
        .bitrate = needs->bitrate,
        .data_bitrate = needs->data_bitrate,
        .fd = needs->fd,
        .start_us = hal_time_now_us(b->devices.clock),
    };
    b->bus = sim_bus_create(&config);
    if (b->bus == NULL)
        return file_error(error, "can", "%d and %d bit/s are out of range, or out of memory", needs->bitrate,
                          needs->data_bitrate);
    b->devices.can = sim_bus_attach(b->bus);
    if (b->devices.can == NULL)
        return file_error(error, "can", "out of memory");
    b->server = socketcand_server_open((int)port, b->bus, error);
    if (b->server == NULL)
        return false;
    fprintf(stderr, "can: bus on 127.0.0.1:%d (socketcand, channel can0)\n", socketcand_server_port(b->server));
    return true;
}

static bool open_camera(bench_t *b, const board_table_t *table, const hal_board_needs_t *needs,
                        char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *name = table->camera;
    const picture_format_t format = sim_picture_take_format(&name);
    b->video = video_open(name, needs->picture_width, needs->picture_height, error);
    if (b->video == NULL)
        return false;
    const video_info_t *video = video_info(b->video);
    const sim_camera_settings_t settings = {
        .video = b->video,
        .width = needs->picture_width,
        .height = needs->picture_height,
        .format = format,
        .rate = {hal_time_now_us(b->devices.clock), video->rate_frames, video->rate_seconds},
    };
    b->devices.camera = sim_camera_create(&settings, error);
    if (b->devices.camera == NULL)
        return false;
    fprintf(stderr, "camera: %s, %s, %dx%d, %d frames\n", name, sim_picture_formats[format], needs->picture_width,
            needs->picture_height, video->frame_count);
    return true;
}

static bool open_display(bench_t *b, const board_table_t *table, const hal_board_needs_t *needs,
                         char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *name = table->display;
    const picture_format_t format = sim_picture_take_format(&name);
    b->folder = strcmp(name, "none") == 0 ? NULL : name;
    if (b->folder != NULL && !folder_make(b->folder, error))
        return false;
    const sim_display_settings_t settings = {
        .width = needs->panel_width,
        .height = needs->panel_height,
        .format = format,
        .clock = b->devices.clock,
        .blanks = {hal_time_now_us(b->devices.clock), needs->refresh_frames, needs->refresh_seconds},
        .while_waiting = move_world,
        .context = b,
    };
    b->devices.display = sim_display_create(&settings, error);
    if (b->devices.display == NULL)
        return false;
    fprintf(stderr, "display: %s, %dx%d at %.2f Hz, %s%s\n", sim_picture_formats[format], needs->panel_width,
            needs->panel_height, (double)needs->refresh_frames / needs->refresh_seconds,
            b->folder == NULL ? "no files" : "a PNG each second: ", b->folder == NULL ? "" : b->folder);
    return true;
}

/* The devices that need no more than the clock. */
static bool open_rest(bench_t *b, char error[HAL_BOARD_ERROR_LENGTH])
{
    b->devices.gpio = sim_gpio_create(b->devices.clock, error);
    b->devices.watchdog = b->devices.gpio == NULL ? NULL : sim_watchdog_create(b->devices.clock, WATCHDOG_US, error);
    b->devices.service = b->devices.watchdog == NULL ? NULL : sim_service_create(error);
    return b->devices.service != NULL;
}

/* @return A bench with its clock; NULL: no memory. */
static bench_t *begin(char error[HAL_BOARD_ERROR_LENGTH])
{
    const sim_clock_settings_t clock = {.real = true};
    bench_t *b = calloc(1, sizeof *b);
    if (b == NULL) {
        file_error(error, "bench", "out of memory");
        return NULL;
    }
    b->devices.own = b;
    b->devices.clock = sim_clock_create(&clock, error);
    if (b->devices.clock != NULL)
        return b;
    hal_board_close(&b->devices);
    return NULL;
}

static hal_status_t finish(bench_t *b, bool ok, hal_board_t *board)
{
    if (!ok) {
        hal_board_close(&b->devices);
        return HAL_IO;
    }
    *board = b->devices;
    move_world(b); /* the camera's first picture is there for the first step */
    return HAL_OK;
}

hal_status_t hal_board_open(hal_board_t *board, const board_table_t *table, const hal_board_needs_t *needs,
                            char error[HAL_BOARD_ERROR_LENGTH])
{
    bench_t *b = begin(error);
    if (b == NULL)
        return HAL_IO;
    const bool ok = open_bus(b, table, needs, error) && open_camera(b, table, needs, error) &&
                    open_display(b, table, needs, error) && open_rest(b, error) &&
                    hal_workers_open(&b->devices.workers, &table->workers, error) == HAL_OK;
    return finish(b, ok, board);
}

hal_status_t hal_board_open_some(hal_board_t *board, const board_table_t *table, char error[HAL_BOARD_ERROR_LENGTH])
{
    const hal_board_needs_t usual = {.panel_width = 1280,
                                     .panel_height = 800,
                                     .refresh_frames = 60,
                                     .refresh_seconds = 1,
                                     .bitrate = 500000,
                                     .data_bitrate = 2000000,
                                     .fd = true};
    const board_table_t dark = {.display = "none"};
    bench_t *b = begin(error);
    if (b == NULL)
        return HAL_IO;
    if (table->can != NULL && !open_bus(b, table, &usual, error)) {
        fprintf(stderr, "wallwarp: %s\n", error);
        b->devices.can = NULL;
    }
    bool ok = open_display(b, table, &usual, error);
    if (!ok) {
        fprintf(stderr, "wallwarp: %s\n", error);
        ok = open_display(b, &dark, &usual, error);
    }
    return finish(b, ok && open_rest(b, error), board);
}

void hal_board_close(hal_board_t *board)
{
    bench_t *b = board->own;
    hal_workers_close(board->workers);
    sim_service_destroy(board->service);
    sim_watchdog_destroy(board->watchdog);
    sim_gpio_destroy(board->gpio);
    sim_display_destroy(board->display);
    sim_camera_destroy(board->camera);
    video_close(b->video);
    socketcand_server_close(b->server);
    sim_bus_destroy(b->bus);
    sim_clock_destroy(board->clock);
    free(b);
}
