// SPDX-License-Identifier: Apache-2.0
// What the wall shows when there is nothing right to show: a dim, calm picture that names the board and says why.
#include "firmware/safe_picture.h"

#include <stdio.h>

#include "firmware/panel_draw.h"
#include "firmware/panel_text.h"

/* A capital is 7 of these parts of the panel's height: 70 and 56 mm on a wall of 1.08 m. From 5 m 25 mm can be read. */
enum { GROUND = 24, LINE = 72, MARK = 160, HEADING_IN_HEIGHT = 108, REASON_IN_HEIGHT = 135, HEADING_LENGTH = 64 };

static int32_t at_least_1(int32_t value)
{
    return value > 1 ? value : 1;
}

static void draw_bars(const picture_t *panel, int32_t node, int32_t unit)
{
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

static void write_heading(char heading[HEADING_LENGTH], const safe_picture_t *what)
{
    if (what->node == 0)
        (void)snprintf(heading, HEADING_LENGTH, "wallwarp: %.31s, no node", what->board);
    else
        (void)snprintf(heading, HEADING_LENGTH, "wallwarp: %.31s, node %d", what->board, (int)what->node);
}

/* Between the bars and the border. The heading has two lines at most, the reason what is left. */
static void draw_text(const picture_t *panel, const safe_picture_t *what, int32_t unit)
{
    const int32_t w = panel->width, h = panel->height, bottom = h - 4 * unit;
    const int32_t largest = at_least_1(h / HEADING_IN_HEIGHT);
    char text[HEADING_LENGTH];
    write_heading(text, what);
    panel_text_box_t heading = {4 * unit, 16 * unit, at_least_1(w - 8 * unit), 18 * largest, 1};
    heading.scale = panel_text_scale(&heading, text, largest);
    panel_text_box_t reason = heading;
    reason.y += panel_text_height(&heading, text) + 4 * unit;
    reason.height = at_least_1(bottom - reason.y);
    reason.scale = panel_text_scale(&reason, what->reason, at_least_1(h / REASON_IN_HEIGHT));

    const int32_t used = reason.y + panel_text_height(&reason, what->reason) - heading.y;
    panel_draw_rectangle(panel, 3 * unit, heading.y - 2 * unit, (const int32_t[2]){w - 6 * unit, used + 4 * unit},
                         GROUND);
    panel_text_draw(panel, &heading, text, MARK);
    panel_text_draw(panel, &reason, what->reason, MARK);
}

void safe_picture_draw(const picture_t *panel, const safe_picture_t *what)
{
    const int32_t w = panel->width, h = panel->height;
    const int32_t unit = at_least_1(h / 90);
    panel_draw_ground(panel, LINE);
    panel_draw_rectangle(panel, unit, unit, (const int32_t[2]){w - 2 * unit, h - 2 * unit}, GROUND);
    panel_draw_rectangle(panel, w / 2 - unit / 2, 0, (const int32_t[2]){unit, h}, LINE);
    panel_draw_rectangle(panel, 0, h / 2 - unit / 2, (const int32_t[2]){w, unit}, LINE);
    draw_bars(panel, what->node, unit);
    draw_text(panel, what, unit);
}
