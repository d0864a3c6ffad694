// SPDX-License-Identifier: Apache-2.0
// The fixed-point formats of the frame path, with their rounding and saturation: only here.
//
// Positions  Q18 int32: 13 integer bits reach +-8192 px, 18 fraction bits leave the grid's forward differences right
//            to 2^-10 px over a span of 64.
// Phases     Kernels see positions rounded to 1/128 px (1/64 costs 0.04 dB where these are a quarter of a texel).
// Sums       Both passes of a window of texels go from 8 bits to 8 bits through 16:
//            first pass   v = sum(w1 * p), the weights' sum S1 is 128 (or 255 where no weight is negative);
//                         less its middle, 128 * S1, v fits signed 16 bits with all that a cubic overshoots (without
//                         negative weights it fits unsigned ones as it is): 8 x 8 bit multiplies do for vector code;
//            second pass  out = (sum(w2 * v) + 2^21) >> 22, the weights' sum S2 is chosen so that S1 * S2 = 2^22,
//                         nearly: 32767 for 128 and 16448 for 255. A constant picture comes out unchanged:
//                         |S1 * S2 - 2^22| <= 128 is at most 0.008 of a grey level.
// Filters    Weights sum to 2^14 on both axes, their absolute values to 3 times that at most: that of the filter which
//            makes B-spline coefficients, sqrt(3) sum |2 - sqrt(3)|^|n|; low-passes before it lessen it. First pass:
//            bytes to 64 per grey level, less 64 * 128, so |v| <= 3 * 64 * 128 = 24576 fits int16. Second pass:
//            |sum| <= 3 * 2^14 * 24576 < 2^31.
// Coefficients  What filters make: int16 in 1/16 of a grey level, less the middle grey 128; |c| <= 9 * 128 * 16, that
//            is 18432, for a low-pass alone 1.7^2 * 128 * 16 = 5919. Windows weigh them with weights of sum 2^14 on
//            both axes; absolute ones sum to 1.25 times that at most (cubic), to once for the B-spline: no sum exceeds
//            2^30.
// Fits       Least squares take int32: pixels and right-hand sides Q17, coefficients along x Q11, along both axes Q4 or
//            less (ls_fit.c); rotations Q31 (ls_axis.c); B-splines and their weights Q30 (ls_knots.h).
#ifndef WARP_FIXED_FIXED_H
#define WARP_FIXED_FIXED_H

#include <stdint.h>

enum {
    GRID_FRACTION_BITS = 18,
    PHASE_BITS = 7,
    PHASES = 1 << PHASE_BITS,
    FIRST_SUM = 128,
    SECOND_SUM = 32767,
    FIRST_SUM_POSITIVE = 255,
    SECOND_SUM_POSITIVE = 16448,
    SUM_SHIFT = 22,
    LONG_FIRST_SHIFT = 6, /**< long windows have as many bits more in the first pass, and lose them before the second */
    FILTER_SUM_LOG2 = 14,
    FILTER_FIRST_BITS = 6, /**< fraction bits after the first pass */
    COEFFICIENT_BITS = 4,  /**< fraction bits of coefficients */
    COEFFICIENT_MIDDLE = 128,
    COEFFICIENT_SUM_LOG2 = 14
};

/** 64 x 64 -> 128 bit products, for the geometry only. */
__extension__ typedef __int128 int128_t;
__extension__ typedef unsigned __int128 uint128_t;

/** @return x / 2^shift, rounded down; shift 0 to 63. Every compiler named in the README shifts arithmetically. */
static inline int64_t floor_shift(int64_t x, int shift)
{
    return x >> shift;
}

/** @return x / 2^shift to nearest, ties up; 1 <= shift <= 62, |x| < 2^62. */
static inline int64_t round_shift(int64_t x, int shift)
{
    return (x + ((int64_t)1 << (shift - 1))) >> shift;
}

static inline int32_t clamp_i32(int32_t x, int32_t low, int32_t high)
{
    return x < low ? low : x > high ? high : x;
}

/** @return a * b / 2^31 to nearest, ties up; not both -2^31. NEON: one vqrdmulh lane. */
static inline int32_t mul_q31(int32_t a, int32_t b)
{
    return (int32_t)(((int64_t)a * b + (1 << 30)) >> 31);
}

static inline int64_t clamp_i64(int64_t x, int64_t low, int64_t high)
{
    return x < low ? low : x > high ? high : x;
}

/** @return The second pass's sum as a grey level, 0 to 255. */
static inline uint8_t pixel_from_sum(int32_t sum)
{
    return (uint8_t)clamp_i32((sum + (1 << (SUM_SHIFT - 1))) >> SUM_SHIFT, 0, 255);
}

/** @return A value of so many fraction bits, less the middle grey, as a grey level, 0 to 255. */
static inline uint8_t pixel_from_centred(int32_t value, int fraction_bits)
{
    return (uint8_t)clamp_i32(((value + (1 << (fraction_bits - 1))) >> fraction_bits) + COEFFICIENT_MIDDLE, 0, 255);
}

/** @return The upper half of a * b. */
static inline uint64_t mul_high(uint64_t a, uint64_t b)
{
    return (uint64_t)((uint128_t)a * b >> 64);
}

/**
 * @return floor(sqrt(x)).
 *
 * For v in [1/4, 1) a parabola is within 1/32 of 1 / sqrt(v), and y (3 - v y^2) / 2 makes of an error e one of -1.5
 * e^2: after three times 2^-35. It is never too large but by what its products were cut by, less than 8 of 2^62. So v y
 * less that is the root or less, by less than one of its 32 bits.
 */
static inline uint32_t floor_sqrt(uint64_t x)
{
    if (x == 0)
        return 0;
    const uint64_t zeros = (uint64_t)__builtin_clzll(x) & ~(uint64_t)1;
    const uint64_t v = x << zeros, v_q31 = v >> 33;
    uint64_t y_q62 = ((uint64_t)171 << 56) - 105 * (v_q31 * (((uint64_t)1 << 32) - v_q31) >> 6);
    for (int i = 0; i < 3; i++)
        y_q62 = mul_high(y_q62, ((uint64_t)3 << 60) - mul_high(mul_high(y_q62, y_q62), v)) << 3;
    const uint64_t root = (mul_high(v, y_q62) - 8) >> (30 + zeros / 2);
    return (uint32_t)(root + (x - root * root > 2 * root));
}

/**
 * @return Where texel i of an axis of `size` texels is found when the picture is continued by half-sample mirroring:
 *         ... 1 0 | 0 1 ... size-1 | size-1 size-2 ...
 */
static inline int32_t mirror_index(int32_t i, int32_t size)
{
    const int32_t period = 2 * size;
    int32_t m = i < 0 ? -1 - i : i; /* two mirrors: one before the first texel ... */
    if (m >= period)
        m %= period;
    return m < size ? m : period - 1 - m; /* ... and one after the last */
}

#endif
