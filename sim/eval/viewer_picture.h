// SPDX-License-Identifier: Apache-2.0
// What the viewer's eye sees of the lit walls.
#ifndef SIM_EVAL_VIEWER_PICTURE_H
#define SIM_EVAL_VIEWER_PICTURE_H

#include <stdint.h>

#include "sim/eval/double_homography.h"
#include "warp_fixed/image.h"

enum {
    VIEWER_MAX_WALLS = 32,
    VIEWER_MAX_SAMPLES = 16,
    VIEWER_BACKGROUND = 24 /**< gray level where no wall is */
};

/** One wall. */
typedef struct {
    double_homography_t homography; /**< from its panel to the viewer's picture */
    image_t shown; /**< stretched over the panel: what the projector shows, or for the view without compensation the
                        plain picture, of any size */
} viewer_wall_t;

/**
 * Draw the viewer's view.
 *
 * Each pixel is the mean, rounded half up, of samples x samples looks; each look takes the nearest pixel of what the
 * nearest wall in its way shows. About 5 ns per look; no allocation.
 *
 * @param out         Any size: the field of view is that of the viewer's camera. Must not overlap what is shown.
 * @param walls       Their pictures have the format of out.
 * @param wall_count  0 to VIEWER_MAX_WALLS.
 * @param samples     1 to VIEWER_MAX_SAMPLES.
 */
void viewer_picture(const image_t *out, const viewer_wall_t *walls, int32_t wall_count, int32_t samples);

#endif
