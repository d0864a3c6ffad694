// SPDX-License-Identifier: Apache-2.0
// A window of coefficients around each point: short windows (at most WINDOW_SHORT_TAPS along both axes).
//
// Weighed columns fit 16 bits again: 1.25 times a low-pass's 5919, or 18432 under a B-spline (fixed.h). What is always
// inlined has constant bounds there, and no branches.
#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/resample_long_neon.h"
#include "warp_fixed/window_patch_neon.h"
#include "warp_fixed/window_sums_neon.h"

enum { LANES = 8, SHIFT = COEFFICIENT_SUM_LOG2 + COEFFICIENT_BITS };

/* There are loops for 2, 4, 5, 6 and 8 taps; other windows are taken for longer ones: weights beyond theirs are 0. */
static int32_t taps_of_loop(int32_t taps)
{
    return taps <= 2 ? 2 : taps == 3 ? 4 : taps == 7 ? 8 : taps;
}

/* Sums of eight columns. */
typedef struct {
    int32x4_t low, high;
} sums_t;

NEON_INLINE int16x8_t eight_coefficients(const uint8_t *at)
{
    return vreinterpretq_s16_u8(vld1q_u8(at));
}

/* No function, for intrinsics want lanes that are constants. */
#define ADD_ROW(sums, values, weights, lane)                                                                           \
    ((sums_t){vmlal_lane_s16((sums).low, vget_low_s16(values), weights, lane),                                         \
              vmlal_lane_s16((sums).high, vget_high_s16(values), weights, lane)})

/* Eight columns of ny rows, weighed. Halves that nobody reads cost nothing. */
NEON_INLINE int16x8_t weigh_columns(const uint8_t *const *rows, size_t at, int16x8_t weights, int32_t ny)
{
    const int16x4_t upper = vget_low_s16(weights), lower = vget_high_s16(weights);
    const int16x8_t top = eight_coefficients(rows[0] + at);
    sums_t sums = {vmull_lane_s16(vget_low_s16(top), upper, 0), vmull_lane_s16(vget_high_s16(top), upper, 0)};
    sums = ADD_ROW(sums, eight_coefficients(rows[1] + at), upper, 1);
    if (ny > 2) {
        sums = ADD_ROW(sums, eight_coefficients(rows[2] + at), upper, 2);
        sums = ADD_ROW(sums, eight_coefficients(rows[3] + at), upper, 3);
    }
    if (ny > 4)
        sums = ADD_ROW(sums, eight_coefficients(rows[4] + at), lower, 0);
    if (ny > 5)
        sums = ADD_ROW(sums, eight_coefficients(rows[5] + at), lower, 1);
    if (ny > 6) {
        sums = ADD_ROW(sums, eight_coefficients(rows[6] + at), lower, 2);
        sums = ADD_ROW(sums, eight_coefficients(rows[7] + at), lower, 3);
    }
    return vcombine_s16(vrshrn_n_s32(sums.low, COEFFICIENT_SUM_LOG2), vrshrn_n_s32(sums.high, COEFFICIENT_SUM_LOG2));
}

/* Second-pass sums of the four channels of a pixel. A vector of columns has two pixels. */
NEON_INLINE int32x4_t weigh_xrgb(const uint8_t *const *rows, size_t at, int16x8_t first, int32_t ny, int16x8_t second,
                                 int32_t nx)
{
    const int16x4_t left = vget_low_s16(second), right = vget_high_s16(second);
    int16x8_t v[WINDOW_SHORT_TAPS / 2];
    for (uint32_t pair = 0; 2 * pair < (uint32_t)nx; pair++)
        v[pair] = weigh_columns(rows, at + 16 * pair, first, ny);
    int32x4_t sums = vmull_lane_s16(vget_low_s16(v[0]), left, 0);
    sums = vmlal_lane_s16(sums, vget_high_s16(v[0]), left, 1);
    if (nx > 2) {
        sums = vmlal_lane_s16(sums, vget_low_s16(v[1]), left, 2);
        sums = vmlal_lane_s16(sums, vget_high_s16(v[1]), left, 3);
    }
    if (nx > 4)
        sums = vmlal_lane_s16(sums, vget_low_s16(v[2]), right, 0);
    if (nx > 5)
        sums = vmlal_lane_s16(sums, vget_high_s16(v[2]), right, 1);
    if (nx > 6) {
        sums = vmlal_lane_s16(sums, vget_low_s16(v[3]), right, 2);
        sums = vmlal_lane_s16(sums, vget_high_s16(v[3]), right, 3);
    }
    return sums;
}

