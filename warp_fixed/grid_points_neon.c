// SPDX-License-Identifier: Apache-2.0
// Points of a row of the grid: a block's middle in 64-bit integers, the rest in lanes: both coordinates, four points.
//
// What grid_row.c says of a block, line by line, where all of it fits into 32 bits; see there for names and why. A
// point and a step to the next one are between those at the row's ends, which fit; what they are summed up from may
// wrap.
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/neon.h"

/* A block's quadratic, x and y in two lanes: point(k) = first + k step - k (k - 1) / 2 bend. */
typedef struct {
    int32x2_t first, step, bend;
} quadratics_t;

/* Points k to k + 3 of one coordinate, by how much the next four are larger, and by how much that shrinks. */
typedef struct {
    uint32x4_t point, step, less;
} four_points_t;

static inline int32x2_t half_of(int64_t x, int64_t y)
{
    return vrshrn_n_s64(vcombine_s64(vcreate_s64((uint64_t)x), vcreate_s64((uint64_t)y)), 1);
}

static inline quadratics_t block_quadratics(const grid_row_cursor_t *row, int32_t begin, int32_t end, int span_log2)
{
    const int32_t u_half = begin + end; /* the block's middle */
    const reciprocal_t over = reciprocal_of(row->w_by_u * u_half + row->w_at_zero);
    const int64_t lifted = over.reciprocal << (over.zeros - row->lift);
    const int64_t x = row->x.by_u * u_half + row->x.at_zero, y = row->y.by_u * u_half + row->y.at_zero;
    const int32x2_t middle = half_of(upper_64(x, lifted), upper_64(y, lifted));
    const int32x2_t slope = half_of(slope_q25_in_64_bits(row->x.slope, over), slope_q25_in_64_bits(row->y.slope, over));
    const int32x2_t turn = vrshrn_n_s64(vdupq_n_s64(upper_64(row->turn, lifted)), 1);
    const int32x2_t turn_m = vshl_s32(turn, vdup_n_s32(span_log2 - 1));
    const int32x2_t square = vshrn_n_s64(vmull_s32(turn_m, turn_m), 32);

    const int32x2_t slope_3_4 = vsra_n_s32(slope, vneg_s32(slope), 2); /* floor(3 s / 4) = s + floor(-s / 4) */
    const int32x2_t d = vadd_s32(slope, vshrn_n_s64(vmull_s32(slope_3_4, square), 32));
    const int32x2_t s_r = vshrn_n_s64(vmull_s32(slope, turn), 32);
    const int32x2_t bend = vrshr_n_s32(vadd_s32(s_r, vshrn_n_s64(vmull_s32(s_r, square), 32)), 5);
    const int32x2_t minus_n = vdup_n_s32(begin - end + 1), bend_n = vmul_s32(bend, minus_n);
    const int64x2_t half_way = vrshrq_n_s64(vmull_s32(d, minus_n), 1); /* -floor(d n / 2) = round(-d n / 2) */
    const int64x2_t first = vmlsl_s32(half_way, vshl_n_s32(bend_n, 3), minus_n);
    const int32x2_t step = vsub_s32(d, vshl_n_s32(vadd_s32(bend, bend_n), 5));
    return (quadratics_t){vadd_s32(middle, vrshrn_n_s64(first, 6)), vrshr_n_s32(step, 6), bend};
}

/* point(k + 4) = point(k) + 4 step - (4 k + 6) bend: modulo 2^32 all the way. */
static inline four_points_t first_points(uint32x4_t first, uint32_t step, uint32x4_t step_4, uint32_t bend,
                                         uint32x4_t bend_16)
{
    static const uint32_t by_step[4] = {0, 1, 2, 3}, by_bend[2][4] = {{0, 0, 1, 3}, {6, 10, 14, 18}};
    const uint32x4_t along_step = vmlaq_n_u32(first, vld1q_u32(by_step), step);
    return (four_points_t){vmlsq_n_u32(along_step, vld1q_u32(by_bend[0]), bend),
                           vmlsq_n_u32(step_4, vld1q_u32(by_bend[1]), bend), bend_16};
}

