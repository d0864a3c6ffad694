// SPDX-License-Identifier: Apache-2.0
// A window of XRGB texels around each point: short windows, with a loop for each number of columns and rows.
#include <stdbool.h>
#include <stddef.h>

#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/resample_cubic_neon.h"
#include "warp_fixed/resample_linear_neon.h"
#include "warp_fixed/resample_long_neon.h"
#include "warp_fixed/window_ahead.h"
#include "warp_fixed/window_texels_neon.h"
#ifdef __AVX2__
#include "warp_fixed/resample_window_avx2.h"
#endif

/* sums + weights[lane] * values of one pixel's four channels. */
#define ADD_PIXEL(sums, values, weights, lane, negative)                                                               \
    ((negative) ? vmlal_lane_s16(sums, values, weights, lane)                                                          \
                : vreinterpretq_s32_u32(vmlal_lane_u16(vreinterpretq_u32_s32(sums), vreinterpret_u16_s16(values),      \
                                                       vreinterpret_u16_s16(weights), lane)))

/* weights[0] * values. */
NEON_INLINE int32x4_t first_pixel(int16x4_t values, int16x4_t weights, bool negative)
{
    return negative
               ? vmull_lane_s16(values, weights, 0)
               : vreinterpretq_s32_u32(vmull_lane_u16(vreinterpret_u16_s16(values), vreinterpret_u16_s16(weights), 0));
}

/* The first row of nx pixels, as sums of pairs of columns. */
NEON_INLINE void first_row_xrgb(int16x8_t *v, const uint8_t *texels, uint8x16_t weight, int32_t nx, bool negative)
{
    for (int32_t pair = 0; 2 * pair < nx; pair += 2) {
        if (nx <= 2 * pair + 2) {
            v[pair] = products(vld1_u8(texels + 8 * pair), vget_low_u8(weight), negative);
        } else {
            const uint8x16_t four = vld1q_u8(texels + 8 * pair);
            v[pair] = products(vget_low_u8(four), vget_low_u8(weight), negative);
            v[pair + 1] = products(vget_high_u8(four), vget_high_u8(weight), negative);
        }
    }
}

/* Another row. */
NEON_INLINE void add_row_xrgb(int16x8_t *v, const uint8_t *texels, uint8x16_t weight, int32_t nx, bool negative)
{
    for (int32_t pair = 0; 2 * pair < nx; pair += 2) {
        if (nx <= 2 * pair + 2) {
            v[pair] = add_products(v[pair], vld1_u8(texels + 8 * pair), vget_low_u8(weight), negative);
        } else {
            const uint8x16_t four = vld1q_u8(texels + 8 * pair);
            v[pair] = add_products(v[pair], vget_low_u8(four), vget_low_u8(weight), negative);
            v[pair + 1] = add_products(v[pair + 1], vget_high_u8(four), vget_high_u8(weight), negative);
        }
    }
}

/* Second-pass sums of one pixel, negated where weights are negative. */
NEON_INLINE int32x4_t weigh_xrgb(one_window_t one, ptrdiff_t stride, int32_t nx, int32_t ny, bool negative)
{
    const splats_t splats = load_splats(one.first, ny);
    int16x8_t v[WINDOW_SHORT_TAPS / 2];
    first_row_xrgb(v, one.texels, splats.row[0], nx, negative);
    for (int t = 1; t < ny; t++)
        add_row_xrgb(v, one.texels + t * stride, splats.row[t], nx, negative);

    const int16x8_t weights = vreinterpretq_s16_u8(vld1q_u8(one.second));
    const int16x4_t left = vget_low_s16(weights), right = vget_high_s16(weights);
    int32x4_t sums = first_pixel(vget_low_s16(v[0]), left, negative);
    sums = ADD_PIXEL(sums, vget_high_s16(v[0]), left, 1, negative);
    if (nx > 2)
        sums = ADD_PIXEL(sums, vget_low_s16(v[1]), left, 2, negative);
    if (nx > 3)
        sums = ADD_PIXEL(sums, vget_high_s16(v[1]), left, 3, negative);
    if (nx > 4)
        sums = ADD_PIXEL(sums, vget_low_s16(v[2]), right, 0, negative);
    if (nx > 5)
        sums = ADD_PIXEL(sums, vget_high_s16(v[2]), right, 1, negative);
    if (nx > 6)
        sums = ADD_PIXEL(sums, vget_low_s16(v[3]), right, 2, negative);
    if (nx > 7)
        sums = ADD_PIXEL(sums, vget_high_s16(v[3]), right, 3, negative);
    return sums;
}

/* Four pixels. */
NEON_INLINE uint8x16_t four_xrgb(const one_window_t *origin, const window_step_t *step, ptrdiff_t stride, int32_t nx,
                                 int32_t ny, bool negative)
{
#ifdef __AVX2__
    if (!negative)
        return four_positive_xrgb(origin, step, stride, nx, ny);
#endif
    const int32x4_t a = weigh_xrgb(nth_window(origin, step, 0), stride, nx, ny, negative);
    const int32x4_t b = weigh_xrgb(nth_window(origin, step, 1), stride, nx, ny, negative);
    const int32x4_t c = weigh_xrgb(nth_window(origin, step, 2), stride, nx, ny, negative);
    const int32x4_t d = weigh_xrgb(nth_window(origin, step, 3), stride, nx, ny, negative);
    return vcombine_u8(pixels_from_sums(a, b, negative), pixels_from_sums(c, d, negative));
}

