// SPDX-License-Identifier: Apache-2.0
// The moving viewer of the study: walks past the wall, bobs with each step, and may shake the head.
#include "sim/study/flicker_walk.h"

#include <math.h>

const double flicker_walk_bob_hz = 1.8, flicker_walk_yaw_hz = 0.7;

void flicker_walk_turn(pose_t *pose, const double rotation_rad[3])
{
    const double angle =
        sqrt(rotation_rad[0] * rotation_rad[0] + rotation_rad[1] * rotation_rad[1] + rotation_rad[2] * rotation_rad[2]);
    const double c = cos(angle / 2), s = angle > 0.0 ? sin(angle / 2) / angle : 0.0;
    const double x = s * rotation_rad[0], y = s * rotation_rad[1], z = s * rotation_rad[2];
    const int32_t *q = pose->quaternion_q30;
    const double turned[4] = {q[0] * c - q[1] * x - q[2] * y - q[3] * z, q[1] * c + q[0] * x + q[2] * z - q[3] * y,
                              q[2] * c + q[0] * y + q[3] * x - q[1] * z, q[3] * c + q[0] * z + q[1] * y - q[2] * x};
    for (int i = 0; i < 4; i++)
        pose->quaternion_q30[i] = (int32_t)lround(turned[i]);
}

pose_t flicker_walk_pose(const flicker_walk_t *walk, double time_s)
{
    pose_t pose = walk->start;
    const double yaw_rad = walk->yaw_deg * M_PI / 180.0 * sin(2.0 * M_PI * flicker_walk_yaw_hz * time_s);
    pose.eye_nm[0] += llround(walk->speed_m_s * time_s * 1e9);
    pose.eye_nm[1] += llround(walk->bob_m * sin(2.0 * M_PI * flicker_walk_bob_hz * time_s) * 1e9);
    flicker_walk_turn(&pose, (const double[3]){0.0, yaw_rad, 0.0});
    return pose;
}
