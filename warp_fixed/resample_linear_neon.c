// SPDX-License-Identifier: Apache-2.0
// Linear interpolation: its weights follow from the phases, without a table.
//
// The tables' rows for phase p are 128 - p and p in the first pass, 32767 - w and w in the second, where
// w = 256 p - floor(p / 64): 32767 p / 128 rounded by largest remainders.
#include "warp_fixed/resample_linear_neon.h"

#include <string.h>

#include "warp_fixed/fixed.h"

enum { STEP = RESAMPLE_LINEAR_STEP, PHASE_SHIFT = GRID_FRACTION_BITS - PHASE_BITS, ROUNDING = 1 << (SUM_SHIFT - 1) };

/* Where eight windows begin, and the weights of their lower rows, and 32767 - w and w in turn. */
typedef struct {
    uint32x4_t texel[2];
    uint16x8_t lower;
    uint16x8_t second[2];
} eight_windows_t;

/* Phases of eight points. */
static inline uint16x8_t eight_phases(uint32x4_t left_q18, uint32x4_t right_q18)
{
    const uint16x8_t shifted = vcombine_u16(vshrn_n_u32(left_q18, PHASE_SHIFT), vshrn_n_u32(right_q18, PHASE_SHIFT));
    return vandq_u16(shifted, vdupq_n_u16(PHASES - 1));
}

static inline eight_windows_t eight_windows(const window_source_t *source, const int32_t *x_q18, const int32_t *y_q18,
                                            int texel_log2)
{
    const window_begins_t left = window_begins(source, x_q18, y_q18, texel_log2);
    const window_begins_t right = window_begins(source, x_q18 + 4, y_q18 + 4, texel_log2);
    const uint16x8_t phase = eight_phases(left.x_q18, right.x_q18);
    const uint16x8_t most = vdupq_n_u16(SECOND_SUM);
    const uint16x8_t rest = vsraq_n_u16(vsubq_u16(most, vshlq_n_u16(phase, 8)), phase, 6), w = vsubq_u16(most, rest);
    return (eight_windows_t){
        .texel = {left.texel, right.texel},
        .lower = eight_phases(left.y_q18, right.y_q18),
        .second = {vzip1q_u16(rest, w), vzip2q_u16(rest, w)},
    };
}

/* Eight grey levels from second-pass sums. */
static inline uint8x8_t levels(uint32x4_t a, uint32x4_t b)
{
    const uint32x4_t rounding = vdupq_n_u32(ROUNDING);
    return vshrn_n_u16(vcombine_u16(vaddhn_u32(a, rounding), vaddhn_u32(b, rounding)), SUM_SHIFT - 16);
}

/* First-pass sums of two columns of four channels: at most 255 * FIRST_SUM, below 2^15. */
static inline uint16x8_t columns(const uint8_t *above, const uint8_t *below, const uint8_t *upper, const uint8_t *lower)
{
    return vmlal_u8(vmull_u8(vld1_u8(above), vld1_dup_u8(upper)), vld1_u8(below), vld1_dup_u8(lower));
}

/* Four pixels: offsets of their windows, a byte each of the first pass' weights, pairs of the second's. */
static inline uint8x16_t four_xrgb(const window_source_t *from, uint32x4_t texel, const uint8_t *upper,
                                   const uint8_t *lower, uint16x8_t second)
{
    const uint8_t *above = from->data, *below = from->data + from->stride;
    uint32_t at[4];
    vst1q_u32(at, texel);
    const uint32x4_t a = two_weighed(columns(above + at[0], below + at[0], &upper[0], &lower[0]), second, 0);
    const uint32x4_t b = two_weighed(columns(above + at[1], below + at[1], &upper[1], &lower[1]), second, 1);
    const uint32x4_t c = two_weighed(columns(above + at[2], below + at[2], &upper[2], &lower[2]), second, 2);
    const uint32x4_t d = two_weighed(columns(above + at[3], below + at[3], &upper[3], &lower[3]), second, 3);
    return vcombine_u8(levels(a, b), levels(c, d));
}

void resample_linear_xrgb_neon(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    (void)window;
    const window_source_t from = *source; /* what is written might alias these */
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += STEP, y_q18 += STEP, out += 4 * STEP) {
            const eight_windows_t windows = eight_windows(&from, x_q18, y_q18, 2);
            uint8_t upper[STEP], lower[STEP];
            vst1_u8(upper, vsub_u8(vdup_n_u8(FIRST_SUM), vmovn_u16(windows.lower)));
            vst1_u8(lower, vmovn_u16(windows.lower));
            vst1q_u8(out, four_xrgb(&from, windows.texel[0], &upper[0], &lower[0], windows.second[0]));
            vst1q_u8(out + 16, four_xrgb(&from, windows.texel[1], &upper[4], &lower[4], windows.second[1]));
        }
    }
}

static inline uint32_t two_texels(const uint8_t *texels)
{
    uint16_t two;
    memcpy(&two, texels, sizeof two);
    return two;
}

/* Pairs of texels of four windows, gathered outside the vector registers: no load waits for the one before. */
static inline uint8x8_t four_pairs(const uint8_t *texels, const uint32_t *at)
{
    const uint32_t left = two_texels(texels + at[0]) | two_texels(texels + at[1]) << 16;
    const uint32_t right = two_texels(texels + at[2]) | two_texels(texels + at[3]) << 16;
    return vcreate_u8(left | (uint64_t)right << 32);
}

static inline uint8x16_t eight_pairs(const uint8_t *texels, const uint32_t *at)
{
    return vcombine_u8(four_pairs(texels, at), four_pairs(texels, at + 4));
}

/* Second-pass sums of four windows: v has two columns of each, `second` their weights. */
static inline uint32x4_t weigh_gray(uint16x8_t v, uint16x8_t second)
{
    return vpaddq_u32(vmull_u16(vget_low_u16(v), vget_low_u16(second)),
                      vmull_u16(vget_high_u16(v), vget_high_u16(second)));
}

void resample_linear_gray_neon(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    (void)window;
    const window_source_t from = *source; /* what is written might alias these */
    const uint8_t *above = from.data, *below = from.data + from.stride;
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += STEP, y_q18 += STEP, out += STEP) {
            const eight_windows_t windows = eight_windows(&from, x_q18, y_q18, 0);
            uint32_t at[STEP];
            store_numbers(at, windows.texel[0]);
            store_numbers(at + 4, windows.texel[1]);
            const uint8x16_t lower = vreinterpretq_u8_u16(vmulq_n_u16(windows.lower, 0x0101));
            const uint8x16_t upper = vsubq_u8(vdupq_n_u8(FIRST_SUM), lower);
            const uint8x16_t top = eight_pairs(above, at), bottom = eight_pairs(below, at);
            const uint16x8_t left =
                vmlal_u8(vmull_u8(vget_low_u8(top), vget_low_u8(upper)), vget_low_u8(bottom), vget_low_u8(lower));
            const uint16x8_t right = vmlal_high_u8(vmull_high_u8(top, upper), bottom, lower);
            vst1_u8(out, levels(weigh_gray(left, windows.second[0]), weigh_gray(right, windows.second[1])));
        }
    }
}
