// SPDX-License-Identifier: Apache-2.0
// A window of gray texels around each point: short windows, with a loop for each number of rows; rows of eight are
// read.
#include <string.h>

#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/resample_cubic_neon.h"
#include "warp_fixed/resample_linear_neon.h"
#include "warp_fixed/resample_long_neon.h"
#include "warp_fixed/resample_pairs_neon.h"
#include "warp_fixed/window_texels_neon.h"

/* First-pass weights of one window, a short vector to each row. */
typedef struct {
    uint8x8_t row[WINDOW_SHORT_TAPS];
} short_splats_t;

NEON_INLINE short_splats_t load_short_splats(const uint8_t *first, int32_t ny)
{
    short_splats_t splats;
    const uint8x8x4_t above = load_4_short_splats(first);
    for (int t = 0; t < 4; t++)
        splats.row[t] = above.val[t];
    if (ny == 5) {
        splats.row[4] = vld1_dup_u8(first + 4);
    } else if (ny > 5) {
        const uint8x8x4_t below = load_4_short_splats(first + 4);
        for (int t = 0; t < 4; t++)
            splats.row[4 + t] = below.val[t];
    }
    return splats;
}

/* Second-pass sums of one pixel, to be added up. Rows of eight texels are read. */
NEON_INLINE int32x4_t weigh_gray(const uint8_t *texels, ptrdiff_t stride, const uint8_t *first, int32_t ny,
                                 const uint8_t *second)
{
    const short_splats_t splats = load_short_splats(first, ny);
    uint16x8_t v = vmull_u8(vld1_u8(texels), splats.row[0]);
    for (int t = 1; t < ny; t++)
        v = vmlal_u8(v, vld1_u8(texels + t * stride), splats.row[t]);
    const uint16x8_t w = vreinterpretq_u16_u8(vld1q_u8(second));
    return vreinterpretq_s32_u32(vmlal_high_u16(vmull_u16(vget_low_u16(v), vget_low_u16(w)), v, w));
}

NEON_INLINE void patch_gray(const patch_t *patch, const window_t *window, const window_source_t *source, int32_t ny)
{
    const window_source_t from = *source; /* what is written might alias these */
    const ptrdiff_t stride = from.stride;
    const uint8_t *first = window->y.first_bytes;
    const uint8_t *second = (const uint8_t *)window->x.second;
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += PATCH_STEP, y_q18 += PATCH_STEP) {
            const window_step_t step = window_step(&from, x_q18, y_q18, 0);
            const int32x4_t a =
                weigh_gray(from.data + stored_offset(&step.texel[0]), stride, first + stored_offset(&step.row_y[0]), ny,
                           second + stored_offset(&step.row_x[0]));
            const int32x4_t b =
                weigh_gray(from.data + stored_offset(&step.texel[1]), stride, first + stored_offset(&step.row_y[1]), ny,
                           second + stored_offset(&step.row_x[1]));
            const int32x4_t c =
                weigh_gray(from.data + stored_offset(&step.texel[2]), stride, first + stored_offset(&step.row_y[2]), ny,
                           second + stored_offset(&step.row_x[2]));
            const int32x4_t d =
                weigh_gray(from.data + stored_offset(&step.texel[3]), stride, first + stored_offset(&step.row_y[3]), ny,
                           second + stored_offset(&step.row_x[3]));
            const int32x4_t four = vpaddq_s32(vpaddq_s32(a, b), vpaddq_s32(c, d));
            const uint8x8_t pixels = pixels_from_sums(four, four, false);
            memcpy(out, &pixels, PATCH_STEP);
            out += PATCH_STEP;
        }
    }
}

static void weigh_positive(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    switch (window->y.taps) {
    case 1:
    case WINDOW_MIN_TAPS:
        patch_gray(patch, window, source, WINDOW_MIN_TAPS);
        break;
    case 3:
        patch_gray(patch, window, source, 3);
        break;
    case 4:
        patch_gray(patch, window, source, 4);
        break;
    case 5:
        patch_gray(patch, window, source, 5);
        break;
    case 6:
        patch_gray(patch, window, source, 6);
        break;
    case 7:
        patch_gray(patch, window, source, 7);
        break;
    default:
        patch_gray(patch, window, source, WINDOW_SHORT_TAPS);
    }
}

static patch_loop_t loop_for(const window_t *window)
{
    if (window->x.resampler != WARP_LINEAR && !window_is_cubic(window) && window->x.negative)
        return resample_pairs_gray_neon(window);
    patch_loop_t loop = {
        .weigh = weigh_positive,
        .taps_x = WINDOW_SHORT_TAPS,
        .taps_y = window->y.taps < WINDOW_MIN_TAPS ? WINDOW_MIN_TAPS : window->y.taps,
        .pixel_bytes = 1,
        .step = PATCH_STEP,
    };
    if (window->x.resampler == WARP_LINEAR) {
        loop.weigh = resample_linear_gray_neon;
        loop.taps_x = WINDOW_MIN_TAPS;
        loop.step = RESAMPLE_LINEAR_STEP;
        loop.pair_step = 1;
    } else if (window_is_cubic(window)) {
        loop.weigh = resample_cubic_gray_neon;
    }
    return loop;
}

void resample_window_gray_neon(const patch_t *patch, const window_t *window)
{
    if (!offsets_fit(window->picture.stride, window->picture.height)) {
        resample_window_gray_scalar(patch, window);
    } else if (!window_is_short(window)) {
        resample_long_gray_neon(patch, window);
    } else {
        const texels_t texels = texels_of(&window->picture);
        const patch_loop_t loop = loop_for(window);
        weigh_anywhere(patch, window, &texels, &loop);
    }
}