/* Second-pass sums of a pixel, to be added up. */
NEON_INLINE int32x4_t weigh_gray(const uint8_t *const *rows, size_t at, int16x8_t first, int32_t ny, int16x8_t second,
                                 int32_t nx)
{
    const int16x8_t v = weigh_columns(rows, at, first, ny);
    const int32x4_t sums = vmull_s16(vget_low_s16(v), vget_low_s16(second));
    return nx > 4 ? vmlal_high_s16(sums, v, second) : sums;
}

/* Second-pass sums of U, V of even texels, then of odd ones. A vector of columns has four texels. */
NEON_INLINE int32x4_t weigh_chroma(const uint8_t *const *rows, size_t at, int16x8_t first, int32_t ny, int16x8_t second,
                                   int32_t nx)
{
    const int16x8_t left = vzip1q_s16(second, second), v = weigh_columns(rows, at, first, ny);
    int32x4_t sums = vmlal_high_s16(vmull_s16(vget_low_s16(v), vget_low_s16(left)), v, left);
    if (nx > 4) {
        const int16x8_t right = vzip2q_s16(second, second), u = weigh_columns(rows, at + 16, first, ny);
        sums = vmlal_high_s16(vmlal_s16(sums, vget_low_s16(u), vget_low_s16(right)), u, right);
    }
    return sums;
}

/* Row 0 of the weights of both passes. */
typedef struct {
    const int16_t *first;
    const uint8_t *second;
} patch_tables_t;

/* Second-pass sums of window i of a step. */
NEON_INLINE int32x4_t weigh_pixel(const uint8_t *const *rows, const patch_tables_t *tables, const window_step_t *step,
                                  int i, int32_t nx, int32_t ny, int32_t channels)
{
    const int16x8_t first = vld1q_s16(tables->first + stored_offset(&step->row_y[i]));
    const int16x8_t second = vreinterpretq_s16_u8(vld1q_u8(tables->second + stored_offset(&step->row_x[i])));
    const size_t at = stored_offset(&step->texel[i]);
    return channels == 1   ? weigh_gray(rows, at, first, ny, second, nx)
           : channels == 2 ? weigh_chroma(rows, at, first, ny, second, nx)
                           : weigh_xrgb(rows, at, first, ny, second, nx);
}

/* As pixel_from_centred(): the middle grey goes in before the shift, which is made in two (the second saturates). */
NEON_INLINE uint8x8_t pixels_from_sums(int32x4_t a, int32x4_t b)
{
    const int32x4_t start = vdupq_n_s32((COEFFICIENT_MIDDLE << SHIFT) + (1 << (SHIFT - 1)));
    return vqshrun_n_s16(vcombine_s16(vaddhn_s32(a, start), vaddhn_s32(b, start)), SHIFT - 16);
}

NEON_INLINE void weigh_patch(const patch_t *patch, const window_t *window, const window_source_t *source, int32_t nx,
                             int32_t ny, int32_t channels)
{
    const window_source_t from = *source; /* what is written might alias these */
    const int32_t width = patch->width, height = patch->height;
    const patch_tables_t tables = {window->y.first, (const uint8_t *)window->x.second};
    const uint8_t *rows[WINDOW_SHORT_TAPS];
    for (int t = 0; t < ny; t++)
        rows[t] = from.data + (ptrdiff_t)t * from.stride;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += PATCH_STEP, y_q18 += PATCH_STEP) {
            const window_step_t step = window_step(&from, x_q18, y_q18, channels == 1 ? 1 : channels == 2 ? 2 : 3);
            const int32x4_t a = weigh_pixel(rows, &tables, &step, 0, nx, ny, channels);
            const int32x4_t b = weigh_pixel(rows, &tables, &step, 1, nx, ny, channels);
            const int32x4_t c = weigh_pixel(rows, &tables, &step, 2, nx, ny, channels);
            const int32x4_t d = weigh_pixel(rows, &tables, &step, 3, nx, ny, channels);
            if (channels == 1) {
                const int32x4_t four = vpaddq_s32(vpaddq_s32(a, b), vpaddq_s32(c, d));
                const uint8x8_t pixels = pixels_from_sums(four, four);
                memcpy(out, &pixels, PATCH_STEP);
            } else if (channels == 2) {
                vst1_u8(out, pixels_from_sums(chroma_from_sums(a, b), chroma_from_sums(c, d)));
            } else {
                vst1q_u8(out, vcombine_u8(pixels_from_sums(a, b), pixels_from_sums(c, d)));
            }
            out += PATCH_STEP * channels;
        }
    }
}

