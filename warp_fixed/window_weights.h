// SPDX-License-Identifier: Apache-2.0
// One table of weights for every interpolating and averaging kernel, by side of the footprint and phase.
//
// A pixel's value is sum_y first(y) sum_x second(x) picture(x, y) over a small window. Along each axis, texel i (its
// centre at i + 1/2) weighs (C(x + s/2 - i - 1/2) - C(x - s/2 - i - 1/2)) / s, where C is the running integral of the
// kernel and s the side it is averaged over; for s = 0 the kernel itself: interpolation. Weights are exact rationals,
// rounded by largest remainders so that their sum is exact.
//
// With h the kernel's half width, a window begins with the first texel whose centre is right of x - s/2 - h. How far
// right, in 1/128 px, is its row in the table: see window_place.h.
#ifndef WARP_FIXED_WINDOW_WEIGHTS_H
#define WARP_FIXED_WINDOW_WEIGHTS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/method.h"

enum {
    WINDOW_SIDES = 64 + 6 * 32 + 1, /**< below 1 px in steps of 1/64, then 32 steps to each doubling, up to 64 px */
    WINDOW_MAX_SIDE = 64,           /**< picture pixels; larger footprints are read from halved levels */
    WINDOW_MAX_TAPS = WINDOW_MAX_SIDE + 4,
    CUBIC_TAPS = 4,
    WINDOW_SHORT_TAPS = 8,    /**< up to here the first pass has 8-bit weights */
    WINDOW_ROW_SLACK = 8,     /**< weights from the begin of a row that vector code may load, if there are fewer */
    WINDOW_SHORT_SIDES = 153, /**< sides with short windows, of the narrowest kernel, half width 1/2 */
    /** Weights of all sides of the widest kernel, half width 2; there are zeros after those of side 0. */
    WINDOW_POOL = 4488 * PHASES + WINDOW_SHORT_TAPS + WINDOW_ROW_SLACK
};

/** Weights along one axis for one side: PHASES rows of each table. */
typedef struct {
    warp_resampler_t resampler;
    bool negative; /**< some weights of the table are: sums overshoot what bytes can make */
    /** Sum FIRST_SUM, FIRST_SUM_POSITIVE, or that << LONG_FIRST_SHIFT; of coefficients as second. */
    const int16_t *first;
    const int16_t *second;      /**< sum SECOND_SUM, SECOND_SUM_POSITIVE, of coefficients 1 << COEFFICIENT_SUM_LOG2 */
    const uint8_t *first_bytes; /**< as `first`, negated where `negative`; of short windows of texels alone. Where four
                                   taps are `negative`, their absolute values follow: outer ones are not positive.
                                   Where taps are an odd number, the byte before a row is 0 */
    int32_t taps;               /**< 1 to WINDOW_MAX_TAPS */
    int32_t row;                /**< entries from row to row: taps, or WINDOW_SHORT_TAPS with zeros where these do */
    int32_t lead;               /**< 1/128 px: 1 - h - s/2 */
    /** 0, or LONG_FIRST_SHIFT when taps > WINDOW_SHORT_TAPS; of coefficients: COEFFICIENT_SUM_LOG2. */
    int32_t first_shift;
} window_axis_t;

/** The table of one resampler. */
typedef struct {
    warp_resampler_t resampler;
    bool of_coefficients;      /**< not of texels: kernels.h */
    bool negative;             /**< some weights are */
    int32_t half_width;        /**< of the kernel, 1/128 px */
    uint32_t at[WINDOW_SIDES]; /**< of row 0 in the pools */
    uint8_t taps[WINDOW_SIDES];
    int16_t first[WINDOW_POOL];
    int16_t second[WINDOW_POOL];
    uint8_t first_bytes[(WINDOW_SHORT_SIDES * PHASES + 1) * WINDOW_SHORT_TAPS];
} window_weights_t;

/** Which entry of the table serves a footprint's side, and from which level of the picture. */
typedef struct {
    uint16_t side; /**< 0 to WINDOW_SIDES - 1 */
    uint8_t level; /**< the axis is divided by 8^level */
} window_side_t;

/**
 * Build the table of a resampler. WARP_NEAREST, WARP_LS and WARP_AUTO have none: their table is left as it is.
 *
 * @param of_coefficients  For coefficients instead of texels; always for WARP_SPLINE and WARP_MEAN_SPLINE.
 */
void window_weights_init(window_weights_t *weights, warp_resampler_t resampler, bool of_coefficients);

/**
 * Choose by the footprint's width (or height): area takes it as the side; mean+cubic and mean+spline take
 * sqrt(w^2 - 1), since the picture's pixels are means over a unit box themselves; plain kernels take 0.
 */
window_side_t window_side(warp_resampler_t resampler, uint32_t width_q16);

/** @return The axis' weights, pointing into the table. */
window_axis_t window_axis(const window_weights_t *weights, uint16_t side);

#endif
