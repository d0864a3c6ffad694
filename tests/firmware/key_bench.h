// SPDX-License-Identifier: Apache-2.0
// The small room of room_bench.h with a key, a tracker that has it too, and a stranger who hears and sends all he
// likes.
#ifndef TESTS_FIRMWARE_KEY_BENCH_H
#define TESTS_FIRMWARE_KEY_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "sim/pose/pose_sender.h"
#include "tests/support/auth_frames.h"
#include "tests/support/room_bench.h"

enum { KEY_POSES = 8000, KEY_POSE_US = 4167, KEY_HEARD = 2048, KEY_AGAIN_MS = 2500 };

static struct {
    can_auth_t *key, *other; /* the room's, and another */
    room_bench_t room;
    pose_list_entry_t entry[KEY_POSES];
    pose_list_t list;
    pose_sender_t tracker;
    bool sending;
    hal_can_t *stranger;
    hal_can_frame_t heard[KEY_HEARD]; /* by the stranger, since key_listen() */
    int frames;
} k;

static inline void key_open(bool fd)
{
    static const hal_key_t other = {{1}};
    k.key = can_auth_open(&AUTH_KEY);
    k.other = can_auth_open(&other);
    assert_non_null(k.key);
    assert_non_null(k.other);
    room_bench_open_with_key(&k.room, fd, k.key);
    k.stranger = sim_bus_attach(sim_world_bus(k.room.world));
    k.list = (pose_list_t){k.entry, KEY_POSES};
    for (int n = 0; n < KEY_POSES; n++)
        k.entry[n] = (pose_list_entry_t){n * (int64_t)KEY_POSE_US, room_bench_pose(n)};
    k.sending = false;
    k.frames = 0;
}

static inline void key_close(void)
{
    room_bench_close(&k.room);
    can_auth_close(k.key);
    can_auth_close(k.other);
}

static inline int key_open_fd(void **state)
{
    (void)state;
    key_open(true);
    return 0;
}

static inline int key_open_classic(void **state)
{
    (void)state;
    key_open(false);
    return 0;
}

static inline int key_teardown(void **state)
{
    (void)state;
    key_close();
    return 0;
}

/* A tracker begins; another one is silent from now on. */
static inline void key_track(can_auth_t *key, uint64_t session)
{
    const pose_sender_config_t config = {.bus = sim_world_bus(k.room.world),
                                         .list = &k.list,
                                         .fd = k.room.room.fd,
                                         .start_us = room_bench_now_us(&k.room),
                                         .sync = true,
                                         .key = key,
                                         .session = session};
    assert_true(pose_sender_open(&k.tracker, &config));
    k.sending = true;
}

static inline void key_step(void)
{
    hal_can_frame_t frame;
    if (k.sending)
        pose_sender_advance(&k.tracker, room_bench_now_us(&k.room));
    room_bench_step(&k.room);
    while (hal_can_receive(k.stranger, &frame) == HAL_OK)
        if (k.frames < KEY_HEARD)
            k.heard[k.frames++] = frame;
}

static inline void key_run(int milliseconds)
{
    for (int i = 0; i < milliseconds * ROOM_BENCH_HZ / 1000; i++)
        key_step();
}

/* Forget what was heard. */
static inline void key_listen(void)
{
    k.frames = 0;
}

static inline void key_inject(const hal_can_frame_t *frame, int frames)
{
    for (int i = 0; i < frames; i++)
        assert_int_equal(hal_can_send(k.stranger, &frame[i]), HAL_OK);
}

static inline const projector_t *key_board(int board)
{
    return sim_world_projector(k.room.world, board);
}

static inline const can_faults_t *key_faults(int board)
{
    return &key_board(board)->can_faults;
}

static inline void assert_boards_are(can_board_state_t state)
{
    for (int b = 0; b < ROOM_BENCH_BOARDS; b++)
        assert_int_equal(key_board(b)->report.state, state);
}

static inline void assert_refused(uint32_t refused)
{
    for (int b = 0; b < ROOM_BENCH_BOARDS; b++)
        assert_int_equal(can_faults_refused(key_faults(b)), refused);
}

/* Nobody has believed it: the eye did not go there. */
static inline void assert_nobody_far(void)
{
    for (int b = 0; b < ROOM_BENCH_BOARDS; b++)
        assert_true(key_board(b)->poses.newest.pose.eye_nm[2] == 0);
}

/* All that the stranger has heard, again, but what is no use to him. */
static inline void key_repeat_all(void)
{
    hal_can_frame_t heard[KEY_HEARD];
    const int frames = k.frames;
    memcpy(heard, k.heard, sizeof heard);
    for (int i = 0; i < frames; i++)
        if (heard[i].id < CAN_ID_STATUS || heard[i].id - CAN_ID_COMMAND < 64) {
            key_inject(&heard[i], 1);
            if (i % 4 == 3)
                key_step();
        }
}

/* Frames of one pose, signed as the tracker would, but made at another time. */
static inline int key_sign_pose(hal_can_frame_t frame[POSE_AUTH_FRAMES], can_auth_t *key, uint64_t session,
                                int64_t bus_us)
{
    pose_auth_t signer;
    const pose_t far = {.eye_nm = {0, 0, -900000000}, .quaternion_q30 = {1 << 30, 0, 0, 0}};
    const can_pose_t pose = {.pose = far,
                             .capture_time_us = (uint64_t)bus_us % CAN_POSE_SET_WRAP_US,
                             .quality = CAN_POSE_TRACKED,
                             .counter = (uint8_t)((k.tracker.counter + 1) % CAN_E2E_P01_COUNTERS)};
    const bool fd = k.room.room.fd;
    assert_true(fd ? can_pose_fd_encode(frame, &pose) : can_pose_set_encode(frame, &pose));
    pose_auth_init(&signer, key, session, 0);
    return pose_auth_sign_pose(&signer, frame, fd ? 1 : CAN_POSE_PARTS, 0, (uint64_t)bus_us);
}

/* The tracker of session 1 is believed, and nothing was refused. */
static inline void key_start_running(void)
{
    key_run(500);
    key_track(k.key, 1);
    key_run(KEY_AGAIN_MS);
    assert_boards_are(CAN_BOARD_RUNNING);
}

#endif
