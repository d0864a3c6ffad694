// SPDX-License-Identifier: Apache-2.0
// Collects, checks and counts the pose messages of one viewer.
#include "firmware/pose_from_can.h"

#include <string.h>

static const int64_t FARTHEST_NM = INT64_C(1000000000000);

void can_faults_count(can_faults_t *faults, can_check_t check)
{
    switch (check) {
    case CAN_CHECK_LENGTH:
        faults->length++;
        break;
    case CAN_CHECK_CRC:
        faults->crc++;
        break;
    case CAN_CHECK_COUNTER:
        faults->counter_invalid++;
        break;
    case CAN_CHECK_VALUE:
        faults->bad_pose++;
        break;
    case CAN_CHECK_OK:
    case CAN_CHECK_OTHER:
        break;
    }
}

/* @return Does the frame with this counter carry on the sequence, or is it a duplicate or stale? Counts either way. */
static bool carries_on(can_sequence_t *sequence, int counter, int counters, int64_t time_us, can_faults_t *faults)
{
    const bool first = !sequence->any;
    const bool silent = !first && time_us - sequence->last_us > POSE_FROM_CAN_SILENCE_US;
    uint32_t lost = 0;
    const can_e2e_step_t step =
        first || silent ? CAN_E2E_RESTART : can_e2e_step(sequence->newest, counter, counters, &lost);
    sequence->any = true;
    sequence->last_us = time_us;
    if (step == CAN_E2E_DUPLICATE) {
        faults->duplicate++;
        return false;
    }
    if (step == CAN_E2E_STALE) {
        faults->stale++;
        return false;
    }
    if (step == CAN_E2E_RESTART && !first)
        faults->sender_restart++;
    faults->counter_lost += lost;
    sequence->newest = counter;
    return true;
}

static bool is_sane(const pose_t *pose)
{
    for (int i = 0; i < 3; i++)
        if (pose->eye_nm[i] > FARTHEST_NM || pose->eye_nm[i] < -FARTHEST_NM)
            return false;
    /* In Q20 a square is at most 2^42; the sum of four fits easily. */
    int64_t norm_squared = 0;
    for (int i = 0; i < 4; i++) {
        const int64_t component = pose->quaternion_q30[i] / (1 << 10);
        norm_squared += component * component;
    }
    const int64_t one = INT64_C(1) << 40;
    return norm_squared >= one / 10000 * 9801 && norm_squared <= one / 10000 * 10201;
}

static void take_capture_time(can_poses_t *poses, const bus_master_t *time, uint64_t wrap_us)
{
    poses->captured = false;
    poses->capture_bus_us = 0;
    if (time == NULL || time->origin != BUS_MASTER_TRACKER || !bus_master_knows(time, poses->received_us))
        return;
    const int64_t received_bus_us = bus_time_from_local(&time->time, poses->received_us);
    const int64_t capture_bus_us = bus_time_extend(received_bus_us, poses->newest.capture_time_us, wrap_us);
    if (received_bus_us - capture_bus_us > POSE_FROM_CAN_OLDEST_US ||
        capture_bus_us - received_bus_us > POSE_FROM_CAN_AHEAD_US)
        return;
    poses->captured = true;
    poses->capture_bus_us = capture_bus_us;
}

static void remember(can_poses_t *poses, const bus_master_t *time, int counters)
{
    const bool fd = counters == CAN_E2E_P05_COUNTERS;
    poses->counters = counters;
    take_capture_time(poses, time, fd ? CAN_POSE_FD_WRAP_US : CAN_POSE_SET_WRAP_US);
    int64_t time_us = poses->received_us;
    if (time != NULL)
        time_us = poses->captured ? poses->capture_bus_us : bus_time_from_local(&time->time, poses->received_us);
    (void)pose_history_add(&poses->history, &poses->newest, time_us);
}

