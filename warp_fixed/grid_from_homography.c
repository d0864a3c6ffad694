// SPDX-License-Identifier: Apache-2.0
// Homography -> where every lit projector pixel falls in the picture, in Q18 integers.
//
// Why a block's quadratic is good enough. Along a row, x(t) = x_c + s t / (1 + r t), where t is the distance from the
// block's middle in pixels, s = dx/du there and r = (dw/du) / w there: exact, because x and w are linear in t.
// With |t| <= m, the half length of an unclipped block, and |r m| <= 1/16, the series s (t - r t^2 + r^2 t^3 - ...) is
// cut after t^2, but t^3 is replaced by its best line on [-m, m], (3/4) m^2 t, and t^4 by m^2 t^2 (Chebyshev). Left is
//     |s| |r|^2 m^3 / 4  of the cubic term,  |s| |r|^3 m^4 / 8 of the fourth, and less than 1/50 of the first beyond,
// together below 1.06 |s| r^2 m^3 / 4. The row's blocks are so short that |s| r^2 m^3 <= 2^-8 at both of its ends,
// and s and r are largest at one of them, since w has its least value there. So the cut costs at most 1.06 * 2^-10 px.
// Rounding the second difference to Q18 costs 2^-20 * 31.5^2 < 2^-10, the first 2^-19 * 63 < 2^-13, the exact point
// (33-bit reciprocal of w, x up to 2^13 px) 2^-18. The sum is below 0.0022 px; 1/256 is 0.0039.
#include "warp_fixed/grid_from_homography.h"

#include "warp_fixed/fixed.h"

enum { FORM_BITS = 60, MAX_SPAN_LOG2 = 6, MIN_X_PX = -2048, MAX_X_PX = 6144 };

/* 1 / w of a point with positive w: reciprocal * 2^-(63 + shift), 2^31 < reciprocal <= 2^32. */
typedef struct {
    int64_t reciprocal;
    int shift;
} reciprocal_t;

/* mantissa * 2^shift, |mantissa| < 2^31. */
typedef struct {
    int64_t mantissa;
    int shift;
} short_t;

static int64_t value_at(const grid_linear_t *form, int32_t u_half, int32_t v_half)
{
    return form->u * u_half + form->v * v_half + form->c;
}

/* @return The exponent by which the reals are the form's integers: real form = integers * 2^exponent. */
static int32_t linear_from_reals(grid_linear_t *form, const real_t by_pixel[3])
{
    const real_t reach = real_from_int(IMAGE_MAX_WIDTH, 0);
    const real_t bound =
        real_add(real_mul(real_add(real_abs(by_pixel[0]), real_abs(by_pixel[1])), reach), real_abs(by_pixel[2]));
    const int32_t bits = FORM_BITS - (bound.exponent + 63);
    const int64_t limit = (int64_t)1 << FORM_BITS;
    form->u = real_to_fixed(by_pixel[0], bits - 1, limit);
    form->v = real_to_fixed(by_pixel[1], bits - 1, limit);
    form->c = real_to_fixed(by_pixel[2], bits, limit);
    return -bits;
}

/* Half-plane of panel points whose pixel, widened by 1/8 on each side, reaches form >= 0. */
static void edge_from_reals(grid_linear_t *edge, const real_t form[3])
{
    const real_t reach = real_mul(real_add(real_abs(form[0]), real_abs(form[1])), real_from_int(5, -3));
    const real_t widened[3] = {form[0], form[1], real_add(form[2], reach)};
    (void)linear_from_reals(edge, widened);
}

/* The five half-planes of a lit pixel: left, right, top, bottom of the picture, and in front of the viewer. */
static void edges_from_homography(grid_linear_t edge[5], const homography_t *h)
{
    const int32_t size[2] = {h->picture_width, h->picture_height};
    for (int a = 0; a < 2; a++) {
        real_t beyond[3];
        for (int k = 0; k < 3; k++)
            beyond[k] = real_sub(real_mul(real_from_int(size[a], 0), h->row[2][k]), h->row[a][k]);
        edge_from_reals(&edge[2 * a], h->row[a]);
        edge_from_reals(&edge[2 * a + 1], beyond);
    }
    (void)linear_from_reals(&edge[4], h->row[2]);
    edge[4].c -= 1; /* depth 0 is behind */
}

