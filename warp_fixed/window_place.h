// SPDX-License-Identifier: Apache-2.0
// Which texels and which weights a point's window has along one axis.
#ifndef WARP_FIXED_WINDOW_PLACE_H
#define WARP_FIXED_WINDOW_PLACE_H

#include <stdint.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/window_weights.h"

/** Where a window begins along one axis, and its rows of weights. */
typedef struct {
    int32_t begin;
    const int16_t *first, *second;
} window_place_t;

/** The window around a point. @param size  Of level 0, pixels: the point is clamped to it, then rounded to a phase. */
static inline window_place_t window_place(const window_axis_t *axis, int32_t point_q18, int32_t size, int level)
{
    const int32_t clamped = clamp_i32(point_q18, 0, size << GRID_FRACTION_BITS) >> (3 * level);
    const int32_t rounding = GRID_FRACTION_BITS - PHASE_BITS;
    const int32_t from_centre = ((clamped + (1 << (rounding - 1))) >> rounding) - PHASES / 2;
    const int32_t from_begin = from_centre + axis->lead;
    const int32_t row = (from_begin & (PHASES - 1)) * axis->row;
    return (window_place_t){from_begin >> PHASE_BITS, axis->first + row, axis->second + row};
}

#endif
