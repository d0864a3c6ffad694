// SPDX-License-Identifier: Apache-2.0
// The second pass of a symmetric FIR filter: 32 sums of a row at a time.
//
// Sums of equal distance are added first and multiplied once wherever that fits 16 bits: always under a low-pass.
// Filters up to UNROLLED_RADIUS have loops of their own, with their weights in registers.
#include <stdbool.h>
#include <stddef.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/prefilter_sums_neon.h"

enum { ROW_STEP = 32, VECTORS = ROW_STEP / SUM_LANES, UNROLLED_RADIUS = FILTER_SLACK };

/* Sums of a step of a row. */
typedef struct {
    sums_t eight[VECTORS];
} row_sums_t;

NEON_INLINE row_sums_t row_sums(const int16_t *v, const int16_t *weights, int32_t radius, int32_t channels, bool pairs)
{
    row_sums_t sums;
    for (int i = 0; i < VECTORS; i++)
        sums.eight[i] = product(vld1q_s16(v + i * SUM_LANES), weights[0]);
    for (int32_t d = 1; d <= radius; d++) {
        const int16x8x4_t left = vld1q_s16_x4(v - d * channels), right = vld1q_s16_x4(v + d * channels);
        for (int i = 0; i < VECTORS; i++) {
            if (pairs) {
                sums.eight[i] = add_product(sums.eight[i], vaddq_s16(left.val[i], right.val[i]), weights[d]);
            } else {
                sums.eight[i] = add_product(sums.eight[i], left.val[i], weights[d]);
                sums.eight[i] = add_product(sums.eight[i], right.val[i], weights[d]);
            }
        }
    }
    return sums;
}

/* The same of four channels, with pairs. Two pixels are a vector: each is loaded once for all that need it. */
NEON_INLINE row_sums_t row_sums_xrgb(const int16_t *v, const int16_t *weights, int32_t radius)
{
    int16x8_t near[4 * UNROLLED_RADIUS]; /* near[UNROLLED_RADIUS + i] begins i pixels from v */
    const int16x8x4_t left = vld1q_s16_x4(v - 12);
    const int16x8x3_t right = vld1q_s16_x3(v + 20);
    for (int i = 0; i < 8; i++)
        near[2 * i] = vld1q_s16(v - 16 + 8 * i);
    for (int i = 0; i < 4; i++)
        near[2 * i + 1] = left.val[i];
    for (int i = 0; i < 3; i++)
        near[2 * i + 9] = right.val[i];
    row_sums_t sums;
    for (int i = 0; i < VECTORS; i++) {
        const int16x8_t *middle = near + UNROLLED_RADIUS + 2 * i;
        sums.eight[i] = product(middle[0], weights[0]);
        for (int32_t d = 1; d <= radius; d++)
            sums.eight[i] = add_product(sums.eight[i], vaddq_s16(middle[-d], middle[d]), weights[d]);
    }
    return sums;
}

/* Where the second pass writes: one of both, which the compiler knows. */
typedef struct {
    bool to_bytes;
    uint8_t *bytes;
    int16_t *coefficients;
} row_out_t;

static inline row_out_t next_step(row_out_t out)
{
    return out.to_bytes ? (row_out_t){true, out.bytes + ROW_STEP, NULL}
                        : (row_out_t){false, NULL, out.coefficients + ROW_STEP};
}

/* Both ways the shift is made with the narrowing to 16 bits; bytes take four bits more, and saturation, to 8. */
NEON_INLINE void store_row(row_out_t out, row_sums_t sums)
{
    _Static_assert(FILTER_SUM_LOG2 + FILTER_FIRST_BITS - COEFFICIENT_BITS == 16, "what is narrowed are coefficients");
    int16x8_t narrow[VECTORS];
    for (int i = 0; i < VECTORS; i++)
        narrow[i] = out.to_bytes ? upper_halves(sums.eight[i]) : rounded_upper_halves(sums.eight[i]);
    for (int i = 0; i < VECTORS; i++) {
        if (out.to_bytes) {
            const int16x8_t grey = vaddq_s16(narrow[i], vdupq_n_s16(COEFFICIENT_MIDDLE << COEFFICIENT_BITS));
            vst1_u8(out.bytes + i * SUM_LANES, vqrshrun_n_s16(grey, COEFFICIENT_BITS));
        } else {
            vst1q_s16(out.coefficients + i * SUM_LANES, narrow[i]);
        }
    }
}

