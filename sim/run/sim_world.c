// SPDX-License-Identifier: Apache-2.0
// A room in one process: every board with its devices and the real firmware, on one simulated bus.
#include "sim/run/sim_world.h"

#include <stdlib.h>

#include "sim/devices/sim_camera.h"
#include "sim/devices/sim_clock.h"
#include "sim/devices/sim_display.h"
#include "sim/devices/sim_gpio.h"
#include "sim/devices/sim_service.h"
#include "sim/devices/sim_watchdog.h"
#include "sim/rng.h"

typedef struct {
    hal_board_t devices;
    projector_t *projector;
    int64_t step_time_us;
    rng_t random; /* seeds of the board's starts */
    bool busy;    /* with its last step, in virtual time */
    bool down;    /* between two versions */
} node_t;

struct sim_world {
    sim_world_config_t config;
    sim_bus_t *bus;
    node_t node[ROOM_MAX_BOARDS];
};

static int64_t stamp(void *context, int64_t time_us)
{
    return sim_clock_shows_us(context, time_us);
}

/* The board's clock, and its controller's stamps on it. */
static bool open_clock(sim_world_t *world, int32_t index, char error[FILE_ERROR_LENGTH])
{
    const sim_world_config_t *config = &world->config;
    const sim_world_clocks_t *off = &config->clocks;
    hal_board_t *devices = &world->node[index].devices;
    rng_t random = {config->seed + ((uint64_t)index << 32)};
    const double offset_us = (double)off->offset_us * rng_unit(&random);
    const double drift_ppb = (double)off->drift_ppb * (2.0 * rng_unit(&random) - 1.0);
    const sim_clock_settings_t clock = {.real = config->real,
                                        .epoch_us = config->start_us,
                                        .offset_us = (int64_t)offset_us,
                                        .drift_ppb = (int32_t)drift_ppb};
    devices->clock = sim_clock_create(&clock, error);
    if (devices->clock == NULL)
        return false;
    sim_can_set_stamps(devices->can, stamp, devices->clock, off->jitter_us);
    return true;
}

static hal_camera_t *open_camera(const sim_world_t *world, int32_t index, char error[FILE_ERROR_LENGTH])
{
    const sim_world_config_t *config = &world->config;
    const video_info_t *video = video_info(config->video);
    const sim_camera_settings_t camera = {
        .video = config->video,
        .width = config->room->camera.width,
        .height = config->room->camera.height,
        .format = config->camera,
        .rate = {config->start_us, video->rate_frames, video->rate_seconds},
        .clock = world->node[index].devices.clock,
        .seed = (uint32_t)config->seed + (uint32_t)index,
    };
    return sim_camera_create(&camera, error);
}

static bool open_devices(sim_world_t *world, int32_t index, char error[FILE_ERROR_LENGTH])
{
    const sim_world_config_t *config = &world->config;
    const room_board_t *board = &config->room->board[index];
    hal_board_t *devices = &world->node[index].devices;
    devices->can = sim_bus_attach(world->bus);
    if (devices->can == NULL)
        return file_error(error, board->name, "no room on the bus, or out of memory");
    if (!open_clock(world, index, error))
        return false;
    devices->camera = open_camera(world, index, error);
    const sim_display_settings_t display = {
        .width = board->wall.panel_width,
        .height = board->wall.panel_height,
        .format = config->display,
        .clock = devices->clock,
        .blanks = config->refresh,
    };
    devices->display = devices->camera == NULL ? NULL : sim_display_create(&display, error);
    devices->gpio = devices->display == NULL ? NULL : sim_gpio_create(devices->clock, error);
    devices->watchdog =
        devices->gpio == NULL ? NULL : sim_watchdog_create(devices->clock, SIM_WORLD_WATCHDOG_US, error);
    devices->service = devices->watchdog == NULL ? NULL : sim_service_create(error);
    if (devices->service == NULL || config->update == NULL)
        return devices->service != NULL;
    devices->update = sim_update_create(config->update, config->start_us, error);
    return devices->update != NULL;
}

static void start(sim_world_t *world, int32_t index)
{
    const room_t *room = world->config.room;
    node_t *node = &world->node[index];
    room_board_t board = room->board[index];
    if (world->config.method != NULL)
        board.method = world->config.method;
    const warp_kernels_t *kernels = world->config.kernels != NULL ? world->config.kernels : warp_kernels_best();
    projector_init(node->projector, room, &board, &node->devices, kernels);
    projector_use_key(node->projector, world->config.key, rng_next(&node->random));
    if (world->config.real) /* the boards share this machine */
        projector_keep_method(node->projector);
}

bool sim_world_restart(sim_world_t *world, int32_t index, char error[FILE_ERROR_LENGTH])
{
    hal_board_t *devices = &world->node[index].devices;
    hal_camera_t *camera = open_camera(world, index, error); /* the old one has lent its pictures */
    if (camera == NULL)
        return false;
    sim_camera_destroy(devices->camera);
    devices->camera = camera;
    start(world, index);
    return true;
}

/* What it heard before, and its watchdog's wait, are of the firmware that is gone. */
static bool start_other_slot(sim_world_t *world, int32_t index, char error[FILE_ERROR_LENGTH])
{
    hal_board_t *devices = &world->node[index].devices;
    hal_can_frame_t frame;
    hal_watchdog_t *watchdog = sim_watchdog_create(devices->clock, SIM_WORLD_WATCHDOG_US, error);
    if (watchdog == NULL)
        return false;
    sim_watchdog_destroy(devices->watchdog);
    devices->watchdog = watchdog;
    sim_bus_replug(devices->can);
    while (hal_can_receive(devices->can, &frame) == HAL_OK)
        continue;
    return sim_world_restart(world, index, error);
}

