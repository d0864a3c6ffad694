// SPDX-License-Identifier: Apache-2.0
// The step k of a frame -> that of its chroma, along each axis.
#ifndef WARP_FIXED_CHROMA_STEP_H
#define WARP_FIXED_CHROMA_STEP_H

#include <stdint.h>

#include "warp_fixed/homography_of_chroma.h"

/** Q16, in chroma pixels of the picture. */
typedef struct {
    int32_t x_q16, y_q16;
} chroma_step_t;

/**
 * k times how much longer, or shorter, a footprint's side |(dx/du, dx/dv)| or |(dy/du, dy/dv)| (footprint_sides_t) is
 * for chroma pixels than for pixels, each in its own: their shape may differ between panel and picture, and also from
 * a square, which a turned picture shows. Both are k when a chroma pixel is two by two pixels of both, or two by one
 * of both and the picture is not turned. At 90 degrees two by one gives k / 2 and 2 k; from two by one to two by two, k
 * and 2 k.
 *
 * @param homography  Of the frame's pixels.
 * @param k_q16       Its step k.
 * @param pixel       Of the panel: where k is reached.
 */
chroma_step_t chroma_step(const homography_t *homography, int32_t k_q16, const int32_t pixel[2], chroma_log2_t panel,
                          chroma_log2_t picture);

#endif