static int64_t floor_div(int64_t a, int64_t b)
{
    const int64_t quotient = a / b;
    return quotient - (a % b != 0 && (a < 0) != (b < 0));
}

/* Narrow [*first, *last] (half pixels) to where edge >= 0 on the row v_half. */
static void clip_half_pixels(int64_t *first, int64_t *last, const grid_linear_t *edge, int32_t v_half)
{
    const int64_t at_zero = edge->v * v_half + edge->c;
    if (edge->u > 0) {
        const int64_t least = -floor_div(at_zero, edge->u);
        *first = least > *first ? least : *first;
    } else if (edge->u < 0) {
        const int64_t most = floor_div(at_zero, -edge->u);
        *last = most < *last ? most : *last;
    } else if (at_zero < 0) {
        *last = -1;
    }
}

static grid_row_t lit_row(const grid_t *grid, const grid_linear_t edge[5], int32_t j)
{
    int64_t first = 1, last = 2 * (int64_t)grid->panel_width - 1; /* half pixels; centres are odd */
    for (int e = 0; e < 5; e++)
        clip_half_pixels(&first, &last, &edge[e], 2 * j + 1);
    if (first > last)
        return (grid_row_t){0, 0, 0};
    const int64_t begin = first / 2, end = (last + 1) / 2;
    return begin < end ? (grid_row_t){(int16_t)begin, (int16_t)end, 0} : (grid_row_t){0, 0, 0};
}

static reciprocal_t reciprocal_of(int64_t w)
{
    const int shift = 32 - __builtin_clzll((uint64_t)w); /* w has 32 + shift bits */
    const uint64_t normal = shift >= 0 ? (uint64_t)w >> shift : (uint64_t)w << -shift;
    return (reciprocal_t){(int64_t)(((uint64_t)1 << 63) / normal), shift};
}

/* value * reciprocal * 2^exponent as fixed point, rounded to nearest, saturated to +-2^52. */
static int64_t quotient_fixed(int64_t value, reciprocal_t w, int32_t exponent, int fraction_bits)
{
    const int shift = 63 + w.shift - exponent - fraction_bits;
    const int128_t product = (int128_t)value * w.reciprocal;
    const int64_t limit = (int64_t)1 << 52;
    if (shift > 120)
        return 0;
    if (shift <= 0)
        return product > 0 ? limit : product < 0 ? -limit : 0;
    const int128_t rounded = (product + ((int128_t)1 << (shift - 1))) >> shift;
    return rounded > limit ? limit : rounded < -limit ? -limit : (int64_t)rounded;
}

static short_t short_from_wide(int128_t wide)
{
    const uint128_t size = (uint128_t)(wide < 0 ? -wide : wide);
    const uint64_t high = (uint64_t)(size >> 64), low = (uint64_t)size;
    const int bits = high != 0 ? 128 - __builtin_clzll(high) : low != 0 ? 64 - __builtin_clzll(low) : 0;
    const int shift = bits > 31 ? bits - 31 : 0;
    return (short_t){(int64_t)(wide >> shift), shift};
}

/* d(form / w)/d(half pixel) = (form.d * w - form * w.d) / w^2, constant but for w along a row; here per pixel, Q24. */
static int64_t slope_q24(int64_t form_d, int64_t form, int64_t w_d, int64_t w, reciprocal_t over, int32_t exponent)
{
    const short_t top = short_from_wide((int128_t)form_d * w - (int128_t)form * w_d);
    const int64_t once = floor_shift(top.mantissa * over.reciprocal, 32);
    /* slope = 2 * once * 2^(32 + top.shift + exponent) * reciprocal * 2^-(126 + 2 over.shift) */
    return quotient_fixed(once, over, 33 + top.shift + exponent - 63 - over.shift, 24);
}

/* What a block's quadratic is made of, at panel point (u, v), in half pixels. */
typedef struct {
    int64_t x_q18, y_q18;
    int64_t x_slope_q24, y_slope_q24; /* s: per pixel along the row */
    int64_t turn_q32;                 /* r: relative change of w per pixel */
} local_t;

