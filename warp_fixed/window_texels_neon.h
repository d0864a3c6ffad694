// SPDX-License-Identifier: Apache-2.0
// What the loops of short windows of texels share: at most WINDOW_SHORT_TAPS along both axes, with 8-bit weights.
//
// The first pass has 16-bit sums. Without negative weights these are unsigned. With them, texels less 128 (copies:
// window_patch_neon.h), as signed bytes, give sums less 128 * FIRST_SUM, which fit signed 16 bits (fixed.h). A weight
// may be 128, which is no signed byte; its negative is, so these sums, and those of the second pass, are negated. What
// is always inlined has constant bounds there, and no branches.
#ifndef WARP_FIXED_WINDOW_TEXELS_NEON_H
#define WARP_FIXED_WINDOW_TEXELS_NEON_H

#include "warp_fixed/fixed.h"
#include "warp_fixed/window_patch_neon.h"

enum {
    WINDOW_MIN_TAPS = 2, /**< shorter windows are taken for such: weights beyond a window's are 0 */
    ROUNDING = 1 << (SUM_SHIFT - 1),
    /** What the first pass leaves out where weights are negative, times the second's sum; and for rounding. */
    START_NEGATIVE = 128 * FIRST_SUM * SECOND_SUM + ROUNDING
};

/** Where the texels and the rows of weights of one window begin. */
typedef struct {
    const uint8_t *texels, *first, *second;
} one_window_t;

/** @return The step's k-th window, where the source and row 0 of both tables begin at `origin`. */
NEON_INLINE one_window_t nth_window(const one_window_t *origin, const window_step_t *step, int k)
{
    return (one_window_t){origin->texels + stored_offset(&step->texel[k]),
                          origin->first + stored_offset(&step->row_y[k]),
                          origin->second + stored_offset(&step->row_x[k])};
}

/** First-pass weights of one window, a vector to each row. */
typedef struct {
    uint8x16_t row[WINDOW_SHORT_TAPS];
} splats_t;

/** @return The weights of ny rows. */
NEON_INLINE splats_t load_splats(const uint8_t *first, int32_t ny)
{
    splats_t splats;
    const uint8x16x4_t above = load_4_splats(first);
    for (int t = 0; t < 4; t++)
        splats.row[t] = above.val[t];
    if (ny == 5) {
        splats.row[4] = vld1q_dup_u8(first + 4);
    } else if (ny > 5) {
        const uint8x16x4_t below = load_4_splats(first + 4);
        for (int t = 0; t < 4; t++)
            splats.row[4 + t] = below.val[t];
    }
    return splats;
}

/** @return texels * weight: int16_t, or uint16_t where no weight is negative. */
NEON_INLINE int16x8_t products(uint8x8_t texels, uint8x8_t weight, bool negative)
{
    return negative ? vmull_s8(vreinterpret_s8_u8(texels), vreinterpret_s8_u8(weight))
                    : vreinterpretq_s16_u16(vmull_u8(texels, weight));
}

/** @return sums + texels * weight, likewise. */
NEON_INLINE int16x8_t add_products(int16x8_t sums, uint8x8_t texels, uint8x8_t weight, bool negative)
{
    return negative ? vmlal_s8(sums, vreinterpret_s8_u8(texels), vreinterpret_s8_u8(weight))
                    : vreinterpretq_s16_u16(vmlal_u8(vreinterpretq_u16_s16(sums), texels, weight));
}

/**
 * @return Eight values from sums of the second pass; the shift of SUM_SHIFT in two, which round down both: to 16 bits,
 *         then with saturation to 8.
 */
NEON_INLINE uint8x8_t pixels_from_sums(int32x4_t a, int32x4_t b, bool negative)
{
    const int32x4_t start = vdupq_n_s32(negative ? START_NEGATIVE : ROUNDING);
    const int16x8_t high = negative ? vcombine_s16(vsubhn_s32(start, a), vsubhn_s32(start, b))
                                    : vcombine_s16(vaddhn_s32(start, a), vaddhn_s32(start, b));
    return vqshrun_n_s16(high, SUM_SHIFT - 16);
}

static inline texels_t texels_of(const image_t *picture)
{
    return (texels_t){picture->data, picture->width, picture->height, picture->stride, (int32_t)picture->format};
}

#endif
