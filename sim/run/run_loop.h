// SPDX-License-Identifier: Apache-2.0
// The frames of a run, one after the other: in virtual or in real time.
#ifndef SIM_RUN_RUN_LOOP_H
#define SIM_RUN_RUN_LOOP_H

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#include "sim/bus/socketcand_server.h"
#include "sim/pose/pose_sender.h"
#include "sim/run/house_signal.h"
#include "sim/run/run_files.h"
#include "sim/run/run_pictures.h"
#include "sim/run/sim_world.h"

/** What a run is made of; opened and closed by sim_run.c. */
typedef struct {
    const room_t *room;
    sim_world_t *world;
    pose_sender_t *sender;       /**< virtual time; else NULL */
    socketcand_server_t *server; /**< real time; else NULL */
    run_record_t *record;
    run_files_t *files;
    run_pictures_t *pictures;
    sim_rate_t refresh; /**< beat 0 is the first step */
    house_signal_t house;
    int64_t start_us;
    int64_t frames;      /**< to make; INT64_MAX for until *stop */
    int32_t judge_every; /**< 0: never */
    const volatile sig_atomic_t *stop;

    int64_t skipped;             /**< counted: refreshes not held in real time */
    int64_t busy_ns, elapsed_ns; /**< of the bus, at the frame before */
    int64_t told_us;             /**< when progress was last told */
    bool camera_told;
} run_loop_t;

/** Make all frames. @return false when memory is out, or pictures can't be written: run_pictures_finish() tells. */
bool run_loop_virtual(run_loop_t *loop);

/** The same in real time. */
bool run_loop_real(run_loop_t *loop);

#endif
