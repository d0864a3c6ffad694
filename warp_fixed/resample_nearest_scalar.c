// SPDX-License-Identifier: Apache-2.0
// Nearest neighbour: the picture pixel under each point.
#include <string.h>

#include "warp_fixed/fixed.h"
#include "warp_fixed/kernels_scalar.h"

/* Floor of the point; the far edge itself belongs to the last pixel. */
static const uint8_t *pixel_under(const image_t *picture, int32_t x_q18, int32_t y_q18)
{
    const int32_t x = clamp_i32(x_q18 >> GRID_FRACTION_BITS, 0, picture->width - 1);
    const int32_t y = clamp_i32(y_q18 >> GRID_FRACTION_BITS, 0, picture->height - 1);
    return image_row(picture, y) + x * (int32_t)picture->format;
}

/* Always inlined with a constant number of channels. */
static inline void copy_patch(const patch_t *patch, const image_t *picture, int32_t channels)
{
    for (int32_t r = 0; r < patch->height; r++) {
        const int32_t *x_q18 = patch->x_q18 + r * PATCH_MAX_WIDTH, *y_q18 = patch->y_q18 + r * PATCH_MAX_WIDTH;
        for (int32_t k = 0; k < patch->width; k++)
            memcpy(patch->out + r * patch->stride + k * channels, pixel_under(picture, x_q18[k], y_q18[k]),
                   (size_t)channels);
    }
}

void resample_nearest_gray_scalar(const patch_t *patch, const image_t *picture)
{
    copy_patch(patch, picture, 1);
}

void resample_nearest_chroma_scalar(const patch_t *patch, const image_t *picture)
{
    copy_patch(patch, picture, 2);
}

void resample_nearest_xrgb_scalar(const patch_t *patch, const image_t *picture)
{
    copy_patch(patch, picture, 4);
}
