// SPDX-License-Identifier: Apache-2.0
// The moving viewer of the study: walks past the wall, bobs with each step, and may shake the head.
#include "sim/study/study_walk.h"

#include <math.h>

const double study_walk_bob_hz = 1.8, study_walk_yaw_hz = 0.7;
const double study_walk_speed_m_s = 1.4, study_walk_bob_m = 0.015;

pose_t study_walk_pose(const study_walk_t *walk, double time_s)
{
    pose_t pose = walk->start;
    const double yaw_rad = walk->yaw_deg * M_PI / 180.0 * sin(2.0 * M_PI * study_walk_yaw_hz * time_s);
    pose.eye_nm[0] += llround(walk->speed_m_s * time_s * 1e9);
    pose.eye_nm[1] += llround(walk->bob_m * sin(2.0 * M_PI * study_walk_bob_hz * time_s) * 1e9);
    study_pose_turn_head(&pose, (const double[3]){0.0, yaw_rad, 0.0});
    return pose;
}
