// SPDX-License-Identifier: Apache-2.0
// Points of one block of the grid: forward differences in four lanes.
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/neon.h"

/* Points k to k + 3 of one axis, and by how much the next four are larger. */
typedef struct {
    uint32x4_t point, step;
} four_points_t;

/* point(k) = p + k d + k (k - 1) / 2 dd, so point(k + 4) = point(k) + 4 d + (4 k + 6) dd: modulo 2^32 all the way. */
static inline four_points_t first_points(int32_t p, int32_t d, int32_t dd)
{
    static const uint32_t k[4] = {0, 1, 2, 3}, pairs[4] = {0, 0, 1, 3}, by_dd[4] = {6, 10, 14, 18};
    const uint32x4_t along_d = vmlaq_n_u32(vdupq_n_u32((uint32_t)p), vld1q_u32(k), (uint32_t)d);
    return (four_points_t){vmlaq_n_u32(along_d, vld1q_u32(pairs), (uint32_t)dd),
                           vmlaq_n_u32(vdupq_n_u32(4 * (uint32_t)d), vld1q_u32(by_dd), (uint32_t)dd)};
}

void grid_points_neon(int32_t *restrict x_q18, int32_t *restrict y_q18, const grid_quadratic_t *block, int32_t count)
{
    const uint32_t ddx = (uint32_t)block->ddx, ddy = (uint32_t)block->ddy;
    const uint32x4_t more_x = vdupq_n_u32(16 * ddx), more_y = vdupq_n_u32(16 * ddy);
    four_points_t x = first_points(block->x, block->dx, block->ddx);
    four_points_t y = first_points(block->y, block->dy, block->ddy);
    int32_t k = 0;
    for (; k + 4 <= count; k += 4) {
        vst1q_s32(x_q18 + k, vreinterpretq_s32_u32(x.point));
        vst1q_s32(y_q18 + k, vreinterpretq_s32_u32(y.point));
        x.point = vaddq_u32(x.point, x.step);
        y.point = vaddq_u32(y.point, y.step);
        x.step = vaddq_u32(x.step, more_x);
        y.step = vaddq_u32(y.step, more_y);
    }
    const grid_quadratic_t rest = {
        (int32_t)vgetq_lane_u32(x.point, 0), (int32_t)((uint32_t)block->dx + (uint32_t)k * ddx), block->ddx,
        (int32_t)vgetq_lane_u32(y.point, 0), (int32_t)((uint32_t)block->dy + (uint32_t)k * ddy), block->ddy,
    };
    grid_points_scalar(x_q18 + k, y_q18 + k, &rest, count - k);
}
