// SPDX-License-Identifier: Apache-2.0
// Windows of 4 x 4 texels whose outer weights are negative and whose inner ones are not: Keys' cubic.
//
// With the signs known, texels need no copy less 128 (window_patch_neon.h): products are unsigned, outer ones are
// subtracted, and the sums' middle goes from the 16-bit sums, modulo 2^16, before they are taken for signed numbers.
#include "warp_fixed/resample_cubic_neon.h"

#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/window_ahead.h"

enum {
    MIDDLE = 128 * FIRST_SUM,
    START = MIDDLE * SECOND_SUM + (1 << (SUM_SHIFT - 1)) /* what the first pass leaves out, and for rounding */
};

/* First-pass sums less MIDDLE of eight bytes of each row. */
static inline int16x8_t weigh_rows(const uint8x8_t texels[CUBIC_TAPS], const uint8x8_t weights[CUBIC_TAPS])
{
    const uint16x8_t inner = vmlal_u8(vmull_u8(texels[1], weights[1]), texels[2], weights[2]);
    const uint16x8_t sums = vmlsl_u8(vmlsl_u8(inner, texels[0], weights[0]), texels[3], weights[3]);
    return vreinterpretq_s16_u16(vsubq_u16(sums, vdupq_n_u16(MIDDLE)));
}

/* Where the rows of all windows begin, and row 0 of both tables. */
typedef struct {
    const uint8_t *row[CUBIC_TAPS];
    const uint8_t *first, *second;
} cubic_t;

static cubic_t cubic_of(const window_t *window, const window_source_t *source)
{
    cubic_t cubic = {.first = window->y.first_bytes + CUBIC_TAPS, .second = (const uint8_t *)window->x.second};
    for (int t = 0; t < CUBIC_TAPS; t++)
        cubic.row[t] = source->data + (ptrdiff_t)t * source->stride;
    return cubic;
}

static inline int16x4_t second_weights(const cubic_t *cubic, size_t row)
{
    return vreinterpret_s16_u8(vld1_u8(cubic->second + row));
}

/* Second-pass sums of the four channels of window i. */
NEON_INLINE int32x4_t weigh_xrgb(const cubic_t *cubic, const window_step_t *step, int i)
{
    const uint8x16x4_t splats = load_4_splats(cubic->first + stored_offset(&step->row_y[i]));
    const size_t at = stored_offset(&step->texel[i]);
    uint8x8_t low[CUBIC_TAPS], high[CUBIC_TAPS], low_weights[CUBIC_TAPS], high_weights[CUBIC_TAPS];
    for (int t = 0; t < CUBIC_TAPS; t++) {
        const uint8x16_t texels = vld1q_u8(cubic->row[t] + at);
        low[t] = vget_low_u8(texels);
        high[t] = vget_high_u8(texels);
        low_weights[t] = vget_low_u8(splats.val[t]);
        high_weights[t] = vget_high_u8(splats.val[t]);
    }
    const int16x8_t left = weigh_rows(low, low_weights), right = weigh_rows(high, high_weights);
    const int16x4_t w = second_weights(cubic, stored_offset(&step->row_x[i]));
    const int32x4_t two = vmlal_lane_s16(vmull_lane_s16(vget_low_s16(left), w, 0), vget_high_s16(left), w, 1);
    return vmlal_lane_s16(vmlal_lane_s16(two, vget_low_s16(right), w, 2), vget_high_s16(right), w, 3);
}

/* Second-pass products of window i, to be added up. Rows of eight texels are read. */
NEON_INLINE int32x4_t weigh_gray(const cubic_t *cubic, const window_step_t *step, int i)
{
    const uint8x8x4_t splats = load_4_short_splats(cubic->first + stored_offset(&step->row_y[i]));
    const size_t at = stored_offset(&step->texel[i]);
    uint8x8_t texels[CUBIC_TAPS], weights[CUBIC_TAPS];
    for (int t = 0; t < CUBIC_TAPS; t++) {
        texels[t] = vld1_u8(cubic->row[t] + at);
        weights[t] = splats.val[t];
    }
    return vmull_s16(vget_low_s16(weigh_rows(texels, weights)), second_weights(cubic, stored_offset(&step->row_x[i])));
}

/* As pixel_from_sum(): the shift in two, which round down both, the second with saturation. */
static inline uint8x8_t pixels_from_sums(int32x4_t a, int32x4_t b)
{
    const int32x4_t start = vdupq_n_s32(START);
    return vqshrun_n_s16(vcombine_s16(vaddhn_s32(a, start), vaddhn_s32(b, start)), SUM_SHIFT - 16);
}

NEON_INLINE void weigh_patch(const patch_t *patch, const window_t *window, const window_source_t *source,
                             int32_t channels)
{
    const window_source_t from = *source; /* what is written might alias these */
    const cubic_t cubic = cubic_of(window, source);
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int texel_log2 = channels == 4 ? 2 : 0;
        const ptrdiff_t ahead = bytes_ahead(patch, r, &from, texel_log2);
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += PATCH_STEP, y_q18 += PATCH_STEP) {
            const window_step_t step = window_step(&from, x_q18, y_q18, texel_log2);
            prefetch_rows(from.data, ahead + (ptrdiff_t)step.texel[0], from.stride, CUBIC_TAPS);
            if (channels == 4) {
                const uint8x8_t left = pixels_from_sums(weigh_xrgb(&cubic, &step, 0), weigh_xrgb(&cubic, &step, 1));
                const uint8x8_t right = pixels_from_sums(weigh_xrgb(&cubic, &step, 2), weigh_xrgb(&cubic, &step, 3));
                vst1q_u8(out, vcombine_u8(left, right));
            } else {
                const int32x4_t left = vpaddq_s32(weigh_gray(&cubic, &step, 0), weigh_gray(&cubic, &step, 1));
                const int32x4_t right = vpaddq_s32(weigh_gray(&cubic, &step, 2), weigh_gray(&cubic, &step, 3));
                const int32x4_t four = vpaddq_s32(left, right);
                const uint8x8_t pixels = pixels_from_sums(four, four);
                memcpy(out, &pixels, PATCH_STEP);
            }
            out += PATCH_STEP * channels;
        }
    }
}

void resample_cubic_xrgb_neon(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_patch(patch, window, source, 4);
}

void resample_cubic_gray_neon(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    weigh_patch(patch, window, source, 1);
}
