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

/** @return a * b / 2^64, rounded down. */
static inline int64_t upper_64(int64_t a, int64_t b)
{
    return (int64_t)((int128_t)a * b >> 64);
}

/**
 * @param w  1 to 2^60.
 *
 * A 64-bit division keeps an A72 for 20 cycles and an A57 for 35. d = n / 2^32 is in [1/2, 1), and y = 4 ((9 - 8 d)^2 +
 * 24) / 99 within 1/99 of 1 / d (Chebyshev). With e = 1 - d y, y (1 + e + e^2) is within 2^-19. What 2^63 then leaves
 * of multiples of n, at most 2^44, is as good as divided by it, give or take 1/64: 1/32 is taken off, to err to one
 * side.
 */
static inline reciprocal_t reciprocal_of(int64_t w)
{
    const int zeros = __builtin_clzll((uint64_t)w);
    const uint64_t d_q64 = (uint64_t)w << zeros, n = d_q64 >> 32;
    const uint64_t s_q29 = ((uint64_t)9 << 29) - n;
    const uint64_t first_q61 = mul_high(s_q29 * s_q29 + ((uint64_t)24 << 58), ((uint64_t)1 << 63) / 99 << 6);
    const uint64_t near_q61 = mul_high(first_q61, d_q64); /* 1 - e */
    const int64_t e_q64 = (int64_t)(0 - 8 * near_q61);    /* modulo 2^64: |e| is far below 1 / 2 */
    const uint64_t more_q61 = ((uint64_t)1 << 62) - near_q61 + ((uint64_t)upper_64(e_q64, e_q64) >> 3);
    const int64_t most = (int64_t)(mul_high(first_q61, more_q61) >> 27);
    const int64_t left = (int64_t)(((uint64_t)1 << 63) - (uint64_t)most * n);
    const int64_t least = most + (((left >> 16) * most - ((int64_t)1 << 42)) >> 47);
    return (reciprocal_t){least + (((uint64_t)1 << 63) - (uint64_t)least * n >= n), zeros};
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

/** A change per pixel: with R and z of above, (numerator R / 2^64) R / 2^(shift - 2 z) in Q24. */
typedef struct {
    int64_t numerator; /**< its lower 32 bits are 0 */
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
        return (slope_t){(int64_t)(upper >> 32 << 32), at_31_bits - (97 - zeros)};
    }
    const int bits = low != 0 ? 64 - __builtin_clzll(low) : 0;
    const int cut = bits > 31 ? bits - 31 : 0;
    return (slope_t){(int64_t)(wide >> cut) * ((int64_t)1 << 32), at_31_bits - cut};
}

/**
 * @return Twice the slope there, rounded down, 2^53 at most: (it + 1) >> 1 is the slope to nearest. For shift - 2 z
 * from 1 to 64, and slopes that then fit: 64 bits hold all of it.
 */
static inline int64_t slope_q25_in_64_bits(slope_t slope, reciprocal_t over)
{
    const int64_t once = upper_64(slope.numerator, over.reciprocal);
    return once * over.reciprocal >> (slope.shift - 1 - 2 * over.zeros);
}

/** @return The same for any shift; what it rounds to is saturated to +-2^52. */
static inline int64_t slope_q25(slope_t slope, reciprocal_t over)
{
    const int shift = slope.shift - 2 * over.zeros;
    if (shift >= 11 && shift <= 64) /* the common case */
        return slope_q25_in_64_bits(slope, over);
    return 2 * quotient(upper_64(slope.numerator, over.reciprocal), over.reciprocal, shift);
}

#endif
