// SPDX-License-Identifier: Apache-2.0
// Text on a panel of any format that a display takes.
#include "firmware/panel_text.h"

#include "firmware/font_5x8.h"
#include "firmware/panel_draw.h"
#include "firmware/text_wrap.h"

/* Letters of a line; the gap behind the last one may be off the box. */
static int32_t columns(const panel_text_box_t *box)
{
    const int32_t fit = (box->width + (FONT_ADVANCE - FONT_WIDTH) * box->scale) / (FONT_ADVANCE * box->scale);
    return fit > 1 ? fit : 1;
}

int32_t panel_text_height(const panel_text_box_t *box, const char *text)
{
    const int32_t lines = text_wrap_count(text, columns(box));
    return lines == 0 ? 0 : box->scale * (FONT_LINE * (lines - 1) + FONT_HEIGHT);
}

int32_t panel_text_scale(const panel_text_box_t *box, const char *text, int32_t most)
{
    panel_text_box_t tried = *box;
    for (tried.scale = most; tried.scale > 1; tried.scale--)
        if (panel_text_height(&tried, text) <= box->height)
            break;
    return tried.scale;
}

/* Pixels of a letter that are side by side are one rectangle. */
static void draw_letter(const picture_t *panel, int32_t x, int32_t y, int32_t scale, const char *letter, uint8_t level)
{
    for (int32_t row = 0; row < FONT_HEIGHT; row++)
        for (int32_t begin = 0, end; begin < FONT_WIDTH; begin = end + 1) {
            for (end = begin; end < FONT_WIDTH && font_pixel(*letter, end, row); end++)
                ;
            if (end > begin)
                panel_draw_rectangle(panel, x + begin * scale, y + row * scale,
                                     (const int32_t[2]){(end - begin) * scale, scale}, level);
        }
}

void panel_text_draw(const picture_t *panel, const panel_text_box_t *box, const char *text, uint8_t level)
{
    const int32_t scale = box->scale;
    int32_t y = box->y;
    text_line_t line = text_wrap_next(&text, columns(box));
    while (line.bytes > 0 && y + FONT_HEIGHT * scale <= box->y + box->height) {
        int32_t x = box->x;
        for (int32_t i = 0; i < line.bytes; i++) {
            if (text_wrap_letters(&(text_line_t){line.begin + i, 1}) == 0)
                continue;
            draw_letter(panel, x, y, scale, line.begin + i, level);
            x += FONT_ADVANCE * scale;
        }
        y += FONT_LINE * scale;
        line = text_wrap_next(&text, columns(box));
    }
}
