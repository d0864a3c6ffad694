// SPDX-License-Identifier: Apache-2.0
// Windows with more than WINDOW_SHORT_TAPS along either axis: eight columns at a time, with 16-bit weights.
//
// First-pass sums less their middle, 128 times the sum of weights, fit signed 16 bits whatever the weights' sign.
#include "warp_fixed/resample_long_neon.h"

#include <string.h>

#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/window_place_neon.h"
#include "warp_fixed/window_sums_neon.h"

enum { LANES = 8 };

/* How much less the first-pass sums are, and what the second pass begins with for that. */
typedef struct {
    int32_t middle, start;
} offset_t;

/* Tables of windows this long are area's and mean+cubic's. */
static offset_t offset_of(const window_t *window)
{
    const int32_t first_sum = window->x.negative ? FIRST_SUM : FIRST_SUM_POSITIVE;
    const int32_t second_sum = window->x.negative ? SECOND_SUM : SECOND_SUM_POSITIVE;
    return (offset_t){128 * first_sum, 128 * first_sum * second_sum};
}

/* First-pass sums of `columns` bytes, rounded up to whole vectors, into v. */
static inline void first_pass(int16_t *v, const uint8_t *texels, ptrdiff_t stride, const window_axis_t *y,
                              const int16_t *first, int32_t columns, int32_t middle)
{
    const int32x4_t start = vdupq_n_s32(((1 << y->first_shift) >> 1) - middle * (1 << y->first_shift));
    const int32x4_t shift = vdupq_n_s32(-y->first_shift);
    for (int32_t c = 0; c < columns; c += LANES) {
        int32x4_t low = start, high = start;
        const uint8_t *at = texels + c;
        for (int32_t t = 0; t < y->taps; t++, at += stride) {
            const int16x8_t wide = vreinterpretq_s16_u16(vmovl_u8(vld1_u8(at)));
            low = vmlal_n_s16(low, vget_low_s16(wide), first[t]);
            high = vmlal_n_s16(high, vget_high_s16(wide), first[t]);
        }
        vst1q_s16(v + c, vcombine_s16(vmovn_s32(vshlq_s32(low, shift)), vmovn_s32(vshlq_s32(high, shift))));
    }
}

/* pixel_from_sum() of four channels. */
static inline uint8x8_t pixel_from_sums(int32x4_t sums)
{
    const int16x4_t high = vshrn_n_s32(vaddq_s32(sums, vdupq_n_s32(1 << (SUM_SHIFT - 1))), 16);
    return vqshrun_n_s16(vcombine_s16(high, high), SUM_SHIFT - 16);
}

static void weigh_xrgb(uint8_t *out, const window_t *window, int32_t texel, const int16_t *first, const int16_t *second)
{
    int16_t v[4 * WINDOW_MAX_TAPS + LANES];
    const int32_t nx = window->x.taps;
    const offset_t offset = offset_of(window);
    first_pass(v, window->picture.data + texel, window->picture.stride, &window->y, first, 4 * nx, offset.middle);
    const uint8x8_t pixel = pixel_from_sums(window_sums_xrgb(v, second, nx, offset.start));
    memcpy(out, &pixel, 4);
}

void resample_long_xrgb_neon(const patch_t *patch, const window_t *window)
{
    const placed_loop_t loop = {weigh_xrgb, resample_window_xrgb_scalar, window->picture.stride,
                                (window->x.taps + 1) & -2, 4};
    weigh_placed(patch, window, &loop);
}

static void weigh_chroma(uint8_t *out, const window_t *window, int32_t texel, const int16_t *first,
                         const int16_t *second)
{
    int16_t v[2 * WINDOW_MAX_TAPS + 2 * LANES];
    const int32_t nx = window->x.taps;
    const offset_t offset = offset_of(window);
    first_pass(v, window->picture.data + texel, window->picture.stride, &window->y, first, 2 * nx, offset.middle);
    vst1q_s16(v + 2 * nx, vdupq_n_s16(0));
    const int32x4_t sums = window_sums_chroma(v, second, nx);
    const int32x2_t both = vadd_s32(vdup_n_s32(offset.start), vadd_s32(vget_low_s32(sums), vget_high_s32(sums)));
    const uint8x8_t pixel = pixel_from_sums(vcombine_s32(both, both));
    memcpy(out, &pixel, 2);
}

void resample_long_chroma_neon(const patch_t *patch, const window_t *window)
{
    const placed_loop_t loop = {weigh_chroma, resample_window_chroma_scalar, window->picture.stride,
                                (window->x.taps + 3) & -4, 2};
    weigh_placed(patch, window, &loop);
}

static void weigh_gray(uint8_t *out, const window_t *window, int32_t texel, const int16_t *first, const int16_t *second)
{
    int16_t v[WINDOW_MAX_TAPS + 2 * LANES];
    const int32_t nx = window->x.taps;
    const offset_t offset = offset_of(window);
    first_pass(v, window->picture.data + texel, window->picture.stride, &window->y, first, nx, offset.middle);
    vst1q_s16(v + nx, vdupq_n_s16(0));
    *out = pixel_from_sum(offset.start + vaddvq_s32(window_sums_gray(v, second, nx)));
}

void resample_long_gray_neon(const patch_t *patch, const window_t *window)
{
    const placed_loop_t loop = {weigh_gray, resample_window_gray_scalar, window->picture.stride,
                                (window->x.taps + LANES - 1) & -LANES, 1};
    weigh_placed(patch, window, &loop);
}
