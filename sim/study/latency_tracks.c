// SPDX-License-Identifier: Apache-2.0
// A viewer's motions, which of their poses are late or noisy, and what that does to the content's place.
#include "sim/study/latency_tracks.h"

#include <math.h>

#include "sim/study/study_walk.h"

enum { TIMES = 20 };

const double latency_yaw_deg = 45.0;

typedef struct {
    const char *name;
    bool walks, turns;
} motion_t;

static const motion_t motion[LATENCY_TRACKS] = {
    [LATENCY_WALKING] = {"walking: wall late", true, false},
    [LATENCY_TURNING] = {"turning: wall late", false, true},
    [LATENCY_TRAP] = {"both: picture late and wall newest", true, true},
    [LATENCY_ONE_POSE] = {"both: one late pose", true, true},
    [LATENCY_ONE_TURN] = {"both: late turn and newest place", true, true},
    [LATENCY_ONE_POSE_WALKING] = {"walking: one late pose", true, false},
};

const char *latency_track_name(latency_track_t track)
{
    return motion[track].name;
}

double latency_time_s(int32_t n, int32_t count)
{
    return ((n + 0.5) / count - 0.5) / study_walk_yaw_hz;
}

pose_t latency_pose(latency_track_t track, double time_s)
{
    const motion_t *of = &motion[track];
    const study_walk_t walk = {study_pose(0.0), of->walks ? study_walk_speed_m_s : 0.0,
                               of->walks ? study_walk_bob_m : 0.0, of->turns ? latency_yaw_deg : 0.0};
    return study_walk_pose(&walk, time_s);
}

static latency_poses_t late_poses(latency_track_t track, double time_s, double latency_s)
{
    const pose_t now = latency_pose(track, time_s), old = latency_pose(track, time_s - latency_s);
    pose_t turned_back = now;
    for (int i = 0; i < 4; i++)
        turned_back.quaternion_q30[i] = old.quaternion_q30[i];
    switch (track) {
    case LATENCY_TRAP:
        return (latency_poses_t){.drawn = old, .corrected = now, .eye = now};
    case LATENCY_ONE_TURN:
        return (latency_poses_t){.drawn = old, .corrected = turned_back, .eye = now};
    case LATENCY_ONE_POSE:
    case LATENCY_ONE_POSE_WALKING:
        return (latency_poses_t){.drawn = old, .corrected = old, .eye = now};
    case LATENCY_WALKING:
    case LATENCY_TURNING:
    case LATENCY_TRACKS:
        break;
    }
    return (latency_poses_t){.drawn = now, .corrected = old, .eye = now};
}

latency_error_t latency_late_error(const study_scene_t *scene, latency_track_t track, double latency_s,
                                   double content_m)
{
    latency_error_t error = {0};
    for (int32_t n = 0; n < TIMES; n++) {
        latency_poses_t poses = late_poses(track, latency_time_s(n, TIMES), latency_s);
        poses.content_m = content_m;
        latency_error_add(&error, scene, &poses);
    }
    return error;
}

pose_t latency_tracked(const pose_t *pose, const study_noise_t *noise, int32_t draw)
{
    rng_t rng = {(uint64_t)draw + 1};
    return study_pose_tracked(pose, noise, &rng);
}

latency_error_t latency_noise_error(const study_scene_t *scene, bool picture_too, const study_noise_t *noise,
                                    double content_m)
{
    latency_error_t error = {0};
    for (int32_t n = 0; n < TIMES; n++) {
        const pose_t eye = latency_pose(LATENCY_WALKING, latency_time_s(n, TIMES));
        const pose_t seen = latency_tracked(&eye, noise, n);
        const latency_poses_t poses = {picture_too ? seen : eye, seen, eye, content_m};
        latency_error_add(&error, scene, &poses);
    }
    return error;
}
