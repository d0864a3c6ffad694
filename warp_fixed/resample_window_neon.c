// SPDX-License-Identifier: Apache-2.0
// A window of texels around each point: short windows (at most WINDOW_SHORT_TAPS along both axes) with 8-bit weights.
//
// The first pass has 16-bit sums. Without negative weights these are unsigned. With them, texels less 128, as signed
// bytes, give sums less 128 * FIRST_SUM, which fit signed 16 bits (fixed.h). A weight may be 128, which is no signed
// byte; its negative is, so the first pass subtracts products with negated weights. Weights are the low bytes of table
// entries: every CPU that this code runs on is little endian. What is always inlined has constant bounds there, and no
// branches.
#include <string.h>

#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/resample_long_neon.h"
#include "warp_fixed/window_place_neon.h"

enum {
    ROUNDING = 1 << (SUM_SHIFT - 1),
    START_NEGATIVE = 128 * FIRST_SUM * SECOND_SUM + ROUNDING /* what the first pass left out, times the second's sum */
};

/* A row of up to eight first-pass weights as bytes, negated where some are negative. */
static inline uint8x8_t first_weights(const int16_t *first, bool negative)
{
    const uint8x8_t weights = vmovn_u16(vreinterpretq_u16_s16(vld1q_s16(first)));
    return negative ? vreinterpret_u8_s8(vneg_s8(vreinterpret_s8_u8(weights))) : weights;
}

/* First-pass sums of eight bytes: int16_t, or uint16_t where no weight is negative. Texels are less 128 then. */
static inline int16x8_t add_row(int16x8_t sums, uint8x8_t texels, uint8x8_t weight, bool negative)
{
    if (!negative)
        return vreinterpretq_s16_u16(vmlal_u8(vreinterpretq_u16_s16(sums), texels, weight));
    return vmlsl_s8(sums, vreinterpret_s8_u8(texels), vreinterpret_s8_u8(weight));
}

/* The same with the upper half of texels. */
static inline int16x8_t add_row_high(int16x8_t sums, uint8x16_t texels, uint8x16_t weight, bool negative)
{
    if (!negative)
        return vreinterpretq_s16_u16(vmlal_high_u8(vreinterpretq_u16_s16(sums), texels, weight));
    return vmlsl_high_s8(sums, vreinterpretq_s8_u8(texels), vreinterpretq_s8_u8(weight));
}

/* Add a row of nx pixels, an odd number and one more, to the sums of pairs. nx is a constant where this is inlined. */
static inline __attribute__((always_inline)) void add_row_xrgb(int16x8_t *v, const uint8_t *texels, uint8x16_t weight,
                                                               int32_t nx, bool negative)
{
    const uint8x8_t low_weight = vget_low_u8(weight);
    const uint8x16_t middle = vdupq_n_u8(negative ? 128 : 0);
    for (int pair = 0; 2 * pair < nx; pair += 2) {
        if (nx <= 2 * pair + 2) {
            v[pair] = add_row(v[pair], veor_u8(vld1_u8(texels + 8 * pair), vget_low_u8(middle)), low_weight, negative);
            continue;
        }
        const uint8x16_t four = veorq_u8(vld1q_u8(texels + 8 * pair), middle);
        v[pair] = add_row(v[pair], vget_low_u8(four), low_weight, negative);
        v[pair + 1] = add_row_high(v[pair + 1], four, weight, negative);
    }
}

/* sums + weights[lane] * values, for one pixel's four channels. */
#define ADD_PIXEL(sums, values, weights, lane, negative)                                                               \
    ((negative) ? vmlal_lane_s16(sums, values, weights, lane)                                                          \
                : vreinterpretq_s32_u32(vmlal_lane_u16(vreinterpretq_u32_s32(sums), vreinterpret_u16_s16(values),      \
                                                       vreinterpret_u16_s16(weights), lane)))

