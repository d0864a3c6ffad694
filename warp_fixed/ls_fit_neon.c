// SPDX-License-Identifier: Apache-2.0
// The least-squares fit of a strip, four lanes at a time.
#include <stddef.h>
#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/neon.h"

enum { LANES = 4 };

/* From bytes to Q17 in two widenings. */
static inline void store_pixels(int32_t *data, uint8x16_t bytes)
{
    enum { FIRST = 7, SECOND = LS_PIXEL_BITS - FIRST };
    const uint16x8_t low = vshll_n_u8(vget_low_u8(bytes), FIRST), high = vshll_n_u8(vget_high_u8(bytes), FIRST);
    vst1q_s32(data, vreinterpretq_s32_u32(vshll_n_u16(vget_low_u16(low), SECOND)));
    vst1q_s32(data + 4, vreinterpretq_s32_u32(vshll_n_u16(vget_high_u16(low), SECOND)));
    vst1q_s32(data + 8, vreinterpretq_s32_u32(vshll_n_u16(vget_low_u16(high), SECOND)));
    vst1q_s32(data + 12, vreinterpretq_s32_u32(vshll_n_u16(vget_high_u16(high), SECOND)));
}

void ls_pixels_gray_neon(int32_t *restrict data, const uint8_t *const *rows, int32_t x)
{
    uint8_t bytes[LS_LANES];
    for (int row = 0; row < LS_LANES; row++)
        bytes[row] = rows[row][x];
    store_pixels(data, vld1q_u8(bytes));
}

void ls_pixels_chroma_neon(int32_t *restrict data, const uint8_t *const *rows, int32_t x)
{
    uint8_t bytes[LS_LANES];
    for (int row = 0; row < LS_LANES / 2; row++)
        memcpy(bytes + 2 * row, rows[row] + (ptrdiff_t)x * 2, 2);
    store_pixels(data, vld1q_u8(bytes));
}

void ls_pixels_xrgb_neon(int32_t *restrict data, const uint8_t *const *rows, int32_t x)
{
    uint8_t bytes[LS_LANES];
    for (int row = 0; row < LS_LANES / 4; row++)
        memcpy(bytes + 4 * row, rows[row] + (ptrdiff_t)x * 4, 4);
    store_pixels(data, vld1q_u8(bytes));
}

/* The shift saturates to -2^31 too, which is no coefficient. */
void ls_scale_neon(int32_t *restrict to, const int32_t *restrict from, const int32_t *restrict shift)
{
    for (int lane = 0; lane < LS_LANES; lane += LANES) {
        const int32x4_t scaled = shift_saturated(vld1q_s32(from + lane), vld1q_s32(shift + lane));
        vst1q_s32(to + lane, vmaxq_s32(scaled, vdupq_n_s32(-INT32_MAX)));
    }
}

/* vqrdmulhq_s32() is mul_q31(): (2 a b + 2^31) / 2^32, rounded down. */
void ls_forward_neon(int32_t *restrict z, const int32_t *restrict data, const ls_equation_t *equation)
{
    for (int lane = 0; lane < LS_LANES; lane += LANES) {
        int32x4_t d = vqrdmulhq_n_s32(vld1q_s32(data + lane), equation->scale_q31);
        for (int t = 0; t < LS_TAPS; t++) {
            const int32_t cos = equation->cos_q31[t], sin = equation->sin_q31[t];
            const int32x4_t old = vld1q_s32(z + t * LS_LANES + lane);
            vst1q_s32(z + t * LS_LANES + lane, vaddq_s32(vqrdmulhq_n_s32(old, cos), vqrdmulhq_n_s32(d, sin)));
            d = vsubq_s32(vqrdmulhq_n_s32(d, cos), vqrdmulhq_n_s32(old, sin));
        }
    }
}

/* Narrowing saturates to -2^31 to 2^31 - 1; -2^31 itself is no coefficient. */
void ls_backward_neon(int32_t *row, const ls_solution_t *solution)
{
    const int64x2_t shift = vdupq_n_s64(-solution->shift);
    const int64x2_t half = vdupq_n_s64((int64_t)1 << (solution->shift - 1));
    for (int lane = 0; lane < LS_LANES; lane += LANES) {
        const int32x4_t own = vld1q_s32(row + lane);
        int64x2_t low = vmlal_n_s32(half, vget_low_s32(own), solution->own);
        int64x2_t high = vmlal_n_s32(half, vget_high_s32(own), solution->own);
        for (int t = 0; t < LS_TAPS - 1; t++) {
            const int32x4_t next = vld1q_s32(row + (t + 1) * LS_LANES + lane);
            low = vmlal_n_s32(low, vget_low_s32(next), solution->next[t]);
            high = vmlal_n_s32(high, vget_high_s32(next), solution->next[t]);
        }
        const int32x4_t sums = vcombine_s32(vqmovn_s64(vshlq_s64(low, shift)), vqmovn_s64(vshlq_s64(high, shift)));
        vst1q_s32(row + lane, vmaxq_s32(sums, vdupq_n_s32(-INT32_MAX)));
    }
}
