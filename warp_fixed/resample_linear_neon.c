// SPDX-License-Identifier: Apache-2.0
// Linear interpolation: its weights follow from the phases, without a table.
//
// The tables' rows for phase p are 128 - p and p in the first pass, 32767 - w and w in the second, where
// w = 256 p - floor(p / 64): 32767 p / 128 rounded by largest remainders.
//
// Gray windows are read from copies in which each byte is followed by the one below: one load has a window's four
// texels. This saves 2 instructions a pixel, and the copy costs some 0.4 for each texel.
#include "warp_fixed/resample_linear_neon.h"

#include "warp_fixed/fixed.h"
#include "warp_fixed/window_ahead.h"

enum { STEP = RESAMPLE_LINEAR_STEP, PHASE_SHIFT = GRID_FRACTION_BITS - PHASE_BITS, ROUNDING = 1 << (SUM_SHIFT - 1) };

#ifdef __AVX2__
#include "warp_fixed/resample_linear_avx2.h"
#else
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

static inline void eight_xrgb(uint8_t *out, const window_source_t *from, const int32_t *x_q18, const int32_t *y_q18,
                              ptrdiff_t ahead)
{
    (void)ahead;
    const eight_windows_t windows = eight_windows(from, x_q18, y_q18, 2);
    uint8_t upper[STEP], lower[STEP];
    vst1_u8(upper, vsub_u8(vdup_n_u8(FIRST_SUM), vmovn_u16(windows.lower)));
    vst1_u8(lower, vmovn_u16(windows.lower));
    vst1q_u8(out, four_xrgb(from, windows.texel[0], &upper[0], &lower[0], windows.second[0]));
    vst1q_u8(out + 16, four_xrgb(from, windows.texel[1], &upper[4], &lower[4], windows.second[1]));
}
#endif

void resample_linear_xrgb_neon(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    (void)window;
    const window_source_t from = *source; /* what is written might alias these */
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const ptrdiff_t ahead = bytes_ahead(patch, r, &from, 2);
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += STEP, y_q18 += STEP, out += 4 * STEP)
            eight_xrgb(out, &from, x_q18, y_q18, ahead);
    }
}

/* Where eight windows begin along one axis, in phases; modulo 2^16, for a copy has less than 512 texels. */
static inline uint16x8_t eight_begins(const int32_t *point_q18, uint16x8_t start)
{
    const uint32x4_t left = vreinterpretq_u32_s32(vld1q_s32(point_q18));
    const uint32x4_t right = vreinterpretq_u32_s32(vld1q_s32(point_q18 + 4));
    return vaddq_u16(vcombine_u16(vrshrn_n_u32(left, PHASE_SHIFT), vrshrn_n_u32(right, PHASE_SHIFT)), start);
}

/* w of eight windows, of their phases times 512; less 1 where the upper bit of the phase is set. */
static inline uint16x8_t right_weights(uint16x8_t begins)
{
    const uint16x8_t p_512 = vshlq_n_u16(begins, 16 - PHASE_BITS), p_256 = vshrq_n_u16(p_512, 1);
    return vreinterpretq_u16_s16(vsraq_n_s16(vreinterpretq_s16_u16(p_256), vreinterpretq_s16_u16(p_512), 15));
}

/* Windows of eight pixels: first the left column of each, the upper texels, then the lower ones; then the right one. */
typedef struct {
    uint8x16_t left, right;
} eight_quads_t;

static inline uint16x8_t two_quads(const uint8_t *texels, size_t a, size_t b)
{
    return vreinterpretq_u16_u8(vzip1q_u8(load_word(texels + a), load_word(texels + b)));
}

static inline eight_quads_t eight_quads(const uint8_t *texels, const uint32_t *at)
{
    size_t offset[STEP];
    for (int k = 0; k < STEP; k++)
        offset[k] = stored_offset(&at[k]);
    const uint16x8_t p = two_quads(texels, offset[0], offset[1]), q = two_quads(texels, offset[2], offset[3]);
    const uint16x8_t r = two_quads(texels, offset[4], offset[5]), s = two_quads(texels, offset[6], offset[7]);
    const uint32x4_t a = vreinterpretq_u32_u16(vzip1q_u16(p, q)), b = vreinterpretq_u32_u16(vzip1q_u16(r, s));
    return (eight_quads_t){vreinterpretq_u8_u32(vzip1q_u32(a, b)), vreinterpretq_u8_u32(vzip2q_u32(a, b))};
}

/* First-pass sums of eight columns: at most 255 * FIRST_SUM, below 2^15. */
static inline uint16x8_t eight_columns(uint8x16_t texels, uint8x16_t weights)
{
    return vmlal_high_u8(vmull_u8(vget_low_u8(texels), vget_low_u8(weights)), texels, weights);
}

/* Eight grey levels from first-pass sums. */
static inline uint8x8_t eight_gray(uint16x8_t left, uint16x8_t right, uint16x8_t rest, uint16x8_t w)
{
    const uint32x4_t a =
        vmlal_u16(vmull_u16(vget_low_u16(left), vget_low_u16(rest)), vget_low_u16(right), vget_low_u16(w));
    const uint32x4_t b = vmlal_high_u16(vmull_high_u16(left, rest), right, w);
    return vrshrn_n_u16(vuzp2q_u16(vreinterpretq_u16_u32(a), vreinterpretq_u16_u32(b)), SUM_SHIFT - 16);
}

void resample_linear_gray_neon(const patch_t *patch, const window_t *window, const window_source_t *source)
{
    (void)window;
    const window_source_t from = *source; /* what is written might alias these */
    const uint16x8_t x_start = vdupq_n_u16((uint16_t)(from.x_start_q18 >> PHASE_SHIFT));
    const uint16x8_t y_start = vdupq_n_u16((uint16_t)(from.y_start_q18 >> PHASE_SHIFT));
    const int32_t width = patch->width, height = patch->height;
    for (int32_t r = 0; r < height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        uint8_t *out = patch->out + r * patch->stride;
        for (const int32_t *end = x_q18 + width; x_q18 < end; x_q18 += STEP, y_q18 += STEP, out += STEP) {
            const uint16x8_t x = eight_begins(x_q18, x_start), y = eight_begins(y_q18, y_start);
            const uint16x8_t column = vshrq_n_u16(x, PHASE_BITS), row = vshrq_n_u16(y, PHASE_BITS);
            uint32_t at[STEP];
            store_numbers(at, vmlal_n_u16(vshll_n_u16(vget_low_u16(column), 1), vget_low_u16(row), COPY_STRIDE));
            store_numbers(at + 4, vmlal_n_u16(vshll_n_u16(vget_high_u16(column), 1), vget_high_u16(row), COPY_STRIDE));
            const uint16x8_t lower = vandq_u16(y, vdupq_n_u16(PHASES - 1));
            const uint16x8_t upper = vsubq_u16(vdupq_n_u16(FIRST_SUM), lower);
            const uint8x16_t first = vuzp1q_u8(vreinterpretq_u8_u16(upper), vreinterpretq_u8_u16(lower));
            const uint16x8_t w = right_weights(x), rest = veorq_u16(w, vdupq_n_u16(SECOND_SUM));
            const eight_quads_t quads = eight_quads(from.data, at);
            vst1_u8(out, eight_gray(eight_columns(quads.left, first), eight_columns(quads.right, first), rest, w));
        }
    }
}
