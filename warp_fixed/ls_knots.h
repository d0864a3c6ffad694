// SPDX-License-Identifier: Apache-2.0
// The knots of a least-squares spline along one axis, and the cubic B-splines on them (eq 6 of the paper).
//
// On [0, size] stand `intervals` pieces, with four knots at each end. Least squares: all of the same length, size /
// intervals. Interpolation (not-a-knot): the inner knots are at 2.5, 3.5, ..., size - 2.5, on the centres of pixels;
// the first two and last two inner centres have none. Piece i is made of the B-splines i to i + 3.
#ifndef WARP_FIXED_LS_KNOTS_H
#define WARP_FIXED_LS_KNOTS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/fixed.h"

enum {
    LS_TAPS = 4,               /**< B-splines that are not zero in a piece */
    LS_GUARD_Q16 = 5 << 14,    /**< 1.25: below it, down to 1, a fit would be nearly singular */
    LS_WEIGHT_BITS = 30,       /**< B-splines and their weights are Q30 */
    LS_KNOT_UNITS = PHASES / 2 /**< of a half pixel, when interpolating */
};

typedef struct {
    int32_t size;      /**< pixels, 1 to IMAGE_MAX_WIDTH */
    int32_t intervals; /**< pieces: 1 to size - 3, or 1 */
    bool interpolates; /**< not-a-knot instead of least squares */
} ls_knots_t;

/**
 * Knots for a step k: round(size / k) pieces, but no more coefficients than pixels.
 *
 * @param size   1 to IMAGE_MAX_WIDTH. Below 4: one piece, of a polynomial of degree size - 1.
 * @param k_q16  k <= 1 interpolates; between 1 and 1.25 counts as 1.25.
 */
ls_knots_t ls_knots(int32_t size, int32_t k_q16);

/** @return B-splines, and so coefficients: 4 to max(size, 4). */
int32_t ls_coefficients(const ls_knots_t *knots);

/** @return Length of the axis in phases: PHASES per knot distance, or per pixel when interpolating; at most 2^19. */
int32_t ls_phases(const ls_knots_t *knots);

/** @return The centre of pixel i, in units of which a phase has ls_units_per_phase(); below 2^31. */
int64_t ls_site(const ls_knots_t *knots, int32_t i);

/** @return Units of ls_site() in a phase. */
int64_t ls_units_per_phase(const ls_knots_t *knots);

/**
 * The four B-splines that are not zero at a position, by de Boor's recursion.
 *
 * @param[out] value     Q30, none below 0; each errs by 2^-28 at most, and their sum is 2^30 exactly.
 * @param      position  In the units of ls_site(), within the axis.
 * @return The first one's number: that of the piece.
 */
int32_t ls_basis(int32_t value[LS_TAPS], const ls_knots_t *knots, int64_t position);

#endif
