// SPDX-License-Identifier: Apache-2.0
// Where the eye sees content that was drawn, or corrected, for another pose: how far from where it should be.
#ifndef SIM_STUDY_LATENCY_ERROR_H
#define SIM_STUDY_LATENCY_ERROR_H

#include <stdint.h>

#include "sim/study/study_scene.h"

/** The three poses of one frame. */
typedef struct {
    pose_t drawn;     /**< what the engine drew the picture for */
    pose_t corrected; /**< what the wall was corrected for */
    pose_t eye;       /**< where the viewer is and looks when it is shown */
    double content_m; /**< the drawn world is a plane this far behind the wall; may be infinite */
} latency_poses_t;

/** Sums over points and frames, all 0 at the beginning. */
typedef struct {
    double px, worst_px; /**< in the eye's picture */
    double deg, worst_deg;
    int64_t points;
} latency_error_t;

enum { LATENCY_POINTS_X = 16, LATENCY_POINTS_Y = 9 };

/**
 * Add one frame, over a raster of points of the eye's view that see content on the wall.
 *
 * The eye sees a wall point; that shows the picture point that the corrected pose gives it; there the drawn pose put a
 * world point; and that should be seen in another direction.
 */
void latency_error_add(latency_error_t *error, const study_scene_t *scene, const latency_poses_t *poses);

/** @return Mean over all that was added, px or degrees; NaN when no point saw content. */
double latency_mean_px(const latency_error_t *error);
double latency_mean_deg(const latency_error_t *error);

#endif
