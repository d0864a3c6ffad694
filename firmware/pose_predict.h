// SPDX-License-Identifier: Apache-2.0
// Pose history -> where the viewer's eye is, and how it looks, at a time that is yet to come.
//
// A parabola (parabola_fit.h) through the poses of the last 110 ms of the present run, for the position and for the
// rotation vector from the newest orientation. It smooths the tracker's noise, and goes on for a bounded lead. Of what
// it says that part is kept that would have been best for the same lead in eight trials over the last quarter of a
// second: who swings too quickly to be predicted is held.
//
// Figures, with 0.5 mm and 0.05 degrees of noise at 240 Hz (the study's section on prediction has them all): at 40 ms
// lead 3 to 8 % of the error of holding the newest pose, when walking, turning the head, and stopping and going; at
// rest a third of it. It is worse by 10 % at most for swings of any size up to 6 Hz.
#ifndef FIRMWARE_POSE_PREDICT_H
#define FIRMWARE_POSE_PREDICT_H

#include "firmware/pose_history.h"

enum {
    POSE_PREDICT_WINDOW_US = 110000, /**< poses older than the newest by more are not used */
    POSE_PREDICT_FULL_US = 60000,    /**< up to this lead the motion goes on; then it fades, */
    POSE_PREDICT_STILL_US = 140000,  /**< and from here on the pose stays, where 100 ms of motion would have led */
    POSE_PREDICT_NOISE_NM = 500000,  /**< noise expected of a tracker, along each axis: 0.5 mm, */
    POSE_PREDICT_NOISE_Q30 = 937024  /**< and about each: 0.05 degrees, radians in Q30; what is measured counts more */
};

/** What a predicted pose is. */
typedef enum {
    POSE_PREDICT_NONE = 0,  /**< no pose has come yet */
    POSE_PREDICT_TRACKED,   /**< the tracker's own measurement, smoothed: no lead was asked for */
    POSE_PREDICT_PREDICTED, /**< expected from the motion so far, or by the tracker */
    POSE_PREDICT_HELD       /**< nothing is known of the motion: the run is too short, or too old */
} pose_predict_t;

/**
 * Predict. O(poses of half a second), no state; 0.4 million instructions at 240 Hz.
 *
 * Lost poses only make the noise of the rest count more. As the newest pose gets older, the lead grows, with it what
 * is said above. After POSE_HISTORY_SILENCE_US or a jump the newest pose is held until the new run, some 25 ms long,
 * tells of its velocity.
 *
 * @param      time_us  A time before the newest pose's is taken as that.
 * @param[out] pose     Untouched when POSE_PREDICT_NONE is returned; otherwise its quaternion is of unit length.
 */
pose_predict_t pose_predict(const pose_history_t *history, int64_t time_us, pose_t *pose);

#endif
