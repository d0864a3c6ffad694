// SPDX-License-Identifier: Apache-2.0
// Poses of a viewer before the study's wall: at an angle, with the head turned, as a tracker reports them.
#ifndef SIM_STUDY_STUDY_POSE_H
#define SIM_STUDY_STUDY_POSE_H

#include "sim/rng.h"
#include "warp_fixed/homography_from_pose.h"

enum { STUDY_DISTANCE_MM = 2500 };

/** The pose 2.5 m from the wall's centre and looking at it, turned about the wall's vertical axis, degrees. */
pose_t study_pose(double angle_deg);

/**
 * The same, turned about more axes of the wall through its centre: about x (the wall's horizontal) first, then y, then
 * z. study_pose(a) is study_pose_turned({0, a, 0}).
 */
pose_t study_pose_turned(const double angle_deg[3]);

/** Turn the viewer's head. @param rotation_rad  Axis, in the camera frame, times angle. */
void study_pose_turn_head(pose_t *pose, const double rotation_rad[3]);

/** Error of a tracked pose: standard deviation along, and about, each of three axes. */
typedef struct {
    double position_mm, orientation_deg;
} study_noise_t;

/** @return The pose as a tracker reports it. The same numbers make the same error, scaled by the noise. */
pose_t study_pose_tracked(const pose_t *pose, const study_noise_t *noise, rng_t *rng);

#endif
