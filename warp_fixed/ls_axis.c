// SPDX-License-Identifier: Apache-2.0
// One axis of the least-squares spline (eq 7 of the paper): its equations solved once, for any picture.
//
// R and the equations are Q31. A column of all equations has a norm of at most 0.97 (0.7 unless interpolating), and
// rotations keep it: no entry of R reaches 1. Measured at sizes up to 4096, rounding adds at most 2^-27 to an entry
// while k is below 5, where 20 equations meet in it, and 2^-23 in an axis of one piece. R's condition is 1270 at most,
// at k = 1.25 and size 17; 54 from k = 1.5 on; 16 from k = 2 on and when interpolating. Weights as far apart as 4096
// make it 64 times as large at most.
#include "warp_fixed/ls_axis.h"

static const int32_t one_q31 = INT32_MAX;

typedef struct {
    int32_t cos, sin;
} rotation_t;

void ls_axis_init(ls_axis_t *axis)
{
    axis->knots = (ls_knots_t){.size = 0};
}

static int32_t to_q31(int64_t value)
{
    return (int32_t)clamp_i64(value, -one_q31, one_q31);
}

/*
 * The square root of 2^60 <= s < 2^63, short by less than 1: Newton's steps from a line that errs by 12 % at most, so
 * after them by 0.7 %, 2^-15, 2^-31 and 2^-63.
 */
static int64_t root_of(int64_t s)
{
    int64_t root = (s >> 32) + (s >> 36) + 910533000;
    for (int step = 0; step < 4; step++)
        root = (root + s / root) >> 1;
    return root;
}

/* The rotation that turns (x, y) into (r, 0): x >= 0. Scaled up first, so that cos^2 + sin^2 = 1 within 2^-29. */
static rotation_t rotation_from(int64_t x, int64_t y)
{
    if (y == 0)
        return (rotation_t){one_q31, 0};
    while (x < 1 << 30 && y < 1 << 30 && y > -(1 << 30)) {
        x *= 2;
        y *= 2;
    }
    const int64_t length = root_of(x * x + y * y);
    return (rotation_t){to_q31(x * ((int64_t)1 << 31) / length), to_q31(y * ((int64_t)1 << 31) / length)};
}

/* Take the equation b, whose unknowns begin at `first`, into R, whose rows are kept where the solution will be. */
static void rotate_in(ls_axis_t *axis, ls_equation_t *equation, int64_t b[LS_TAPS])
{
    for (int t = 0; t < LS_TAPS; t++) {
        ls_solution_t *row = &axis->solution[equation->first + t];
        const rotation_t turn = rotation_from(row->own, b[t]);
        for (int u = t; u < LS_TAPS; u++) {
            int32_t *entry = u == t ? &row->own : &row->next[u - t - 1];
            const int64_t r = *entry;
            *entry = to_q31(round_shift(turn.cos * r + turn.sin * b[u], 31));
            b[u] = round_shift(turn.cos * b[u] - turn.sin * r, 31);
        }
        equation->cos_q31[t] = turn.cos;
        equation->sin_q31[t] = turn.sin;
    }
}

/* sqrt(weight / h), Q31. */
static int32_t scale_of(const ls_knots_t *knots, uint16_t weight)
{
    const int32_t bounded = clamp_i32(weight, LS_WEIGHT_MIN, LS_WEIGHT_ONE);
    if (knots->interpolates)
        return to_q31(floor_sqrt((uint64_t)bounded << 47));
    const uint64_t square_q50 = ((uint64_t)bounded << 35) * (uint64_t)knots->intervals / (uint64_t)knots->size;
    return to_q31(floor_sqrt(square_q50 << 12));
}

static void rotate_in_pixel(ls_axis_t *axis, int32_t i, uint16_t weight)
{
    ls_equation_t *equation = &axis->equation[i];
    int32_t value[LS_TAPS];
    int64_t b[LS_TAPS];
    equation->scale_q31 = scale_of(&axis->knots, weight);
    equation->first = ls_basis(value, &axis->knots, ls_site(&axis->knots, i));
    for (int t = 0; t < LS_TAPS; t++)
        b[t] = round_shift((int64_t)value[t] * equation->scale_q31, LS_WEIGHT_BITS);
    rotate_in(axis, equation, b);
}

/* Equation i of an axis of fewer than 4 pixels: a difference of order `size`, an eighth of it to stay below 1. */
static void rotate_in_difference(ls_axis_t *axis, int32_t i)
{
    static const int32_t difference[LS_TAPS - 1][LS_TAPS] = {{-1, 1}, {1, -2, 1}, {-1, 3, -3, 1}};
    const int32_t size = axis->knots.size;
    int64_t b[LS_TAPS] = {0};
    for (int32_t t = 0; t <= size; t++)
        b[i - size + t] = difference[size - 1][t] * (1 << 28);
    axis->equation[i] = (ls_equation_t){.first = 0, .scale_q31 = 0};
    rotate_in(axis, &axis->equation[i], b);
}

