// SPDX-License-Identifier: Apache-2.0
// The built-in test picture: colour bars, a gray ramp, a grid and a moving bar.
#include "sim/devices/test_pattern.h"

#include <stdbool.h>

#include "sim/files/pixel.h"

enum { BARS = 8, CELLS_X = 16, CELLS_Y = 9, BRIGHT = 191, WHITE = 255 };

typedef struct {
    uint8_t red, green, blue;
} colour_t;

/* Whether a line of the grid, or the frame, runs through this column (or row). */
static bool is_line(int32_t at, int32_t size, int32_t cells)
{
    return at == size - 1 || at == 0 || at * cells / size != (at - 1) * cells / size;
}

static colour_t background(const image_t *image, int32_t x, int32_t y)
{
    if (3 * y >= 2 * image->height) {
        const uint8_t gray = (uint8_t)(image->width > 1 ? x * 255 / (image->width - 1) : 0);
        return (colour_t){gray, gray, gray};
    }
    /* From white down, each bar lacks one more of blue, red, green, in binary. */
    const int32_t missing = x * BARS / image->width;
    return (colour_t){missing & 2 ? 0 : BRIGHT, missing & 4 ? 0 : BRIGHT, missing & 1 ? 0 : BRIGHT};
}

void test_pattern_draw(const image_t *image, int64_t index)
{
    static const colour_t orange = {255, 128, 0};
    static const colour_t white = {WHITE, WHITE, WHITE};
    const int32_t step = (int32_t)(index % TEST_PATTERN_STEPS);
    const int32_t bar_begin = image->width * step / TEST_PATTERN_STEPS;
    const int32_t bar_width = image->width / TEST_PATTERN_STEPS > 0 ? image->width / TEST_PATTERN_STEPS : 1;
    for (int32_t y = 0; y < image->height; y++) {
        const bool line = is_line(y, image->height, CELLS_Y);
        uint8_t *to = image_row(image, y);
        for (int32_t x = 0; x < image->width; x++, to += image->format) {
            colour_t colour = background(image, x, y);
            if (line || is_line(x, image->width, CELLS_X))
                colour = white;
            if (x >= bar_begin && x < bar_begin + bar_width)
                colour = orange;
            pixel_put(to, image->format, colour.red, colour.green, colour.blue);
        }
    }
}
