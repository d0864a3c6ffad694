// SPDX-License-Identifier: Apache-2.0
// The knots of a least-squares spline along one axis, and the cubic B-splines on them (eq 6 of the paper).
#include "warp_fixed/ls_knots.h"

ls_knots_t ls_knots(int32_t size, int32_t k_q16)
{
    const int32_t most = size > LS_TAPS ? size - (LS_TAPS - 1) : 1;
    if (k_q16 <= 1 << 16 && size >= LS_TAPS)
        return (ls_knots_t){size, most, true};
    const int64_t k = k_q16 < LS_GUARD_Q16 ? LS_GUARD_Q16 : k_q16;
    const int64_t pieces = (((int64_t)size << 16) + k / 2) / k;
    return (ls_knots_t){size, (int32_t)clamp_i64(pieces, 1, most), false};
}

int32_t ls_coefficients(const ls_knots_t *knots)
{
    return knots->intervals + LS_TAPS - 1;
}

int32_t ls_phases(const ls_knots_t *knots)
{
    return PHASES * (knots->interpolates ? knots->size : knots->intervals);
}

/* Units: 1 / LS_KNOT_UNITS of a half pixel; for least squares 1 / intervals of that, so that every knot is whole. */
int64_t ls_site(const ls_knots_t *knots, int32_t i)
{
    return (int64_t)(2 * i + 1) * LS_KNOT_UNITS * (knots->interpolates ? 1 : knots->intervals);
}

int64_t ls_units_per_phase(const ls_knots_t *knots)
{
    return knots->interpolates ? 1 : knots->size;
}

/* Knot i, at the beginning of piece i; below 0 and above `intervals` those that stand at the ends. */
static int64_t knot_at(const ls_knots_t *knots, int32_t i)
{
    const int32_t inner = clamp_i32(i, 0, knots->intervals);
    if (!knots->interpolates)
        return (int64_t)inner * PHASES * knots->size;
    if (inner == 0 || inner == knots->intervals)
        return inner == 0 ? 0 : (int64_t)2 * LS_KNOT_UNITS * knots->size;
    return (int64_t)(2 * inner + 3) * LS_KNOT_UNITS;
}

static int32_t piece_at(const ls_knots_t *knots, int64_t position)
{
    const int64_t piece = knots->interpolates ? (position - 3 * LS_KNOT_UNITS) / (2 * LS_KNOT_UNITS)
                                              : position / ((int64_t)PHASES * knots->size);
    return (int32_t)clamp_i64(piece, 0, knots->intervals - 1);
}

/* Each of the three levels rounds down twice: the B-splines err by 2.6 units at most at 60,000 random positions. */
int32_t ls_basis(int32_t value[LS_TAPS], const ls_knots_t *knots, int64_t position)
{
    const int32_t piece = piece_at(knots, position);
    int64_t b[LS_TAPS] = {(int64_t)1 << LS_WEIGHT_BITS};
    for (int degree = 1; degree < LS_TAPS; degree++) {
        int64_t carried = 0;
        for (int r = 0; r < degree; r++) {
            const int64_t right = knot_at(knots, piece + r + 1), left = knot_at(knots, piece + r + 1 - degree);
            const int64_t up = b[r] * (position - left) / (right - left); /* < 2^30 * 2^22 */
            b[r] = carried + b[r] - up;
            carried = up;
        }
        b[degree] = carried;
    }
    for (int r = 0; r < LS_TAPS; r++)
        value[r] = (int32_t)b[r];
    return piece;
}
