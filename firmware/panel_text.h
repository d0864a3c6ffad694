// SPDX-License-Identifier: Apache-2.0
// Text on a panel of any format that a display takes, after panel_draw_ground().
#ifndef FIRMWARE_PANEL_TEXT_H
#define FIRMWARE_PANEL_TEXT_H

#include <stdint.h>

#include "warp_fixed/picture.h"

/** Where a text goes. */
typedef struct {
    int32_t x, y;          /**< top-left corner, pixels; may be off the panel */
    int32_t width, height; /**< 1 or more */
    int32_t scale;         /**< pixels of the panel for one of a letter, 1 or more */
} panel_text_box_t;

/**
 * @param most  1 or more.
 * @return The largest scale up to `most` at which the text, in lines, fits into the box; 1 when it does not at any.
 */
int32_t panel_text_scale(const panel_text_box_t *box, const char *text, int32_t most);

/** @return Height of the text in lines of the box's width and scale, pixels; it may be more than the box has. */
int32_t panel_text_height(const panel_text_box_t *box, const char *text);

/** Draw the text in grey letters of this level, in lines. Lines that do not fit into the box whole are left out. */
void panel_text_draw(const picture_t *panel, const panel_text_box_t *box, const char *text, uint8_t level);

#endif
