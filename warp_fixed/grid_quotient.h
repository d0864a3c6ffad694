// SPDX-License-Identifier: Apache-2.0
// Quotients by the depth w, all through one 33-bit reciprocal of it. Of the grid's own files only.
#ifndef WARP_FIXED_GRID_QUOTIENT_H
#define WARP_FIXED_GRID_QUOTIENT_H

#include "warp_fixed/fixed.h"

/** 1 / w = reciprocal * 2^(zeros - 95), but for 2^-31 of it; 2^31 < reciprocal <= 2^32. */
typedef struct {
    int64_t reciprocal;
    int zeros; /**< leading zero bits of w, 3 to 63 */
} reciprocal_t;

enum { RECIPROCAL_SHIFT = 95 };

/** @param w  1 to 2^60. */
static inline reciprocal_t reciprocal_of(int64_t w)
{
    const int zeros = __builtin_clzll((uint64_t)w);
    const uint64_t normal = (uint64_t)w << zeros >> 32;
    return (reciprocal_t){(int64_t)(((uint64_t)1 << 63) / normal), zeros};
}

/** @return value * reciprocal / 2^shift to nearest, ties up, saturated to +-2^52; |value| < 2^63. */
static inline int64_t quotient(int64_t value, int64_t reciprocal, int shift)
{
    const int128_t product = (int128_t)value * reciprocal; /* below 2^95 */
    const int64_t limit = (int64_t)1 << 52;
    if (shift > 96)
        return 0;
    if (shift >= 43) /* the common case: the lower 32 bits decide nothing, and what is left is below 2^52 */
        return (((int64_t)(product >> 32) >> (shift - 33)) + 1) >> 1;
    if (shift <= 0)
        return product > 0 ? limit : product < 0 ? -limit : 0;
    const int128_t rounded = ((product >> (shift - 1)) + 1) >> 1;
    return rounded > limit ? limit : rounded < -limit ? -limit : (int64_t)rounded;
}

/** A change per pixel: with R and z of above, (numerator R / 2^32) R / 2^(shift - 2 z) in Q24; |numerator| <= 2^31. */
typedef struct {
    int64_t numerator;
    int shift;
} slope_t;

enum { SLOPE_BITS = 24 };

/**
 * @param wide      N = (dx/dU) w - x (dw/dU): x 2^exponent / w changes by 2^exponent N / w^2 per half pixel U, by twice
 *                  that per pixel. |N| < 2^126.
 * @param exponent  As above.
 */
static inline slope_t slope_from_numerator(int128_t wide, int32_t exponent)
{
    const uint128_t size = (uint128_t)(wide < 0 ? -wide : wide);
    const uint64_t high = (uint64_t)(size >> 64), low = (uint64_t)size;
    const int at_31_bits = 2 * RECIPROCAL_SHIFT - 33 - SLOPE_BITS - exponent;
    if (high != 0) { /* the common case: the upper 64 bits of wide * 2^(zeros - 1) */
        const int zeros = __builtin_clzll(high);
        const uint64_t upper = (uint64_t)(wide >> 64) << (zeros - 1) | (uint64_t)wide >> 1 >> (64 - zeros);
        return (slope_t){(int64_t)upper >> 32, at_31_bits - (97 - zeros)};
    }
    const int bits = low != 0 ? 64 - __builtin_clzll(low) : 0;
    const int cut = bits > 31 ? bits - 31 : 0;
    return (slope_t){(int64_t)(wide >> cut), at_31_bits - cut};
}

/**
 * @return Twice the slope there, rounded down, 2^53 at most: (it + 1) >> 1 is the slope to nearest. For shift - 2 z
 * from 1 to 64, and slopes that then fit: 64 bits hold all of it.
 */
static inline int64_t slope_q25_in_64_bits(slope_t slope, reciprocal_t over)
{
    const int64_t once = slope.numerator * over.reciprocal >> 32;
    return once * over.reciprocal >> (slope.shift - 1 - 2 * over.zeros);
}

/** @return The same for any shift; what it rounds to is saturated to +-2^52. */
static inline int64_t slope_q25(slope_t slope, reciprocal_t over)
{
    const int shift = slope.shift - 2 * over.zeros;
    if (shift >= 11 && shift <= 64) /* the common case */
        return slope_q25_in_64_bits(slope, over);
    return 2 * quotient(slope.numerator * over.reciprocal >> 32, over.reciprocal, shift);
}

#endif
