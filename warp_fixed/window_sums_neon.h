// SPDX-License-Identifier: Apache-2.0
// The second pass of a window of any length: weighed columns -> sums.
#ifndef WARP_FIXED_WINDOW_SUMS_NEON_H
#define WARP_FIXED_WINDOW_SUMS_NEON_H

#include "warp_fixed/neon.h"

/** @return start + sum(second * v) of the four channels; v has `taps` pixels of them. */
static inline int32x4_t window_sums_xrgb(const int16_t *v, const int16_t *second, int32_t taps, int32_t start)
{
    int32x4_t sums = vdupq_n_s32(start);
    for (int32_t u = 0; u < taps; u++)
        sums = vmlal_n_s16(sums, vld1_s16(v + 4 * u), second[u]);
    return sums;
}

/** @return Four sums to be added up. v is 0 beyond the window, where `second` has weights of other rows. */
static inline int32x4_t window_sums_gray(const int16_t *v, const int16_t *second, int32_t taps)
{
    int32x4_t sums = vdupq_n_s32(0);
    for (int32_t u = 0; u < taps; u += 8) {
        const int16x8_t values = vld1q_s16(v + u), weights = vld1q_s16(second + u);
        sums = vmlal_s16(sums, vget_low_s16(values), vget_low_s16(weights));
        sums = vmlal_s16(sums, vget_high_s16(values), vget_high_s16(weights));
    }
    return sums;
}

/** @return Sums of U, V of even texels, then of odd ones. v is 0 beyond the window, up to a multiple of four texels. */
static inline int32x4_t window_sums_chroma(const int16_t *v, const int16_t *second, int32_t taps)
{
    int32x4_t sums = vdupq_n_s32(0);
    for (int32_t u = 0; u < taps; u += 4) {
        const int16x8_t values = vld1q_s16(v + 2 * u);
        const int16x4_t weights = vld1_s16(second + u);
        sums = vmlal_s16(sums, vget_low_s16(values), vzip1_s16(weights, weights));
        sums = vmlal_s16(sums, vget_high_s16(values), vzip2_s16(weights, weights));
    }
    return sums;
}

/** @return The first four numbers, each twice. On an A72 zip of long vectors takes three micro-operations, trn one. */
static inline int16x8_t twice_low(int16x8_t a)
{
#ifdef __aarch64__
    const int16x8_t wide = vreinterpretq_s16_s32(vmovl_s16(vget_low_s16(a)));
    return vtrn1q_s16(wide, wide);
#else
    return vzip1q_s16(a, a);
#endif
}

/** @return The last four. */
static inline int16x8_t twice_high(int16x8_t a)
{
#ifdef __aarch64__
    const int16x8_t wide = vreinterpretq_s16_s32(vmovl_high_s16(a));
    return vtrn1q_s16(wide, wide);
#else
    return vzip2q_s16(a, a);
#endif
}

/** @return U, V of two pixels, from sums of even and of odd texels of each. */
static inline int32x4_t chroma_from_sums(int32x4_t a, int32x4_t b)
{
#ifdef __aarch64__ /* as above: no zip */
    const uint32x4_t in_a = vreinterpretq_u32_u64(vcombine_u64(vdup_n_u64(UINT64_MAX), vdup_n_u64(0)));
    return vaddq_s32(vbslq_s32(in_a, a, b), vextq_s32(a, b, 2));
#else
    return vaddq_s32(vcombine_s32(vget_low_s32(a), vget_low_s32(b)), vcombine_s32(vget_high_s32(a), vget_high_s32(b)));
#endif
}

#endif
