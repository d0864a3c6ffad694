// SPDX-License-Identifier: Apache-2.0
// Points of a row of the grid: forward differences, block by block.
#include "warp_fixed/kernels_scalar.h"

static void block_points(int32_t *restrict x_q18, int32_t *restrict y_q18, const grid_quadratic_t *block, int32_t count)
{
    uint32_t x = (uint32_t)block->x, dx = (uint32_t)block->dx;
    uint32_t y = (uint32_t)block->y, dy = (uint32_t)block->dy;
    for (int32_t k = 0; k < count; k++) {
        x_q18[k] = (int32_t)x;
        y_q18[k] = (int32_t)y;
        x += dx;
        y += dy;
        dx += (uint32_t)block->ddx;
        dy += (uint32_t)block->ddy;
    }
}

void grid_points_scalar(int32_t *restrict x_q18, int32_t *restrict y_q18, const grid_row_cursor_t *row, int32_t begin,
                        int32_t end)
{
    for (int32_t at = begin; at < end;) {
        const int32_t block_end = grid_row_block_end(row->row, at);
        const grid_quadratic_t block = grid_row_block(row, at, block_end);
        block_points(x_q18 + (at - begin), y_q18 + (at - begin), &block, block_end - at);
        at = block_end;
    }
}
