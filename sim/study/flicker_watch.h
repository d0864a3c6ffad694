// SPDX-License-Identifier: Apache-2.0
// One method watched by a walking viewer, frame by frame.
#ifndef SIM_STUDY_FLICKER_WATCH_H
#define SIM_STUDY_FLICKER_WATCH_H

#include <stdbool.h>

#include "sim/study/flicker_measure.h"
#include "sim/study/study_walk.h"
#include "sim/study/study_scene.h"

/** Frames per second of the projector, and what is left out around the edge of what is covered, picture pixels. */
extern const double flicker_watch_hz, flicker_watch_margin_px;

typedef struct {
    const study_scene_t *scene;
    const image_t *picture; /**< the same in every frame */
    const warp_method_t *method;
    study_walk_t walk; /**< its start is reached in the middle of the frames */
    int32_t frames;    /**< 1 or more */
    int32_t looks;     /**< of the eye along each side of a picture pixel, 1 to VIEWER_MAX_SAMPLES */
} flicker_watch_t;

/**
 * Warp and look at each frame, and sum up. The warp goes on from frame to frame, as on a board.
 *
 * @param[out] sums  Written only when true is returned.
 * @return false when memory is out.
 */
bool flicker_watch(flicker_sums_t *sums, const flicker_watch_t *watch);

#endif
