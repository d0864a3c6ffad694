// SPDX-License-Identifier: Apache-2.0
// Encoders and decoders of the poses in wallwarp.dbc.
#include "firmware/can_protocol.h"

#include "firmware/can_classic.h"

enum { FD_LENGTH = 32, POSITION_SET_NM = 10000, POSITION_FD_NM = 1000, TIME_SET_US = 100 };

/* The signals of wallwarp.dbc. */
static const can_field_t SET_QUALITY = {12, 4}, SET_X = {16, 24}, SET_Y = {40, 24};
static const can_field_t SET_TIME_LOW = {12, 12}, SET_Z = {24, 24}, SET_QW = {48, 16};
static const can_field_t SET_TIME_HIGH = {12, 4}, SET_QX = {16, 16}, SET_QY = {32, 16}, SET_QZ = {48, 16};

static const can_field_t FD_CRC = {0, 16}, FD_COUNTER = {16, 8}, FD_QUALITY = {24, 4}, FD_TRACKER = {28, 4};
static const can_field_t FD_POSITION[3] = {{32, 32}, {64, 32}, {96, 32}};
static const can_field_t FD_QUATERNION[4] = {{128, 24}, {152, 24}, {176, 24}, {200, 24}};
static const can_field_t FD_TIME = {224, 32};

/* To nearest, ties away from zero. */
static int64_t rounded(int64_t value, int64_t divisor)
{
    return (value + (value < 0 ? -divisor / 2 : divisor / 2)) / divisor;
}

static bool pose_header_fits(const can_pose_t *pose, int counters)
{
    return pose->viewer < CAN_VIEWERS && pose->counter < counters &&
           (pose->quality == CAN_POSE_LOST || pose->quality == CAN_POSE_TRACKED || pose->quality == CAN_POSE_PREDICTED);
}

/*
 * Components in Q15, which has no place for 1 or more. A quaternion with a component above 1 is up to 1 % too long: all
 * are divided by 1.01, which turns nothing and leaves the length within the 1 % that receivers allow.
 */
static void quaternion_q15(int64_t q15[4], const int32_t q30[4])
{
    int64_t divisor = 100;
    for (int i = 0; i < 4; i++)
        if (q30[i] > 1 << 30 || q30[i] < -(1 << 30))
            divisor = 101;
    for (int i = 0; i < 4; i++) {
        q15[i] = rounded((int64_t)q30[i] * 100 / divisor, 1 << 15);
        if (q15[i] == 1 << 15)
            q15[i]--;
    }
}

bool can_pose_set_encode(hal_can_frame_t part[CAN_POSE_PARTS], const can_pose_t *pose)
{
    int64_t position[3];
    int64_t quaternion[4];
    if (!pose_header_fits(pose, CAN_E2E_P01_COUNTERS))
        return false;
    for (int i = 0; i < 3; i++) {
        position[i] = rounded(pose->pose.eye_nm[i], POSITION_SET_NM);
        if (!can_field_fits_signed(SET_X, position[i]))
            return false;
    }
    quaternion_q15(quaternion, pose->pose.quaternion_q30);
    for (int i = 0; i < 4; i++)
        if (!can_field_fits_signed(SET_QW, quaternion[i]))
            return false;
    const uint64_t time = (pose->capture_time_us + TIME_SET_US / 2) / TIME_SET_US;

    const uint32_t id = CAN_ID_POSE_SET + 4 * (uint32_t)pose->viewer;
    for (uint32_t i = 0; i < CAN_POSE_PARTS; i++)
        part[i] = can_classic_frame(id + i, pose->counter);
    can_field_put(&part[0], SET_QUALITY, pose->quality);
    can_field_put(&part[0], SET_X, position[0]);
    can_field_put(&part[0], SET_Y, position[1]);
    can_field_put(&part[1], SET_TIME_LOW, (int64_t)time);
    can_field_put(&part[1], SET_Z, position[2]);
    can_field_put(&part[1], SET_QW, quaternion[0]);
    can_field_put(&part[2], SET_TIME_HIGH, (int64_t)(time >> SET_TIME_LOW.length));
    can_field_put(&part[2], SET_QX, quaternion[1]);
    can_field_put(&part[2], SET_QY, quaternion[2]);
    can_field_put(&part[2], SET_QZ, quaternion[3]);
    for (int i = 0; i < CAN_POSE_PARTS; i++)
        can_classic_protect(&part[i]);
    return true;
}

can_check_t can_pose_part_check(const hal_can_frame_t *frame, uint8_t viewer, int *part, uint8_t *counter)
{
    const uint32_t first = CAN_ID_POSE_SET + 4 * (uint32_t)viewer;
    if (frame->extended || frame->id < first || frame->id >= first + CAN_POSE_PARTS)
        return CAN_CHECK_OTHER;
    const can_check_t check = can_classic_check(frame);
    if (check != CAN_CHECK_OK)
        return check;
    *part = (int)(frame->id - first);
    *counter = can_classic_counter(frame);
    return CAN_CHECK_OK;
}

