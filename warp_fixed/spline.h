// SPDX-License-Identifier: Apache-2.0
// The picture as coefficients of the cubic B-spline that goes through its pixels.
//
// The spline sum_n c(n) B(t - n), B the cubic B-spline, goes through the pixels p when c is p filtered by the inverse
// of B's own samples, 6 / (z + 4 + 1/z): c = sqrt(3) sum_m a^|m| p(n - m), a = sqrt(3) - 2, along both axes, with
// half-sample mirror borders. a^8 is 2.7e-5, so a filter of radius 8 is enough.
#ifndef WARP_FIXED_SPLINE_H
#define WARP_FIXED_SPLINE_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/image.h"
#include "warp_fixed/kernels.h"
#include "warp_fixed/levels.h"
#include "warp_fixed/prefilter.h"

/** The coefficients made so far from this frame's picture; 92 MB, touched only as far as a picture needs them. */
typedef struct {
    bool made[LEVELS][LEVELS]; /**< [x level][y level] */
    prefilter_sums_t sums;
    int16_t coefficients[IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * 4 + LEVELS_BYTES]; /**< of the picture, then its levels */
} spline_t;

/** Forget the last frame's coefficients. */
void spline_begin(spline_t *spline);

/**
 * The coefficients of a level of the picture, in 1/16 grey level less the middle grey. Made when first asked for in a
 * frame: 2 x 17 products per byte.
 *
 * @param picture  The picture at that level (levels.h).
 * @return A view into `spline`, valid until spline_begin().
 */
coefficients_t spline_coefficients(spline_t *spline, const warp_kernels_t *kernels, const image_t *picture, int level_x,
                                   int level_y);

#endif
