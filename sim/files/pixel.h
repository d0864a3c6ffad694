// SPDX-License-Identifier: Apache-2.0
// One pixel from R, G and B, in either picture format.
#ifndef SIM_FILES_PIXEL_H
#define SIM_FILES_PIXEL_H

#include <stdint.h>

#include "warp_fixed/image.h"

/**
 * Luma of an 8-bit colour, rounded half up: (19595 R + 38470 G + 7471 B + 32768) >> 16.
 *
 * The weights add up to 65536, so the luma of a gray (v, v, v) is v.
 */
static inline uint8_t luma_from_rgb(uint32_t red, uint32_t green, uint32_t blue)
{
    return (uint8_t)((19595 * red + 38470 * green + 7471 * blue + 32768) >> 16);
}

/** Write one pixel: luma for GRAY8; B, G, R and X = 0 for XRGB8888. */
static inline void pixel_put(uint8_t *pixel, image_format_t format, uint8_t red, uint8_t green, uint8_t blue)
{
    if (format == IMAGE_GRAY8) {
        pixel[0] = luma_from_rgb(red, green, blue);
        return;
    }
    pixel[0] = blue;
    pixel[1] = green;
    pixel[2] = red;
    pixel[3] = 0;
}

#endif
