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

static void row_xrgb(uint8_t *out, const window_t *window, const int32_t *x_q18, const int32_t *y_q18, int32_t count)
{
    const ptrdiff_t stride = window->picture.stride;
    const int32_t nx = window->x.taps;
    const offset_t offset = offset_of(window);
    const placer_t placer = placer_of(window, (nx + 1) & -2, stride);
    int16_t v[4 * WINDOW_MAX_TAPS + LANES];
    places_t places;
    int32_t k = 0;
    for (; k + PLACE_STEP <= count; k += PLACE_STEP) {
        if (!find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
            const patch_t few = {out + (ptrdiff_t)k * 4, 0, x_q18 + k, y_q18 + k, PLACE_STEP, 1};
            resample_window_xrgb_scalar(&few, window);
            continue;
        }
        for (int i = 0; i < PLACE_STEP; i++) {
            const uint8_t *texels = window->picture.data + places.texel[i];
            first_pass(v, texels, stride, &window->y, window->y.first + places.row_y[i] * window->y.row, 4 * nx,
                       offset.middle);
            const int16_t *second = window->x.second + places.row_x[i] * window->x.row;
            const uint8x8_t pixel = pixel_from_sums(window_sums_xrgb(v, second, nx, offset.start));
            memcpy(out + (ptrdiff_t)(k + i) * 4, &pixel, 4);
        }
    }
    const patch_t few = {out + (ptrdiff_t)k * 4, 0, x_q18 + k, y_q18 + k, count - k, 1};
    resample_window_xrgb_scalar(&few, window);
}

void resample_long_xrgb_neon(const patch_t *patch, const window_t *window)
{
    for (int32_t r = 0; r < patch->height; r++)
        row_xrgb(patch->out + r * patch->stride, window, patch->x_q18 + r * PATCH_MAX_WIDTH,
                 patch->y_q18 + r * PATCH_MAX_WIDTH, patch->width);
}

static void row_chroma(uint8_t *out, const window_t *window, const int32_t *x_q18, const int32_t *y_q18, int32_t count)
{
    const ptrdiff_t stride = window->picture.stride;
    const int32_t nx = window->x.taps;
    const offset_t offset = offset_of(window);
    const placer_t placer = placer_of(window, (nx + 3) & -4, stride);
    int16_t v[2 * WINDOW_MAX_TAPS + 2 * LANES];
    places_t places;
    int32_t k = 0;
    for (; k + PLACE_STEP <= count; k += PLACE_STEP) {
        if (!find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
            const patch_t few = {out + (ptrdiff_t)k * 2, 0, x_q18 + k, y_q18 + k, PLACE_STEP, 1};
            resample_window_chroma_scalar(&few, window);
            continue;
        }
        for (int i = 0; i < PLACE_STEP; i++) {
            const uint8_t *texels = window->picture.data + places.texel[i];
            first_pass(v, texels, stride, &window->y, window->y.first + places.row_y[i] * window->y.row, 2 * nx,
                       offset.middle);
            vst1q_s16(v + 2 * nx, vdupq_n_s16(0));
            const int32x4_t sums = window_sums_chroma(v, window->x.second + places.row_x[i] * window->x.row, nx);
            const int32x2_t both =
                vadd_s32(vdup_n_s32(offset.start), vadd_s32(vget_low_s32(sums), vget_high_s32(sums)));
            const uint8x8_t pixel = pixel_from_sums(vcombine_s32(both, both));
            memcpy(out + (ptrdiff_t)(k + i) * 2, &pixel, 2);
        }
    }
    const patch_t few = {out + (ptrdiff_t)k * 2, 0, x_q18 + k, y_q18 + k, count - k, 1};
    resample_window_chroma_scalar(&few, window);
}

void resample_long_chroma_neon(const patch_t *patch, const window_t *window)
{
    for (int32_t r = 0; r < patch->height; r++)
        row_chroma(patch->out + r * patch->stride, window, patch->x_q18 + r * PATCH_MAX_WIDTH,
                   patch->y_q18 + r * PATCH_MAX_WIDTH, patch->width);
}

static void row_gray(uint8_t *out, const window_t *window, const int32_t *x_q18, const int32_t *y_q18, int32_t count)
{
    const ptrdiff_t stride = window->picture.stride;
    const int32_t nx = window->x.taps;
    const offset_t offset = offset_of(window);
    const placer_t placer = placer_of(window, (nx + LANES - 1) & -LANES, stride);
    int16_t v[WINDOW_MAX_TAPS + 2 * LANES];
    places_t places;
    int32_t k = 0;
    for (; k + PLACE_STEP <= count; k += PLACE_STEP) {
        if (!find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
            const patch_t few = {out + k, 0, x_q18 + k, y_q18 + k, PLACE_STEP, 1};
            resample_window_gray_scalar(&few, window);
            continue;
        }
        for (int i = 0; i < PLACE_STEP; i++) {
            const uint8_t *texels = window->picture.data + places.texel[i];
            first_pass(v, texels, stride, &window->y, window->y.first + places.row_y[i] * window->y.row, nx,
                       offset.middle);
            vst1q_s16(v + nx, vdupq_n_s16(0));
            const int16_t *second = window->x.second + places.row_x[i] * window->x.row;
            out[k + i] = pixel_from_sum(offset.start + vaddvq_s32(window_sums_gray(v, second, nx)));
        }
    }
    const patch_t few = {out + k, 0, x_q18 + k, y_q18 + k, count - k, 1};
    resample_window_gray_scalar(&few, window);
}

void resample_long_gray_neon(const patch_t *patch, const window_t *window)
{
    for (int32_t r = 0; r < patch->height; r++)
        row_gray(patch->out + r * patch->stride, window, patch->x_q18 + r * PATCH_MAX_WIDTH,
                 patch->y_q18 + r * PATCH_MAX_WIDTH, patch->width);
}
