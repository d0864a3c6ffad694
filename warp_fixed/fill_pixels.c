// SPDX-License-Identifier: Apache-2.0
// Pixels of one colour.
#include "warp_fixed/fill_pixels.h"

#include <string.h>

enum { VECTOR = 16, VECTORS = 8 };

typedef uint32_t vector_t __attribute__((vector_size(VECTOR)));

void fill_pixels(uint8_t *out, const uint8_t *colour, image_format_t format, int32_t count)
{
    uint32_t word;
    if (format == IMAGE_GRAY8)
        word = 0x01010101u * colour[0];
    else if (format == IMAGE_UV88)
        word = 0x00010001u * (colour[0] | (uint32_t)colour[1] << 8);
    else
        memcpy(&word, colour, sizeof word);
    const vector_t vector = {word, word, word, word};
    size_t bytes = (size_t)count * format;
    for (; bytes >= VECTORS * VECTOR; bytes -= VECTORS * VECTOR, out += VECTORS * VECTOR)
        for (int k = 0; k < VECTORS; k++)
            memcpy(out + k * VECTOR, &vector, VECTOR);
    for (; bytes >= VECTOR; bytes -= VECTOR, out += VECTOR)
        memcpy(out, &vector, VECTOR);
    memcpy(out, &vector, bytes);
}
