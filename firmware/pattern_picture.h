// SPDX-License-Identifier: Apache-2.0
// Pictures for setting a projector up: focus, edges, brightness.
#ifndef FIRMWARE_PATTERN_PICTURE_H
#define FIRMWARE_PATTERN_PICTURE_H

#include "firmware/command.h"
#include "warp_fixed/picture.h"

/**
 * Draw one: the grid (lines of 1 to 4 pixels on black: the border, squares of an eighth of the height from the middle
 * on, the middle lines twice as wide), white, or black.
 *
 * @param[out] panel    Every pixel is written. Any size; GRAY8, XRGB8888, or luma and chroma.
 * @param      pattern  Not COMMAND_PATTERN_NONE.
 */
void pattern_picture_draw(const picture_t *panel, command_pattern_t pattern);

#endif
