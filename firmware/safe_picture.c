// SPDX-License-Identifier: Apache-2.0
// What the wall shows when there is nothing right to show: a dim, calm picture that names the board.
#include "firmware/safe_picture.h"

#include "warp_fixed/color.h"
#include "warp_fixed/fill_pixels.h"

enum { GROUND = 24, LINE = 72, MARK = 160, NO_COLOUR = 128 };

/* A grey pixel as it is in plane 0. @return Its bytes. */
static int32_t grey_pixel(uint8_t pixel[4], const picture_t *panel, uint8_t level)
{
    uint8_t yuv[3];
    color_yuv_from_bgr(yuv, (const uint8_t[3]){level, level, level}, panel->matrix);
    const bool yuyv = panel->format == PICTURE_YUYV;
    for (int i = 0; i < 4; i++)
        pixel[i] = picture_is_yuv(panel->format) ? yuv[0] : level;
    if (panel->format == PICTURE_YUYV || panel->format == PICTURE_UYVY) {
        pixel[yuyv] = NO_COLOUR;
        return IMAGE_UV88;
    }
    return panel->format == PICTURE_XRGB8888 ? IMAGE_XRGB8888 : IMAGE_GRAY8;
}

/* Fill [left, right) x [top, bottom), cut to the panel. */
static void fill(const picture_t *panel, const int32_t left_top[2], const int32_t right_bottom[2], uint8_t level)
{
    const int32_t left = left_top[0] < 0 ? 0 : left_top[0], top = left_top[1] < 0 ? 0 : left_top[1];
    const int32_t right = right_bottom[0] < panel->width ? right_bottom[0] : panel->width;
    const int32_t bottom = right_bottom[1] < panel->height ? right_bottom[1] : panel->height;
    uint8_t pixel[4];
    const int32_t bytes = grey_pixel(pixel, panel, level);
    if (left >= right)
        return;
    for (int32_t y = top; y < bottom; y++)
        fill_pixels(panel->data[0] + (ptrdiff_t)y * panel->stride[0] + left * bytes, pixel, (image_format_t)bytes,
                    right - left);
}

static void fill_rectangle(const picture_t *panel, int32_t x, int32_t y, const int32_t size[2], uint8_t level)
{
    fill(panel, (const int32_t[2]){x, y}, (const int32_t[2]){x + size[0], y + size[1]}, level);
}

/* Where chroma has a plane of its own. */
static void leave_no_colour(const picture_t *panel)
{
    for (int32_t y = 0; panel->format == PICTURE_NV12 && y < panel->height / 2; y++)
        fill_pixels(panel->data[1] + (ptrdiff_t)y * panel->stride[1], (const uint8_t[1]){NO_COLOUR}, IMAGE_GRAY8,
                    panel->width);
}

void safe_picture_draw(const picture_t *panel, int32_t node)
{
    const int32_t w = panel->width, h = panel->height;
    const int32_t unit = h / 90 > 0 ? h / 90 : 1;
    leave_no_colour(panel);
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
