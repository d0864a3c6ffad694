// SPDX-License-Identifier: Apache-2.0
// The two passes of a symmetric FIR filter, to bytes or to spline coefficients.
#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_scalar.h"

void prefilter_columns_scalar(int16_t *restrict v, const uint8_t *const *rows, const fir_t *fir, int32_t count)
{
    const int32_t r = fir->radius, half = (1 << fir->first_shift) >> 1, offset = fir->offset;
    for (int32_t x = 0; x < count; x++) {
        int32_t sum = fir->first[0] * rows[r][x];
        for (int32_t d = 1; d <= r; d++)
            sum += fir->first[d] * (rows[r - d][x] + rows[r + d][x]);
        v[x] = (int16_t)(((sum + half) >> fir->first_shift) - offset);
    }
}

/*
 * Absolute weights sum to 1.7 times the sum at most (kaiser at k = 1.37), so |v| <= 1.7 * 2^14 and |sum| <= 1.7 * 32767
 * * |v| < 2^31. The offset's share is added after the last 8 bits are gone, which changes nothing, since it and the
 * rounding have none set there.
 */
void prefilter_row_scalar(uint8_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                          int32_t channels)
{
    const int32_t middle = (PREFILTER_OFFSET * SECOND_SUM + (1 << (SUM_SHIFT - 1))) >> 8;
    for (int32_t x = 0; x < count; x++) {
        int32_t sum = fir->second[0] * v[x];
        for (int32_t d = 1; d <= fir->radius; d++)
            sum += fir->second[d] * (v[x - d * channels] + v[x + d * channels]);
        out[x] = (uint8_t)clamp_i32(((sum >> 8) + middle) >> (SUM_SHIFT - 8), 0, 255);
    }
}

void spline_row_scalar(int16_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                       int32_t channels)
{
    for (int32_t x = 0; x < count; x++) {
        int32_t sum = fir->second[0] * v[x];
        for (int32_t d = 1; d <= fir->radius; d++)
            sum += fir->second[d] * (v[x - d * channels] + v[x + d * channels]);
        out[x] = (int16_t)round_shift(sum, 16);
    }
}
