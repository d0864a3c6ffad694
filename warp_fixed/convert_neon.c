// SPDX-License-Identifier: Apache-2.0
// Rows of one format -> rows of another: 16 bytes of each channel at a time.
#include "warp_fixed/kernels_neon.h"
#include "warp_fixed/kernels_scalar.h"
#include "warp_fixed/neon.h"

enum { LANES = 16, PAIRS = LANES / 2 };

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

/* Eight of them in 1 / 2^COLOR_BITS. */
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

/* Each twice. */
static inline sums_t add_twice(const sums_t *luma, sums_t chroma, int half)
{
    const int32x4_t four = half == 0 ? chroma.low : chroma.high;
    return (sums_t){vaddq_s32(luma->low, vzip1q_s32(four, four)), vaddq_s32(luma->high, vzip2q_s32(four, four))};
}

/* As color_byte(): |sum| < 2^23, and 2^23 / 2^COLOR_BITS fits 16 bits. */
static inline uint8x8_t bytes(sums_t sums)
{
    return vqmovun_s16(vcombine_s16(vrshrn_n_s32(sums.low, COLOR_BITS), vrshrn_n_s32(sums.high, COLOR_BITS)));
}

void xrgb_from_yuv_neon(uint8_t *restrict out, const uint8_t *restrict luma, const uint8_t *restrict chroma,
                        const color_matrix_t *matrix, int32_t pairs)
{
    int32_t i = 0;
    for (; i + PAIRS <= pairs; i += PAIRS) {
        const uint8x8x2_t uv = vld2_u8(chroma + 2 * i);
        const int16x8_t u = vreinterpretq_s16_u16(vsubl_u8(uv.val[0], vdup_n_u8(128)));
        const int16x8_t v = vreinterpretq_s16_u16(vsubl_u8(uv.val[1], vdup_n_u8(128)));
        const sums_t blue = product(u, matrix->blue_from_u), red = product(v, matrix->red_from_v);
        const sums_t green = add_product(product(u, matrix->green_from_u), v, matrix->green_from_v);
        for (int half = 0; half < 2; half++) {
            const uint8x8_t y = vld1_u8(luma + 2 * i + 8 * half);
            const sums_t level = product(vreinterpretq_s16_u16(vsubl_u8(y, vdup_n_u8(16))), COLOR_LUMA);
            const uint8x8x4_t pixels = {{bytes(add_twice(&level, blue, half)), bytes(add_twice(&level, green, half)),
                                         bytes(add_twice(&level, red, half)), vdup_n_u8(0)}};
            vst4_u8(out + 8 * i + 32 * half, pixels);
        }
    }
    xrgb_from_yuv_scalar(out + 8 * i, luma + 2 * i, chroma + 2 * i, matrix, pairs - i);
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