static local_t local_at(const grid_t *grid, int32_t u_half, int32_t v_half)
{
    const int64_t w = value_at(&grid->w, u_half, v_half);
    const int64_t x = value_at(&grid->x, u_half, v_half), y = value_at(&grid->y, u_half, v_half);
    const reciprocal_t over = reciprocal_of(w > 0 ? w : 1);
    local_t local;
    local.x_q18 = quotient_fixed(x, over, grid->x_exponent, GRID_FRACTION_BITS);
    local.y_q18 = quotient_fixed(y, over, grid->y_exponent, GRID_FRACTION_BITS);
    local.x_slope_q24 = slope_q24(grid->x.u, x, grid->w.u, w, over, grid->x_exponent);
    local.y_slope_q24 = slope_q24(grid->y.u, y, grid->w.u, w, over, grid->y_exponent);
    local.turn_q32 = quotient_fixed(2 * grid->w.u, over, 0, 32);
    return local;
}

/* The longest block, log2, whose quadratic keeps the bound above at this point. */
static uint8_t longest_span(const local_t *local)
{
    const int64_t x_slope = local->x_slope_q24 < 0 ? -local->x_slope_q24 : local->x_slope_q24;
    const int64_t y_slope = local->y_slope_q24 < 0 ? -local->y_slope_q24 : local->y_slope_q24;
    const int64_t slope_q12 = ((x_slope > y_slope ? x_slope : y_slope) >> 12) + 1;
    const int64_t turn_q32 = local->turn_q32 < 0 ? -local->turn_q32 : local->turn_q32;
    if (turn_q32 > (int64_t)1 << 28 || slope_q12 > (int64_t)1 << 22) /* r > 1/16 or s > 1024 px per px */
        return 0;
    const int64_t turn_squared_q40 = (turn_q32 * turn_q32 >> 24) + 1;
    const int64_t product_q52 = slope_q12 * turn_squared_q40; /* s r^2; < 2^22 * 2^33 */
    for (uint8_t log2 = MAX_SPAN_LOG2; log2 > 0; log2--) {
        const int m_log2 = log2 - 1;
        if (product_q52 <= (int64_t)1 << (52 - 8 - 3 * m_log2) && turn_q32 <= (int64_t)1 << (28 - m_log2) &&
            slope_q12 <= (int64_t)1 << (22 - m_log2))
            return log2;
    }
    return 0;
}

void grid_from_homography(grid_t *grid, const homography_t *homography)
{
    grid_linear_t edge[5];
    grid->panel_width = homography->panel_width;
    grid->panel_height = homography->panel_height;
    grid->picture_width = homography->picture_width;
    grid->picture_height = homography->picture_height;
    const int32_t w_exponent = linear_from_reals(&grid->w, homography->row[2]);
    grid->x_exponent = linear_from_reals(&grid->x, homography->row[0]) - w_exponent;
    grid->y_exponent = linear_from_reals(&grid->y, homography->row[1]) - w_exponent;
    edges_from_homography(edge, homography);

    for (int32_t j = 0; j < grid->panel_height; j++) {
        grid_row_t row = lit_row(grid, edge, j);
        if (row.begin < row.end) {
            const local_t first = local_at(grid, 2 * row.begin + 1, 2 * j + 1);
            const local_t last = local_at(grid, 2 * row.end - 1, 2 * j + 1);
            const uint8_t at_first = longest_span(&first), at_last = longest_span(&last);
            row.span_log2 = at_first < at_last ? at_first : at_last;
        }
        grid->row[j] = row;
    }
}

