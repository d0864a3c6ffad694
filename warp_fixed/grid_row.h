// SPDX-License-Identifier: Apache-2.0
// One row of the grid: what its pixels share, and by it their points.
//
// A grid_row_cursor_t is made once per row; then warp_kernels_t's grid_points() makes the points of any of the row's
// blocks, at any time and in any order.
#ifndef WARP_FIXED_GRID_ROW_H
#define WARP_FIXED_GRID_ROW_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/grid_from_homography.h"
#include "warp_fixed/grid_quotient.h"

/**
 * One coordinate along a row, U = 2 i + 1 being the centre of a pixel in half pixels.
 *
 * With R and z of w's reciprocal (grid_quotient.h), a point is (by_u U + at_zero) R / 2^(point_shift - z) in Q18.
 */
typedef struct {
    int64_t by_u, at_zero;
    slope_t slope; /**< the same at every pixel of the row */
    int32_t point_shift;
} grid_row_axis_t;

/** What the pixels of one row share. */
typedef struct {
    grid_row_t row;
    grid_row_axis_t x, y;
    int64_t w_by_u, w_at_zero;
    int64_t turn; /**< w's relative change per pixel is turn R / 2^(turn_shift - z) in Q32; 0 for blocks of one pixel */
    int32_t turn_shift;
    int32_t lift; /**< where row.fits_32: twice a point or turn is its numerator * (R << (z - lift)) >> 64 */
} grid_row_cursor_t;

/** Points of one block: x(k) = x + k dx + k (k - 1) / 2 ddx, in Q18 picture pixels, modulo 2^32; y likewise. */
typedef struct {
    int32_t x, dx, ddx;
    int32_t y, dy, ddy;
} grid_quadratic_t;

/** @return What the pixels of row j share. Of no use where none is lit. */
grid_row_cursor_t grid_row_cursor(const grid_t *grid, int32_t j);

/** Complete the grid's entry of row j, whose lit pixels are known, and some: length of blocks, size of numbers. */
void grid_row_plan(grid_t *grid, int32_t j);

/** @return One past the last lit pixel of the block that holds lit pixel i. */
static inline int32_t grid_row_block_end(grid_row_t row, int32_t i)
{
    const int32_t aligned = ((i >> row.span_log2) + 1) << row.span_log2;
    return aligned < row.end ? aligned : row.end;
}

/** @return One past the last lit pixel from lit pixel i up to the next multiple of GRID_MAX_SPAN: whole blocks. */
static inline int32_t grid_row_tile_end(grid_row_t row, int32_t i)
{
    const int32_t aligned = (i | (GRID_MAX_SPAN - 1)) + 1;
    return aligned < row.end ? aligned : row.end;
}

/**
 * The quadratic of one block.
 *
 * @param begin  First pixel: a multiple of the row's block length, or the row's begin.
 * @param end    grid_row_block_end() of it.
 */
grid_quadratic_t grid_row_block(const grid_row_cursor_t *row, int32_t begin, int32_t end);

/** The point of one lit pixel, as every frame uses it. @return false, and nothing written, when it is not lit. */
bool grid_point(const grid_t *grid, int32_t i, int32_t j, int32_t *x_q18, int32_t *y_q18);

#endif
