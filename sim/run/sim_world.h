// SPDX-License-Identifier: Apache-2.0
// A room in one process: every board with its devices and the real firmware, on one simulated bus.
#ifndef SIM_RUN_SIM_WORLD_H
#define SIM_RUN_SIM_WORLD_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/projector.h"
#include "firmware/room.h"
#include "sim/bus/sim_bus.h"
#include "sim/devices/sim_rate.h"
#include "sim/devices/sim_update.h"
#include "sim/files/file_io.h"
#include "sim/files/video_file.h"

typedef struct sim_world sim_world_t;

enum { SIM_WORLD_WATCHDOG_US = 2000000 };

/** What the boards' clocks are off by: each its own, drawn from the world's seed. All 0: all show the world's time. */
typedef struct {
    int64_t offset_us;  /**< from 0 to this */
    int32_t drift_ppb;  /**< up to this either way */
    uint32_t jitter_us; /**< every stamp of a frame is late by 0 to this */
} sim_world_clocks_t;

typedef struct {
    const room_t *room;            /**< must outlive the world */
    video_t *video;                /**< what every camera plays; must outlive the world */
    const warp_method_t *method;   /**< of every board, in place of the room's; NULL for the room's */
    const warp_kernels_t *kernels; /**< of every board; NULL for the fastest */
    picture_format_t camera;       /**< what every camera delivers; any but GRAY8 */
    picture_format_t display;      /**< what every display takes besides XRGB8888: NV12, YUYV or XRGB8888 */
    bool real;                     /**< clocks run by themselves (CLOCK_MONOTONIC); else in virtual time */
    int64_t start_us;              /**< now, when the world begins: the cameras' first picture */
    sim_rate_t refresh;            /**< vertical blanks of all displays; beat 0 is after start_us */
    uint64_t seed;                 /**< of everything random, when faults, clocks or a key are asked for */
    can_auth_t *key;               /**< of the room, must outlive the world; NULL: it has none */
    sim_world_clocks_t clocks;
    const sim_update_settings_t *update; /**< of every board's update agent; NULL: they have none */
} sim_world_config_t;

/**
 * Make bus, devices and projectors. Uses the heap; about 201 MB of address space per board, mostly untouched.
 *
 * @return NULL with the reason in error.
 */
sim_world_t *sim_world_create(const sim_world_config_t *config, char error[FILE_ERROR_LENGTH]);

/** NULL is allowed. */
void sim_world_destroy(sim_world_t *world);

/** @return The bus, to attach nodes to and to advance between steps. Its controllers 0 to K - 1 are the boards. */
sim_bus_t *sim_world_bus(sim_world_t *world);

/** @return The board's devices, in the order of the room file: for faults on demand. */
const hal_board_t *sim_world_devices(const sim_world_t *world, int32_t board);

/** @return The board's projector, to look at. */
const projector_t *sim_world_projector(const sim_world_t *world, int32_t board);

/**
 * Bring bus, clocks, displays, cameras and update agents to now_us; in virtual time not those of a board whose clock is
 * ahead, because its last step took longer than a refresh (sim_display_faults_t.drawing_us).
 *
 * @param      now_us  Just after a vertical blank; never less than at the last call.
 * @param[out] error   On failure: a camera could not read its video, or memory is out.
 * @return false when a picture was lost because the video could not be read, or a board not started anew; all else is
 * done.
 */
bool sim_world_advance(sim_world_t *world, int64_t now_us, char error[FILE_ERROR_LENGTH]);

/** Start one board's firmware and camera anew, as after a reset. @return false, and nothing changed, with the reason in
 *  error. */
bool sim_world_restart(sim_world_t *world, int32_t board, char error[FILE_ERROR_LENGTH]);

/** Let one board do one projector_step(); none while it is still at work on its last one. */
void sim_world_step_board(sim_world_t *world, int32_t board);

/** One refresh: sim_world_advance(), then a step of every board, in the order of the room file. */
bool sim_world_step(sim_world_t *world, int64_t now_us, char error[FILE_ERROR_LENGTH]);

/**
 * What the board's wall shows from a vertical blank on. Call it after the step that drew the picture.
 *
 * @param blank_us  The blank; all earlier ones are performed too.
 * @return NULL while the wall is dark, as it is while the board starts in its other slot. Valid until the next step.
 */
const image_t *sim_world_shown(sim_world_t *world, int32_t board, int64_t blank_us);

/** @return Real time that the board's newest projector_step() took on this machine, us. */
int64_t sim_world_step_time_us(const sim_world_t *world, int32_t board);

#endif
