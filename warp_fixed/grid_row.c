// SPDX-License-Identifier: Apache-2.0
// One row of the grid: what its pixels share, and by it their points.
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
//
// Exact points are clamped to [-2048, 6144] px, beside any picture; |s| m is at most 1024 px, so what follows from such
// a point by a quadratic is wrong, but stays more than 900 px beyond the picture as the true points do.
#include "warp_fixed/grid_row.h"

#include "warp_fixed/fixed.h"

enum { MAX_SPAN_LOG2 = 6, MIN_X_PX = -2048, MAX_X_PX = 6144, TURN_BITS = 32 };

_Static_assert(GRID_MAX_SPAN == 1 << MAX_SPAN_LOG2, "the longest block");

/* What a block's quadratic is made of, at its middle. */
typedef struct {
    int64_t x_q18, y_q18;
    int64_t x_slope_q24, y_slope_q24; /* s: per pixel along the row */
    int64_t turn_q32;                 /* r */
} local_t;

static int64_t size_of(int64_t x)
{
    return x < 0 ? -x : x;
}

static grid_row_axis_t row_axis(const grid_linear_t *form, int32_t exponent, const grid_linear_t *w, int32_t v_half)
{
    const int64_t at_zero = form->v * v_half + form->c, w_at_zero = w->v * v_half + w->c;
    const int128_t numerator = (int128_t)form->u * w_at_zero - (int128_t)at_zero * w->u;
    return (grid_row_axis_t){.by_u = form->u,
                             .at_zero = at_zero,
                             .slope = slope_from_numerator(numerator, exponent),
                             .point_shift = RECIPROCAL_SHIFT - GRID_FRACTION_BITS - exponent};
}

static int64_t value_at(const grid_row_axis_t *axis, int32_t u_half)
{
    return axis->by_u * u_half + axis->at_zero;
}

static int64_t depth_at(const grid_row_cursor_t *row, int32_t u_half)
{
    return row->w_by_u * u_half + row->w_at_zero;
}

static int64_t point_q18(const grid_row_axis_t *axis, int32_t u_half, reciprocal_t over)
{
    const int64_t one = (int64_t)1 << GRID_FRACTION_BITS;
    const int64_t point = quotient(value_at(axis, u_half), over.reciprocal, axis->point_shift - over.zeros);
    return clamp_i64(point, MIN_X_PX * one, MAX_X_PX * one);
}

static int64_t slope_q24(const grid_row_axis_t *axis, reciprocal_t over)
{
    return (slope_q25(axis->slope, over) + 1) >> 1;
}

static local_t local_at(const grid_row_cursor_t *row, int32_t u_half)
{
    const reciprocal_t over = reciprocal_of(depth_at(row, u_half));
    return (local_t){
        .x_q18 = point_q18(&row->x, u_half, over),
        .y_q18 = point_q18(&row->y, u_half, over),
        .x_slope_q24 = slope_q24(&row->x, over),
        .y_slope_q24 = slope_q24(&row->y, over),
        .turn_q32 = quotient(row->turn, over.reciprocal, row->turn_shift - over.zeros),
    };
}

static grid_row_cursor_t cursor_of(const grid_t *grid, int32_t j)
{
    const int32_t v_half = 2 * j + 1;
    return (grid_row_cursor_t){
        .row = grid->row[j],
        .x = row_axis(&grid->x, grid->x_exponent, &grid->w, v_half),
        .y = row_axis(&grid->y, grid->y_exponent, &grid->w, v_half),
        .w_by_u = grid->w.u,
        .w_at_zero = grid->w.v * v_half + grid->w.c,
        .turn = 2 * grid->w.u,
        .turn_shift = RECIPROCAL_SHIFT - TURN_BITS,
    };
}

