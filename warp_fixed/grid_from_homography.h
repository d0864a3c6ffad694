// SPDX-License-Identifier: Apache-2.0
// Homography -> where every lit projector pixel falls in the picture, in Q18 integers.
//
// A row of the panel is first clipped to its lit pixels. Within it, each aligned block of 2^n pixels has one exact
// point, in its middle; the others follow from it by a quadratic, evaluated with integer forward differences. n is
// chosen per row from a proved bound, so that a point errs by less than 1/256 px (see the proof in grid_row.c).
// A point depends on its pixel and the homography only, never on the order in which pixels are visited.
#ifndef WARP_FIXED_GRID_FROM_HOMOGRAPHY_H
#define WARP_FIXED_GRID_FROM_HOMOGRAPHY_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/homography_from_pose.h"
#include "warp_fixed/image.h"

enum { GRID_MAX_SPAN = 64 };

/** u * U + v * V + c, where (U, V) = (2 i + 1, 2 j + 1) is a pixel's centre in half pixels. |value| < 2^60. */
typedef struct {
    int64_t u, v, c;
} grid_linear_t;

/** Lit pixels [begin, end) of one row, log2 of the length of its blocks, and how large numbers are. */
typedef struct {
    int16_t begin, end;
    uint8_t span_log2;
    bool fits_32; /**< points and their derivatives fit into 32 bits */
} grid_row_t;

typedef struct {
    int32_t panel_width, panel_height;
    int32_t picture_width, picture_height;
    grid_linear_t x, y, w; /**< picture point = (x, y) / w * 2^(x, y)_exponent */
    int32_t x_exponent, y_exponent;
    grid_row_t row[IMAGE_MAX_HEIGHT];
} grid_t;

/**
 * Plan a frame's grid: linear forms, lit pixels and block length of every row.
 *
 * A pixel is lit when its depth is positive and its square, widened by an eighth of a pixel on each side, can reach
 * the picture. O(rows).
 *
 * @param[out] grid        All of it is written but the rows beyond the panel.
 * @param      homography  Its panel is at most IMAGE_MAX_WIDTH x IMAGE_MAX_HEIGHT.
 */
void grid_from_homography(grid_t *grid, const homography_t *homography);

/** @return w at the centre of a pixel, on the scale of grid->w. */
int64_t grid_depth(const grid_t *grid, int32_t i, int32_t j);

#endif
