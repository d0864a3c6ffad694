// SPDX-License-Identifier: Apache-2.0
// The moving viewer of the study: walks past the wall, bobs with each step, and may shake the head.
#include "sim/study/flicker_walk.h"

#include <math.h>

const double flicker_walk_bob_hz = 1.8, flicker_walk_yaw_hz = 0.7;

/* The quaternion turned by an angle about the camera's own y axis. */
static void turn(int32_t quaternion_q30[4], double angle)
{
    const double c = cos(angle / 2), s = sin(angle / 2);
    const double w = quaternion_q30[0], x = quaternion_q30[1], y = quaternion_q30[2], z = quaternion_q30[3];
    const double turned[4] = {w * c - y * s, x * c - z * s, y * c + w * s, z * c + x * s};
    for (int i = 0; i < 4; i++)
        quaternion_q30[i] = (int32_t)lround(turned[i]);
}

pose_t flicker_walk_pose(const flicker_walk_t *walk, double time_s)
{
    pose_t pose = walk->start;
    pose.eye_nm[0] += llround(walk->speed_m_s * time_s * 1e9);
    pose.eye_nm[1] += llround(walk->bob_m * sin(2.0 * M_PI * flicker_walk_bob_hz * time_s) * 1e9);
    turn(pose.quaternion_q30, walk->yaw_deg * M_PI / 180.0 * sin(2.0 * M_PI * flicker_walk_yaw_hz * time_s));
    return pose;
}
