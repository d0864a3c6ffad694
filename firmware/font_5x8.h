// SPDX-License-Identifier: Apache-2.0
// Letters for the board's own pictures: ASCII, each 5 pixels wide and 8 high, as simple as they can be read from afar.
#ifndef FIRMWARE_FONT_5X8_H
#define FIRMWARE_FONT_5X8_H

#include <stdbool.h>
#include <stdint.h>

enum {
    FONT_WIDTH = 5,
    FONT_HEIGHT = 8,  /**< the last row is for what hangs below the line */
    FONT_ADVANCE = 6, /**< from one letter to the next */
    FONT_LINE = 10    /**< from one line to the next */
};

/**
 * @param c    What has no letter (control characters, all but ASCII) is shown as a box.
 * @param x,y  Column from the left, 0 to FONT_WIDTH - 1, and row from the top, 0 to FONT_HEIGHT - 1.
 * @return Is this pixel of the letter drawn?
 */
bool font_pixel(char c, int32_t x, int32_t y);

#endif
