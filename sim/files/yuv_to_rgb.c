// SPDX-License-Identifier: Apache-2.0
// 8-bit Y'CbCr to R'G'B', in integers.
#include "sim/files/yuv_to_rgb.h"

const yuv_matrix_t *yuv_matrix(bool bt709, bool full_range)
{
    static const yuv_matrix_t matrices[2][2] = {
        {{16, 76309, 104597, -25675, -53279, 132201}, {0, 65536, 91881, -22553, -46802, 116130}},
        {{16, 76309, 117489, -13975, -34925, 138438}, {0, 65536, 103206, -12276, -30679, 121609}},
    };
    return &matrices[bt709][full_range];
}

/* Clamped before the shift, so nothing negative is shifted. */
static uint8_t byte_from_q16(int32_t value_q16)
{
    const int32_t rounded_q16 = value_q16 + 32768;
    if (rounded_q16 < 0)
        return 0;
    return rounded_q16 >= 256 << 16 ? 255 : (uint8_t)(rounded_q16 >> 16);
}

rgb_t rgb_from_yuv(const yuv_matrix_t *matrix, uint8_t y, uint8_t cb, uint8_t cr)
{
    /* |sum| < 255 * 76309 + 128 * 138438 < 2^26 */
    const int32_t luma_q16 = matrix->y_gain * (y - matrix->y_black);
    const int32_t b = cb - 128;
    const int32_t r = cr - 128;
    return (rgb_t){byte_from_q16(luma_q16 + matrix->red_from_cr * r),
                   byte_from_q16(luma_q16 + matrix->green_from_cb * b + matrix->green_from_cr * r),
                   byte_from_q16(luma_q16 + matrix->blue_from_cb * b)};
}
