// SPDX-License-Identifier: Apache-2.0
// Homography -> how large projector pixels are in the picture: the step k of a frame, the sides of each block.
#ifndef WARP_FIXED_FOOTPRINT_FROM_HOMOGRAPHY_H
#define WARP_FIXED_FOOTPRINT_FROM_HOMOGRAPHY_H

#include <stdint.h>

#include "warp_fixed/grid_from_homography.h"
#include "warp_fixed/homography_from_pose.h"

enum { FOOTPRINT_BLOCK = 16, FOOTPRINT_MAX_STEP_Q16 = 4096 << 16 };

/** Step k of the non-uniform pattern (eq 4, 5), Q16 picture pixels. */
typedef struct {
    int32_t in_q16;  /**< over neighbours that both land in the picture; 0 when there are none */
    int32_t all_q16; /**< over the whole panel; FOOTPRINT_MAX_STEP_Q16 when part of it is behind the viewer */
} footprint_step_t;

/**
 * The worst sampling step in closed form: the larger column norm of the Jacobian, over the vertices of the polygon of
 * pixel centres, for in_q16 clipped to the picture. Never below the exhaustive maximum of neighbour distances; above
 * it by the change of the Jacobian over half a pixel. Saturates at FOOTPRINT_MAX_STEP_Q16.
 */
footprint_step_t footprint_step(const homography_t *homography);

/** Moment-matched sides of a pixel's footprint, Q16 picture pixels: |(dx/du, dx/dv)| and |(dy/du, dy/dv)|. */
typedef struct {
    uint32_t width_q16, height_q16;
} footprint_sides_t;

/** Sides of the blocks of one band of FOOTPRINT_BLOCK rows; block b covers pixels [16 b, 16 b + 16). */
typedef struct {
    int32_t begin, end; /**< lit blocks of the band */
    footprint_sides_t block[IMAGE_MAX_WIDTH / FOOTPRINT_BLOCK];
} footprint_band_t;

/**
 * Sides of every lit block of the band of rows [16 band, 16 band + 16).
 *
 * They are taken once per block, in the band's middle lit row (the next one below, should that be empty), at the lit
 * pixel nearest to the block's middle (measured: costs less than 0.001 dB against sides of each pixel).
 */
void footprint_band(footprint_band_t *out, const grid_t *grid, int32_t band);

#endif
