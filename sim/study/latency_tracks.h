// SPDX-License-Identifier: Apache-2.0
// A viewer's motions, which of their poses are late or noisy, and what that does to the content's place.
#ifndef SIM_STUDY_LATENCY_TRACKS_H
#define SIM_STUDY_LATENCY_TRACKS_H

#include <stdbool.h>

#include "sim/study/latency_error.h"

/** Who moves how, and who uses which pose. */
typedef enum {
    LATENCY_WALKING,          /**< the picture is drawn for the newest pose, the wall corrected for an old one */
    LATENCY_TURNING,          /**< the same */
    LATENCY_TRAP,             /**< walking and turning; the picture drawn for an old pose, the wall for the newest */
    LATENCY_ONE_POSE,         /**< both; picture and wall for the same old pose */
    LATENCY_ONE_TURN,         /**< both; the wall for the picture's old orientation at the newest place */
    LATENCY_ONE_POSE_WALKING, /**< walking; picture and wall for the same old pose */
    LATENCY_TRACKS
} latency_track_t;

extern const double latency_yaw_deg;

/** @return "walking: wall late", ... */
const char *latency_track_name(latency_track_t track);

/** @return Time n of count over one swing of the head, in the middle of which the viewer is before the wall's centre.
 */
double latency_time_s(int32_t n, int32_t count);

/** @return The true pose. */
pose_t latency_pose(latency_track_t track, double time_s);

/** @return The error over one swing of the head. @param content_m  As in latency_poses_t. */
latency_error_t latency_late_error(const study_scene_t *scene, latency_track_t track, double latency_s,
                                   double content_m);

/** @return The pose with the tracker's noise. @param draw  Its seed: the same draw is the same error, scaled. */
pose_t latency_tracked(const pose_t *pose, const study_noise_t *noise, int32_t draw);

/** Noise on the wall's pose alone, or on one pose that the picture is drawn for too; the viewer walks. */
latency_error_t latency_noise_error(const study_scene_t *scene, bool picture_too, const study_noise_t *noise,
                                    double content_m);

#endif
