// SPDX-License-Identifier: Apache-2.0
// Draws the code of firmware/frame_tag.h into a picture: for render engines. This file and its .c need nothing else of
// this tree; take both into your engine. An engine that draws with shaders takes paint_tag.glsl instead.
#ifndef SIM_TAG_PAINT_TAG_H
#define SIM_TAG_PAINT_TAG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** A finished picture, as it will be sent: after tone mapping and transfer function, before any compression. */
typedef struct {
    uint8_t *pixels;     /**< the leftmost pixel of the top row */
    int width, height;   /**< pixels */
    ptrdiff_t row_bytes; /**< from one row to the row below; negative where rows are stored from the bottom up */
    int pixel_bytes;     /**< 1: gray, or the Y of planar YUV; 3: RGB in any order; 4: RGBX, BGRX, RGBA, BGRA */
} paint_tag_picture_t;

typedef struct {
    uint32_t capture_time_us; /**< of the pose that the picture was drawn from, as its CAN message has it: of the FD
                                 frame the time modulo 2^32; of the classic set (time + 50) / 100 % 65536 * 100 */
    uint32_t frame_number;    /**< one more with every picture */
    unsigned viewer;          /**< of that pose, 0 to 3 */
} paint_tag_t;

/**
 * Draw the code: gray 32 and 224; a fourth byte, where pixels have one, becomes 255.
 *
 * @return false, and nothing drawn, when the picture has no room for it (its height must be twice that of the code and
 *         2 px more, which all pictures from 320 x 52 on are), pixel_bytes is not 1, 3 or 4, or the viewer is above 3.
 */
bool paint_tag(const paint_tag_picture_t *picture, const paint_tag_t *tag);

#endif