NEON_INLINE void patch_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source, int32_t nx,
                            int32_t ny, bool negative)
{
    const window_source_t from = *source; /* what is written might alias these */
    const one_window_t origin = {from.data, window->y.first_bytes, (const uint8_t *)window->x.second};
    const ptrdiff_t stride = negative ? COPY_STRIDE : from.stride;
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const ptrdiff_t ahead = bytes_ahead(patch, r, &from, 2);
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += PATCH_STEP, y_q18 += PATCH_STEP) {
            const window_step_t step = window_step(&from, x_q18, y_q18, 2);
            if (!negative) /* otherwise it is a copy */
                prefetch_rows(from.data, ahead + (ptrdiff_t)step.texel[0], stride, ny);
            vst1q_u8(out, four_xrgb(&origin, &step, stride, nx, ny, negative));
            out += 4 * PATCH_STEP;
        }
    }
}

NEON_INLINE void rows_4_to_8_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source,
                                  int32_t nx, bool negative)
{
    switch (window->y.taps) {
    case 4:
        patch_xrgb(patch, window, source, nx, 4, negative);
        break;
    case 5:
        patch_xrgb(patch, window, source, nx, 5, negative);
        break;
    case 6:
        patch_xrgb(patch, window, source, nx, 6, negative);
        break;
    case 7:
        patch_xrgb(patch, window, source, nx, 7, negative);
        break;
    default:
        patch_xrgb(patch, window, source, nx, WINDOW_SHORT_TAPS, negative);
    }
}

NEON_INLINE void rows_1_to_8_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source,
                                  int32_t nx)
{
    switch (window->y.taps) {
    case 1:
    case 2:
        patch_xrgb(patch, window, source, nx, WINDOW_MIN_TAPS, false);
        break;
    case 3:
        patch_xrgb(patch, window, source, nx, 3, false);
        break;
    default:
        rows_4_to_8_xrgb(patch, window, source, nx, false);
    }
}

static void positive_two_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8_xrgb(patch, window, source, 2);
}

static void positive_three_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8_xrgb(patch, window, source, 3);
}

static void positive_four_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8_xrgb(patch, window, source, 4);
}

static void positive_five_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8_xrgb(patch, window, source, 5);
}

static void positive_six_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8_xrgb(patch, window, source, 6);
}

static void positive_seven_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8_xrgb(patch, window, source, 7);
}

static void positive_eight_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8_xrgb(patch, window, source, WINDOW_SHORT_TAPS);
}

static void negative_four_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_4_to_8_xrgb(patch, window, source, 4, true);
}

static void negative_five_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_4_to_8_xrgb(patch, window, source, 5, true);
}

static void negative_six_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_4_to_8_xrgb(patch, window, source, 6, true);
}

static void negative_seven_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_4_to_8_xrgb(patch, window, source, 7, true);
}

static void negative_eight_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_4_to_8_xrgb(patch, window, source, WINDOW_SHORT_TAPS, true);
}

/* By the window's columns. */
static weigh_patch_fn *const positive_xrgb[WINDOW_SHORT_TAPS + 1] = {
    NULL,
    positive_two_xrgb,
    positive_two_xrgb,
    positive_three_xrgb,
    positive_four_xrgb,
    positive_five_xrgb,
    positive_six_xrgb,
    positive_seven_xrgb,
    positive_eight_xrgb,
};

/* Kernels with negative weights are at least four texels wide. */
static weigh_patch_fn *const negative_xrgb[WINDOW_SHORT_TAPS + 1] = {
    NULL,
    NULL,
    NULL,
    NULL,
    negative_four_xrgb,
    negative_five_xrgb,
    negative_six_xrgb,
    negative_seven_xrgb,
    negative_eight_xrgb,
};

void resample_window_xrgb_neon(const patch_t *patch, const window_t *window)
{
    if (!offsets_fit(window->picture.stride, window->picture.height)) {
        resample_window_xrgb_scalar(patch, window);
    } else if (!window_is_short(window)) {
        resample_long_xrgb_neon(patch, window);
    } else {
        const bool negative = window->x.negative;
        const int32_t nx = window->x.taps, ny = window->y.taps;
        const texels_t texels = texels_of(&window->picture);
        patch_loop_t loop = {
            .weigh = (negative ? negative_xrgb : positive_xrgb)[nx],
            .taps_x = (nx + 1) & -2,
            .taps_y = ny < WINDOW_MIN_TAPS ? WINDOW_MIN_TAPS : ny,
            .pixel_bytes = 4,
            .step = PATCH_STEP,
            .centred = negative,
        };
        if (window->x.resampler == WARP_LINEAR) {
            loop.weigh = resample_linear_xrgb_neon;
            loop.step = RESAMPLE_LINEAR_STEP;
        } else if (window_is_cubic(window)) {
            loop.weigh = resample_cubic_xrgb_neon;
            loop.centred = false;
        }
        weigh_anywhere(patch, window, &texels, &loop);
    }
}
