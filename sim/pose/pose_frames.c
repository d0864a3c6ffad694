// SPDX-License-Identifier: Apache-2.0
// A pose -> its frames, of either kind.
#include "sim/pose/pose_frames.h"

int pose_frames(hal_can_frame_t frame[CAN_POSE_PARTS], const can_pose_t *pose, bool fd, uint64_t count)
{
    const uint64_t counters = fd ? CAN_E2E_P05_COUNTERS : CAN_E2E_P01_COUNTERS;
    can_pose_t counted = *pose;
    counted.counter = (uint8_t)(count % counters);
    if (fd)
        return can_pose_fd_encode(frame, &counted) ? 1 : 0;
    return can_pose_set_encode(frame, &counted) ? CAN_POSE_PARTS : 0;
}
