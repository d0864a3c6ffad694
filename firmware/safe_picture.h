// SPDX-License-Identifier: Apache-2.0
// What the wall shows when there is nothing right to show: a dim, calm picture that names the board.
#ifndef FIRMWARE_SAFE_PICTURE_H
#define FIRMWARE_SAFE_PICTURE_H

#include <stdint.h>

#include "warp_fixed/picture.h"

/**
 * Draw it: dark grey, a border line, a cross through the middle, and the node number as bars in the top-left corner,
 * wide for tens and narrow for ones.
 *
 * @param[out] panel  Every pixel is written. Any size; GRAY8, XRGB8888, or luma and chroma.
 * @param      node   1 to 63.
 */
void safe_picture_draw(const picture_t *panel, int32_t node);

#endif
