// SPDX-License-Identifier: Apache-2.0
// Fuzzes the receiver of poses: whatever comes over the bus, its newest pose is one that a wall can be drawn from, and
// a damaged frame never becomes it.
#include "firmware/bus_receive.h"

#include <string.h>

#include "tests/fuzz/input.h"
#include "tests/fuzz/input_frame.h"

enum { QUEUE_FRAMES = 4 };

/* A controller that delivers what the input says. */
struct hal_can {
    hal_can_frame_t frame[QUEUE_FRAMES];
    int count, next;
    bool broken, bus_off, restart_refused, endless;
    uint32_t lost;
};

hal_status_t hal_can_receive(hal_can_t *can, hal_can_frame_t *frame)
{
    if (can->broken)
        return HAL_IO;
    if (can->next == can->count && can->endless)
        can->next = 0;
    if (can->next == can->count)
        return HAL_EMPTY;
    *frame = can->frame[can->next++];
    return HAL_OK;
}

hal_status_t hal_can_send(hal_can_t *can, const hal_can_frame_t *frame)
{
    (void)can;
    (void)frame;
    return HAL_FULL;
}

uint32_t hal_can_lost(const hal_can_t *can)
{
    return can->lost;
}

hal_can_state_t hal_can_state(const hal_can_t *can)
{
    return can->bus_off ? HAL_CAN_BUS_OFF : HAL_CAN_ERROR_ACTIVE;
}

hal_status_t hal_can_restart(hal_can_t *can)
{
    return can->restart_refused ? HAL_IO : HAL_OK;
}

typedef struct {
    can_poses_t poses;
    bus_master_t time;
    can_faults_t faults;
    int64_t time_us;
    can_pose_t sent; /* counts on where a sound sender would */
} bench_t;

static void check_newest(const bench_t *bench, uint8_t viewer)
{
    const can_pose_t *newest = &bench->poses.newest;
    int64_t norm_squared = 0; /* of the components in Q20, rounded down */
    if (!bench->poses.any)
        return;
    fuzz_check(newest->viewer == viewer && bench->poses.viewer == viewer, "the pose is this viewer's");
    fuzz_check(newest->quality == CAN_POSE_TRACKED || newest->quality == CAN_POSE_PREDICTED, "the viewer was seen");
    fuzz_check(bench->poses.received_us <= bench->time_us, "the pose does not come from the future");
    for (int i = 0; i < 3; i++)
        fuzz_check(newest->pose.eye_nm[i] >= -INT64_C(1000000000000) &&
                       newest->pose.eye_nm[i] <= INT64_C(1000000000000),
                   "the eye is within 1000 m");
    for (int i = 0; i < 4; i++) {
        const int64_t component = newest->pose.quaternion_q30[i] >> 10;
        norm_squared += component * component;
    }
    fuzz_check(norm_squared > (INT64_C(98009) << 40) / 100000 && norm_squared < (INT64_C(102011) << 40) / 100000,
               "the quaternion is nearly of unit length");
}

static void receive(bench_t *bench, hal_can_t *can)
{
    const uint8_t viewer = bench->poses.viewer;
    const can_faults_t before = bench->faults;
    bus_receive(&(bus_receivers_t){.poses = &bench->poses, .time = &bench->time, .faults = &bench->faults}, can);
    fuzz_check(bench->faults.overrun >= before.overrun && bench->faults.crc >= before.crc, "faults are counted up");
    fuzz_check(can->broken || can->endless || can->next == can->count, "everything received is taken");
    fuzz_check(bench->faults.lost == can->lost, "lost frames are counted");
    check_newest(bench, viewer);
}

/* A good pose, a little further than the last one: a set or an FD frame. @return how many frames. */
static int encode_next(bench_t *bench, input_t *input, bool fd, hal_can_frame_t *frame)
{
    can_pose_t *pose = &bench->sent;
    const int counters = fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS;
    const int step = input_range(input, 0, 255);
    pose->viewer = bench->poses.viewer;
    pose->counter = (uint8_t)((pose->counter % counters + 1 + step) % counters);
    pose->quality = (can_pose_quality_t)((CAN_POSE_TRACKED + input_byte(input)) % 3);
    for (int i = 0; i < 3; i++)
        pose->pose.eye_nm[i] = input_number(input, fd ? 41 : 36);
    memset(pose->pose.quaternion_q30, 0, sizeof pose->pose.quaternion_q30);
    pose->pose.quaternion_q30[input_byte(input) & 3] = (1 << 30) + (int32_t)input_number(input, 25);
    const bool encoded = fd ? can_pose_fd_encode(frame, pose) : can_pose_set_encode(frame, pose);
    return encoded ? fd ? 1 : CAN_POSE_PARTS : 0;
}

/* One frame of a good pose arrives with one bit wrong, alone: it must not be taken. */
static void receive_damaged(bench_t *bench, input_t *input, bool fd)
{
    hal_can_t can = {.count = 1};
    hal_can_frame_t frame[CAN_POSE_PARTS];
    const can_pose_t sender = bench->sent, newest = bench->poses.newest;
    const bool any = bench->poses.any;
    const int count = encode_next(bench, input, fd, frame);
    bench->sent = sender;
    if (count == 0)
        return;
    can.frame[0] = frame[input_byte(input) % count];
    can.frame[0].time_us = bench->time_us;
    can.frame[0].data[input_byte(input) % can.frame[0].length] ^= (uint8_t)(1 << (input_byte(input) & 7));
    const uint32_t crc = bench->faults.crc;
    receive(bench, &can);
    fuzz_check(bench->faults.crc == crc + 1, "a damaged frame is counted");
    fuzz_check(bench->poses.any == any && memcmp(&bench->poses.newest, &newest, sizeof newest) == 0,
               "a damaged frame changes nothing");
}

static void one_turn(bench_t *bench, input_t *input)
{
    hal_can_t can = {.count = 0};
    const uint8_t kind = input_byte(input);
    bench->time_us += input_number(input, 30) & INT64_MAX >> 33;
    if (kind % 4 == 3) {
        receive_damaged(bench, input, kind & 8);
        return;
    }
    if (kind % 4 == 0) {
        can.count = encode_next(bench, input, kind & 8, can.frame);
    } else {
        can.count = 1 + kind / 8 % QUEUE_FRAMES;
        for (int i = 0; i < can.count; i++)
            can.frame[i] = input_frame(input);
    }
    for (int i = 0; i < can.count; i++)
        can.frame[i].time_us = bench->time_us += 100;
    can.broken = kind == 0xF9;
    can.bus_off = kind == 0xFA || kind == 0xFD;
    can.restart_refused = kind == 0xFD;
    can.lost = kind;
    can.endless = kind == 0xFE && can.count > 0;
    receive(bench, &can);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    bench_t bench;
    memset(&bench, 0, sizeof bench);
    bench.poses.viewer = input_byte(&input) % CAN_VIEWERS;
    bus_master_init(&bench.time, 1, bench.time_us);
    bench.time_us = 1000000;
    while (input.left > 0)
        one_turn(&bench, &input);
    return 0;
}
