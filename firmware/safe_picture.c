// SPDX-License-Identifier: Apache-2.0
// What the wall shows when there is nothing right to show: a dim, calm picture that names the board.
#include "firmware/safe_picture.h"

#include <string.h>

enum { GROUND = 24, LINE = 72, MARK = 160 };

/* Fill [left, right) x [top, bottom), cut to the panel. */
static void fill(const image_t *panel, const int32_t left_top[2], const int32_t right_bottom[2], uint8_t level)
{
    const int32_t left = left_top[0] < 0 ? 0 : left_top[0], top = left_top[1] < 0 ? 0 : left_top[1];
    const int32_t right = right_bottom[0] < panel->width ? right_bottom[0] : panel->width;
    const int32_t bottom = right_bottom[1] < panel->height ? right_bottom[1] : panel->height;
    const int32_t channels = (int32_t)panel->format;
    if (left >= right)
        return;
    for (int32_t y = top; y < bottom; y++)
        memset(image_row(panel, y) + left * channels, level, (size_t)((right - left) * channels));
}

static void fill_rectangle(const image_t *panel, int32_t x, int32_t y, const int32_t size[2], uint8_t level)
{
    fill(panel, (const int32_t[2]){x, y}, (const int32_t[2]){x + size[0], y + size[1]}, level);
}

void safe_picture_draw(const image_t *panel, int32_t node)
{
    const int32_t w = panel->width, h = panel->height;
    const int32_t unit = h / 90 > 0 ? h / 90 : 1;
    fill_rectangle(panel, 0, 0, (const int32_t[2]){w, h}, LINE);
    fill_rectangle(panel, unit, unit, (const int32_t[2]){w - 2 * unit, h - 2 * unit}, GROUND);
    fill_rectangle(panel, w / 2 - unit / 2, 0, (const int32_t[2]){unit, h}, LINE);
    fill_rectangle(panel, 0, h / 2 - unit / 2, (const int32_t[2]){w, unit}, LINE);

    int32_t x = 4 * unit;
    for (int32_t ten = 0; ten < node / 10; ten++) {
        fill_rectangle(panel, x, 4 * unit, (const int32_t[2]){4 * unit, 8 * unit}, MARK);
        x += 6 * unit;
    }
    for (int32_t one = 0; one < node % 10; one++) {
        fill_rectangle(panel, x, 4 * unit, (const int32_t[2]){unit, 8 * unit}, MARK);
        x += 3 * unit;
    }
}
