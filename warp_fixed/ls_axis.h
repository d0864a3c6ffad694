// SPDX-License-Identifier: Apache-2.0
// One axis of the least-squares spline (eq 7 of the paper): its equations solved once, for any picture.
//
// Pixel i gives the equation sqrt(w_i / h) * (sum_j B_j(site i) c_j = pixel i), h being the pieces' length. Givens
// rotations turn these, one after the other, into a band R c = z of width 4: orthogonal, so nothing grows, and errors
// are enlarged by the condition of R alone. (That of the normal equations is its square: 1.6e6 at k = 1.25.) The
// rotations and R depend on size, knots and weights only, and are kept. An axis of fewer than 4 pixels has equations
// to spare: differences of the coefficients, of order `size`, are 0.
#ifndef WARP_FIXED_LS_AXIS_H
#define WARP_FIXED_LS_AXIS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/image.h"
#include "warp_fixed/ls_knots.h"

enum {
    LS_MAX_SIZE = IMAGE_MAX_WIDTH, /**< equations, and coefficients, of an axis */
    LS_WEIGHT_ONE = 32768,         /**< an axis' largest weight */
    LS_WEIGHT_MIN = LS_WEIGHT_ONE / 4096,
    LS_EDGE_PHASES = 9 * PHASES / 2, /**< 4.5 pixels of not-a-knot; least squares needs 2 knot distances */
    LS_FACTOR_BITS = 23,             /**< x_q18 * phase_factor >> (18 + 23) is a phase */
    LS_STATE_BITS = 6                /**< right-hand sides have as many fraction bits more than coefficients */
};

_Static_assert((int)IMAGE_MAX_HEIGHT <= (int)LS_MAX_SIZE, "one type serves both axes");

/** What one equation does to right-hand sides: four rotations of it with z[first] to z[first + 3]. */
typedef struct {
    int32_t first;
    int32_t scale_q31; /**< of the pixel: sqrt(w_i / h), at most 1 */
    int32_t cos_q31[LS_TAPS], sin_q31[LS_TAPS];
} ls_equation_t;

/** c_j = (own * z_j + next[0] * c_(j+1) + next[1] * c_(j+2) + next[2] * c_(j+3)) / 2^shift; all less than 2^29. */
typedef struct {
    int32_t own, next[LS_TAPS - 1];
    int32_t shift; /**< 1 to 29 */
} ls_solution_t;

/** Weights of the four coefficients from `first` on, Q30, with sum 2^30. */
typedef struct {
    const int32_t *weight; /**< LS_TAPS of them, in the axis */
    int32_t first;
} ls_taps_t;

/** A solved axis, about 260 KB. No pointers: may be moved. */
typedef struct {
    ls_knots_t knots;     /**< size 0: none yet */
    int32_t equations;    /**< max(size, 4) */
    int32_t coefficients; /**< 4 to equations */
    int32_t phases;       /**< length of the axis */
    int32_t phase_factor; /**< phases per pixel, with LS_FACTOR_BITS fraction bits */
    int32_t edge_phases;  /**< a row of weights for each; from there on to the axis' middle, PHASES rows serve */
    int32_t middle_phase; /**< where piece 0 would begin, were all pieces alike */
    ls_equation_t equation[LS_MAX_SIZE];
    ls_solution_t solution[LS_MAX_SIZE];
    int32_t weight[2][LS_EDGE_PHASES + PHASES][LS_TAPS]; /**< rows from the near end; and in reverse, from the far */
} ls_axis_t;

/** Forget the axis. */
void ls_axis_init(ls_axis_t *axis);

/**
 * Solve the axis for a step k. Does nothing when size and knots are those of the last call.
 *
 * Some 1400 instructions per pixel.
 *
 * @param axis    From ls_axis_init(), which must be called again when the weights change.
 * @param size    1 to LS_MAX_SIZE.
 * @param k_q16   See ls_knots().
 * @param weight  w_i of eq 7, `size` of them; LS_WEIGHT_ONE is the largest. Those below LS_WEIGHT_MIN, also 0, count as
 *                that, so that the equations have one solution whatever the weights are.
 */
void ls_axis_update(ls_axis_t *axis, int32_t size, int32_t k_q16, const uint16_t *weight);

/**
 * The weights at a point.
 *
 * @param x_q18  Picture pixels; clamped here to [0, size], and rounded to a phase.
 */
ls_taps_t ls_axis_taps(const ls_axis_t *axis, int32_t x_q18);

#endif
