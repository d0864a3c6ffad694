// SPDX-License-Identifier: Apache-2.0
// Between R, G, B and Y, U, V of limited range, in integers.
#ifndef WARP_FIXED_COLOR_H
#define WARP_FIXED_COLOR_H

#include <stdint.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/picture.h"

enum { COLOR_BITS = 13, COLOR_LUMA = 9539 /**< 255 / 219 */ };

/**
 * From Y, U, V, in 1 / 2^COLOR_BITS: with red and blue weights Kr, Kb (BT.709: 0.2126, 0.0722; BT.601: 0.299, 0.114),
 * Kg = 1 - Kr - Kb and c = 255 / 224,
 *
 *   R = 255/219 (Y - 16) + 2 c (1 - Kr) (V - 128)
 *   G = 255/219 (Y - 16) - 2 c (1 - Kb) Kb/Kg (U - 128) - 2 c (1 - Kr) Kr/Kg (V - 128)
 *   B = 255/219 (Y - 16) + 2 c (1 - Kb) (U - 128)
 *
 * Sums are rounded half up, then clamped to 0..255: never 1 from the exact value, rounded.
 */
typedef struct {
    int16_t red_from_v, green_from_u, green_from_v, blue_from_u;
} color_matrix_t;

/** @return Its numbers. */
static inline color_matrix_t color_matrix(picture_matrix_t matrix)
{
    return matrix == PICTURE_BT601 ? (color_matrix_t){13075, -3209, -6660, 16525}
                                   : (color_matrix_t){14686, -1747, -4366, 17305};
}

/** @return A sum in 1 / 2^COLOR_BITS, of magnitude below 2^30, as a byte. */
static inline uint8_t color_byte(int32_t sum)
{
    return (uint8_t)clamp_i32((int32_t)round_shift(sum, COLOR_BITS), 0, 255);
}

/** Write Y, U, V of a colour B, G, R: to the nearest byte, nearly always. */
static inline void color_yuv_from_bgr(uint8_t yuv[3], const uint8_t bgr[3], picture_matrix_t matrix)
{
    /* Q16; rows of U and V add up to 0, so that greys are 128. */
    static const int32_t weight[2][3][3] = {
        {{4064, 40254, 11966}, {28784, -22188, -6596}, {-2639, -26145, 28784}},
        {{6416, 33039, 16829}, {28784, -19070, -9714}, {-4681, -24103, 28784}},
    };
    for (int row = 0; row < 3; row++) {
        const int32_t *w = weight[matrix == PICTURE_BT601][row];
        const int32_t sum = w[0] * bgr[0] + w[1] * bgr[1] + w[2] * bgr[2];
        yuv[row] = (uint8_t)(round_shift(sum, 16) + (row == 0 ? 16 : 128));
    }
}

#endif
