// SPDX-License-Identifier: Apache-2.0
// Grey rectangles on a panel of any format that a display takes.
#include "firmware/panel_draw.h"

#include "warp_fixed/color.h"
#include "warp_fixed/fill_pixels.h"

enum { NO_COLOUR = 128 };

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

void panel_draw_rectangle(const picture_t *panel, int32_t x, int32_t y, const int32_t size[2], uint8_t level)
{
    fill(panel, (const int32_t[2]){x, y}, (const int32_t[2]){x + size[0], y + size[1]}, level);
}

void panel_draw_ground(const picture_t *panel, uint8_t level)
{
    for (int32_t y = 0; panel->format == PICTURE_NV12 && y < panel->height / 2; y++)
        fill_pixels(panel->data[1] + (ptrdiff_t)y * panel->stride[1], (const uint8_t[1]){NO_COLOUR}, IMAGE_GRAY8,
                    panel->width);
    panel_draw_rectangle(panel, 0, 0, (const int32_t[2]){panel->width, panel->height}, level);
}