NEON_INLINE void weigh_rows(const patch_t *patch, const window_t *window, const window_source_t *source, int32_t nx,
                            int32_t channels)
{
    switch (taps_of_loop(window->y.taps)) {
    case 2:
        weigh_patch(patch, window, source, nx, 2, channels);
        break;
    case 4:
        weigh_patch(patch, window, source, nx, 4, channels);
        break;
    case 5:
        weigh_patch(patch, window, source, nx, 5, channels);
        break;
    case 6:
        weigh_patch(patch, window, source, nx, 6, channels);
        break;
    default:
        weigh_patch(patch, window, source, nx, WINDOW_SHORT_TAPS, channels);
    }
}

static void two_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, 2, 4);
}

static void four_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, 4, 4);
}

static void five_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, 5, 4);
}

static void six_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, 6, 4);
}

static void eight_xrgb(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, WINDOW_SHORT_TAPS, 4);
}

/* By the window's columns. */
static weigh_patch_fn *const by_columns_xrgb[WINDOW_SHORT_TAPS + 1] = {
    NULL, two_xrgb, two_xrgb, four_xrgb, four_xrgb, five_xrgb, six_xrgb, eight_xrgb, eight_xrgb,
};

static void four_gray(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, 4, 1);
}

static void eight_gray(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, WINDOW_SHORT_TAPS, 1);
}

static void four_chroma(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, 4, 2);
}

static void eight_chroma(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_rows(patch, window, source, WINDOW_SHORT_TAPS, 2);
}

static texels_t texels_of(const coefficients_t *from)
{
    const int32_t texel_bytes = from->channels * (int32_t)sizeof *from->data;
    return (texels_t){(const uint8_t *)from->data, from->width, from->height, (ptrdiff_t)from->width * texel_bytes,
                      texel_bytes};
}

void resample_coefficients_xrgb_neon(const patch_t *patch, const window_t *window)
{
    if (!window_is_short(window)) {
        resample_long_coefficients_xrgb_neon(patch, window);
        return;
    }
    const texels_t texels = texels_of(&window->coefficients);
    const int32_t nx = window->x.taps;
    const patch_loop_t loop = {
        .weigh = by_columns_xrgb[nx],
        .taps_x = (taps_of_loop(nx) + 1) & -2,
        .taps_y = taps_of_loop(window->y.taps),
        .pixel_bytes = 4,
        .step = PATCH_STEP,
    };
    weigh_anywhere(patch, window, &texels, &loop);
}

void resample_coefficients_chroma_neon(const patch_t *patch, const window_t *window)
{
    if (!window_is_short(window)) {
        resample_long_coefficients_chroma_neon(patch, window);
        return;
    }
    const texels_t texels = texels_of(&window->coefficients);
    const bool narrow = window->x.taps <= 4;
    const patch_loop_t loop = {
        .weigh = narrow ? four_chroma : eight_chroma,
        .taps_x = narrow ? 4 : WINDOW_SHORT_TAPS,
        .taps_y = taps_of_loop(window->y.taps),
        .pixel_bytes = 2,
        .step = PATCH_STEP,
    };
    weigh_anywhere(patch, window, &texels, &loop);
}

void resample_coefficients_gray_neon(const patch_t *patch, const window_t *window)
{
    if (!window_is_short(window)) {
        resample_long_coefficients_gray_neon(patch, window);
        return;
    }
    const texels_t texels = texels_of(&window->coefficients);
    const patch_loop_t loop = {
        .weigh = window->x.taps <= 4 ? four_gray : eight_gray,
        .taps_x = LANES,
        .taps_y = taps_of_loop(window->y.taps),
        .pixel_bytes = 1,
        .step = PATCH_STEP,
    };
    weigh_anywhere(patch, window, &texels, &loop);
}