/* Second-pass sums of one pixel. nx is a constant where this is inlined. */
static inline __attribute__((always_inline)) int32x4_t weigh_xrgb(const uint8_t *texels, ptrdiff_t stride,
                                                                  const int16_t *first, int32_t ny,
                                                                  const int16_t *second, int32_t nx, bool negative)
{
    int16x8_t v[WINDOW_SHORT_TAPS / 2];
    for (int pair = 0; 2 * pair < nx; pair++)
        v[pair] = vdupq_n_s16(0);
    const uint8x8_t w = first_weights(first, negative);
    add_row_xrgb(v, texels, vdupq_lane_u8(w, 0), nx, negative);
    if (ny > 1)
        add_row_xrgb(v, texels + 1 * stride, vdupq_lane_u8(w, 1), nx, negative);
    if (ny > 2)
        add_row_xrgb(v, texels + 2 * stride, vdupq_lane_u8(w, 2), nx, negative);
    if (ny > 3)
        add_row_xrgb(v, texels + 3 * stride, vdupq_lane_u8(w, 3), nx, negative);
    if (ny > 4)
        add_row_xrgb(v, texels + 4 * stride, vdupq_lane_u8(w, 4), nx, negative);
    if (ny > 5)
        add_row_xrgb(v, texels + 5 * stride, vdupq_lane_u8(w, 5), nx, negative);
    if (ny > 6)
        add_row_xrgb(v, texels + 6 * stride, vdupq_lane_u8(w, 6), nx, negative);
    if (ny > 7)
        add_row_xrgb(v, texels + 7 * stride, vdupq_lane_u8(w, 7), nx, negative);

    const int16x8_t weights = vld1q_s16(second);
    const int16x4_t left = vget_low_s16(weights), right = vget_high_s16(weights);
    int32x4_t sums = vdupq_n_s32(negative ? START_NEGATIVE : ROUNDING);
    sums = ADD_PIXEL(sums, vget_low_s16(v[0]), left, 0, negative);
    if (nx > 1)
        sums = ADD_PIXEL(sums, vget_high_s16(v[0]), left, 1, negative);
    if (nx > 2)
        sums = ADD_PIXEL(sums, vget_low_s16(v[1]), left, 2, negative);
    if (nx > 3)
        sums = ADD_PIXEL(sums, vget_high_s16(v[1]), left, 3, negative);
    if (nx > 4)
        sums = ADD_PIXEL(sums, vget_low_s16(v[2]), right, 0, negative);
    if (nx > 5)
        sums = ADD_PIXEL(sums, vget_high_s16(v[2]), right, 1, negative);
    if (nx > 6)
        sums = ADD_PIXEL(sums, vget_low_s16(v[3]), right, 2, negative);
    if (nx > 7)
        sums = ADD_PIXEL(sums, vget_high_s16(v[3]), right, 3, negative);
    return sums;
}

/* Eight values; the shift of SUM_SHIFT in two, which round down both: to 16 bits, then with saturation to 8. */
static inline uint8x8_t pixels_from_sums(int32x4_t a, int32x4_t b)
{
    return vqshrun_n_s16(vcombine_s16(vshrn_n_s32(a, 16), vshrn_n_s32(b, 16)), SUM_SHIFT - 16);
}

static inline __attribute__((always_inline)) void short_xrgb(uint8_t *out, const window_t *window, const int32_t *x_q18,
                                                             const int32_t *y_q18, int32_t count, int32_t nx,
                                                             int32_t ny, bool negative)
{
    const ptrdiff_t stride = window->picture.stride;
    const placer_t placer = placer_of(window, (nx + 1) & -2, stride);
    places_t places;
    int32_t k = 0;
    for (; k + PLACE_STEP <= count; k += PLACE_STEP) {
        if (!find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
            resample_window_xrgb_scalar(out + (ptrdiff_t)k * 4, window, x_q18 + k, y_q18 + k, PLACE_STEP);
            continue;
        }
        int32x4_t sums[PLACE_STEP];
        for (int i = 0; i < PLACE_STEP; i++)
            sums[i] = weigh_xrgb(window->picture.data + place_begin(&places, window, i, stride, 4), stride,
                                 window->y.first + places.phase_y[i] * ny, ny,
                                 window->x.second + places.phase_x[i] * nx, nx, negative);
        vst1q_u8(out + (ptrdiff_t)k * 4,
                 vcombine_u8(pixels_from_sums(sums[0], sums[1]), pixels_from_sums(sums[2], sums[3])));
    }
    resample_window_xrgb_scalar(out + (ptrdiff_t)k * 4, window, x_q18 + k, y_q18 + k, count - k);
}

/* Square windows of the plain interpolators come first: all their loops have constant bounds. */
static inline __attribute__((always_inline)) void short_xrgb_by_taps(uint8_t *out, const window_t *window,
                                                                     const int32_t *x_q18, const int32_t *y_q18,
                                                                     int32_t count, bool negative)
{
    const int32_t nx = window->x.taps, ny = window->y.taps;
    if (!negative && nx == 2 && ny == 2) {
        short_xrgb(out, window, x_q18, y_q18, count, 2, 2, negative);
        return;
    }
    if (nx == 4 && ny == 4) {
        short_xrgb(out, window, x_q18, y_q18, count, 4, 4, negative);
        return;
    }
    switch (nx) {
    case 1:
        short_xrgb(out, window, x_q18, y_q18, count, 1, ny, negative);
        break;
    case 2:
        short_xrgb(out, window, x_q18, y_q18, count, 2, ny, negative);
        break;
    case 3:
        short_xrgb(out, window, x_q18, y_q18, count, 3, ny, negative);
        break;
    case 4:
        short_xrgb(out, window, x_q18, y_q18, count, 4, ny, negative);
        break;
    case 5:
        short_xrgb(out, window, x_q18, y_q18, count, 5, ny, negative);
        break;
    case 6:
        short_xrgb(out, window, x_q18, y_q18, count, 6, ny, negative);
        break;
    case 7:
        short_xrgb(out, window, x_q18, y_q18, count, 7, ny, negative);
        break;
    default:
        short_xrgb(out, window, x_q18, y_q18, count, WINDOW_SHORT_TAPS, ny, negative);
    }
}

