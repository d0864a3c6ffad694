// SPDX-License-Identifier: Apache-2.0
// What the wall shows when there is nothing right to show: a dim, calm picture that names the board and says why.
#ifndef FIRMWARE_SAFE_PICTURE_H
#define FIRMWARE_SAFE_PICTURE_H

#include <stdint.h>

#include "warp_fixed/picture.h"

/** What it says. */
typedef struct {
    const char *board;  /**< its name in the room; without a room, what kind of board it is */
    int32_t node;       /**< 1 to 63; 0: none is known */
    const char *reason; /**< why there is nothing right to show, one line of any length */
} safe_picture_t;

/**
 * Draw it: dark grey, a border line, a cross through the middle, the node number as bars in the top-left corner, wide
 * for tens and narrow for ones; and over the cross, in letters as large as they fit, board, node and reason.
 *
 * @param[out] panel  Every pixel is written. Any size; GRAY8, XRGB8888, or luma and chroma. On a small one the end of
 *                    the reason is left out.
 */
void safe_picture_draw(const picture_t *panel, const safe_picture_t *what);

#endif
