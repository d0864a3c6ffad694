// SPDX-License-Identifier: Apache-2.0
// Linear interpolation: its weights follow from the phases, without a table.
//
// The tables' rows for phase p are 128 - p and p in the first pass, 32767 - w and w in the second, where
// w = 256 p - floor(p / 64): 32767 p / 128 rounded by largest remainders.
#include "warp_fixed/resample_linear_neon.h"

#include <string.h>

#include "warp_fixed/fixed.h"

enum { PHASE_SHIFT = GRID_FRACTION_BITS - PHASE_BITS, ROUNDING = 1 << (SUM_SHIFT - 1) };

/* Phases of four points. */
static inline uint32x4_t phases(uint32x4_t point_q18)
{
    return vandq_u32(vshrq_n_u32(point_q18, PHASE_SHIFT), vdupq_n_u32(PHASES - 1));
}

/* Second-pass weights of four points: 32767 - w and w in turn. */
static inline uint32x4_t second_weights(uint32x4_t phase)
{
    const uint32x4_t w = vsubq_u32(vshlq_n_u32(phase, 8), vshrq_n_u32(phase, 6));
    return vmlaq_n_u32(vdupq_n_u32(SECOND_SUM), w, UINT16_MAX);
}

/* Eight grey levels from second-pass sums. */
static inline uint8x8_t levels(uint32x4_t a, uint32x4_t b)
{
    const uint32x4_t rounding = vdupq_n_u32(ROUNDING);
    return vshrn_n_u16(vcombine_u16(vaddhn_u32(a, rounding), vaddhn_u32(b, rounding)), SUM_SHIFT - 16);
}

/* First-pass sums of two columns of four channels. */
static inline uint16x8_t columns(const uint8_t *above, const uint8_t *below, const uint8_t *upper, const uint8_t *lower)
{
    return vmlal_u8(vmull_u8(vld1_u8(above), vld1_dup_u8(upper)), vld1_u8(below), vld1_dup_u8(lower));
}

/* Second-pass sums of one pixel, and of the one after it, whose weights are next to its own. */
static inline uint32x4_t weigh_even(uint16x8_t v, uint16x4_t second)
{
    return vmlal_lane_u16(vmull_lane_u16(vget_low_u16(v), second, 0), vget_high_u16(v), second, 1);
}

static inline uint32x4_t weigh_odd(uint16x8_t v, uint16x4_t second)
{
    return vmlal_lane_u16(vmull_lane_u16(vget_low_u16(v), second, 2), vget_high_u16(v), second, 3);
}

void resample_linear_xrgb_neon(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    (void)window;
    const window_source_t from = *source; /* what is written might alias these */
    const uint8_t *above = from.data, *below = from.data + from.stride;
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += PATCH_STEP, y_q18 += PATCH_STEP) {
            const window_begins_t begins = window_begins(&from, x_q18, y_q18, 2);
            const uint16x4_t phase_y = vmovn_u32(phases(begins.y_q18));
            const uint16x8_t second = vreinterpretq_u16_u32(second_weights(phases(begins.x_q18)));
            const uint16x4_t left = vget_low_u16(second), right = vget_high_u16(second);
            uint32_t at[PATCH_STEP];
            uint8_t lower[8], upper[8];
            vst1q_u32(at, begins.texel);
            vst1_u8(lower, vmovn_u16(vcombine_u16(phase_y, phase_y)));
            vst1_u8(upper, vsub_u8(vdup_n_u8(FIRST_SUM), vmovn_u16(vcombine_u16(phase_y, phase_y))));
            const uint32x4_t a = weigh_even(columns(above + at[0], below + at[0], &upper[0], &lower[0]), left);
            const uint32x4_t b = weigh_odd(columns(above + at[1], below + at[1], &upper[1], &lower[1]), left);
            const uint32x4_t c = weigh_even(columns(above + at[2], below + at[2], &upper[2], &lower[2]), right);
            const uint32x4_t d = weigh_odd(columns(above + at[3], below + at[3], &upper[3], &lower[3]), right);
            vst1q_u8(out, vcombine_u8(levels(a, b), levels(c, d)));
            out += 4 * PATCH_STEP;
        }
    }
}

/* Two texels, and zeros. */
static inline uint64_t two_texels(const uint8_t *texels)
{
    uint16_t two;
    memcpy(&two, texels, sizeof two);
    return two;
}

/* Pairs of texels of four windows. */
static inline uint8x8_t four_pairs(const uint8_t *texels, uint32x4_t offset)
{
    const uint64x2_t offsets = vreinterpretq_u64_u32(offset);
    const uint64_t left = vgetq_lane_u64(offsets, 0), right = vgetq_lane_u64(offsets, 1);
    uint16x4_t pairs = vcreate_u16(two_texels(texels + (uint32_t)left));
    pairs = vset_lane_u16((uint16_t)two_texels(texels + (left >> 32)), pairs, 1);
    pairs = vset_lane_u16((uint16_t)two_texels(texels + (uint32_t)right), pairs, 2);
    return vreinterpret_u8_u16(vset_lane_u16((uint16_t)two_texels(texels + (right >> 32)), pairs, 3));
}

/* Phases of eight points. */
static inline uint16x8_t eight_phases(uint32x4_t left_q18, uint32x4_t right_q18)
{
    const uint16x8_t shifted =
        vcombine_u16(vmovn_u32(vshrq_n_u32(left_q18, PHASE_SHIFT)), vmovn_u32(vshrq_n_u32(right_q18, PHASE_SHIFT)));
    return vandq_u16(shifted, vdupq_n_u16(PHASES - 1));
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
    enum { STEP = RESAMPLE_LINEAR_GRAY_STEP };
    const window_source_t from = *source; /* what is written might alias these */
    const uint8_t *above = from.data, *below = from.data + from.stride;
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += STEP, y_q18 += STEP, out += STEP) {
            const window_begins_t left = window_begins(&from, x_q18, y_q18, 0);
            const window_begins_t right = window_begins(&from, x_q18 + 4, y_q18 + 4, 0);
            const uint8x16_t lower = vreinterpretq_u8_u16(vmulq_n_u16(eight_phases(left.y_q18, right.y_q18), 0x0101));
            const uint8x16_t upper = vsubq_u8(vdupq_n_u8(FIRST_SUM), lower);
            const uint16x8_t v_left = vmlal_u8(vmull_u8(four_pairs(above, left.texel), vget_low_u8(upper)),
                                               four_pairs(below, left.texel), vget_low_u8(lower));
            const uint16x8_t v_right = vmlal_u8(vmull_u8(four_pairs(above, right.texel), vget_high_u8(upper)),
                                                four_pairs(below, right.texel), vget_high_u8(lower));
            const uint16x8_t phase = eight_phases(left.x_q18, right.x_q18);
            const uint16x8_t w = vsubq_u16(vshlq_n_u16(phase, 8), vshrq_n_u16(phase, 6));
            const uint16x8_t rest = vsubq_u16(vdupq_n_u16(SECOND_SUM), w);
            vst1_u8(out, levels(weigh_gray(v_left, vzip1q_u16(rest, w)), weigh_gray(v_right, vzip2q_u16(rest, w))));
        }
    }
}