/* The longest block, log2, whose quadratic keeps the bound above here. */
static uint8_t longest_span(const local_t *local)
{
    const int64_t x_slope = size_of(local->x_slope_q24), y_slope = size_of(local->y_slope_q24);
    const int64_t slope_q12 = ((x_slope > y_slope ? x_slope : y_slope) >> 12) + 1;
    const int64_t turn_q32 = size_of(local->turn_q32);
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

/*
 * Points must be away from where they are clamped, and so are all between, for x / w only rises or only falls along a
 * row. Slopes are largest at an end too; a block's d of differences() is larger by 3 / 4 of 1 / 256 at most.
 */
static bool fits_32(const local_t *local)
{
    const int64_t one = (int64_t)1 << GRID_FRACTION_BITS, low = (MIN_X_PX + 2) * one, high = (MAX_X_PX - 2) * one;
    const int64_t most = ((int64_t)1 << 31) - (1 << 24);
    return local->x_q18 > low && local->x_q18 < high && local->y_q18 > low && local->y_q18 < high &&
           size_of(local->x_slope_q24) < most && size_of(local->y_slope_q24) < most;
}

void grid_row_plan(grid_t *grid, int32_t j)
{
    grid_row_t *row = &grid->row[j];
    const grid_row_cursor_t cursor = cursor_of(grid, j);
    const local_t first = local_at(&cursor, 2 * row->begin + 1), last = local_at(&cursor, 2 * row->end - 1);
    const uint8_t at_first = longest_span(&first), at_last = longest_span(&last);
    row->span_log2 = at_first < at_last ? at_first : at_last;
    row->fits_32 = fits_32(&first) && fits_32(&last);
}

/* How far values between two, and the difference of these, can be shifted to the left. */
static int headroom(int64_t first, int64_t last)
{
    const uint64_t bits = (uint64_t)(size_of(first) | size_of(last));
    return __builtin_clzll(bits | 1) - 2;
}

/* Make slopes that are 0 all along the row so, and leave others alone. @return Are their shifts within 64 bits? */
static bool settle_slope(slope_t *slope, int least_zeros, int most_zeros)
{
    if (slope->numerator == 0 || slope->shift - 2 * most_zeros > 64)
        *slope = (slope_t){0, 64 + 2 * least_zeros};
    return slope->shift - 2 * most_zeros >= 1 && slope->shift - 2 * least_zeros <= 64;
}

static void lift_axis(grid_row_axis_t *axis, int by)
{
    axis->by_u *= (int64_t)1 << by;
    axis->at_zero *= (int64_t)1 << by;
    axis->point_shift += by;
}

static int least_of(int a, int b)
{
    return a < b ? a : b;
}

/*
 * Vector code takes the upper 64 bits of numerator * (R << (z - lift)), and half of that. So numerators are shifted to
 * the left until 65 - (z - lift) is what the quotient is shifted by, point_shift - z. @return Is there room for that?
 */
static bool lift_row(grid_row_cursor_t *row)
{
    const int32_t first = 2 * row->row.begin + 1, last = 2 * row->row.end - 1;
    const int at_first = __builtin_clzll((uint64_t)depth_at(row, first));
    const int at_last = __builtin_clzll((uint64_t)depth_at(row, last));
    const int least_zeros = least_of(at_first, at_last), most_zeros = at_first + at_last - least_zeros;
    const int x_by = 65 - row->x.point_shift, y_by = 65 - row->y.point_shift, turn_by = 65 - row->turn_shift;
    int lift = least_zeros;
    lift = least_of(lift, headroom(row->x.at_zero, value_at(&row->x, last)) - x_by);
    lift = least_of(lift, headroom(row->y.at_zero, value_at(&row->y, last)) - y_by);
    lift = least_of(lift, headroom(row->turn, row->turn) - turn_by);
    const bool x_settled = settle_slope(&row->x.slope, least_zeros, most_zeros);
    const bool y_settled = settle_slope(&row->y.slope, least_zeros, most_zeros);
    if (!x_settled || !y_settled || x_by + lift < 0 || y_by + lift < 0 || turn_by + lift < 0 || most_zeros - lift > 30)
        return false;
    lift_axis(&row->x, x_by + lift);
    lift_axis(&row->y, y_by + lift);
    row->turn *= (int64_t)1 << (turn_by + lift);
    row->turn_shift += turn_by + lift;
    row->lift = lift;
    return true;
}

grid_row_cursor_t grid_row_cursor(const grid_t *grid, int32_t j)
{
    grid_row_cursor_t row = cursor_of(grid, j);
    if (row.row.span_log2 == 0)
        row.turn = 0;
    row.row.fits_32 = row.row.fits_32 && lift_row(&row);
    return row;
}

/* One coordinate's forward differences over `count` pixels from the middle's value and slope; square_q32 is (r m)^2. */
static void differences(int32_t out[3], int64_t middle_q18, int64_t slope, int64_t turn_q32, int64_t square_q32,
                        int32_t count)
{
    const int64_t d_q24 = slope + floor_shift(floor_shift(slope * 3, 2) * square_q32, 32);
    const int64_t bend_q24 = floor_shift(slope * turn_q32, 32);
    const int64_t dd_q18 = -round_shift(bend_q24 + floor_shift(bend_q24 * square_q32, 32), 5); /* 2 E */
    const int64_t first_q24 =
        (middle_q18 * 64) - floor_shift(d_q24 * (count - 1), 1) + dd_q18 * 8 * (count - 1) * (count - 1);
    const int64_t step_q24 = d_q24 + dd_q18 * 32 * (2 - count);
    out[0] = (int32_t)round_shift(first_q24, 6);
    out[1] = (int32_t)round_shift(step_q24, 6);
    out[2] = (int32_t)dd_q18;
}

grid_quadratic_t grid_row_block(const grid_row_cursor_t *row, int32_t begin, int32_t end)
{
    const local_t local = local_at(row, begin + end);
    /* 2 r m; |r m| <= 1/16, and r is 0 where blocks are of one pixel. */
    const int64_t twice_q32 = local.turn_q32 * ((int64_t)1 << row->row.span_log2);
    const int64_t square_q32 = floor_shift(twice_q32 * twice_q32, 34);
    int32_t x[3], y[3];
    differences(x, local.x_q18, local.x_slope_q24, local.turn_q32, square_q32, end - begin);
    differences(y, local.y_q18, local.y_slope_q24, local.turn_q32, square_q32, end - begin);
    return (grid_quadratic_t){x[0], x[1], x[2], y[0], y[1], y[2]};
}

bool grid_point(const grid_t *grid, int32_t i, int32_t j, int32_t *x_q18, int32_t *y_q18)
{
    const grid_row_cursor_t row = grid_row_cursor(grid, j);
    if (i < row.row.begin || i >= row.row.end)
        return false;
    const int32_t aligned = (i >> row.row.span_log2) << row.row.span_log2;
    const int32_t begin = aligned > row.row.begin ? aligned : row.row.begin;
    const grid_quadratic_t q = grid_row_block(&row, begin, grid_row_block_end(row.row, i));
    const uint32_t k = (uint32_t)(i - begin), pairs = k * (k - 1) / 2;
    *x_q18 = (int32_t)((uint32_t)q.x + k * (uint32_t)q.dx + pairs * (uint32_t)q.ddx);
    *y_q18 = (int32_t)((uint32_t)q.y + k * (uint32_t)q.dy + pairs * (uint32_t)q.ddy);
    return true;
}
