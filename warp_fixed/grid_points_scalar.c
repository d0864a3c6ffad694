// SPDX-License-Identifier: Apache-2.0
// Points of one block of the grid: forward differences.
#include "warp_fixed/kernels_scalar.h"

void grid_points_scalar(int32_t *restrict x_q18, int32_t *restrict y_q18, const grid_quadratic_t *block, int32_t count)
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
