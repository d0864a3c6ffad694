// SPDX-License-Identifier: Apache-2.0
// Sums of weighted 16-bit values, for both passes of a filter.
#ifndef WARP_FIXED_PREFILTER_SUMS_NEON_H
#define WARP_FIXED_PREFILTER_SUMS_NEON_H

#include <stdint.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/neon.h"

enum { SUM_LANES = 8, FIRST_SHIFT = FILTER_SUM_LOG2 - FILTER_FIRST_BITS };

#ifdef __AVX2__

/** 32-bit sums of SUM_LANES values. */
typedef struct {
    __m256i all;
} sums_t;

static inline sums_t product(int16x8_t values, int16_t weight)
{
    return (sums_t){x86_eight_products(values, weight)};
}

static inline sums_t add_product(sums_t sums, int16x8_t values, int16_t weight)
{
    return (sums_t){x86_add_eight_products(sums.all, values, weight)};
}

/** @return Sums with FILTER_FIRST_BITS, rounded half up, modulo 2^16. */
static inline int16x8_t first_pass_sums(sums_t sums)
{
    return x86_eight_shifted(_mm256_add_epi32(sums.all, _mm256_set1_epi32(1 << (FIRST_SHIFT - 1))), FIRST_SHIFT);
}

/** @return Sums / 2^16, rounded half up, modulo 2^16. */
static inline int16x8_t rounded_upper_halves(sums_t sums)
{
    return x86_eight_shifted(_mm256_add_epi32(sums.all, _mm256_set1_epi32(1 << 15)), 16);
}

/** @return Sums / 2^16, rounded down. */
static inline int16x8_t upper_halves(sums_t sums)
{
    return x86_eight_shifted(sums.all, 16);
}

#else

typedef struct {
    int32x4_t low, high;
} sums_t;

static inline sums_t product(int16x8_t values, int16_t weight)
{
    return (sums_t){vmull_n_s16(vget_low_s16(values), weight), vmull_high_s16(values, vdupq_n_s16(weight))};
}

static inline sums_t add_product(sums_t sums, int16x8_t values, int16_t weight)
{
    return (sums_t){vmlal_n_s16(sums.low, vget_low_s16(values), weight), vmlal_high_n_s16(sums.high, values, weight)};
}

static inline int16x8_t first_pass_sums(sums_t sums)
{
    return vcombine_s16(vrshrn_n_s32(sums.low, FIRST_SHIFT), vrshrn_n_s32(sums.high, FIRST_SHIFT));
}

static inline int16x8_t rounded_upper_halves(sums_t sums)
{
    return vcombine_s16(vrshrn_n_s32(sums.low, 16), vrshrn_n_s32(sums.high, 16));
}

static inline int16x8_t upper_halves(sums_t sums)
{
    return vcombine_s16(vshrn_n_s32(sums.low, 16), vshrn_n_s32(sums.high, 16));
}

#endif

#endif
