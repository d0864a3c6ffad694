// SPDX-License-Identifier: Apache-2.0
// Points of a row of the grid: a block's middle in 64-bit integers, the rest in lanes: both coordinates, four points.
//
// What grid_row.c says of a block, line by line, where all of it fits into 32 bits; see there for names and why. A
// point and a step to the next one are between those at the row's ends, which fit; what they are summed up from may
// wrap.
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/neon.h"

/* What a block's quadratic is made of, at the block's middle; twice as much of each. */
typedef struct {
    int64_t x, y, x_slope, y_slope, turn;
} middle_t;

/* Quadratics of two blocks: x and y of the one, x and y of the other. point(k) = first + k step - k (k - 1) / 2 bend.
 */
typedef struct {
    uint32x4_t first, step, bend;
} quadratics_t;

/* Points k to k + 3 of one coordinate, by how much the next four are larger, and by how much that shrinks. */
typedef struct {
    uint32x4_t point, step, less;
} four_points_t;

/* @param u_half  The block's begin + end. */
static inline middle_t block_middle(const grid_row_cursor_t *row, int32_t u_half)
{
    const reciprocal_t over = reciprocal_of(row->w_by_u * u_half + row->w_at_zero);
    const int64_t lifted = over.reciprocal << (over.zeros - row->lift);
    return (middle_t){
        .x = upper_64(row->x.by_u * u_half + row->x.at_zero, lifted),
        .y = upper_64(row->y.by_u * u_half + row->y.at_zero, lifted),
        .x_slope = slope_q25_in_64_bits(row->x.slope, over),
        .y_slope = slope_q25_in_64_bits(row->y.slope, over),
        .turn = upper_64(row->turn, lifted),
    };
}

static inline int64x2_t two_numbers(int64_t a, int64_t b)
{
    return vcombine_s64(vcreate_s64((uint64_t)a), vcreate_s64((uint64_t)b));
}

/* A block's first point, from its middle. */
static inline int32x2_t first_from_middle(int32x2_t d, int32x2_t bend_8_n, int32x2_t minus_n)
{
    const int64x2_t half_way = vrshrq_n_s64(vmull_s32(d, minus_n), 1); /* -floor(d n / 2) = round(-d n / 2) */
    return vrshrn_n_s64(vmlsl_s32(half_way, bend_8_n, minus_n), 6);
}

/* @param b  NULL where only one block is wanted. @param minus_n  1 - count of each block's points, for x and for y. */
NEON_INLINE quadratics_t block_quadratics(const middle_t *a, const middle_t *b, int32x4_t minus_n, int span_log2)
{
    const middle_t *next = b == NULL ? a : b;
    const int32x4_t middle = rounded_halves(two_numbers(a->x, a->y), two_numbers(next->x, next->y));
    const int32x4_t slope =
        rounded_halves(two_numbers(a->x_slope, a->y_slope), two_numbers(next->x_slope, next->y_slope));
    const int32x4_t turn = rounded_halves(vdupq_n_s64(a->turn), vdupq_n_s64(next->turn));
    const int32x4_t turn_m = vshlq_s32(turn, vdupq_n_s32(span_log2 - 1));
    const int32x4_t square = upper_product(turn_m, turn_m);

    const int32x4_t slope_3_4 = vhaddq_s32(slope, vshrq_n_s32(slope, 1)); /* floor((s + floor(s / 2)) / 2) */
    const int32x4_t d = add_upper_product(slope, slope_3_4, square);
    const int32x4_t s_r = upper_product(slope, turn);
    const int32x4_t bend = vrshrq_n_s32(add_upper_product(s_r, s_r, square), 5);
    const int32x4_t bend_n = vmulq_s32(bend, minus_n), bend_8_n = vshlq_n_s32(bend_n, 3);
    const int32x2_t first_a = first_from_middle(vget_low_s32(d), vget_low_s32(bend_8_n), vget_low_s32(minus_n));
    const int32x2_t first_b =
        b == NULL ? first_a : first_from_middle(vget_high_s32(d), vget_high_s32(bend_8_n), vget_high_s32(minus_n));
    const int32x4_t step = vrshrq_n_s32(vsubq_s32(d, vshlq_n_s32(vaddq_s32(bend, bend_n), 5)), 6);
    return (quadratics_t){vreinterpretq_u32_s32(vaddq_s32(middle, vcombine_s32(first_a, first_b))),
                          vreinterpretq_u32_s32(step), vreinterpretq_u32_s32(bend)};
}

