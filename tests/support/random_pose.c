// SPDX-License-Identifier: Apache-2.0
// Random poses for the tests of the bus.
#include "tests/support/random_pose.h"

#include <math.h>

can_pose_t random_pose(rng_t *rng, int64_t limit_nm, int counters)
{
    can_pose_t pose = {
        .capture_time_us = rng_next(rng) >> 8,
        .quality = (can_pose_quality_t)(rng_next(rng) % 3),
        .viewer = (uint8_t)(rng_next(rng) % CAN_VIEWERS),
        .tracker = (uint8_t)(rng_next(rng) % 16),
        .counter = (uint8_t)(rng_next(rng) % (uint64_t)counters),
    };
    for (int i = 0; i < 3; i++)
        pose.pose.eye_nm[i] = rng_int(rng, -limit_nm, limit_nm);
    for (int i = 0; i < 4; i++)
        pose.pose.quaternion_q30[i] = (int32_t)rng_int(rng, -(1 << 30), 1 << 30);
    return pose;
}

can_pose_t random_pose_sane(rng_t *rng, int64_t limit_nm, int counters)
{
    can_pose_t pose = random_pose(rng, limit_nm, counters);
    double norm = 0;
    for (int i = 0; i < 4; i++)
        norm = hypot(norm, (double)pose.pose.quaternion_q30[i]);
    for (int i = 0; i < 4; i++)
        pose.pose.quaternion_q30[i] = (int32_t)lrint((double)pose.pose.quaternion_q30[i] / norm * (1 << 30));
    pose.quality = CAN_POSE_TRACKED;
    pose.viewer = 0;
    return pose;
}
