// SPDX-License-Identifier: Apache-2.0
// Fuzzes the decoders of wallwarp.dbc: what one accepts, its encoder accepts too, and it decodes to the same again.
#include "firmware/can_protocol.h"

#include <string.h>

#include "tests/fuzz/input.h"
#include "tests/fuzz/input_frame.h"

static bool same_pose(const can_pose_t *a, const can_pose_t *b)
{
    return memcmp(&a->pose, &b->pose, sizeof a->pose) == 0 && a->capture_time_us == b->capture_time_us &&
           a->quality == b->quality && a->viewer == b->viewer && a->tracker == b->tracker && a->counter == b->counter;
}

static void check_pose_fd(const hal_can_frame_t *frame, uint8_t viewer)
{
    can_pose_t pose, again;
    hal_can_frame_t encoded;
    if (can_pose_fd_decode(&pose, frame, viewer) != CAN_CHECK_OK)
        return;
    fuzz_check(pose.viewer == viewer && pose.capture_time_us < CAN_POSE_FD_WRAP_US, "an FD pose is in range");
    fuzz_check(can_pose_fd_encode(&encoded, &pose), "a decoded FD pose can be encoded");
    fuzz_check(can_pose_fd_decode(&again, &encoded, viewer) == CAN_CHECK_OK, "an encoded FD pose can be decoded");
    fuzz_check(same_pose(&pose, &again), "an FD pose stays the same");
}

static void check_pose_set(const hal_can_frame_t part[CAN_POSE_PARTS], uint8_t viewer)
{
    can_pose_t pose, again;
    hal_can_frame_t encoded[CAN_POSE_PARTS];
    if (can_pose_set_decode(&pose, part, viewer) != CAN_CHECK_OK)
        return;
    fuzz_check(pose.viewer == viewer && pose.capture_time_us < CAN_POSE_SET_WRAP_US, "a pose of a set is in range");
    fuzz_check(can_pose_set_encode(encoded, &pose), "a decoded set can be encoded");
    fuzz_check(can_pose_set_decode(&again, encoded, viewer) == CAN_CHECK_OK, "an encoded set can be decoded");
    fuzz_check(same_pose(&pose, &again), "a pose of a set stays the same");
}

static void check_part(const hal_can_frame_t *frame, uint8_t viewer)
{
    int part = -1;
    uint8_t counter = 255;
    const bool good = can_pose_part_check(frame, viewer, &part, &counter) == CAN_CHECK_OK;
    fuzz_check(good ? part >= 0 && part < CAN_POSE_PARTS : part == -1, "the part is 0 to 2, written on success only");
    fuzz_check(good ? counter < CAN_E2E_P01_COUNTERS : counter == 255, "the counter is 0 to 14, on success only");
}

static void check_heartbeat(const hal_can_frame_t *frame)
{
    can_heartbeat_t heartbeat, again;
    hal_can_frame_t encoded;
    if (can_heartbeat_decode(&heartbeat, frame) != CAN_CHECK_OK)
        return;
    fuzz_check(can_heartbeat_encode(&encoded, &heartbeat), "a decoded heartbeat can be encoded");
    fuzz_check(can_heartbeat_decode(&again, &encoded) == CAN_CHECK_OK, "an encoded heartbeat can be decoded");
    fuzz_check(heartbeat.node == again.node && heartbeat.counter == again.counter && heartbeat.state == again.state &&
                   heartbeat.fault_flags == again.fault_flags && heartbeat.frame_number == again.frame_number &&
                   heartbeat.uptime_s == again.uptime_s,
               "a heartbeat stays the same");
}

static void check_status(const hal_can_frame_t *frame)
{
    can_status_t status, again;
    hal_can_frame_t encoded;
    if (can_status_decode(&status, frame) != CAN_CHECK_OK)
        return;
    fuzz_check(can_status_encode(&encoded, &status), "a decoded status can be encoded");
    fuzz_check(can_status_decode(&again, &encoded) == CAN_CHECK_OK, "an encoded status can be decoded");
    fuzz_check(status.node == again.node && status.counter == again.counter &&
                   status.pose_counter == again.pose_counter && status.pose_age_ms == again.pose_age_ms &&
                   status.step_q8 == again.step_q8 && status.warp_time_us == again.warp_time_us &&
                   status.can_faults == again.can_faults,
               "a status stays the same");
}

static void check_stage(const hal_can_frame_t *frame)
{
    can_stage_t stage, again;
    hal_can_frame_t encoded;
    if (can_stage_decode(&stage, frame) != CAN_CHECK_OK)
        return;
    fuzz_check(can_stage_encode(&encoded, &stage), "a decoded stage can be encoded");
    fuzz_check(can_stage_decode(&again, &encoded) == CAN_CHECK_OK, "an encoded stage can be decoded");
    fuzz_check(stage.node == again.node && stage.counter == again.counter && stage.stage == again.stage &&
                   stage.mean_us == again.mean_us && stage.worst_us == again.worst_us && stage.shown == again.shown &&
                   stage.late == again.late,
               "a stage stays the same");
}

