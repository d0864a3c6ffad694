// SPDX-License-Identifier: Apache-2.0
// The two passes of a symmetric FIR filter: sixteen columns, or eight sums of a row, at a time.
#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/neon.h"

enum { COLUMNS = 16, ROW_STEP = 8, FIRST_SHIFT = FILTER_SUM_LOG2 - FILTER_FIRST_BITS };

/* 32-bit sums of eight neighbours. */
typedef struct {
    int32x4_t low, high;
} sums_t;

static inline sums_t add_products(sums_t sums, int16x8_t values, int16_t weight)
{
    return (sums_t){vmlal_n_s16(sums.low, vget_low_s16(values), weight),
                    vmlal_n_s16(sums.high, vget_high_s16(values), weight)};
}

/* The middle grey goes out before the shift, as a multiple of what is shifted out. */
static inline void sixteen_columns(int16_t *v, const uint8_t *const *rows, const fir_t *fir, int32_t x)
{
    const int32_t r = fir->radius;
    const int32x4_t start = vdupq_n_s32((1 << (FIRST_SHIFT - 1)) - (COEFFICIENT_MIDDLE << FILTER_SUM_LOG2));
    const uint8x16_t middle = vld1q_u8(rows[r] + x);
    sums_t low = {start, start}, high = {start, start};
    low = add_products(low, vreinterpretq_s16_u16(vmovl_u8(vget_low_u8(middle))), fir->weight[0]);
    high = add_products(high, vreinterpretq_s16_u16(vmovl_u8(vget_high_u8(middle))), fir->weight[0]);
    for (int32_t d = 1; d <= r; d++) {
        const uint8x16_t above = vld1q_u8(rows[r - d] + x), below = vld1q_u8(rows[r + d] + x);
        const uint16x8_t left = vaddl_u8(vget_low_u8(above), vget_low_u8(below));
        const uint16x8_t right = vaddl_u8(vget_high_u8(above), vget_high_u8(below));
        low = add_products(low, vreinterpretq_s16_u16(left), fir->weight[d]);
        high = add_products(high, vreinterpretq_s16_u16(right), fir->weight[d]);
    }
    vst1q_s16(v + x, vcombine_s16(vshrn_n_s32(low.low, FIRST_SHIFT), vshrn_n_s32(low.high, FIRST_SHIFT)));
    vst1q_s16(v + x + 8, vcombine_s16(vshrn_n_s32(high.low, FIRST_SHIFT), vshrn_n_s32(high.high, FIRST_SHIFT)));
}

void filter_columns_neon(int16_t *restrict v, const uint8_t *const *rows, const fir_t *fir, int32_t count)
{
    const int32_t whole = count & -COLUMNS, rest = count - whole;
    for (int32_t x = 0; x < whole; x += COLUMNS)
        sixteen_columns(v, rows, fir, x);
    const uint8_t *rest_rows[2 * PREFILTER_MAX_RADIUS + 1];
    for (int32_t i = 0; rest > 0 && i <= 2 * fir->radius; i++)
        rest_rows[i] = rows[i] + whole;
    filter_columns_scalar(v + whole, rest_rows, fir, rest);
}

/* start + the sums of eight outputs, without their last 16 bits. */
static inline int16x8_t row_sums(const int16_t *v, const fir_t *fir, int32_t channels, int32_t start)
{
    sums_t sums = {vdupq_n_s32(start), vdupq_n_s32(start)};
    sums = add_products(sums, vld1q_s16(v), fir->weight[0]);
    for (int32_t d = 1; d <= fir->radius; d++) {
        sums = add_products(sums, vld1q_s16(v - d * channels), fir->weight[d]);
        sums = add_products(sums, vld1q_s16(v + d * channels), fir->weight[d]);
    }
    return vcombine_s16(vshrn_n_s32(sums.low, 16), vshrn_n_s32(sums.high, 16));
}

void filter_row_neon(int16_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                     int32_t channels)
{
    _Static_assert(FILTER_SUM_LOG2 + FILTER_FIRST_BITS - COEFFICIENT_BITS == 16, "row_sums() makes coefficients");
    int32_t x = 0;
    for (; x + ROW_STEP <= count; x += ROW_STEP)
        vst1q_s16(out + x, row_sums(v + x, fir, channels, 1 << 15));
    filter_row_scalar(out + x, v + x, fir, count - x, channels);
}

/* The middle grey makes sums of 1.3 * 2^30 at most. The shift is made in two, the second with saturation. */
void filter_row_bytes_neon(uint8_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                           int32_t channels)
{
    enum { SHIFT = FILTER_SUM_LOG2 + FILTER_FIRST_BITS };
    const int32_t start = (COEFFICIENT_MIDDLE << SHIFT) + (1 << (SHIFT - 1));
    int32_t x = 0;
    for (; x + ROW_STEP <= count; x += ROW_STEP)
        vst1_u8(out + x, vqshrun_n_s16(row_sums(v + x, fir, channels, start), SHIFT - 16));
    filter_row_bytes_scalar(out + x, v + x, fir, count - x, channels);
}
