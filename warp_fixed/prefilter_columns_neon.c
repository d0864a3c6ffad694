// SPDX-License-Identifier: Apache-2.0
// The first pass of a symmetric FIR filter: 16 columns of two rows at a time.
//
// Bytes of equal distance are added first and multiplied once. A72: its one port for multiplications is always busy.
// Radii of short low-passes, and the one of splines alone, have loops of their own, with their weights in registers.
#include <stddef.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/prefilter_sums_neon.h"

enum { COLUMNS = 2 * SUM_LANES, SPLINES_RADIUS = 8 };

_Static_assert(FILTER_ROWS == 2, "an upper and a lower one");

/* Of sixteen columns of one row. */
typedef struct {
    sums_t left, right;
} columns_t;

static inline columns_t column_products(uint8x16_t bytes, int16_t weight)
{
    return (columns_t){product(vreinterpretq_s16_u16(vmovl_u8(vget_low_u8(bytes))), weight),
                       product(vreinterpretq_s16_u16(vmovl_high_u8(bytes)), weight)};
}

static inline columns_t add_pairs(columns_t sums, uint8x16_t above, uint8x16_t below, int16_t weight)
{
    const uint16x8_t left = vaddl_u8(vget_low_u8(above), vget_low_u8(below)), right = vaddl_high_u8(above, below);
    return (columns_t){add_product(sums.left, vreinterpretq_s16_u16(left), weight),
                       add_product(sums.right, vreinterpretq_s16_u16(right), weight)};
}

static inline int16x8_t first_pass(sums_t sums)
{
    return vsubq_s16(first_pass_sums(sums), vdupq_n_s16(COEFFICIENT_MIDDLE << FILTER_FIRST_BITS));
}

static inline void store_columns(int16_t *v, columns_t sums)
{
    vst1q_s16(v, first_pass(sums.left));
    vst1q_s16(v + SUM_LANES, first_pass(sums.right));
}

/* What is below the upper row's pair at some distance is above the lower row's at the next. */
NEON_INLINE void sixteen_columns(int16_t *upper, int16_t *lower, const uint8_t *const *rows, const int16_t *weights,
                                 int32_t radius, ptrdiff_t x)
{
    uint8x16_t above = vld1q_u8(rows[radius] + x), below = vld1q_u8(rows[radius + 1] + x);
    columns_t up = column_products(above, weights[0]), low = column_products(below, weights[0]);
    for (int32_t d = 1; d <= radius; d++) {
        const uint8x16_t next_above = vld1q_u8(rows[radius - d] + x), next_below = vld1q_u8(rows[radius + 1 + d] + x);
        up = add_pairs(up, next_above, below, weights[d]);
        low = add_pairs(low, above, next_below, weights[d]);
        above = next_above;
        below = next_below;
    }
    store_columns(upper, up);
    store_columns(lower, low);
}

NEON_INLINE void columns_unrolled(int16_t *const v[FILTER_ROWS], const uint8_t *const *rows, const fir_t *fir,
                                  int32_t radius, ptrdiff_t begin, ptrdiff_t end)
{
    int16_t *restrict upper = v[0] + begin, *restrict lower = v[1] + begin;
    const uint8_t *row[2 * SPLINES_RADIUS + FILTER_ROWS];
    int16_t weights[SPLINES_RADIUS + 1];
    for (int32_t i = 0; i < 2 * radius + FILTER_ROWS; i++)
        row[i] = rows[i];
    for (int32_t d = 0; d <= radius; d++)
        weights[d] = fir->weight[d];
    for (ptrdiff_t x = begin; x < end; x += COLUMNS, upper += COLUMNS, lower += COLUMNS)
        sixteen_columns(upper, lower, row, weights, radius, x);
}

static void columns(int16_t *const v[FILTER_ROWS], const uint8_t *const *rows, const fir_t *fir, ptrdiff_t begin,
                    ptrdiff_t end)
{
    switch (fir->radius) {
    case 1:
        columns_unrolled(v, rows, fir, 1, begin, end);
        break;
    case 2:
        columns_unrolled(v, rows, fir, 2, begin, end);
        break;
    case 3:
        columns_unrolled(v, rows, fir, 3, begin, end);
        break;
    case 4:
        columns_unrolled(v, rows, fir, 4, begin, end);
        break;
    case SPLINES_RADIUS:
        columns_unrolled(v, rows, fir, SPLINES_RADIUS, begin, end);
        break;
    default:
        for (ptrdiff_t x = begin; x < end; x += COLUMNS)
            sixteen_columns(v[0] + x, v[1] + x, rows, fir->weight, fir->radius, x);
    }
}

/* The last step ends with the row, wherever it begins. */
void filter_columns_neon(int16_t *const v[FILTER_ROWS], const uint8_t *const *rows, const fir_t *fir, int32_t count)
{
    if (count < COLUMNS) {
        filter_columns_scalar(v, rows, fir, count);
        return;
    }
    columns(v, rows, fir, 0, count & -COLUMNS);
    if (count % COLUMNS != 0)
        columns(v, rows, fir, count - COLUMNS, count);
}
