// SPDX-License-Identifier: Apache-2.0
// Rows of one format -> rows of another.
#include "warp_fixed/kernels_scalar.h"

void planes_from_yuyv_scalar(uint8_t *restrict luma, uint8_t *restrict chroma, const uint8_t *restrict from,
                             int32_t pairs)
{
    for (int32_t i = 0; i < 2 * pairs; i++) {
        luma[i] = from[2 * i];
        chroma[i] = from[2 * i + 1];
    }
}

void planes_from_uyvy_scalar(uint8_t *restrict luma, uint8_t *restrict chroma, const uint8_t *restrict from,
                             int32_t pairs)
{
    planes_from_yuyv_scalar(chroma, luma, from, pairs);
}

void yuyv_from_planes_scalar(uint8_t *restrict out, const uint8_t *restrict luma, const uint8_t *restrict chroma,
                             int32_t pairs)
{
    for (int32_t i = 0; i < 2 * pairs; i++) {
        out[2 * i] = luma[i];
        out[2 * i + 1] = chroma[i];
    }
}

void xrgb_from_yuv_scalar(uint8_t *restrict out, const uint8_t *restrict luma, const uint8_t *restrict chroma,
                          const color_matrix_t *matrix, int32_t pairs)
{
    for (int32_t i = 0; i < 2 * pairs; i++) {
        const int32_t y = COLOR_LUMA * (luma[i] - 16), u = chroma[i & ~1] - 128, v = chroma[i | 1] - 128;
        out[4 * i] = color_byte(y + matrix->blue_from_u * u);
        out[4 * i + 1] = color_byte(y + matrix->green_from_u * u + matrix->green_from_v * v);
        out[4 * i + 2] = color_byte(y + matrix->red_from_v * v);
        out[4 * i + 3] = 0;
    }
}

void xrgb_from_rgb888_scalar(uint8_t *restrict out, const uint8_t *restrict from, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        for (int32_t channel = 0; channel < 3; channel++)
            out[4 * i + channel] = from[3 * i + channel];
        out[4 * i + 3] = 0;
    }
}

void xrgb_from_bgr888_scalar(uint8_t *restrict out, const uint8_t *restrict from, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        for (int32_t channel = 0; channel < 3; channel++)
            out[4 * i + channel] = from[3 * i + 2 - channel];
        out[4 * i + 3] = 0;
    }
}
