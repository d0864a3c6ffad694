// SPDX-License-Identifier: Apache-2.0
// Draws the code of firmware/frame_tag.h. Written from that definition, with nothing of the decoder: see paint_tag.h.
#include "sim/tag/paint_tag.h"

#include <string.h>

enum { BLOCKS = 120, BLACK = 32, WHITE = 224, OPAQUE = 255 };

static uint32_t crc32_with(uint32_t crc, uint32_t word, int bytes)
{
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
        crc ^= word >> shift & 0xFFU;
        for (int bit = 0; bit < 8; bit++)
            crc = (crc & 1U) != 0 ? crc >> 1 ^ 0xEDB88320U : crc >> 1;
    }
    return crc;
}

/* The blocks from `first` on: the lowest `count` bits of a number, the highest of these first. */
static void put(bool white[BLOCKS], int first, uint32_t number, int count)
{
    for (int bit = 0; bit < count; bit++)
        white[first + bit] = (number >> (count - 1 - bit) & 1U) != 0;
}

static void draw_block(const paint_tag_picture_t *picture, int left, int top, int side, bool white)
{
    for (int y = top; y < top + side; y++)
        for (int x = left; x < left + side; x++) {
            uint8_t *pixel = picture->pixels + y * picture->row_bytes + (ptrdiff_t)x * picture->pixel_bytes;
            memset(pixel, white ? WHITE : BLACK, picture->pixel_bytes == 1 ? 1 : 3);
            if (picture->pixel_bytes == 4)
                pixel[3] = OPAQUE;
        }
}

bool paint_tag(const paint_tag_picture_t *picture, const paint_tag_t *tag)
{
    const int side = picture->width < 320 ? 4 : 8, whole = picture->width / side;
    const int columns = whole < BLOCKS ? whole : BLOCKS, pixel_bytes = picture->pixel_bytes;
    if (columns < 1 || (pixel_bytes != 1 && pixel_bytes != 3 && pixel_bytes != 4) || tag->viewer > 3)
        return false;
    const int rows = (BLOCKS + columns - 1) / columns;
    if (picture->height < 2 * (rows * side + 2))
        return false;

    const uint32_t head = 0x10U | tag->viewer;
    uint32_t crc = crc32_with(0xFFFFFFFFU, head, 1);
    crc = crc32_with(crc, tag->capture_time_us, 4);
    crc = ~crc32_with(crc, tag->frame_number, 4);
    bool white[BLOCKS];
    put(white, 0, 0xF350U, 16);
    put(white, 16, head, 8);
    put(white, 24, tag->capture_time_us, 32);
    put(white, 56, tag->frame_number, 32);
    put(white, 88, crc, 32);
    for (int block = 0; block < BLOCKS; block++)
        draw_block(picture, block % columns * side, block / columns * side, side, white[block]);
    return true;
}
