// SPDX-License-Identifier: Apache-2.0
// A window of chroma texels around each point: short windows (window_texels_neon.h), with U and V side by side.
//
// A row of up to four texels is 8 bytes, one of up to eight is 16. Weights of the second pass are doubled for U and V;
// its sums of even and of odd texels are added up last.
#include <stdbool.h>
#include <stddef.h>

#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/resample_long_neon.h"
#include "warp_fixed/window_sums_neon.h"
#include "warp_fixed/window_texels_neon.h"

enum { NARROW = 4 };

/* Sums of eight columns (U and V of four texels) each: int16_t, or uint16_t where no weight is negative. */
typedef struct {
    int16x8_t left, right;
} columns_t;

NEON_INLINE columns_t first_pass(const uint8_t *texels, ptrdiff_t stride, const splats_t *splats, int32_t ny,
                                 int32_t columns, bool negative)
{
    columns_t v;
    for (int t = 0; t < ny; t++, texels += stride) {
        const uint8x16_t weight = splats->row[t];
        const uint8x16_t row = columns > NARROW ? vld1q_u8(texels) : vcombine_u8(vld1_u8(texels), vdup_n_u8(0));
        v.left = t == 0 ? products(vget_low_u8(row), vget_low_u8(weight), negative)
                        : add_products(v.left, vget_low_u8(row), vget_low_u8(weight), negative);
        v.right = t == 0 ? products(vget_high_u8(row), vget_high_u8(weight), negative)
                         : add_products(v.right, vget_high_u8(row), vget_high_u8(weight), negative);
    }
    return v;
}

NEON_INLINE int32x4_t multiply(int16x8_t v, int16x8_t weights, bool negative)
{
    if (negative)
        return vmlal_high_s16(vmull_s16(vget_low_s16(v), vget_low_s16(weights)), v, weights);
    const uint16x8_t u = vreinterpretq_u16_s16(v), w = vreinterpretq_u16_s16(weights);
    return vreinterpretq_s32_u32(vmlal_high_u16(vmull_u16(vget_low_u16(u), vget_low_u16(w)), u, w));
}

/* The first two texels alone, or all four. */
NEON_INLINE int32x4_t add_multiplied(int32x4_t sums, int16x8_t v, int16x8_t weights, int32_t texels, bool negative)
{
    if (negative) {
        sums = vmlal_s16(sums, vget_low_s16(v), vget_low_s16(weights));
        return texels > 2 ? vmlal_high_s16(sums, v, weights) : sums;
    }
    const uint16x8_t u = vreinterpretq_u16_s16(v), w = vreinterpretq_u16_s16(weights);
    const uint32x4_t low = vmlal_u16(vreinterpretq_u32_s32(sums), vget_low_u16(u), vget_low_u16(w));
    return vreinterpretq_s32_u32(texels > 2 ? vmlal_high_u16(low, u, w) : low);
}

/* U, V of even texels, U, V of odd ones; negated where weights are negative. */
NEON_INLINE int32x4_t second_pass(columns_t v, const uint8_t *second, int32_t columns, bool negative)
{
    const int16x8_t weights = vreinterpretq_s16_u8(vld1q_u8(second));
    const int32x4_t sums = multiply(v.left, vzip1q_s16(weights, weights), negative);
    if (columns <= NARROW)
        return sums;
    return add_multiplied(sums, v.right, vzip2q_s16(weights, weights), columns - NARROW, negative);
}

/* Where the windows' texels and weights are. */
typedef struct {
    const uint8_t *data;
    ptrdiff_t stride;
    const uint8_t *first, *second;
} tables_t;

/* Second-pass sums of window i of a step. */
NEON_INLINE int32x4_t weigh(const tables_t *tables, const window_step_t *step, int i, int32_t ny, int32_t columns,
                            bool negative)
{
    const splats_t splats = load_splats(tables->first + stored_offset(&step->row_y[i]), ny);
    const uint8_t *texels = tables->data + stored_offset(&step->texel[i]);
    const columns_t v = first_pass(texels, tables->stride, &splats, ny, columns, negative);
    return second_pass(v, tables->second + stored_offset(&step->row_x[i]), columns, negative);
}

