// SPDX-License-Identifier: Apache-2.0
// Pixels of one colour.
#include "warp_fixed/fill_pixels.h"

#include <string.h>

enum { WORDS = 16 };

void fill_pixels(uint8_t *out, const uint8_t *colour, image_format_t format, int32_t count)
{
    uint32_t word, block[WORDS]; /* 64 bytes: four vector stores each time */
    if (format == IMAGE_GRAY8)
        word = 0x01010101u * colour[0];
    else if (format == IMAGE_UV88)
        word = 0x00010001u * (colour[0] | (uint32_t)colour[1] << 8);
    else
        memcpy(&word, colour, sizeof word);
    for (int k = 0; k < WORDS; k++)
        block[k] = word;
    size_t bytes = (size_t)count * format;
    for (; bytes >= sizeof block; bytes -= sizeof block) {
        memcpy(out, block, sizeof block);
        out += sizeof block;
    }
    memcpy(out, block, bytes);
}
