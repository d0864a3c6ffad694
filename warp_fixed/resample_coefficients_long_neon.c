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

static void row_xrgb(uint8_t *out, const window_t *window, const int32_t *x_q18, const int32_t *y_q18, int32_t count)
{
    const ptrdiff_t stride = (ptrdiff_t)window->coefficients.width * 4;
    const int32_t nx = window->x.taps, ny = window->y.taps;
    const placer_t placer = placer_of(window, (nx + 1) & -2, stride);
    int16_t v[4 * WINDOW_MAX_TAPS + LANES];
    places_t places;
    int32_t k = 0;
    for (; k + PLACE_STEP <= count; k += PLACE_STEP) {
        if (!find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
            const patch_t few = {out + (ptrdiff_t)k * 4, 0, x_q18 + k, y_q18 + k, PLACE_STEP, 1};
            resample_coefficients_xrgb_scalar(&few, window);
            continue;
        }
        for (int i = 0; i < PLACE_STEP; i++) {
            const int16_t *corner = window->coefficients.data + places.texel[i];
            first_pass(v, corner, stride, window->y.first + places.row_y[i] * window->y.row, ny, 4 * nx);
            const int32x4_t sums = window_sums_xrgb(v, window->x.second + places.row_x[i] * window->x.row, nx, 0);
            const uint8x8_t pixel = pixels_from_sums(sums);
            memcpy(out + (ptrdiff_t)(k + i) * 4, &pixel, 4);
        }
    }
    const patch_t few = {out + (ptrdiff_t)k * 4, 0, x_q18 + k, y_q18 + k, count - k, 1};
    resample_coefficients_xrgb_scalar(&few, window);
}

void resample_long_coefficients_xrgb_neon(const patch_t *patch, const window_t *window)
{
    for (int32_t r = 0; r < patch->height; r++)
        row_xrgb(patch->out + r * patch->stride, window, patch->x_q18 + r * PATCH_MAX_WIDTH,
                 patch->y_q18 + r * PATCH_MAX_WIDTH, patch->width);
}

static void row_chroma(uint8_t *out, const window_t *window, const int32_t *x_q18, const int32_t *y_q18, int32_t count)
{
    const ptrdiff_t stride = (ptrdiff_t)window->coefficients.width * 2;
    const int32_t nx = window->x.taps, ny = window->y.taps;
    const placer_t placer = placer_of(window, (nx + 3) & -4, stride);
    int16_t v[2 * WINDOW_MAX_TAPS + 2 * LANES];
    places_t places;
    int32_t k = 0;
    for (; k + PLACE_STEP <= count; k += PLACE_STEP) {
        if (!find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
            const patch_t few = {out + (ptrdiff_t)k * 2, 0, x_q18 + k, y_q18 + k, PLACE_STEP, 1};
            resample_coefficients_chroma_scalar(&few, window);
            continue;
        }
        for (int i = 0; i < PLACE_STEP; i++) {
            const int16_t *corner = window->coefficients.data + places.texel[i];
            first_pass(v, corner, stride, window->y.first + places.row_y[i] * window->y.row, ny, 2 * nx);
            vst1q_s16(v + 2 * nx, vdupq_n_s16(0));
            const int32x4_t sums = window_sums_chroma(v, window->x.second + places.row_x[i] * window->x.row, nx);
            const int32x2_t both = vadd_s32(vget_low_s32(sums), vget_high_s32(sums));
            const uint8x8_t pixel = pixels_from_sums(vcombine_s32(both, both));
            memcpy(out + (ptrdiff_t)(k + i) * 2, &pixel, 2);
        }
    }
    const patch_t few = {out + (ptrdiff_t)k * 2, 0, x_q18 + k, y_q18 + k, count - k, 1};
    resample_coefficients_chroma_scalar(&few, window);
}

void resample_long_coefficients_chroma_neon(const patch_t *patch, const window_t *window)
{
    for (int32_t r = 0; r < patch->height; r++)
        row_chroma(patch->out + r * patch->stride, window, patch->x_q18 + r * PATCH_MAX_WIDTH,
                   patch->y_q18 + r * PATCH_MAX_WIDTH, patch->width);
}

static void row_gray(uint8_t *out, const window_t *window, const int32_t *x_q18, const int32_t *y_q18, int32_t count)
{
    const ptrdiff_t stride = window->coefficients.width;
    const int32_t nx = window->x.taps, ny = window->y.taps;
    const placer_t placer = placer_of(window, (nx + LANES - 1) & -LANES, stride);
    int16_t v[WINDOW_MAX_TAPS + 2 * LANES];
    places_t places;
    int32_t k = 0;
    for (; k + PLACE_STEP <= count; k += PLACE_STEP) {
        if (!find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
            const patch_t few = {out + k, 0, x_q18 + k, y_q18 + k, PLACE_STEP, 1};
            resample_coefficients_gray_scalar(&few, window);
            continue;
        }
        int32x4_t sums[PLACE_STEP];
        for (int i = 0; i < PLACE_STEP; i++) {
            const int16_t *corner = window->coefficients.data + places.texel[i];
            first_pass(v, corner, stride, window->y.first + places.row_y[i] * window->y.row, ny, nx);
            vst1q_s16(v + nx, vdupq_n_s16(0));
            sums[i] = window_sums_gray(v, window->x.second + places.row_x[i] * window->x.row, nx);
        }
        const uint8x8_t pixels =
            pixels_from_sums(vpaddq_s32(vpaddq_s32(sums[0], sums[1]), vpaddq_s32(sums[2], sums[3])));
        memcpy(out + k, &pixels, PLACE_STEP);
    }
    const patch_t few = {out + k, 0, x_q18 + k, y_q18 + k, count - k, 1};
    resample_coefficients_gray_scalar(&few, window);
}

void resample_long_coefficients_gray_neon(const patch_t *patch, const window_t *window)
{
    for (int32_t r = 0; r < patch->height; r++)
        row_gray(patch->out + r * patch->stride, window, patch->x_q18 + r * PATCH_MAX_WIDTH,
                 patch->y_q18 + r * PATCH_MAX_WIDTH, patch->width);
}
