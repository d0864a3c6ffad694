// SPDX-License-Identifier: Apache-2.0
// A pose -> its frames, of either kind.
#ifndef SIM_POSE_POSE_FRAMES_H
#define SIM_POSE_POSE_FRAMES_H

#include <stdbool.h>
#include <stdint.h>

#include "firmware/can_protocol.h"

/**
 * @param[out] frame  Written as far as the result says.
 * @param      pose   Its capture time may be of any length: the message takes what it carries.
 * @param      fd     One CAN FD frame, else a set of three classic frames.
 * @param      count  Of the viewer's poses so far, from any start: the counter comes from it, not from the pose.
 * @return Frames made: 1, 3, or 0 when the pose does not fit its message.
 */
int pose_frames(hal_can_frame_t frame[CAN_POSE_PARTS], const can_pose_t *pose, bool fd, uint64_t count);

#endif
