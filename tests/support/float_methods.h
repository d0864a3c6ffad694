// SPDX-License-Identifier: Apache-2.0
// The methods' definitions in floating point: what the fixed-point ones are measured against.
#ifndef TESTS_SUPPORT_FLOAT_METHODS_H
#define TESTS_SUPPORT_FLOAT_METHODS_H

#include "warp_fixed/kernels.h"
#include "warp_fixed/method.h"

/** Weights of distance 0, 1, ... of a filter, whose sum over both sides is 1. @return The radius. */
int float_taps(double taps[PREFILTER_MAX_RADIUS + 1], warp_filter_t filter, double k);

/** Weight, along one axis, of the texel (or coefficient) whose centre is at distance t before the point. */
double float_weight(warp_resampler_t resampler, double t, double side);

/** @return The side, in px, that entry `side` of a weight table stands for: see WINDOW_SIDES. */
double float_side(int32_t side);

/** Turn a gray picture, row by row, into the coefficients of its interpolating cubic B-spline. */
void float_spline_coefficients(double *values, int width, int height);

#endif