/*
 * Row of R -> how its unknown follows from the next three. The diagonal is at least R's smallest singular value: above
 * 2^14 here with the most unequal weights, so that shift stays above 10.
 */
static void solve_row(ls_solution_t *row)
{
    const int64_t diagonal = row->own > 2 ? row->own : 2;
    const int64_t own = (int64_t)1 << (31 - LS_STATE_BITS);
    int64_t largest = own;
    for (int t = 0; t < LS_TAPS - 1; t++) {
        const int64_t entry = row->next[t] < 0 ? -(int64_t)row->next[t] : row->next[t];
        largest = entry > largest ? entry : largest;
    }
    row->shift = 29;
    while (row->shift > 1 && (largest << row->shift) / diagonal >= 1 << 29)
        row->shift--;
    const int64_t unit = (int64_t)1 << row->shift;
    row->own = to_q31(own * unit / diagonal);
    for (int t = 0; t < LS_TAPS - 1; t++)
        row->next[t] = to_q31(-row->next[t] * unit / diagonal);
}

static void solve(ls_axis_t *axis, const uint16_t *weight)
{
    for (int32_t j = 0; j < axis->coefficients; j++)
        axis->solution[j] = (ls_solution_t){.own = 0};
    for (int32_t i = 0; i < axis->equations; i++) {
        if (i < axis->knots.size)
            rotate_in_pixel(axis, i, weight[i]);
        else
            rotate_in_difference(axis, i);
    }
    for (int32_t j = 0; j < axis->coefficients; j++)
        solve_row(&axis->solution[j]);
}

/* Of a phase, counted from the end that is nearer. */
static int32_t row_of(const ls_axis_t *axis, int32_t phase)
{
    if (phase < axis->edge_phases)
        return phase;
    return axis->edge_phases + ((phase - axis->middle_phase) & (PHASES - 1));
}

/*
 * Away from the ends all pieces are alike: from the third on for least squares, and after 4.5 pixels for not-a-knot.
 * Rows beyond the axis' middle are never asked for.
 */
static void tabulate(ls_axis_t *axis)
{
    const int64_t units = ls_units_per_phase(&axis->knots);
    const int32_t wanted = axis->knots.interpolates ? LS_EDGE_PHASES : 2 * PHASES;
    const int32_t half = axis->phases / 2;
    axis->edge_phases = half < wanted ? half + 1 : wanted;
    axis->middle_phase = axis->knots.interpolates ? 3 * PHASES / 2 : 0;
    for (int32_t phase = 0; phase <= half && phase < wanted + PHASES; phase++)
        (void)ls_basis(axis->weight[0][row_of(axis, phase)], &axis->knots, phase * units);
    for (int32_t row = 0; row < LS_EDGE_PHASES + PHASES; row++)
        for (int t = 0; t < LS_TAPS; t++)
            axis->weight[1][row][t] = axis->weight[0][row][LS_TAPS - 1 - t];
}

void ls_axis_update(ls_axis_t *axis, int32_t size, int32_t k_q16, const uint16_t *weight)
{
    const ls_knots_t knots = ls_knots(size, k_q16);
    if (axis->knots.size == size && axis->knots.intervals == knots.intervals &&
        axis->knots.interpolates == knots.interpolates)
        return;
    axis->knots = knots;
    axis->equations = size > LS_TAPS ? size : LS_TAPS;
    axis->coefficients = ls_coefficients(&knots);
    axis->phases = ls_phases(&knots);
    axis->phase_factor = (int32_t)(((int64_t)axis->phases << LS_FACTOR_BITS) / size);
    solve(axis, weight);
    tabulate(axis);
}

ls_taps_t ls_axis_taps(const ls_axis_t *axis, int32_t x_q18)
{
    const int64_t x = clamp_i32(x_q18, 0, axis->knots.size << GRID_FRACTION_BITS);
    const int32_t phase = (int32_t)round_shift(x * axis->phase_factor, GRID_FRACTION_BITS + LS_FACTOR_BITS);
    const bool mirrored = phase > axis->phases - phase;
    const int32_t from_end = mirrored ? axis->phases - phase : phase;
    const int32_t from_middle = from_end - axis->middle_phase;
    const int32_t piece = from_middle < 0 ? 0 : from_middle >> PHASE_BITS;
    return (ls_taps_t){axis->weight[mirrored][row_of(axis, from_end)],
                       mirrored ? axis->coefficients - LS_TAPS - piece : piece};
}
