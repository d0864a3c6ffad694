// SPDX-License-Identifier: Apache-2.0
// The moving viewer of the study: walks past the wall, bobs with each step, and may shake the head.
#ifndef SIM_STUDY_STUDY_WALK_H
#define SIM_STUDY_STUDY_WALK_H

#include "sim/study/study_pose.h"

/** Position p = start + speed t along the wall's rows + bob sin(2 pi 1.8 t) down its columns; the head turns by
 * yaw sin(2 pi 0.7 t) about the camera's y axis. */
typedef struct {
    pose_t start;
    double speed_m_s;
    double bob_m;
    double yaw_deg;
} study_walk_t;

extern const double study_walk_bob_hz, study_walk_yaw_hz;

/** An ordinary walk. */
extern const double study_walk_speed_m_s, study_walk_bob_m;

/** @return Where the viewer is at a time, before a wall whose rows run along the world's x and columns along y. */
pose_t study_walk_pose(const study_walk_t *walk, double time_s);

#endif
