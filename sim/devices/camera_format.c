// SPDX-License-Identifier: Apache-2.0
// What a camera of another format makes of a picture.
#include "sim/devices/camera_format.h"

#include <stddef.h>

#include "warp_fixed/color.h"

const char *const camera_format_names[PICTURE_FORMATS] = {
    [PICTURE_XRGB8888] = "xrgb8888", [PICTURE_GRAY8] = "gray8", [PICTURE_RGB888] = "rgb888",
    [PICTURE_BGR888] = "bgr888",     [PICTURE_YUYV] = "yuyv",   [PICTURE_UYVY] = "uyvy",
    [PICTURE_NV12] = "nv12",
};

static uint8_t *pixel_row(const picture_t *picture, int plane, int32_t y)
{
    return picture->data[plane] + (ptrdiff_t)y * picture->stride[plane];
}

static void convert_rgb(const picture_t *to, const image_t *from)
{
    const int32_t bytes = to->format == PICTURE_XRGB8888 ? 4 : 3;
    for (int32_t y = 0; y < to->height; y++)
        for (int32_t x = 0; x < to->width; x++)
            for (int32_t c = 0; c < bytes; c++)
                pixel_row(to, 0, y)[bytes * x + (to->format == PICTURE_BGR888 ? 2 - c : c)] =
                    image_row(from, y)[4 * x + c];
}

/* Y of each pixel, from column x on, of a pair; U and V of the `rows` pairs from row y on. */
static void convert_pair(uint8_t luma[2][2], uint8_t chroma[2], const picture_t *to, const image_t *from,
                         const int32_t at[2])
{
    const int32_t rows = 1 << picture_chroma_rows_log2(to->format);
    int32_t sum[3] = {0, 0, 0};
    uint8_t yuv[3], mean[3];
    for (int32_t v = 0; v < rows; v++)
        for (int32_t u = 0; u < 2; u++) {
            const uint8_t *bgr = image_row(from, at[1] + v) + (ptrdiff_t)(at[0] + u) * 4;
            color_yuv_from_bgr(yuv, bgr, to->matrix);
            luma[v][u] = yuv[0];
            for (int c = 0; c < 3; c++)
                sum[c] += bgr[c];
        }
    for (int c = 0; c < 3; c++)
        mean[c] = (uint8_t)((sum[c] + rows) / (2 * rows));
    color_yuv_from_bgr(yuv, mean, to->matrix);
    chroma[0] = yuv[1];
    chroma[1] = yuv[2];
}

static void convert_yuv(const picture_t *to, const image_t *from)
{
    const int32_t rows = 1 << picture_chroma_rows_log2(to->format), first = to->format == PICTURE_UYVY;
    for (int32_t y = 0; y < to->height; y += rows) {
        for (int32_t x = 0; x < to->width; x += 2) {
            uint8_t luma[2][2], chroma[2];
            const int32_t at[2] = {x, y};
            convert_pair(luma, chroma, to, from, at);
            for (int32_t k = 0; k < 2; k++) {
                if (to->format == PICTURE_NV12) {
                    pixel_row(to, 0, y)[x + k] = luma[0][k];
                    pixel_row(to, 0, y + 1)[x + k] = luma[1][k];
                    pixel_row(to, 1, y / 2)[x + k] = chroma[k];
                } else {
                    pixel_row(to, 0, y)[2 * (x + k) + first] = luma[0][k];
                    pixel_row(to, 0, y)[2 * (x + k) + 1 - first] = chroma[k];
                }
            }
        }
    }
}

void camera_format_convert(const picture_t *to, const image_t *from)
{
    if (picture_is_yuv(to->format))
        convert_yuv(to, from);
    else
        convert_rgb(to, from);
}