static inline void store_four(int32_t *out, four_points_t *four)
{
    vst1q_s32(out, vreinterpretq_s32_u32(four->point));
    four->point = vaddq_u32(four->point, four->step);
    four->step = vsubq_u32(four->step, four->less);
}

/* All points come before the first store: so stores of neighbours become pairs. */
static inline void store_sixteen(int32_t *out, four_points_t *four)
{
    const uint32x4_t less = four->less;
    const uint32x4_t p0 = four->point, s0 = four->step;
    const uint32x4_t p1 = vaddq_u32(p0, s0), s1 = vsubq_u32(s0, less);
    const uint32x4_t p2 = vaddq_u32(p1, s1), s2 = vsubq_u32(s1, less);
    const uint32x4_t p3 = vaddq_u32(p2, s2), s3 = vsubq_u32(s2, less);
    vst1q_s32(out, vreinterpretq_s32_u32(p0));
    vst1q_s32(out + 4, vreinterpretq_s32_u32(p1));
    vst1q_s32(out + 8, vreinterpretq_s32_u32(p2));
    vst1q_s32(out + 12, vreinterpretq_s32_u32(p3));
    four->point = vaddq_u32(p3, s3);
    four->step = vsubq_u32(s3, less);
}

/* The first count % 4. */
static inline void store_rest(int32_t *out, uint32x4_t point, int32_t count)
{
    if (count & 2) {
        vst1_s32(out, vreinterpret_s32_u32(vget_low_u32(point)));
        point = vextq_u32(point, point, 2);
        out += 2;
    }
    if (count & 1)
        vst1q_lane_s32(out, vreinterpretq_s32_u32(point), 0);
}

static inline void block_points(int32_t *x_q18, int32_t *y_q18, quadratics_t block, int32_t count)
{
    const uint32x2_t first = vreinterpret_u32_s32(block.first), step = vreinterpret_u32_s32(block.step),
                     bend = vreinterpret_u32_s32(block.bend);
    const uint32x2_t step_4 = vshl_n_u32(step, 2), bend_16 = vshl_n_u32(bend, 4);
    four_points_t x = first_points(vdupq_lane_u32(first, 0), vget_lane_u32(step, 0), vdupq_lane_u32(step_4, 0),
                                   vget_lane_u32(bend, 0), vdupq_lane_u32(bend_16, 0));
    four_points_t y = first_points(vdupq_lane_u32(first, 1), vget_lane_u32(step, 1), vdupq_lane_u32(step_4, 1),
                                   vget_lane_u32(bend, 1), vdupq_lane_u32(bend_16, 1));
    for (uint32_t n = (uint32_t)count >> 4; n > 0; n--) {
        store_sixteen(x_q18, &x);
        store_sixteen(y_q18, &y);
        x_q18 += 16;
        y_q18 += 16;
    }
    if ((count & 15) == 0)
        return;
    for (int32_t n = count >> 2 & 3; n > 0; n--) {
        store_four(x_q18, &x);
        store_four(y_q18, &y);
        x_q18 += 4;
        y_q18 += 4;
    }
    store_rest(x_q18, x.point, count);
    store_rest(y_q18, y.point, count);
}

void grid_points_neon(int32_t *restrict x_q18, int32_t *restrict y_q18, const grid_row_cursor_t *row, int32_t begin,
                      int32_t end)
{
    if (!row->row.fits_32) {
        grid_points_scalar(x_q18, y_q18, row, begin, end);
        return;
    }
    const int span_log2 = row->row.span_log2;
    int32_t block_end = grid_row_block_end(row->row, begin);
    /* One block: most often so in gentle perspective, and it needs no registers for what the row has left. */
    if (begin < end && block_end == end) {
        block_points(x_q18, y_q18, block_quadratics(row, begin, end, span_log2), end - begin);
        return;
    }
    for (int32_t at = begin; at < end;) {
        const int32_t count = block_end - at;
        block_points(x_q18, y_q18, block_quadratics(row, at, block_end, span_log2), count);
        x_q18 += count;
        y_q18 += count;
        at = block_end;
        block_end = block_end + (1 << span_log2) < end ? block_end + (1 << span_log2) : end;
    }
}
