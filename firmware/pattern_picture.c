// SPDX-License-Identifier: Apache-2.0
// Pictures for setting a projector up: focus, edges, brightness.
#include "firmware/pattern_picture.h"

#include "firmware/panel_draw.h"

enum { BLACK = 0, WHITE = 255, SQUARES = 8, ROWS_PER_LINE = 540 };

/* Lines at equal distances from the middle, both ways. */
static void draw_lines(const picture_t *panel, bool upright, int32_t width)
{
    const int32_t step = panel->height / SQUARES > 0 ? panel->height / SQUARES : 1;
    const int32_t length = upright ? panel->width : panel->height, middle = length / 2;
    for (int32_t away = 0; away <= middle; away += step) {
        const int32_t thick = away == 0 ? 2 * width : width;
        const int32_t size[2] = {upright ? thick : panel->width, upright ? panel->height : thick};
        for (int side = -1; side <= 1; side += 2) {
            const int32_t at = middle + side * away - thick / 2;
            panel_draw_rectangle(panel, upright ? at : 0, upright ? 0 : at, size, WHITE);
        }
    }
}

static void draw_border(const picture_t *panel, int32_t width)
{
    const int32_t across[2] = {panel->width, width}, down[2] = {width, panel->height};
    panel_draw_rectangle(panel, 0, 0, across, WHITE);
    panel_draw_rectangle(panel, 0, panel->height - width, across, WHITE);
    panel_draw_rectangle(panel, 0, 0, down, WHITE);
    panel_draw_rectangle(panel, panel->width - width, 0, down, WHITE);
}

void pattern_picture_draw(const picture_t *panel, command_pattern_t pattern)
{
    panel_draw_ground(panel, pattern == COMMAND_PATTERN_WHITE ? WHITE : BLACK);
    if (pattern != COMMAND_PATTERN_GRID)
        return;
    const int32_t width = 1 + panel->height / ROWS_PER_LINE;
    draw_lines(panel, true, width);
    draw_lines(panel, false, width);
    draw_border(panel, width);
}
