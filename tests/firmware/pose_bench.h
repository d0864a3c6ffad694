// SPDX-License-Identifier: Apache-2.0
// A pose receiver on a made-up CAN controller, for tests. It defines the HAL's CAN functions: one include per program.
#ifndef TESTS_FIRMWARE_POSE_BENCH_H
#define TESTS_FIRMWARE_POSE_BENCH_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "firmware/bus_receive.h"
#include "tests/support/random_pose.h"

enum { FAKE_CAN_FRAMES = 1024 };

struct hal_can {
    hal_can_frame_t frame[FAKE_CAN_FRAMES];
    int count, next; /* frames queued since the queue was last empty; the next to be received */
    hal_can_state_t state;
    bool broken; /* receive fails */
    bool restart_refused;
    int restarts;         /* asked for */
    uint32_t lost, told;  /* frames: as it is; as it was at the newest call of receive */
    hal_can_frame_t sent; /* the newest */
};

hal_status_t hal_can_receive(hal_can_t *can, hal_can_frame_t *frame)
{
    can->told = can->lost;
    if (can->broken)
        return HAL_IO;
    if (can->next == can->count) {
        can->next = can->count = 0;
        return HAL_EMPTY;
    }
    *frame = can->frame[can->next++];
    return HAL_OK;
}

hal_status_t hal_can_send(hal_can_t *can, const hal_can_frame_t *frame)
{
    can->sent = *frame;
    return HAL_OK;
}

uint32_t hal_can_lost(const hal_can_t *can)
{
    return can->told;
}

hal_can_state_t hal_can_state(const hal_can_t *can)
{
    return can->state;
}

hal_status_t hal_can_restart(hal_can_t *can)
{
    can->restarts++;
    return can->restart_refused ? HAL_IO : HAL_OK;
}

enum { POSE_PERIOD_US = 4167 };

/* A receiver on a controller of its own, and a sender's clock. */
typedef struct {
    hal_can_t can;
    can_poses_t poses;
    can_faults_t faults, expected;
    int64_t time_us;
    rng_t rng;
} bench_t;

static inline bench_t new_bench(void)
{
    bench_t bench;
    memset(&bench, 0, sizeof bench);
    bench.time_us = 1000000;
    bench.rng.state = 20240131;
    return bench;
}

static inline void receive(bench_t *bench)
{
    bus_receive(&(bus_receivers_t){.poses = &bench->poses, .faults = &bench->faults}, &bench->can);
    assert_int_equal(bench->can.next, bench->can.count);
}

static inline void check_faults(const bench_t *bench)
{
    assert_memory_equal(&bench->faults, &bench->expected, sizeof bench->faults);
}

static inline can_pose_t pose_number(bench_t *bench, int number)
{
    can_pose_t pose = random_pose_sane(&bench->rng, INT64_C(80000000000), 1);
    pose.counter = (uint8_t)number;
    return pose;
}

static inline void queue(bench_t *bench, const hal_can_frame_t *frame)
{
    assert_true(bench->can.count < FAKE_CAN_FRAMES);
    hal_can_frame_t stamped = *frame;
    stamped.time_us = bench->time_us += 250;
    bench->can.frame[bench->can.count++] = stamped;
}

static inline void make_set(hal_can_frame_t part[CAN_POSE_PARTS], can_pose_t *pose)
{
    assert_true(can_pose_set_encode(part, pose));
    assert_int_equal(can_pose_set_decode(pose, part, pose->viewer), CAN_CHECK_OK);
}

static inline can_pose_t send_set(bench_t *bench, int counter)
{
    hal_can_frame_t part[CAN_POSE_PARTS];
    can_pose_t pose = pose_number(bench, counter);
    make_set(part, &pose);
    for (int i = 0; i < CAN_POSE_PARTS; i++)
        queue(bench, &part[i]);
    return pose;
}

static inline can_pose_t send_fd(bench_t *bench, int counter)
{
    hal_can_frame_t frame;
    can_pose_t pose = pose_number(bench, counter);
    assert_true(can_pose_fd_encode(&frame, &pose));
    assert_int_equal(can_pose_fd_decode(&pose, &frame, 0), CAN_CHECK_OK);
    queue(bench, &frame);
    return pose;
}

static inline void assert_newest(const bench_t *bench, const can_pose_t *pose)
{
    assert_true(bench->poses.any);
    assert_memory_equal(&bench->poses.newest.pose, &pose->pose, sizeof pose->pose);
    assert_int_equal(bench->poses.newest.counter, pose->counter);
    assert_true(bench->poses.newest.capture_time_us == pose->capture_time_us);
}

#endif
