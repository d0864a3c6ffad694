// SPDX-License-Identifier: Apache-2.0
// A window of chroma texels around each point: short windows (window_texels_neon.h), with U and V side by side.
//
// A row of up to four texels is 8 bytes, one of up to eight is 16. Weights of the second pass are doubled for U and V;
// its sums of even and of odd texels are added up last.
#include <stddef.h>

#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/resample_long_neon.h"
#include "warp_fixed/resample_pairs_neon.h"
#include "warp_fixed/window_sums_neon.h"
#include "warp_fixed/window_texels_neon.h"

enum { NARROW = 4 };

/* Sums of eight columns (U and V of four texels) each. */
typedef struct {
    uint16x8_t left, right;
} columns_t;

NEON_INLINE columns_t first_pass(const uint8_t *texels, ptrdiff_t stride, const splats_t *splats, int32_t ny,
                                 int32_t columns)
{
    columns_t v;
    for (int t = 0; t < ny; t++, texels += stride) {
        const uint8x16_t weight = splats->row[t];
        const uint8x16_t row = columns > NARROW ? vld1q_u8(texels) : vcombine_u8(vld1_u8(texels), vdup_n_u8(0));
        v.left = t == 0 ? vmull_u8(vget_low_u8(row), vget_low_u8(weight))
                        : vmlal_u8(v.left, vget_low_u8(row), vget_low_u8(weight));
        v.right = t == 0 ? vmull_u8(vget_high_u8(row), vget_high_u8(weight))
                         : vmlal_u8(v.right, vget_high_u8(row), vget_high_u8(weight));
    }
    return v;
}

/* U, V of even texels, U, V of odd ones. */
NEON_INLINE int32x4_t second_pass(columns_t v, const uint8_t *second, int32_t columns)
{
    const int16x8_t weights = vreinterpretq_s16_u8(vld1q_u8(second));
    const uint16x8_t left = vreinterpretq_u16_s16(twice_low(weights));
    const uint16x8_t right = vreinterpretq_u16_s16(twice_high(weights));
    uint32x4_t sums = vmull_u16(vget_low_u16(v.left), vget_low_u16(left));
    sums = vmlal_high_u16(sums, v.left, left);
    if (columns > NARROW)
        sums = vmlal_u16(sums, vget_low_u16(v.right), vget_low_u16(right));
    if (columns > NARROW + 2)
        sums = vmlal_high_u16(sums, v.right, right);
    return vreinterpretq_s32_u32(sums);
}

/* Where the windows' texels and weights are. */
typedef struct {
    const uint8_t *data;
    ptrdiff_t stride;
    const uint8_t *first, *second;
} tables_t;

/* Second-pass sums of window i of a step. */
NEON_INLINE int32x4_t weigh(const tables_t *tables, const window_step_t *step, int i, int32_t ny, int32_t columns)
{
    const splats_t splats = load_splats(tables->first + stored_offset(&step->row_y[i]), ny);
    const uint8_t *texels = tables->data + stored_offset(&step->texel[i]);
    const columns_t v = first_pass(texels, tables->stride, &splats, ny, columns);
    return second_pass(v, tables->second + stored_offset(&step->row_x[i]), columns);
}

NEON_INLINE void weigh_patch(const patch_t *patch, const window_t *window, const window_source_t *source, int32_t ny,
                             int32_t columns)
{
    const window_source_t from = *source; /* what is written might alias it */
    const tables_t tables = {from.data, from.stride, window->y.first_bytes, (const uint8_t *)window->x.second};
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += PATCH_STEP, y_q18 += PATCH_STEP) {
            const window_step_t step = window_step(&from, x_q18, y_q18, 1);
            const int32x4_t left =
                chroma_from_sums(weigh(&tables, &step, 0, ny, columns), weigh(&tables, &step, 1, ny, columns));
            const int32x4_t right =
                chroma_from_sums(weigh(&tables, &step, 2, ny, columns), weigh(&tables, &step, 3, ny, columns));
            vst1_u8(out, pixels_from_sums(left, right, false));
            out += 2 * PATCH_STEP;
        }
    }
}

NEON_INLINE void rows_4_to_8(const patch_t *patch, const window_t *window, const window_source_t *source,
                             int32_t columns)
{
    switch (window->y.taps) {
    case 4:
        weigh_patch(patch, window, source, 4, columns);
        break;
    case 5:
        weigh_patch(patch, window, source, 5, columns);
        break;
    case 6:
        weigh_patch(patch, window, source, 6, columns);
        break;
    case 7:
        weigh_patch(patch, window, source, 7, columns);
        break;
    default:
        weigh_patch(patch, window, source, WINDOW_SHORT_TAPS, columns);
    }
}

NEON_INLINE void rows_1_to_8(const patch_t *patch, const window_t *window, const window_source_t *source,
                             int32_t columns)
{
    if (window->y.taps <= WINDOW_MIN_TAPS)
        weigh_patch(patch, window, source, WINDOW_MIN_TAPS, columns);
    else if (window->y.taps == 3)
        weigh_patch(patch, window, source, 3, columns);
    else
        rows_4_to_8(patch, window, source, columns);
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

/* By the window's columns, in pairs: 1 and 2, 3 and 4, ... */
static weigh_patch_fn *const positive_loops[WINDOW_SHORT_TAPS / 2] = {positive_four, positive_four, positive_six,
                                                                      positive_eight};

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
    patch_loop_t loop = {
        .weigh = positive_loops[(nx - 1) / 2],
        .taps_x = nx > NARROW ? WINDOW_SHORT_TAPS : NARROW,
        .taps_y = ny < WINDOW_MIN_TAPS ? WINDOW_MIN_TAPS : ny,
        .pixel_bytes = 2,
        .step = PATCH_STEP,
    };
    if (window->x.negative)
        loop = resample_pairs_chroma_neon(window);
    weigh_anywhere(patch, window, &texels, &loop);
}
