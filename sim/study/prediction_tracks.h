// SPDX-License-Identifier: Apache-2.0
// Viewers who walk, turn their heads, stop and go; tracked with noise, and how far off their predicted poses are.
#ifndef SIM_STUDY_PREDICTION_TRACKS_H
#define SIM_STUDY_PREDICTION_TRACKS_H

#include "sim/study/study_pose.h"

typedef enum {
    PREDICTION_WALKING,     /**< 1.4 m/s, with a bob of 30 mm times sin(2 pi 2 t) */
    PREDICTION_TURNING,     /**< the head, 45 degrees times sin(2 pi 0.7 t) about its vertical axis */
    PREDICTION_BOTH,        /**< walking and turning */
    PREDICTION_STOP_AND_GO, /**< 1 m/s^2 up to 1.4 m/s, 1 s so, 1 m/s^2 down to a stand, 1 s so; and again */
    PREDICTION_STANDING,    /**< of stop and go only what is due while the viewer stands */
    PREDICTION_TRACKS
} prediction_track_t;

enum {
    PREDICTION_RATE_HZ = 240,
    PREDICTION_EVERY = 4, /**< so many poses make one frame of 60 Hz */
    PREDICTION_SECONDS = 24
};

/** The tracker's noise: 0.5 mm along each axis and 0.05 degrees about each. */
extern const study_noise_t prediction_noise;

/** @return "walking", ... */
const char *prediction_track_name(prediction_track_t track);

/** @return The true pose. */
pose_t prediction_pose(prediction_track_t track, double time_s);

/** Sums of squared errors, all 0 at first: of the newest pose, and of the predicted one. */
typedef struct {
    double hold_mm2, predicted_mm2;   /**< of the length of the position's error */
    double hold_deg2, predicted_deg2; /**< of the angle of the one rotation that mends the orientation */
    int64_t frames;
} prediction_error_t;

/**
 * Add the frames of a run of PREDICTION_SECONDS, but for the first second: the newest pose that came, and the one that
 * is predicted, against where the viewer is after the lead.
 *
 * @param loss  The part of the poses that is lost on the way, 0 to 1; the newest one that came is held or predicted
 * from.
 * @param seed  Of noise and losses.
 */
void prediction_error_add(prediction_error_t *error, prediction_track_t track, int32_t lead_us, double loss,
                          uint64_t seed);

/** @return Predicted error over held error, root mean squares. */
double prediction_position_ratio(const prediction_error_t *error);
double prediction_angle_ratio(const prediction_error_t *error);

#endif
