// SPDX-License-Identifier: Apache-2.0
// Windows of coefficients with more than WINDOW_SHORT_TAPS along either axis: eight columns at a time.
#include <string.h>

#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/resample_long_neon.h"
#include "warp_fixed/window_place_neon.h"
#include "warp_fixed/window_sums_neon.h"

enum { LANES = 8, SHIFT = COEFFICIENT_SUM_LOG2 + COEFFICIENT_BITS, ROUNDING = 1 << (SHIFT - 1) };

/* Weighed columns fit 16 bits again: 1.25 times a low-pass's 5919, or 18432 under a B-spline (fixed.h). */
static inline void first_pass(int16_t *v, const int16_t *coefficients, ptrdiff_t stride, const int16_t *first,
                              int32_t taps, int32_t columns)
{
    for (int32_t c = 0; c < columns; c += LANES) {
        int32x4_t low = vdupq_n_s32(0), high = low;
        const int16_t *at = coefficients + c;
        for (int32_t t = 0; t < taps; t++, at += stride) {
            const int16x8_t row = vld1q_s16(at);
            low = vmlal_n_s16(low, vget_low_s16(row), first[t]);
            high = vmlal_n_s16(high, vget_high_s16(row), first[t]);
        }
        vst1q_s16(v + c,
                  vcombine_s16(vrshrn_n_s32(low, COEFFICIENT_SUM_LOG2), vrshrn_n_s32(high, COEFFICIENT_SUM_LOG2)));
    }
}

/* As pixel_from_centred(): the middle grey goes in before the shift, which is made in two (the second saturates). */
static inline uint8x8_t pixels_from_sums(int32x4_t sums)
{
    const int32x4_t whole = vaddq_s32(sums, vdupq_n_s32((COEFFICIENT_MIDDLE << SHIFT) + ROUNDING));
    const int16x4_t high = vshrn_n_s32(whole, 16);
    return vqshrun_n_s16(vcombine_s16(high, high), SHIFT - 16);
}

static void weigh_xrgb(uint8_t *out, const window_t *window, int32_t texel, const int16_t *first, const int16_t *second)
{
    int16_t v[4 * WINDOW_MAX_TAPS + LANES];
    const int32_t nx = window->x.taps;
    first_pass(v, window->coefficients.data + texel, (ptrdiff_t)window->coefficients.width * 4, first, window->y.taps,
               4 * nx);
    const uint8x8_t pixel = pixels_from_sums(window_sums_xrgb(v, second, nx, 0));
    memcpy(out, &pixel, 4);
}

void resample_long_coefficients_xrgb_neon(const patch_t *patch, const window_t *window)
{
    const placed_loop_t loop = {weigh_xrgb, resample_coefficients_xrgb_scalar,
                                (ptrdiff_t)window->coefficients.width * 4, (window->x.taps + 1) & -2, 4};
    weigh_placed(patch, window, &loop);
}

static void weigh_chroma(uint8_t *out, const window_t *window, int32_t texel, const int16_t *first,
                         const int16_t *second)
{
    int16_t v[2 * WINDOW_MAX_TAPS + 2 * LANES];
    const int32_t nx = window->x.taps;
    first_pass(v, window->coefficients.data + texel, (ptrdiff_t)window->coefficients.width * 2, first, window->y.taps,
               2 * nx);
    vst1q_s16(v + 2 * nx, vdupq_n_s16(0));
    const int32x4_t sums = window_sums_chroma(v, second, nx);
    const int32x2_t both = vadd_s32(vget_low_s32(sums), vget_high_s32(sums));
    const uint8x8_t pixel = pixels_from_sums(vcombine_s32(both, both));
    memcpy(out, &pixel, 2);
}

void resample_long_coefficients_chroma_neon(const patch_t *patch, const window_t *window)
{
    const placed_loop_t loop = {weigh_chroma, resample_coefficients_chroma_scalar,
                                (ptrdiff_t)window->coefficients.width * 2, (window->x.taps + 3) & -4, 2};
    weigh_placed(patch, window, &loop);
}

static void weigh_gray(uint8_t *out, const window_t *window, int32_t texel, const int16_t *first, const int16_t *second)
{
    int16_t v[WINDOW_MAX_TAPS + 2 * LANES];
    const int32_t nx = window->x.taps;
    first_pass(v, window->coefficients.data + texel, (ptrdiff_t)window->coefficients.width, first, window->y.taps, nx);
    vst1q_s16(v + nx, vdupq_n_s16(0));
    *out = pixel_from_centred(vaddvq_s32(window_sums_gray(v, second, nx)), SHIFT);
}

void resample_long_coefficients_gray_neon(const patch_t *patch, const window_t *window)
{
    const placed_loop_t loop = {weigh_gray, resample_coefficients_gray_scalar, (ptrdiff_t)window->coefficients.width,
                                (window->x.taps + LANES - 1) & -LANES, 1};
    weigh_placed(patch, window, &loop);
}