/* @return Was it taken? */
static bool take_pose(can_poses_t *poses, const can_pose_t *pose, int64_t time_us, can_faults_t *faults)
{
    if (pose->quality == CAN_POSE_LOST) {
        faults->tracking_lost++;
        return false;
    }
    if (!is_sane(&pose->pose)) {
        faults->bad_pose++;
        return false;
    }
    poses->newest = *pose;
    poses->received_us = time_us;
    poses->any = true;
    return true;
}

/* @return Was it this viewer's FD pose, good or bad? */
static bool take_fd(can_poses_t *poses, const bus_master_t *time, const hal_can_frame_t *frame, can_faults_t *faults)
{
    can_pose_t pose;
    const can_check_t check = can_pose_fd_decode(&pose, frame, poses->viewer);
    can_faults_count(faults, check);
    if (check == CAN_CHECK_OK && carries_on(&poses->fd, pose.counter, CAN_E2E_P05_COUNTERS, frame->time_us, faults) &&
        take_pose(poses, &pose, frame->time_us, faults))
        remember(poses, time, CAN_E2E_P05_COUNTERS);
    return check != CAN_CHECK_OTHER;
}

static void give_up_set(can_poses_t *poses, can_faults_t *faults)
{
    if (poses->collecting)
        faults->incomplete_set++;
    poses->collecting = false;
}

static void complete_set(can_poses_t *poses, const bus_master_t *time, int64_t time_us, can_faults_t *faults)
{
    can_pose_t pose;
    const can_check_t check = can_pose_set_decode(&pose, poses->part, poses->viewer);
    poses->collecting = false;
    can_faults_count(faults, check);
    if (check == CAN_CHECK_OK && take_pose(poses, &pose, time_us, faults))
        remember(poses, time, CAN_E2E_P01_COUNTERS);
}

/* @return Was it a part of this viewer's sets, good or bad? */
static bool take_part(can_poses_t *poses, const bus_master_t *time, const hal_can_frame_t *frame, can_faults_t *faults)
{
    int part = 0;
    uint8_t counter = 0;
    const can_check_t check = can_pose_part_check(frame, poses->viewer, &part, &counter);
    can_faults_count(faults, check);
    if (check != CAN_CHECK_OK)
        return check != CAN_CHECK_OTHER;

    if (poses->collecting && frame->time_us - poses->set_began_us > POSE_FROM_CAN_SET_US)
        give_up_set(poses, faults);
    if (poses->collecting && counter == poses->set.newest) {
        if (poses->part_here[part]) {
            faults->duplicate++;
            return true;
        }
    } else {
        if (!carries_on(&poses->set, counter, CAN_E2E_P01_COUNTERS, frame->time_us, faults))
            return true;
        give_up_set(poses, faults);
        poses->collecting = true;
        poses->set_began_us = frame->time_us;
        memset(poses->part_here, 0, sizeof poses->part_here);
    }
    poses->part[part] = *frame;
    poses->part_here[part] = true;
    if (poses->part_here[0] && poses->part_here[1] && poses->part_here[2])
        complete_set(poses, time, frame->time_us, faults);
    return true;
}

bool pose_from_frame(can_poses_t *poses, const bus_master_t *time, const hal_can_frame_t *frame, can_faults_t *faults)
{
    return take_fd(poses, time, frame, faults) || take_part(poses, time, frame, faults);
}

uint32_t can_faults_refused(const can_faults_t *faults)
{
    return faults->auth_unsigned + faults->auth_forged + faults->auth_replayed + faults->auth_stale +
           faults->auth_early + faults->auth_commands;
}

uint32_t can_faults_total(const can_faults_t *faults)
{
    return faults->length + faults->crc + faults->counter_invalid + faults->counter_lost + faults->duplicate +
           faults->stale + faults->sender_restart + faults->incomplete_set + faults->bad_pose + faults->io +
           faults->overrun + faults->lost + faults->bus_off + faults->auth_lost + can_faults_refused(faults);
}