/* One coordinate's forward differences from the middle's value and slope. */
static void differences(int32_t out[3], int64_t middle_q18, int64_t slope_q24, const local_t *local, int span_log2,
                        int32_t count)
{
    const int64_t turn_q32 = local->turn_q32;
    /* (r m)^2 in Q32; |r m| <= 1/16 unless the block is one pixel, where it is not used. */
    const int64_t turn_m_q32 = span_log2 > 0 ? turn_q32 * ((int64_t)1 << (span_log2 - 1)) : 0;
    const int64_t square_q32 = floor_shift(turn_m_q32 * turn_m_q32, 32);
    const int64_t d_q24 = slope_q24 + floor_shift(floor_shift(slope_q24 * 3, 2) * square_q32, 32);
    const int64_t bend_q24 = floor_shift(slope_q24 * turn_q32, 32);
    const int64_t dd_q18 =
        span_log2 > 0 ? -round_shift(bend_q24 + floor_shift(bend_q24 * square_q32, 32), 5) : 0; /* 2 E */
    const int64_t first_q24 =
        (middle_q18 * 64) - floor_shift(d_q24 * (count - 1), 1) + dd_q18 * 8 * (count - 1) * (count - 1);
    const int64_t step_q24 = d_q24 + dd_q18 * 32 * (2 - count);
    out[0] = (int32_t)round_shift(first_q24, 6);
    out[1] = (int32_t)round_shift(step_q24, 6);
    out[2] = (int32_t)dd_q18;
}

grid_quadratic_t grid_block(const grid_t *grid, int32_t j, int32_t begin, int32_t end)
{
    const int64_t one = (int64_t)1 << GRID_FRACTION_BITS, low = MIN_X_PX * one, high = MAX_X_PX * one;
    const int span_log2 = grid->row[j].span_log2;
    local_t local = local_at(grid, begin + end, 2 * j + 1);
    if (span_log2 == 0)
        local.x_slope_q24 = local.y_slope_q24 = 0;
    int32_t x[3], y[3];
    differences(x, clamp_i64(local.x_q18, low, high), local.x_slope_q24, &local, span_log2, end - begin);
    differences(y, clamp_i64(local.y_q18, low, high), local.y_slope_q24, &local, span_log2, end - begin);
    return (grid_quadratic_t){x[0], x[1], x[2], y[0], y[1], y[2]};
}

int32_t grid_block_end(const grid_t *grid, int32_t j, int32_t i)
{
    const grid_row_t *row = &grid->row[j];
    const int32_t aligned = ((i >> row->span_log2) + 1) << row->span_log2;
    return aligned < row->end ? aligned : row->end;
}

bool grid_point(const grid_t *grid, int32_t i, int32_t j, int32_t *x_q18, int32_t *y_q18)
{
    const grid_row_t *row = &grid->row[j];
    if (i < row->begin || i >= row->end)
        return false;
    const int32_t aligned = (i >> row->span_log2) << row->span_log2;
    const int32_t begin = aligned > row->begin ? aligned : row->begin;
    const grid_quadratic_t q = grid_block(grid, j, begin, grid_block_end(grid, j, i));
    const uint32_t k = (uint32_t)(i - begin), pairs = k * (k - 1) / 2;
    *x_q18 = (int32_t)((uint32_t)q.x + k * (uint32_t)q.dx + pairs * (uint32_t)q.ddx);
    *y_q18 = (int32_t)((uint32_t)q.y + k * (uint32_t)q.dy + pairs * (uint32_t)q.ddy);
    return true;
}

int64_t grid_depth(const grid_t *grid, int32_t i, int32_t j)
{
    return value_at(&grid->w, 2 * i + 1, 2 * j + 1);
}

grid_jacobian_t grid_jacobian(const grid_t *grid, int32_t i, int32_t j)
{
    const int32_t u = 2 * i + 1, v = 2 * j + 1;
    const int64_t limit = (int64_t)1 << 31;
    const int64_t w = value_at(&grid->w, u, v), x = value_at(&grid->x, u, v), y = value_at(&grid->y, u, v);
    const reciprocal_t over = reciprocal_of(w > 0 ? w : 1);
    const int64_t slopes_q24[4] = {slope_q24(grid->x.u, x, grid->w.u, w, over, grid->x_exponent),
                                   slope_q24(grid->x.v, x, grid->w.v, w, over, grid->x_exponent),
                                   slope_q24(grid->y.u, y, grid->w.u, w, over, grid->y_exponent),
                                   slope_q24(grid->y.v, y, grid->w.v, w, over, grid->y_exponent)};
    int64_t q16[4];
    for (int k = 0; k < 4; k++)
        q16[k] = clamp_i64(round_shift(slopes_q24[k], 8), -limit, limit);
    return (grid_jacobian_t){q16[0], q16[1], q16[2], q16[3]};
}
