// SPDX-License-Identifier: Apache-2.0
// The two passes of a symmetric FIR filter. That no sum overflows: see fixed.h.
#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_scalar.h"

static void filter_column_row(int16_t *restrict v, const uint8_t *const *rows, const fir_t *fir, int32_t count)
{
    const int32_t r = fir->radius, middle = COEFFICIENT_MIDDLE << FILTER_FIRST_BITS;
    for (int32_t x = 0; x < count; x++) {
        int32_t sum = fir->weight[0] * rows[r][x];
        for (int32_t d = 1; d <= r; d++)
            sum += fir->weight[d] * (rows[r - d][x] + rows[r + d][x]);
        v[x] = (int16_t)(round_shift(sum, FILTER_SUM_LOG2 - FILTER_FIRST_BITS) - middle);
    }
}

void filter_columns_scalar(int16_t *const v[FILTER_ROWS], const uint8_t *const *rows, const fir_t *fir, int32_t count)
{
    for (int i = 0; i < FILTER_ROWS; i++)
        filter_column_row(v[i], rows + i, fir, count);
}

static inline int32_t row_sum(const int16_t *v, const fir_t *fir, int32_t channels)
{
    int32_t sum = fir->weight[0] * v[0];
    for (int32_t d = 1; d <= fir->radius; d++)
        sum += fir->weight[d] * (v[-d * channels] + v[d * channels]);
    return sum;
}

void filter_row_scalar(int16_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                       int32_t channels)
{
    for (int32_t x = 0; x < count; x++)
        out[x] =
            (int16_t)round_shift(row_sum(v + x, fir, channels), FILTER_SUM_LOG2 + FILTER_FIRST_BITS - COEFFICIENT_BITS);
}

void filter_row_bytes_scalar(uint8_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                             int32_t channels)
{
    for (int32_t x = 0; x < count; x++)
        out[x] = pixel_from_centred(row_sum(v + x, fir, channels), FILTER_SUM_LOG2 + FILTER_FIRST_BITS);
}