/* Products of the second pass for one pixel: their four lanes are to be added up. `used` masks the window's weights. */
static inline __attribute__((always_inline)) int32x4_t weigh_gray(const uint8_t *texels, ptrdiff_t stride,
                                                                  const int16_t *first, int32_t ny,
                                                                  const int16_t *second, uint16x8_t used, bool negative)
{
    int16x8_t v = vdupq_n_s16(0);
    const uint8x8_t middle = vdup_n_u8(negative ? 128 : 0);
    for (int32_t t = 0; t < ny; t++, texels += stride) {
        const uint8x8_t weight = vld1_dup_u8((const uint8_t *)(first + t));
        const uint8x8_t signed_weight = negative ? vreinterpret_u8_s8(vneg_s8(vreinterpret_s8_u8(weight))) : weight;
        v = add_row(v, veor_u8(vld1_u8(texels), middle), signed_weight, negative);
    }
    const int16x8_t weights = vandq_s16(vld1q_s16(second), vreinterpretq_s16_u16(used));
    if (negative)
        return vmlal_s16(vmull_s16(vget_low_s16(v), vget_low_s16(weights)), vget_high_s16(v), vget_high_s16(weights));
    const uint16x8_t u = vreinterpretq_u16_s16(v), w = vreinterpretq_u16_s16(weights);
    return vreinterpretq_s32_u32(
        vmlal_u16(vmull_u16(vget_low_u16(u), vget_low_u16(w)), vget_high_u16(u), vget_high_u16(w)));
}

static inline __attribute__((always_inline)) void short_gray(uint8_t *out, const window_t *window, const int32_t *x_q18,
                                                             const int32_t *y_q18, int32_t count, bool negative)
{
    static const uint16_t numbers[WINDOW_SHORT_TAPS] = {0, 1, 2, 3, 4, 5, 6, 7};
    const ptrdiff_t stride = window->picture.stride;
    const int32_t nx = window->x.taps, ny = window->y.taps;
    const uint16x8_t used = vcltq_u16(vld1q_u16(numbers), vdupq_n_u16((uint16_t)nx));
    const int32x4_t start = vdupq_n_s32(negative ? START_NEGATIVE : ROUNDING);
    const placer_t placer = placer_of(window, WINDOW_SHORT_TAPS, stride);
    places_t places;
    int32_t k = 0;
    for (; k + PLACE_STEP <= count; k += PLACE_STEP) {
        if (!find_places(&places, &placer, x_q18 + k, y_q18 + k)) {
            resample_window_gray_scalar(out + k, window, x_q18 + k, y_q18 + k, PLACE_STEP);
            continue;
        }
        int32x4_t sums[PLACE_STEP];
        for (int i = 0; i < PLACE_STEP; i++)
            sums[i] = weigh_gray(window->picture.data + place_begin(&places, window, i, stride, 1), stride,
                                 window->y.first + places.phase_y[i] * ny, ny,
                                 window->x.second + places.phase_x[i] * nx, used, negative);
        const int32x4_t four = vpaddq_s32(vpaddq_s32(sums[0], sums[1]), vpaddq_s32(sums[2], sums[3]));
        const int32x4_t rounded = vaddq_s32(four, start);
        const uint8x8_t pixels = pixels_from_sums(rounded, rounded);
        memcpy(out + k, &pixels, PLACE_STEP);
    }
    resample_window_gray_scalar(out + k, window, x_q18 + k, y_q18 + k, count - k);
}

static bool is_short(const window_t *window)
{
    return window->x.taps <= WINDOW_SHORT_TAPS && window->y.taps <= WINDOW_SHORT_TAPS;
}

void resample_window_xrgb_neon(uint8_t *restrict out, const window_t *window, const int32_t *restrict x_q18,
                               const int32_t *restrict y_q18, int32_t count)
{
    if (!offsets_fit(window->picture.stride, window->picture.height))
        resample_window_xrgb_scalar(out, window, x_q18, y_q18, count);
    else if (!is_short(window))
        resample_long_xrgb_neon(out, window, x_q18, y_q18, count);
    else if (window->x.negative)
        short_xrgb_by_taps(out, window, x_q18, y_q18, count, true);
    else
        short_xrgb_by_taps(out, window, x_q18, y_q18, count, false);
}

void resample_window_gray_neon(uint8_t *restrict out, const window_t *window, const int32_t *restrict x_q18,
                               const int32_t *restrict y_q18, int32_t count)
{
    if (!offsets_fit(window->picture.stride, window->picture.height))
        resample_window_gray_scalar(out, window, x_q18, y_q18, count);
    else if (!is_short(window))
        resample_long_gray_neon(out, window, x_q18, y_q18, count);
    else if (window->x.negative)
        short_gray(out, window, x_q18, y_q18, count, true);
    else
        short_gray(out, window, x_q18, y_q18, count, false);
}
