// SPDX-License-Identifier: Apache-2.0
// The picture at 1/8 and 1/64 of its size along either axis, for footprints of more than 64 texels.
#ifndef WARP_FIXED_LEVELS_H
#define WARP_FIXED_LEVELS_H

#include <stdbool.h>
#include <stdint.h>

#include "warp_fixed/image.h"

enum {
    LEVELS = 3, /**< per axis: 1, 1/8, 1/64 */
    LEVELS_EIGHTH_WIDTH = IMAGE_MAX_WIDTH / 8,
    LEVELS_EIGHTH_HEIGHT = (IMAGE_MAX_HEIGHT + 7) / 8,
    LEVELS_64TH_WIDTH = IMAGE_MAX_WIDTH / 64,
    LEVELS_64TH_HEIGHT = (IMAGE_MAX_HEIGHT + 63) / 64,
    /** bytes of all eight smaller pictures: (sum of widths) x (sum of heights) less the picture itself */
    LEVELS_BYTES = 4 * ((IMAGE_MAX_WIDTH + LEVELS_EIGHTH_WIDTH + LEVELS_64TH_WIDTH) *
                            (IMAGE_MAX_HEIGHT + LEVELS_EIGHTH_HEIGHT + LEVELS_64TH_HEIGHT) -
                        IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT)
};

/** The pictures made so far from this frame's picture. */
typedef struct {
    bool made[LEVELS][LEVELS]; /**< [x level][y level] */
    uint8_t pixels[LEVELS_BYTES];
} levels_t;

/**
 * @return Where the picture of a level lies among all but the first: after all lower ones at their largest sizes, in
 *         channels. Not for level 0 along both axes.
 */
ptrdiff_t levels_offset(int level_x, int level_y);

/** Forget the last frame's pictures. */
void levels_begin(levels_t *levels);

/**
 * The picture with x divided by 8^level_x and y by 8^level_y: means of its texels, rounded half up; texels beyond the
 * edge are mirrored. Made when first asked for in a frame: one pass over the picture.
 *
 * @return A view into `levels`, valid until levels_begin(); *picture itself when both levels are 0.
 */
image_t levels_picture(levels_t *levels, const image_t *picture, int level_x, int level_y);

#endif
