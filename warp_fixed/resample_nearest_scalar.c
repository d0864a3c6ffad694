// SPDX-License-Identifier: Apache-2.0
// Nearest neighbour: the picture pixel under each point.
#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_scalar.h"

/* Floor of the point; the far edge itself belongs to the last pixel. */
static const uint8_t *pixel_under(const image_t *picture, int32_t x_q18, int32_t y_q18)
{
    const int32_t x = clamp_i32(x_q18 >> GRID_FRACTION_BITS, 0, picture->width - 1);
    const int32_t y = clamp_i32(y_q18 >> GRID_FRACTION_BITS, 0, picture->height - 1);
    return image_row(picture, y) + x * (int32_t)picture->format;
}

void resample_nearest_gray_scalar(uint8_t *restrict out, const image_t *picture, const int32_t *restrict x_q18,
                                  const int32_t *restrict y_q18, int32_t count)
{
    for (int32_t k = 0; k < count; k++)
        out[k] = *pixel_under(picture, x_q18[k], y_q18[k]);
}

void resample_nearest_xrgb_scalar(uint8_t *restrict out, const image_t *picture, const int32_t *restrict x_q18,
                                  const int32_t *restrict y_q18, int32_t count)
{
    for (int32_t k = 0; k < count; k++) {
        const uint8_t *pixel = pixel_under(picture, x_q18[k], y_q18[k]);
        for (int32_t channel = 0; channel < 4; channel++)
            out[4 * k + channel] = pixel[channel];
    }
}