/* @param lane  0 to 3. */
NEON_INLINE uint32_t lane_of(uint32x4_t v, int lane)
{
    switch (lane) {
    case 0:
        return vgetq_lane_u32(v, 0);
    case 1:
        return vgetq_lane_u32(v, 1);
    case 2:
        return vgetq_lane_u32(v, 2);
    default:
        return vgetq_lane_u32(v, 3);
    }
}

/* point(k + 4) = point(k) + 4 step - (4 k + 6) bend: modulo 2^32 all the way. */
NEON_INLINE four_points_t first_points(const quadratics_t *two, int lane)
{
    static const uint32_t by_step[4] = {0, 1, 2, 3}, by_bend[2][4] = {{0, 0, 1, 3}, {6, 10, 14, 18}};
    const uint32x4_t first = vdupq_n_u32(lane_of(two->first, lane)), bend = two->bend;
    const uint32x4_t step_4 = vdupq_n_u32(lane_of(vshlq_n_u32(two->step, 2), lane));
    const uint32x4_t along_step = vmlaq_n_u32(first, vld1q_u32(by_step), lane_of(two->step, lane));
    return (four_points_t){vmlsq_n_u32(along_step, vld1q_u32(by_bend[0]), lane_of(bend, lane)),
                           vmlsq_n_u32(step_4, vld1q_u32(by_bend[1]), lane_of(bend, lane)),
                           vdupq_n_u32(lane_of(vshlq_n_u32(bend, 4), lane))};
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

/* @param block  0 or 1: the one that is wanted. */
NEON_INLINE void block_points(int32_t *x_q18, int32_t *y_q18, const quadratics_t *two, int block, int32_t count)
{
    four_points_t x = first_points(two, 2 * block), y = first_points(two, 2 * block + 1);
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

/* Two blocks of the same length. */
NEON_INLINE void two_blocks(int32_t *x_q18, int32_t *y_q18, const middle_t *a, const middle_t *b, int span_log2)
{
    const int32_t length = 1 << span_log2;
    const quadratics_t two = block_quadratics(a, b, vdupq_n_s32(1 - length), span_log2);
    block_points(x_q18, y_q18, &two, 0, length);
    block_points(x_q18 + length, y_q18 + length, &two, 1, length);
}

/*
 * GRID_MAX_SPAN points, whole blocks: without branches, so that the chains of products of all blocks overlap. Of block
 * b, begin + end is 2 begin + (2 b + 1) length.
 *
 * @return Have they been written? Not where blocks are short, or do not begin with the first point.
 */
static inline bool whole_blocks(int32_t *x_q18, int32_t *y_q18, const grid_row_cursor_t *row, int32_t begin)
{
    const int span_log2 = row->row.span_log2;
    if ((begin & ((1 << span_log2) - 1)) != 0)
        return false;
    if (span_log2 == 4) {
        const middle_t a = block_middle(row, 2 * begin + 16), b = block_middle(row, 2 * begin + 48);
        const middle_t c = block_middle(row, 2 * begin + 80), d = block_middle(row, 2 * begin + 112);
        two_blocks(x_q18, y_q18, &a, &b, 4);
        two_blocks(x_q18 + 32, y_q18 + 32, &c, &d, 4);
        return true;
    }
    if (span_log2 == 5) {
        const middle_t a = block_middle(row, 2 * begin + 32), b = block_middle(row, 2 * begin + 96);
        two_blocks(x_q18, y_q18, &a, &b, 5);
        return true;
    }
    if (span_log2 == 6) {
        const middle_t middle = block_middle(row, 2 * begin + 64);
        const quadratics_t twice = block_quadratics(&middle, NULL, vdupq_n_s32(-63), 6);
        block_points(x_q18, y_q18, &twice, 0, 64);
        return true;
    }
    return false;
}

void grid_points_neon(int32_t *restrict x_q18, int32_t *restrict y_q18, const grid_row_cursor_t *row, int32_t begin,
                      int32_t end)
{
    if (!row->row.fits_32) {
        grid_points_scalar(x_q18, y_q18, row, begin, end);
        return;
    }
    if (end - begin == GRID_MAX_SPAN && whole_blocks(x_q18, y_q18, row, begin))
        return;
    for (int32_t at = begin; at < end;) {
        const int32_t whole_end = grid_row_block_end(row->row, at), block_end = whole_end < end ? whole_end : end;
        const int32_t count = block_end - at;
        const middle_t middle = block_middle(row, at + block_end);
        const quadratics_t twice = block_quadratics(&middle, NULL, vdupq_n_s32(1 - count), row->row.span_log2);
        block_points(x_q18, y_q18, &twice, 0, count);
        x_q18 += count;
        y_q18 += count;
        at = block_end;
    }
}