NEON_INLINE void row_unrolled(row_out_t out, const int16_t *v, const fir_t *fir, int32_t radius, int32_t channels,
                              ptrdiff_t count)
{
    int16_t weights[UNROLLED_RADIUS + 1];
    for (int32_t d = 0; d <= radius; d++)
        weights[d] = fir->weight[d];
    const int16_t *const end = v + count;
    if (channels == 1)
        for (; v != end; v += ROW_STEP, out = next_step(out))
            store_row(out, row_sums(v, weights, radius, 1, true));
    else if (channels == 2)
        for (; v != end; v += ROW_STEP, out = next_step(out))
            store_row(out, row_sums(v, weights, radius, 2, true));
    else
        for (; v != end; v += ROW_STEP, out = next_step(out))
            store_row(out, row_sums_xrgb(v, weights, radius));
}

NEON_INLINE void row_rolled(row_out_t out, const int16_t *v, const fir_t *fir, int32_t channels, bool pairs,
                            ptrdiff_t count)
{
    for (const int16_t *const end = v + count; v != end; v += ROW_STEP, out = next_step(out))
        store_row(out, row_sums(v, fir->weight, fir->radius, channels, pairs));
}

/* A sum is at most half of the absolute weights' sum, a pair all of it; and one more for each rounding. */
static bool always_fit(const fir_t *fir)
{
    _Static_assert(COEFFICIENT_MIDDLE << (FILTER_FIRST_BITS + 1) == 1 << FILTER_SUM_LOG2, "half");
    int32_t size = 0;
    for (int32_t d = 0; d <= fir->radius; d++)
        size += (d == 0 ? 1 : 2) * (fir->weight[d] < 0 ? -fir->weight[d] : fir->weight[d]);
    return size + 2 <= INT16_MAX;
}

/* For splines no picture is sure to fit, but nearly all rows do: only fine stripes overshoot by half their contrast. */
static bool these_fit(const int16_t *v, ptrdiff_t count)
{
    int16x8_t largest = vabsq_s16(vld1q_s16(v + count - SUM_LANES));
    for (ptrdiff_t x = 0; x + SUM_LANES <= count; x += SUM_LANES)
        largest = vmaxq_s16(largest, vabsq_s16(vld1q_s16(v + x)));
    return vmaxvq_s16(largest) <= INT16_MAX / 2;
}

/* A multiple of ROW_STEP. */
NEON_INLINE void row_steps(row_out_t out, const int16_t *v, const fir_t *fir, int32_t channels, ptrdiff_t count)
{
    const ptrdiff_t edge = (ptrdiff_t)fir->radius * channels;
    if (!always_fit(fir) && !these_fit(v - edge, count + 2 * edge)) {
        row_rolled(out, v, fir, channels, false, count);
        return;
    }
    switch (fir->radius) {
    case 1:
        row_unrolled(out, v, fir, 1, channels, count);
        break;
    case 2:
        row_unrolled(out, v, fir, 2, channels, count);
        break;
    case 3:
        row_unrolled(out, v, fir, 3, channels, count);
        break;
    case 4:
        row_unrolled(out, v, fir, 4, channels, count);
        break;
    default:
        row_rolled(out, v, fir, channels, true, count);
    }
}

static void row_of_coefficients(int16_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t channels,
                                ptrdiff_t count)
{
    row_steps((row_out_t){false, NULL, out}, v, fir, channels, count);
}

static void row_of_bytes(uint8_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t channels,
                         ptrdiff_t count)
{
    row_steps((row_out_t){true, out, NULL}, v, fir, channels, count);
}

void filter_row_neon(int16_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                     int32_t channels)
{
    if (count < ROW_STEP) {
        filter_row_scalar(out, v, fir, count, channels);
        return;
    }
    const int32_t last = count - ROW_STEP;
    row_of_coefficients(out, v, fir, channels, count & -ROW_STEP);
    if (count % ROW_STEP != 0)
        row_of_coefficients(out + last, v + last, fir, channels, ROW_STEP);
}

void filter_row_bytes_neon(uint8_t *restrict out, const int16_t *restrict v, const fir_t *fir, int32_t count,
                           int32_t channels)
{
    if (count < ROW_STEP) {
        filter_row_bytes_scalar(out, v, fir, count, channels);
        return;
    }
    const int32_t last = count - ROW_STEP;
    row_of_bytes(out, v, fir, channels, count & -ROW_STEP);
    if (count % ROW_STEP != 0)
        row_of_bytes(out + last, v + last, fir, channels, ROW_STEP);
}
