// SPDX-License-Identifier: Apache-2.0
// What the wall shows when there is nothing right to show: a dim, calm picture that names the board.
#include "firmware/safe_picture.h"

#include "firmware/panel_draw.h"

enum { GROUND = 24, LINE = 72, MARK = 160 };

void safe_picture_draw(const picture_t *panel, int32_t node)
{
    const int32_t w = panel->width, h = panel->height;
    const int32_t unit = h / 90 > 0 ? h / 90 : 1;
    panel_draw_ground(panel, LINE);
    panel_draw_rectangle(panel, unit, unit, (const int32_t[2]){w - 2 * unit, h - 2 * unit}, GROUND);
    panel_draw_rectangle(panel, w / 2 - unit / 2, 0, (const int32_t[2]){unit, h}, LINE);
    panel_draw_rectangle(panel, 0, h / 2 - unit / 2, (const int32_t[2]){w, unit}, LINE);

    int32_t x = 4 * unit;
    for (int32_t ten = 0; ten < node / 10; ten++) {
        panel_draw_rectangle(panel, x, 4 * unit, (const int32_t[2]){4 * unit, 8 * unit}, MARK);
        x += 6 * unit;
    }
    for (int32_t one = 0; one < node % 10; one++) {
        panel_draw_rectangle(panel, x, 4 * unit, (const int32_t[2]){unit, 8 * unit}, MARK);
        x += 3 * unit;
    }
}