static void check_quality(const hal_can_frame_t *frame)
{
    can_quality_t quality, again;
    hal_can_frame_t encoded;
    if (can_quality_decode(&quality, frame) != CAN_CHECK_OK)
        return;
    fuzz_check(can_quality_encode(&encoded, &quality), "a decoded quality can be encoded");
    fuzz_check(can_quality_decode(&again, &encoded) == CAN_CHECK_OK, "an encoded quality can be decoded");
    fuzz_check(quality.node == again.node && quality.counter == again.counter && quality.step == again.step &&
                   quality.filter == again.filter && quality.resampler == again.resampler &&
                   quality.changes == again.changes && quality.wanted_us == again.wanted_us &&
                   quality.hold_s == again.hold_s,
               "a quality stays the same");
}

static void check_time(const hal_can_frame_t *frame)
{
    can_time_t time, again;
    hal_can_frame_t encoded;
    if (can_time_decode(&time, frame) != CAN_CHECK_OK)
        return;
    fuzz_check(can_time_encode(&encoded, &time), "a decoded time can be encoded");
    fuzz_check(can_time_decode(&again, &encoded) == CAN_CHECK_OK, "an encoded time can be decoded");
    fuzz_check(time.node == again.node && time.counter == again.counter && time.state == again.state &&
                   time.master == again.master && time.drift_ppb == again.drift_ppb &&
                   time.error_us == again.error_us && time.changes == again.changes && time.relocks == again.relocks &&
                   time.lost == again.lost,
               "a time stays the same");
}

static void check_sync(const hal_can_frame_t *frame)
{
    can_sync_t sync, sync_again;
    can_follow_up_t follow_up, follow_up_again;
    hal_can_frame_t encoded;
    if (can_sync_decode(&sync, frame) == CAN_CHECK_OK) {
        fuzz_check(can_sync_encode(&encoded, &sync), "a decoded sync can be encoded");
        fuzz_check(can_sync_decode(&sync_again, &encoded) == CAN_CHECK_OK, "an encoded sync can be decoded");
        fuzz_check(sync.number == sync_again.number && sync.counter == sync_again.counter &&
                       sync.origin == sync_again.origin,
                   "a sync stays the same");
    }
    if (can_follow_up_decode(&follow_up, frame) == CAN_CHECK_OK) {
        fuzz_check(can_follow_up_encode(&encoded, &follow_up), "a decoded follow-up can be encoded");
        fuzz_check(can_follow_up_decode(&follow_up_again, &encoded) == CAN_CHECK_OK, "an encoded one can be decoded");
        fuzz_check(follow_up.number == follow_up_again.number && follow_up.counter == follow_up_again.counter &&
                       follow_up.time_us == follow_up_again.time_us,
                   "a follow-up stays the same");
    }
}

/* A pose with any numbers in it: the encoders refuse it, or what they write decodes. */
static void check_encoders(input_t *input)
{
    can_pose_t pose = {.capture_time_us = input_bits(input, 8),
                       .quality = (can_pose_quality_t)input_range(input, 0, 3),
                       .viewer = (uint8_t)input_range(input, 0, CAN_VIEWERS),
                       .tracker = input_byte(input),
                       .counter = input_byte(input)};
    for (int i = 0; i < 3; i++)
        pose.pose.eye_nm[i] = input_number(input, 50);
    for (int i = 0; i < 4; i++)
        pose.pose.quaternion_q30[i] = (int32_t)input_bits(input, 4);
    can_pose_t decoded;
    hal_can_frame_t fd, part[CAN_POSE_PARTS];
    if (can_pose_fd_encode(&fd, &pose))
        fuzz_check(can_pose_fd_decode(&decoded, &fd, pose.viewer) == CAN_CHECK_OK, "what is encoded decodes");
    if (can_pose_set_encode(part, &pose))
        fuzz_check(can_pose_set_decode(&decoded, part, pose.viewer) == CAN_CHECK_OK, "a set that is encoded decodes");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    hal_can_frame_t frame[CAN_POSE_PARTS];
    const uint8_t viewer = input_byte(&input) % CAN_VIEWERS;
    check_encoders(&input);
    while (input.left > 0) {
        for (int i = 0; i < CAN_POSE_PARTS; i++) {
            frame[i] = input_frame(&input);
            check_pose_fd(&frame[i], viewer);
            check_part(&frame[i], viewer);
            check_heartbeat(&frame[i]);
            check_status(&frame[i]);
            check_stage(&frame[i]);
            check_quality(&frame[i]);
            check_time(&frame[i]);
            check_sync(&frame[i]);
        }
        check_pose_set(frame, viewer);
    }
    return 0;
}
