// SPDX-License-Identifier: Apache-2.0
// Grey rectangles on a panel of any format that a display takes: what the board's own pictures are made of.
#ifndef FIRMWARE_PANEL_DRAW_H
#define FIRMWARE_PANEL_DRAW_H

#include <stdint.h>

#include "warp_fixed/picture.h"

/** Every pixel becomes the grey of this level, 0 to 255. The first thing to draw. */
void panel_draw_ground(const picture_t *panel, uint8_t level);

/**
 * Fill a rectangle after panel_draw_ground(); what is off the panel is left out.
 *
 * @param x, y  Its top-left corner, pixels; may be negative.
 * @param size  Width and height.
 */
void panel_draw_rectangle(const picture_t *panel, int32_t x, int32_t y, const int32_t size[2], uint8_t level);

#endif