can_check_t can_pose_set_decode(can_pose_t *pose, const hal_can_frame_t part[CAN_POSE_PARTS], uint8_t viewer)
{
    uint8_t counter[CAN_POSE_PARTS] = {0};
    for (int i = 0; i < CAN_POSE_PARTS; i++) {
        int place = 0;
        const can_check_t check = can_pose_part_check(&part[i], viewer, &place, &counter[i]);
        if (check != CAN_CHECK_OK)
            return check;
        if (place != i)
            return CAN_CHECK_OTHER;
        if (counter[i] != counter[0])
            return CAN_CHECK_COUNTER;
    }
    const uint32_t quality = can_field_get(&part[0], SET_QUALITY);
    if (quality > CAN_POSE_PREDICTED)
        return CAN_CHECK_VALUE;

    const uint32_t time_low = can_field_get(&part[1], SET_TIME_LOW);
    const uint32_t time_high = can_field_get(&part[2], SET_TIME_HIGH);
    const uint32_t time = time_high << SET_TIME_LOW.length | time_low;
    *pose = (can_pose_t){
        .pose.eye_nm = {(int64_t)can_field_get_signed(&part[0], SET_X) * POSITION_SET_NM,
                        (int64_t)can_field_get_signed(&part[0], SET_Y) * POSITION_SET_NM,
                        (int64_t)can_field_get_signed(&part[1], SET_Z) * POSITION_SET_NM},
        .pose.quaternion_q30 = {can_field_get_signed(&part[1], SET_QW) * (1 << 15),
                                can_field_get_signed(&part[2], SET_QX) * (1 << 15),
                                can_field_get_signed(&part[2], SET_QY) * (1 << 15),
                                can_field_get_signed(&part[2], SET_QZ) * (1 << 15)},
        .capture_time_us = (uint64_t)time * TIME_SET_US,
        .quality = (can_pose_quality_t)quality,
        .viewer = viewer,
        .counter = counter[0],
    };
    return CAN_CHECK_OK;
}

bool can_pose_fd_encode(hal_can_frame_t *frame, const can_pose_t *pose)
{
    if (!pose_header_fits(pose, CAN_E2E_P05_COUNTERS) || pose->tracker > 15)
        return false;
    hal_can_frame_t made = {
        .id = CAN_ID_POSE_FD + (uint32_t)pose->viewer, .fd = true, .bit_rate_switch = true, .length = FD_LENGTH};
    can_field_put(&made, FD_COUNTER, pose->counter);
    can_field_put(&made, FD_QUALITY, pose->quality);
    can_field_put(&made, FD_TRACKER, pose->tracker);
    can_field_put(&made, FD_TIME, (int64_t)pose->capture_time_us);
    for (int i = 0; i < 3; i++) {
        const int64_t position = rounded(pose->pose.eye_nm[i], POSITION_FD_NM);
        if (!can_field_fits_signed(FD_POSITION[i], position))
            return false;
        can_field_put(&made, FD_POSITION[i], position);
    }
    for (int i = 0; i < 4; i++) {
        const int64_t component = rounded(pose->pose.quaternion_q30[i], 1 << 8);
        if (!can_field_fits_signed(FD_QUATERNION[i], component))
            return false;
        can_field_put(&made, FD_QUATERNION[i], component);
    }
    can_field_put(&made, FD_CRC, can_e2e_p05_crc((uint16_t)made.id, made.data, FD_LENGTH));
    *frame = made;
    return true;
}

can_check_t can_pose_fd_decode(can_pose_t *pose, const hal_can_frame_t *frame, uint8_t viewer)
{
    if (frame->extended || frame->id != CAN_ID_POSE_FD + (uint32_t)viewer)
        return CAN_CHECK_OTHER;
    if (!frame->fd || frame->length != FD_LENGTH)
        return CAN_CHECK_LENGTH;
    if (can_field_get(frame, FD_CRC) != can_e2e_p05_crc((uint16_t)frame->id, frame->data, FD_LENGTH))
        return CAN_CHECK_CRC;
    const uint32_t quality = can_field_get(frame, FD_QUALITY);
    if (quality > CAN_POSE_PREDICTED)
        return CAN_CHECK_VALUE;
    can_pose_t found = {
        .capture_time_us = can_field_get(frame, FD_TIME),
        .quality = (can_pose_quality_t)quality,
        .viewer = viewer,
        .tracker = (uint8_t)can_field_get(frame, FD_TRACKER),
        .counter = (uint8_t)can_field_get(frame, FD_COUNTER),
    };
    for (int i = 0; i < 3; i++)
        found.pose.eye_nm[i] = (int64_t)can_field_get_signed(frame, FD_POSITION[i]) * POSITION_FD_NM;
    for (int i = 0; i < 4; i++)
        found.pose.quaternion_q30[i] = can_field_get_signed(frame, FD_QUATERNION[i]) * (1 << 8);
    *pose = found;
    return CAN_CHECK_OK;
}
