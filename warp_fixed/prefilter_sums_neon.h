// SPDX-License-Identifier: Apache-2.0
// Sums of weighted 16-bit values, for both passes of a filter.
#ifndef WARP_FIXED_PREFILTER_SUMS_NEON_H
#define WARP_FIXED_PREFILTER_SUMS_NEON_H

#include <stdint.h>

#include "warp_fixed/neon.h"

enum { SUM_LANES = 8 };

/** 32-bit sums of SUM_LANES values. */
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

#endif