/* @return false when the board is to start, and can't. */
static bool advance_update(sim_world_t *world, int32_t index, int64_t now_us, char error[FILE_ERROR_LENGTH])
{
    node_t *node = &world->node[index];
    const sim_update_board_t board = sim_update_advance(node->devices.update, now_us);
    const bool was_down = node->down;
    node->down = board == SIM_UPDATE_DOWN;
    if (node->down && !was_down) {
        sim_bus_fail_bus_off(node->devices.can); /* what it has queued is lost */
        sim_bus_fail_unplug(node->devices.can);
        if (hal_can_restart(node->devices.can) != HAL_OK)
            return file_error(error, "can", "the bus controller of board %d is stuck", (int)index + 1);
    }
    return board != SIM_UPDATE_STARTS || start_other_slot(world, index, error);
}

static bool open_node(sim_world_t *world, int32_t index, char error[FILE_ERROR_LENGTH])
{
    const char *name = world->config.room->board[index].name;
    node_t *node = &world->node[index];
    if (!open_devices(world, index, error))
        return false;
    node->projector = calloc(1, sizeof *node->projector);
    if (node->projector == NULL)
        return file_error(error, name, "out of memory: a projector takes %zu MB", sizeof(projector_t) >> 20);
    node->random = (rng_t){world->config.seed + ((uint64_t)(index + 1) << 40)};
    start(world, index);
    return true;
}

sim_world_t *sim_world_create(const sim_world_config_t *config, char error[FILE_ERROR_LENGTH])
{
    sim_world_t *world = calloc(1, sizeof *world);
    if (world == NULL) {
        file_error(error, "room", "out of memory");
        return NULL;
    }
    world->config = *config;
    const sim_bus_config_t bus = {
        .bitrate = config->room->bitrate,
        .data_bitrate = config->room->data_bitrate,
        .fd = config->room->fd,
        .seed = config->seed,
        .start_us = config->start_us,
    };
    world->bus = sim_bus_create(&bus);
    bool ok = world->bus != NULL;
    if (!ok)
        file_error(error, "can", "bit rates %d and %d are out of range, or out of memory", bus.bitrate,
                   bus.data_bitrate);
    for (int32_t i = 0; ok && i < config->room->board_count; i++)
        ok = open_node(world, i, error);
    if (ok)
        return world;
    sim_world_destroy(world);
    return NULL;
}

void sim_world_destroy(sim_world_t *world)
{
    if (world == NULL)
        return;
    for (int32_t i = world->config.room->board_count - 1; i >= 0; i--) {
        node_t *node = &world->node[i];
        free(node->projector);
        sim_update_destroy(node->devices.update);
        sim_service_destroy(node->devices.service);
        sim_watchdog_destroy(node->devices.watchdog);
        sim_gpio_destroy(node->devices.gpio);
        sim_display_destroy(node->devices.display);
        sim_camera_destroy(node->devices.camera);
        sim_clock_destroy(node->devices.clock);
    }
    sim_bus_destroy(world->bus);
    free(world);
}

sim_bus_t *sim_world_bus(sim_world_t *world)
{
    return world->bus;
}

const hal_board_t *sim_world_devices(const sim_world_t *world, int32_t board)
{
    return &world->node[board].devices;
}

const projector_t *sim_world_projector(const sim_world_t *world, int32_t board)
{
    return world->node[board].projector;
}

bool sim_world_advance(sim_world_t *world, int64_t now_us, char error[FILE_ERROR_LENGTH])
{
    bool ok = true;
    sim_bus_advance(world->bus, now_us);
    for (int32_t i = 0; i < world->config.room->board_count; i++) {
        node_t *node = &world->node[i];
        const hal_board_t *devices = &node->devices;
        node->busy = !world->config.real && sim_clock_time_us(devices->clock) > now_us;
        if (node->busy)
            continue;
        if (!world->config.real)
            sim_clock_set_us(devices->clock, now_us);
        sim_display_advance(devices->display, now_us);
        ok &= sim_camera_advance(devices->camera, now_us, error);
        ok &= advance_update(world, i, now_us, error);
    }
    return ok;
}

void sim_world_step_board(sim_world_t *world, int32_t board)
{
    if (world->node[board].busy || world->node[board].down)
        return;
    const int64_t begin_us = sim_clock_monotonic_us();
    projector_step(world->node[board].projector);
    world->node[board].step_time_us = sim_clock_monotonic_us() - begin_us;
}

bool sim_world_step(sim_world_t *world, int64_t now_us, char error[FILE_ERROR_LENGTH])
{
    const bool ok = sim_world_advance(world, now_us, error);
    for (int32_t i = 0; i < world->config.room->board_count; i++)
        sim_world_step_board(world, i);
    return ok;
}

const image_t *sim_world_shown(sim_world_t *world, int32_t board, int64_t blank_us)
{
    hal_display_t *display = world->node[board].devices.display;
    sim_display_advance(display, blank_us);
    return world->node[board].down ? NULL : sim_display_shown(display);
}

int64_t sim_world_step_time_us(const sim_world_t *world, int32_t board)
{
    return world->node[board].step_time_us;
}