NEON_INLINE void weigh_patch(const patch_t *patch, const window_t *window, const window_source_t *source, int32_t ny,
                             int32_t columns, bool negative)
{
    const window_source_t from = *source; /* what is written might alias it */
    const tables_t tables = {from.data, negative ? COPY_STRIDE : from.stride, window->y.first_bytes,
                             (const uint8_t *)window->x.second};
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += PATCH_STEP, y_q18 += PATCH_STEP) {
            const window_step_t step = window_step(&from, x_q18, y_q18, 1);
            const int32x4_t left = chroma_from_sums(weigh(&tables, &step, 0, ny, columns, negative),
                                                    weigh(&tables, &step, 1, ny, columns, negative));
            const int32x4_t right = chroma_from_sums(weigh(&tables, &step, 2, ny, columns, negative),
                                                     weigh(&tables, &step, 3, ny, columns, negative));
            vst1_u8(out, pixels_from_sums(left, right, negative));
            out += 2 * PATCH_STEP;
        }
    }
}

NEON_INLINE void rows_4_to_8(const patch_t *patch, const window_t *window, const window_source_t *source,
                             int32_t columns, bool negative)
{
    switch (window->y.taps) {
    case 4:
        weigh_patch(patch, window, source, 4, columns, negative);
        break;
    case 5:
        weigh_patch(patch, window, source, 5, columns, negative);
        break;
    case 6:
        weigh_patch(patch, window, source, 6, columns, negative);
        break;
    case 7:
        weigh_patch(patch, window, source, 7, columns, negative);
        break;
    default:
        weigh_patch(patch, window, source, WINDOW_SHORT_TAPS, columns, negative);
    }
}

NEON_INLINE void rows_1_to_8(const patch_t *patch, const window_t *window, const window_source_t *source,
                             int32_t columns)
{
    if (window->y.taps <= WINDOW_MIN_TAPS)
        weigh_patch(patch, window, source, WINDOW_MIN_TAPS, columns, false);
    else if (window->y.taps == 3)
        weigh_patch(patch, window, source, 3, columns, false);
    else
        rows_4_to_8(patch, window, source, columns, false);
}

static void positive_four(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8(patch, window, source, NARROW);
}

static void positive_six(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8(patch, window, source, 6);
}

static void positive_eight(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_1_to_8(patch, window, source, WINDOW_SHORT_TAPS);
}

static void negative_four(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_4_to_8(patch, window, source, NARROW, true);
}

static void negative_six(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_4_to_8(patch, window, source, 6, true);
}

static void negative_eight(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    rows_4_to_8(patch, window, source, WINDOW_SHORT_TAPS, true);
}

/* By the window's columns, in pairs: 1 and 2, 3 and 4, ... */
static weigh_patch_fn *const positive_loops[WINDOW_SHORT_TAPS / 2] = {positive_four, positive_four, positive_six,
                                                                      positive_eight};

/* Kernels with negative weights are at least four texels wide. */
static weigh_patch_fn *const negative_loops[WINDOW_SHORT_TAPS / 2] = {NULL, negative_four, negative_six,
                                                                      negative_eight};

void resample_window_chroma_neon(const patch_t *patch, const window_t *window)
{
    const image_t *picture = &window->picture;
    const int32_t nx = window->x.taps, ny = window->y.taps;
    if (!offsets_fit(picture->stride, picture->height)) {
        resample_window_chroma_scalar(patch, window);
        return;
    }
    if (!window_is_short(window)) {
        resample_long_chroma_neon(patch, window);
        return;
    }
    const texels_t texels = texels_of(picture);
    const patch_loop_t loop = {
        .weigh = (window->x.negative ? negative_loops : positive_loops)[(nx - 1) / 2],
        .taps_x = nx > NARROW ? WINDOW_SHORT_TAPS : NARROW,
        .taps_y = ny < WINDOW_MIN_TAPS ? WINDOW_MIN_TAPS : ny,
        .pixel_bytes = 2,
        .step = PATCH_STEP,
        .centred = window->x.negative,
    };
    weigh_anywhere(patch, window, &texels, &loop);
}
