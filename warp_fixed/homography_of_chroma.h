// SPDX-License-Identifier: Apache-2.0
// The homography of a frame's pixels -> that of its chroma pixels.
#ifndef WARP_FIXED_HOMOGRAPHY_OF_CHROMA_H
#define WARP_FIXED_HOMOGRAPHY_OF_CHROMA_H

#include "warp_fixed/homography_from_pose.h"

/** log2 of the width and height of a chroma pixel, in pixels: 0 or 1 each. */
typedef struct {
    int x, y;
} chroma_log2_t;

/**
 * S H S', where S makes chroma pixels of the picture's pixels, and S' pixels of the panel's chroma pixels: both are
 * scales by powers of two about the corner of the raster, so it is exact. Chroma is where picture.h has it.
 */
void homography_of_chroma(homography_t *chroma, const homography_t *homography, chroma_log2_t panel,
                          chroma_log2_t picture);

#endif
