// SPDX-License-Identifier: Apache-2.0
// Pictures of every format in memory: what cameras make of XRGB8888, and displays show as that.
#include "sim/devices/sim_picture.h"

#include <string.h>

#include "warp_fixed/color.h"
#include "warp_fixed/kernels.h"

const char *const sim_picture_formats[PICTURE_FORMATS] = {
    [PICTURE_XRGB8888] = "xrgb8888", [PICTURE_GRAY8] = "gray8", [PICTURE_RGB888] = "rgb888",
    [PICTURE_BGR888] = "bgr888",     [PICTURE_YUYV] = "yuyv",   [PICTURE_UYVY] = "uyvy",
    [PICTURE_NV12] = "nv12",
};

bool sim_picture_format_from_name(picture_format_t *format, const char *name, size_t length)
{
    for (picture_format_t f = PICTURE_XRGB8888; f < PICTURE_FORMATS; f++) {
        const char *candidate = sim_picture_formats[f];
        if (f != PICTURE_GRAY8 && strlen(candidate) == length && strncmp(name, candidate, length) == 0) {
            *format = f;
            return true;
        }
    }
    return false;
}

picture_t sim_picture(picture_format_t format, int32_t width, int32_t height, uint8_t *bytes)
{
    static const int32_t pixel_bytes[PICTURE_FORMATS] = {
        [PICTURE_XRGB8888] = 4, [PICTURE_GRAY8] = 1, [PICTURE_RGB888] = 3, [PICTURE_BGR888] = 3,
        [PICTURE_YUYV] = 2,     [PICTURE_UYVY] = 2,  [PICTURE_NV12] = 1,
    };
    const int32_t stride = width * pixel_bytes[format];
    picture_t picture = {
        .format = format, .width = width, .height = height, .data = {bytes}, .stride = {stride, width}};
    if (bytes != NULL && format == PICTURE_NV12)
        picture.data[1] = bytes + (ptrdiff_t)stride * height;
    return picture;
}

size_t sim_picture_bytes(const picture_t *picture)
{
    const size_t whole = (size_t)picture->stride[0] * (size_t)picture->height;
    return picture->format == PICTURE_NV12 ? whole * 3 / 2 : whole;
}

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

void sim_picture_from_xrgb(const picture_t *to, const image_t *from)
{
    if (picture_is_yuv(to->format))
        convert_yuv(to, from);
    else
        convert_rgb(to, from);
}

/* A row's luma, and U and V in turn. */
typedef struct {
    uint8_t luma[IMAGE_MAX_WIDTH], chroma[IMAGE_MAX_WIDTH];
} yuv_row_t;

static void yuv_row_to_xrgb(uint8_t *to, const picture_t *from, int32_t y)
{
    const warp_kernels_t *kernels = &warp_kernels_scalar;
    const color_matrix_t matrix = color_matrix(from->matrix);
    const int32_t pairs = from->width / 2;
    yuv_row_t row;
    if (from->format == PICTURE_NV12) {
        kernels->xrgb_from_yuv(to, pixel_row(from, 0, y), pixel_row(from, 1, y / 2), &matrix, pairs);
        return;
    }
    (from->format == PICTURE_YUYV ? kernels->planes_from_yuyv
                                  : kernels->planes_from_uyvy)(row.luma, row.chroma, pixel_row(from, 0, y), pairs);
    kernels->xrgb_from_yuv(to, row.luma, row.chroma, &matrix, pairs);
}

void sim_picture_to_xrgb(const image_t *to, const picture_t *from)
{
    for (int32_t y = 0; y < to->height; y++) {
        const uint8_t *row = pixel_row(from, 0, y);
        if (picture_is_yuv(from->format))
            yuv_row_to_xrgb(image_row(to, y), from, y);
        else if (from->format == PICTURE_RGB888)
            warp_kernels_scalar.xrgb_from_rgb888(image_row(to, y), row, to->width);
        else if (from->format == PICTURE_BGR888)
            warp_kernels_scalar.xrgb_from_bgr888(image_row(to, y), row, to->width);
        else
            memcpy(image_row(to, y), row, (size_t)to->width * IMAGE_XRGB8888);
    }
}

picture_format_t sim_picture_take_format(const char **name)
{
    picture_format_t format = PICTURE_XRGB8888;
    const char *colon = strchr(*name, ':');
    if (colon != NULL && sim_picture_format_from_name(&format, *name, (size_t)(colon - *name)))
        *name = colon + 1;
    return format;
}
