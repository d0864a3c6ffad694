// SPDX-License-Identifier: Apache-2.0
// A small room of the simulator for tests: the real firmware in virtual time at 60 Hz, a tracker, ears on the bus.
#ifndef TESTS_SUPPORT_ROOM_BENCH_H
#define TESTS_SUPPORT_ROOM_BENCH_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_protocol.h"
#include "firmware/can_update.h"
#include "sim/run/sim_world.h"

enum { ROOM_BENCH_HZ = 60, ROOM_BENCH_BOARDS = 2, ROOM_BENCH_INSTALL_US = 2000000, ROOM_BENCH_REBOOT_US = 3000000 };

/** What a board has said of itself on the bus. */
typedef struct {
    int heartbeats, statuses, stages, qualities;
    uint32_t flags_ever;       /**< fault flags of all heartbeats */
    uint32_t states_ever;      /**< 1 << state of all heartbeats */
    can_heartbeat_t heartbeat; /**< the newest */
    can_status_t status;
    can_stage_t stage[STAGES];
    can_quality_t quality;
    can_update_t update;
} room_bench_voice_t;

typedef struct {
    room_t room;
    video_t *video;
    sim_world_t *world;
    hal_can_t *tracker;
    room_bench_voice_t voice[ROOM_BENCH_BOARDS];
    int64_t step;       /**< the next one */
    bool tracking;      /**< a pose before each step */
    int poses;          /**< sent so far; the next one's number */
    const pose_t *pose; /**< sent instead of room_bench_pose(), unless NULL */
} room_bench_t;

/** Two boards and a camera of 96 x 54 px with the test pattern; nobody has stepped yet. Fails the test on error. */
void room_bench_open(room_bench_t *bench, bool fd);

/** The same in a room with a key, which must outlive it. The bench's own tracker has none. */
void room_bench_open_with_key(room_bench_t *bench, bool fd, can_auth_t *key);

void room_bench_close(room_bench_t *bench);

/** Pose number n of the tracker: every one differs from the one before. */
pose_t room_bench_pose(int n);

/** Time of the next step, us. */
int64_t room_bench_now_us(const room_bench_t *bench);

/** Send the next pose, if tracking, and bring bus, clocks, displays and cameras to the next step. */
void room_bench_advance(room_bench_t *bench);

/** room_bench_advance(), then one step of every board. */
void room_bench_step(room_bench_t *bench);

/** Steps for so long. */
void room_bench_run(room_bench_t *bench, int milliseconds);

/** @return What the board's newest step has done. */
const projector_report_t *room_bench_report(const room_bench_t *bench, int board);

/** @return Whether the board's wall will show the safe picture with this reason at the next blank. */
bool room_bench_is_safe_picture(room_bench_t *bench, int board, const char *reason);

/** @return With which reason of safe_reason() it will; NULL when with none. */
const char *room_bench_safe_reason(room_bench_t *bench, int board);

#endif
