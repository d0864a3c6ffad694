// SPDX-License-Identifier: Apache-2.0
// Made-up motions of a viewer, as pose lists.
#include "sim/pose/motion.h"

#include <math.h>
#include <stdlib.h>

#include "sim/rng.h"
#include "sim/trackers/tracker_rotation.h"

static const double walk_m = 1.0, walk_m_s = 1.4, bob_m = 0.03, bob_hz = 2.0, look_deg = 20.0, look_hz = 0.7;
static const double orbit_m = 1.0, orbit_hz = 0.1, noise_m = 0.0005, noise_deg = 0.05;
static const double nm_per_m = 1e9, q30 = 1073741824.0;

const char *const motion_names[MOTIONS] = {"still", "walk", "orbit", "noise"};

/* From the start, in its axes: metres, and turns about y (down), x (right), z (forward) in this order. */
typedef struct {
    double m[3], degrees[3];
} step_t;

static step_t step_at(motion_kind_t kind, double s, rng_t *rng)
{
    step_t step = {{0.0}, {0.0}};
    const double turn = 2.0 * M_PI * s;
    if (kind == MOTION_WALK) {
        step.m[0] = walk_m * sin(walk_m_s / walk_m * s);
        step.m[1] = bob_m * sin(bob_hz * turn);
        step.degrees[0] = look_deg * sin(look_hz * turn);
    } else if (kind == MOTION_ORBIT) {
        step.m[0] = -orbit_m * sin(orbit_hz * turn);
        step.m[2] = orbit_m * (1.0 - cos(orbit_hz * turn));
        step.degrees[0] = 360.0 * orbit_hz * s;
    } else if (kind == MOTION_NOISE) {
        for (int i = 0; i < 3; i++) {
            step.m[i] = noise_m * rng_normal(rng);
            step.degrees[i] = noise_deg * rng_normal(rng);
        }
    }
    return step;
}

static pose_t pose_after(const pose_t *start, const step_t *step)
{
    double quaternion[4], way[3], turn[4];
    double length = 0.0;
    for (int i = 0; i < 4; i++)
        length = hypot(length, start->quaternion_q30[i]);
    for (int i = 0; i < 4; i++)
        quaternion[i] = start->quaternion_q30[i] / length;
    tracker_rotation_apply(way, quaternion, step->m);
    tracker_rotation_from_angles(turn, "yxz", step->degrees);
    tracker_rotation_multiply(quaternion, quaternion, turn);
    pose_t pose;
    for (int i = 0; i < 3; i++)
        pose.eye_nm[i] = start->eye_nm[i] + llround(way[i] * nm_per_m);
    for (int i = 0; i < 4; i++)
        pose.quaternion_q30[i] = (int32_t)lround(quaternion[i] * q30);
    return pose;
}

bool motion_make(pose_list_t *list, const motion_t *motion)
{
    const size_t count = (size_t)fmax(1.0, ceil(motion->rate_hz * motion->duration_s));
    pose_list_entry_t *entry = malloc(count * sizeof *entry);
    if (entry == NULL)
        return false;
    rng_t rng = {motion->seed};
    for (size_t i = 0; i < count; i++) {
        const double s = (double)i / motion->rate_hz;
        const step_t step = step_at(motion->kind, s, &rng);
        entry[i] = (pose_list_entry_t){.time_us = llround(s * 1e6), .pose = pose_after(&motion->start, &step)};
    }
    *list = (pose_list_t){.entry = entry, .count = count};
    return true;
}
