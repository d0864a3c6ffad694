// SPDX-License-Identifier: Apache-2.0
// What the eye sees of a wall that was corrected for another pose, against the picture.
#ifndef SIM_STUDY_LATENCY_VIEW_H
#define SIM_STUDY_LATENCY_VIEW_H

#include <stdbool.h>

#include "sim/study/study_scene.h"

/** Squared differences in gray levels, and over how many pixels. */
typedef struct {
    double square;
    int64_t pixels;
} latency_square_t;

/**
 * Warp the picture for one pose, look at the wall from another, and add up where wall and picture are seen from both.
 *
 * @return false when memory is out.
 */
bool latency_view_add(latency_square_t *sum, const study_scene_t *scene, const image_t *picture,
                      const pose_t *corrected, const pose_t *eye);

#endif
