// SPDX-License-Identifier: Apache-2.0
// Homography -> how large projector pixels are in the picture: the step k of a frame, the sides of each block.
#ifndef WARP_FIXED_FOOTPRINT_FROM_HOMOGRAPHY_H
#define WARP_FIXED_FOOTPRINT_FROM_HOMOGRAPHY_H

#include <stdint.h>

#include "warp_fixed/grid_from_homography.h"
#include "warp_fixed/homography_from_pose.h"

enum { FOOTPRINT_BAND = 16, FOOTPRINT_MAX_STEP_Q16 = 4096 << 16 };

/** Step k of the non-uniform pattern (eq 4, 5), Q16 picture pixels. */
typedef struct {
    int32_t in_q16;  /**< over neighbours that both land in the picture; 0 when there is no such pair */
    int32_t all_q16; /**< over the whole panel; FOOTPRINT_MAX_STEP_Q16 when part of it is behind the viewer */
    int32_t
        pixel[2]; /**< of the panel, column and row: the first of two neighbours that are in_q16 apart; 0, 0 if none */
} footprint_step_t;

/**
 * The worst sampling step: the largest distance in the picture of two pixel centres that are neighbours in a row or a
 * column of the panel, exact to 1/65536 px. A centre on the picture's edge lands in it, though it err by 2^-46 of what
 * the panel reaches. Saturates at FOOTPRINT_MAX_STEP_Q16. O(panel's width + height): one pair of each row and column
 * can be the largest.
 */
footprint_step_t footprint_step(const homography_t *homography);

/** Moment-matched sides of a pixel's footprint, Q16 picture pixels: |(dx/du, dx/dv)| and |(dy/du, dy/dv)|. */
typedef struct {
    uint32_t width_q16, height_q16;
} footprint_sides_t;

/** Sides of the blocks of one row of blocks; block b covers pixels [b << size_log2, (b + 1) << size_log2). */
typedef struct {
    int32_t begin, end; /**< lit blocks */
    footprint_sides_t block[IMAGE_MAX_WIDTH];
} footprint_blocks_t;

/**
 * How large the blocks may be that share their sides, in the band of FOOTPRINT_BAND rows from first_row on: the largest
 * size of at most FOOTPRINT_BAND px over which depth changes by no more than 1/16 anywhere in the band. Sides change by
 * up to three times as much; measured, this costs at most 0.003 dB on panels of 16 to 480 px, and almost all frames
 * have blocks of 16 px.
 *
 * @return log2 of the size, 0 to 4.
 */
int footprint_block_log2(const grid_t *grid, int32_t first_row);

/**
 * Sides of every lit block of the rows [first_row, first_row + (1 << size_log2)).
 *
 * They are taken once per block, in the middle one of its lit rows (the next one below, should that be empty), at the
 * lit pixel nearest to the block's middle.
 *
 * @param first_row  A multiple of the size.
 */
void footprint_blocks(footprint_blocks_t *out, const grid_t *grid, int32_t first_row, int size_log2);

#endif
