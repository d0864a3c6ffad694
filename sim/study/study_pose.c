// SPDX-License-Identifier: Apache-2.0
// Poses of a viewer before the study's wall: at an angle, with the head turned, as a tracker reports them.
#include "sim/study/study_pose.h"

#include <math.h>
#include <string.h>

static const double one_q30 = 1073741824.0;

static void multiply(double out[4], const double p[4], const double q[4])
{
    out[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    out[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    out[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    out[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
}

pose_t study_pose_turned(const double angle_deg[3])
{
    double turned[4] = {1.0, 0.0, 0.0, 0.0};
    for (int axis = 0; axis < 3; axis++) {
        const double half = -angle_deg[axis] * M_PI / 360.0;
        double one[4] = {cos(half), 0.0, 0.0, 0.0}, next[4];
        one[axis + 1] = sin(half);
        multiply(next, one, turned);
        memcpy(turned, next, sizeof turned);
    }
    const double w = turned[0], x = turned[1], y = turned[2], z = turned[3];
    /* where the camera's backward axis points */
    const double back[3] = {-2.0 * (x * z + w * y), -2.0 * (y * z - w * x), -(w * w - x * x - y * y + z * z)};
    pose_t pose;
    for (int i = 0; i < 3; i++)
        pose.eye_nm[i] = llround(STUDY_DISTANCE_MM * 1e6 * back[i]);
    for (int i = 0; i < 4; i++)
        pose.quaternion_q30[i] = (int32_t)lround(turned[i] * one_q30);
    return pose;
}

pose_t study_pose(double angle_deg)
{
    return study_pose_turned((const double[3]){0.0, angle_deg, 0.0});
}

void study_pose_turn_head(pose_t *pose, const double rotation_rad[3])
{
    const double angle = hypot(hypot(rotation_rad[0], rotation_rad[1]), rotation_rad[2]);
    const double c = cos(angle / 2), s = angle > 0.0 ? sin(angle / 2) / angle : 0.0;
    const double turn[4] = {c, s * rotation_rad[0], s * rotation_rad[1], s * rotation_rad[2]};
    double q[4], turned[4];
    for (int i = 0; i < 4; i++)
        q[i] = pose->quaternion_q30[i];
    multiply(turned, q, turn);
    for (int i = 0; i < 4; i++)
        pose->quaternion_q30[i] = (int32_t)lround(turned[i]);
}

pose_t study_pose_tracked(const pose_t *pose, const study_noise_t *noise, rng_t *rng)
{
    pose_t tracked = *pose;
    double rotation_rad[3];
    for (int i = 0; i < 3; i++) {
        tracked.eye_nm[i] += llround(noise->position_mm * 1e6 * rng_normal(rng));
        rotation_rad[i] = noise->orientation_deg * M_PI / 180.0 * rng_normal(rng);
    }
    study_pose_turn_head(&tracked, rotation_rad);
    return tracked;
}
