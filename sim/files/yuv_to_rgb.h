// SPDX-License-Identifier: Apache-2.0
// 8-bit Y'CbCr to R'G'B', in integers.
#ifndef SIM_FILES_YUV_TO_RGB_H
#define SIM_FILES_YUV_TO_RGB_H

#include <stdbool.h>
#include <stdint.h>

/**
 * The constants of one conversion, as Q16: real value * 65536, rounded to nearest.
 *
 * With red and blue weights Kr and Kb (BT.601: 0.299, 0.114; BT.709: 0.2126, 0.0722), Kg = 1 - Kr - Kb, and ranges
 * Y 16 to 235, Cb and Cr 16 to 240 (limited) or all 0 to 255 (full), so gains a = 255/219, c = 255/224 or a = c = 1:
 *
 *   R = a (Y - Y0)                                  + 2 c (1 - Kr) (Cr - 128)
 *   G = a (Y - Y0) - 2 c (1 - Kb) Kb/Kg (Cb - 128)  - 2 c (1 - Kr) Kr/Kg (Cr - 128)
 *   B = a (Y - Y0) + 2 c (1 - Kb) (Cb - 128)
 *
 * Each sum is taken in Q16, rounded half up, then clamped to 0..255: within 1 of the exact value, rounded.
 */
typedef struct {
    int32_t y_black; /**< Y0: 16 or 0 */
    int32_t y_gain;
    int32_t red_from_cr;
    int32_t green_from_cb, green_from_cr; /**< negative */
    int32_t blue_from_cb;
} yuv_matrix_t;

typedef struct {
    uint8_t red, green, blue;
} rgb_t;

/** @return The constants for BT.709 or BT.601, full or limited range. */
const yuv_matrix_t *yuv_matrix(bool bt709, bool full_range);

/** @return One converted pixel. Any input is legal. */
rgb_t rgb_from_yuv(const yuv_matrix_t *matrix, uint8_t y, uint8_t cb, uint8_t cr);

#endif
