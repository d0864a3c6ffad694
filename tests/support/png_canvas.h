// SPDX-License-Identifier: Apache-2.0
// For the tests of PNG files: a small picture whose rows have room behind them, and random bytes for it.
#ifndef TESTS_SUPPORT_PNG_CANVAS_H
#define TESTS_SUPPORT_PNG_CANVAS_H

#include <stdint.h>
#include <string.h>

#include "warp_fixed/image.h"

enum { WIDTH = 13, HEIGHT = 7, STRIDE = WIDTH * 4 + 5, UNTOUCHED = 0xA5 };

typedef struct {
    uint8_t bytes[STRIDE * HEIGHT];
    image_t image;
} canvas_t;

static inline uint32_t next_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static inline void blank_canvas(canvas_t *canvas, image_format_t format)
{
    memset(canvas->bytes, UNTOUCHED, sizeof canvas->bytes);
    canvas->image = (image_t){canvas->bytes, WIDTH, HEIGHT, STRIDE, format};
}

#endif
