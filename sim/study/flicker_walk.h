// SPDX-License-Identifier: Apache-2.0
// The moving viewer of the study: walks past the wall, bobs with each step, and may shake the head.
#ifndef SIM_STUDY_FLICKER_WALK_H
#define SIM_STUDY_FLICKER_WALK_H

#include "warp_fixed/homography_from_pose.h"

/** Position p = start + speed t along the wall's rows + bob sin(2 pi 1.8 t) down its columns; the head turns by
 * yaw sin(2 pi 0.7 t) about the camera's y axis. */
typedef struct {
    pose_t start;
    double speed_m_s;
    double bob_m;
    double yaw_deg;
} flicker_walk_t;

extern const double flicker_walk_bob_hz, flicker_walk_yaw_hz;

/** Turn a viewer's head. @param rotation_rad  Axis, in the camera frame, times angle. */
void flicker_walk_turn(pose_t *pose, const double rotation_rad[3]);

/** @return Where the viewer is at a time, before a wall whose rows run along the world's x and columns along y. */
pose_t flicker_walk_pose(const flicker_walk_t *walk, double time_s);

#endif
