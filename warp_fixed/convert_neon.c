// SPDX-License-Identifier: Apache-2.0
// Rows of one format -> rows of another: 16 bytes of each channel at a time.
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/neon.h"

enum { LANES = 16, PAIRS = LANES / 2, SCALE_BITS = 16 - COLOR_BITS };

void planes_from_yuyv_neon(uint8_t *restrict luma, uint8_t *restrict chroma, const uint8_t *restrict from,
                           int32_t pairs)
{
    int32_t i = 0;
    for (; i + PAIRS <= pairs; i += PAIRS) {
        const uint8x16x2_t row = vld2q_u8(from + 4 * i);
        vst1q_u8(luma + 2 * i, row.val[0]);
        vst1q_u8(chroma + 2 * i, row.val[1]);
    }
    planes_from_yuyv_scalar(luma + 2 * i, chroma + 2 * i, from + 4 * i, pairs - i);
}

void planes_from_uyvy_neon(uint8_t *restrict luma, uint8_t *restrict chroma, const uint8_t *restrict from,
                           int32_t pairs)
{
    planes_from_yuyv_neon(chroma, luma, from, pairs);
}

void yuyv_from_planes_neon(uint8_t *restrict out, const uint8_t *restrict luma, const uint8_t *restrict chroma,
                           int32_t pairs)
{
    int32_t i = 0;
    for (; i + PAIRS <= pairs; i += PAIRS) {
        const uint8x16x2_t row = {{vld1q_u8(luma + 2 * i), vld1q_u8(chroma + 2 * i)}};
        vst2q_u8(out + 4 * i, row);
    }
    yuyv_from_planes_scalar(out + 4 * i, luma + 2 * i, chroma + 2 * i, pairs - i);
}

/* Eight of them in 1 / 2^16. */
typedef struct {
    int32x4_t low, high;
} sums_t;

static inline sums_t product(int16x8_t values, int16_t weight)
{
    return (sums_t){vmull_n_s16(vget_low_s16(values), weight), vmull_n_s16(vget_high_s16(values), weight)};
}

static inline sums_t add_product(sums_t sums, int16x8_t values, int16_t weight)
{
    return (sums_t){vmlal_n_s16(sums.low, vget_low_s16(values), weight),
                    vmlal_n_s16(sums.high, vget_high_s16(values), weight)};
}

/* In units whose products with weights are in 1 / 2^16: a narrowing addition then rounds and shifts. */
static inline int16x8_t scaled(uint8x8_t values, int16_t zero)
{
    const int16x8_t wide = vreinterpretq_s16_u16(vshll_n_u8(values, SCALE_BITS));
    return vsubq_s16(wide, vdupq_n_s16((int16_t)(zero << SCALE_BITS)));
}

/* As color_byte(), of sums below 2^26: of left pixels, then of right ones. */
static inline uint8x16_t bytes(sums_t left, sums_t right, sums_t chroma)
{
    const int16x8_t first =
        vcombine_s16(add_rounded_high(left.low, chroma.low), add_rounded_high(left.high, chroma.high));
    const int16x8_t second =
        vcombine_s16(add_rounded_high(right.low, chroma.low), add_rounded_high(right.high, chroma.high));
    return vcombine_u8(vqmovun_s16(first), vqmovun_s16(second));
}

/* Eight pixels: B and G of each, R and X of each. */
static inline void store_eight(uint8_t *out, uint16x8_t bg, uint16x8_t rx)
{
    vst1q_u8(out, vreinterpretq_u8_u16(vzip1q_u16(bg, rx)));
    vst1q_u8(out + LANES, vreinterpretq_u8_u16(vzip2q_u16(bg, rx)));
}

/* Left pixels of eight pairs, then right ones. */
static inline void store_pairs(uint8_t *out, uint8x16_t b, uint8x16_t g, uint8x16_t r)
{
    const uint8x16_t x = vdupq_n_u8(0);
    const uint16x8_t left_bg = vreinterpretq_u16_u8(vzip1q_u8(b, g)), right_bg = vreinterpretq_u16_u8(vzip2q_u8(b, g));
    const uint16x8_t left_rx = vreinterpretq_u16_u8(vzip1q_u8(r, x)), right_rx = vreinterpretq_u16_u8(vzip2q_u8(r, x));
    store_eight(out, vzip1q_u16(left_bg, right_bg), vzip1q_u16(left_rx, right_rx));
    store_eight(out + 2 * LANES, vzip2q_u16(left_bg, right_bg), vzip2q_u16(left_rx, right_rx));
}

void xrgb_from_yuv_neon(uint8_t *restrict out, const uint8_t *restrict luma, const uint8_t *restrict chroma,
                        const color_matrix_t *matrix, int32_t pairs)
{
    const color_matrix_t m = *matrix;
    for (; pairs >= PAIRS; pairs -= PAIRS, luma += LANES, chroma += LANES, out += 4 * LANES) {
        const uint8x8x2_t uv = vld2_u8(chroma), y = vld2_u8(luma);
        const int16x8_t u = scaled(uv.val[0], 128), v = scaled(uv.val[1], 128);
        const sums_t blue = product(u, m.blue_from_u), red = product(v, m.red_from_v);
        const sums_t green = add_product(product(u, m.green_from_u), v, m.green_from_v);
        const sums_t left = product(scaled(y.val[0], 16), COLOR_LUMA);
        const sums_t right = product(scaled(y.val[1], 16), COLOR_LUMA);
        store_pairs(out, bytes(left, right, blue), bytes(left, right, green), bytes(left, right, red));
    }
    xrgb_from_yuv_scalar(out, luma, chroma, matrix, pairs);
}

void xrgb_from_rgb888_neon(uint8_t *restrict out, const uint8_t *restrict from, int32_t count)
{
    int32_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        const uint8x16x3_t row = vld3q_u8(from + 3 * i);
        const uint8x16x4_t pixels = {{row.val[0], row.val[1], row.val[2], vdupq_n_u8(0)}};
        vst4q_u8(out + 4 * i, pixels);
    }
    xrgb_from_rgb888_scalar(out + 4 * i, from + 3 * i, count - i);
}

void xrgb_from_bgr888_neon(uint8_t *restrict out, const uint8_t *restrict from, int32_t count)
{
    int32_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        const uint8x16x3_t row = vld3q_u8(from + 3 * i);
        const uint8x16x4_t pixels = {{row.val[2], row.val[1], row.val[0], vdupq_n_u8(0)}};
        vst4q_u8(out + 4 * i, pixels);
    }
    xrgb_from_bgr888_scalar(out + 4 * i, from + 3 * i, count - i);
}
