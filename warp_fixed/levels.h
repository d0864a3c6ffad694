// SPDX-License-Identifier: Apache-2.0
// The picture at 1/8 and 1/64 of its size along either axis, for footprints of more than 64 texels.
#ifndef WARP_FIXED_LEVELS_H
#define WARP_FIXED_LEVELS_H

#include <stdint.h>

#include "warp_fixed/image.h"
#include "warp_fixed/workers.h"

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

/** The picture, or plane 0 or 1 of it, with x divided by 8^x and y by 8^y; 0 to LEVELS - 1. */
typedef struct {
    int x, y;
    int plane;
} level_t;

/** The smaller pictures of one frame's picture. */
typedef struct {
    uint8_t pixels[LEVELS_BYTES];
} levels_t;

/**
 * @return Where the picture of a level lies among all but the first: after all lower ones at their largest sizes, in
 *         channels; plane 1, which has half the channels at most, in the second half of that place. Not for level 0
 *         along both axes.
 */
ptrdiff_t levels_offset(level_t level);

/** @return A view into `levels`, where levels_make() writes; *picture itself when both levels are 0. */
image_t levels_picture(levels_t *levels, const image_t *picture, level_t level);

/**
 * Make a worker's rows of the picture at a level: means of its texels, rounded half up; texels beyond the edge are
 * mirrored. One pass over the picture. Nothing to do when both levels are 0.
 */
void levels_make(levels_t *levels, const image_t *picture, level_t level, worker_t worker);

#endif
