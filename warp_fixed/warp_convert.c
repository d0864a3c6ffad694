// SPDX-License-Identifier: Apache-2.0
// Pictures and panels of other formats than their planes: taken apart before the warp, put together after it.
#include "warp_fixed/warp_convert.h"

#include <stddef.h>

#include "warp_fixed/color.h"
#include "warp_fixed/fill_pixels.h"

bool warp_converts(const warp_t *warp)
{
    const picture_format_t format = warp->picture.format;
    return format != PICTURE_GRAY8 && format != PICTURE_XRGB8888 && format != PICTURE_NV12;
}

image_t warp_converted_plane(warp_t *warp, int plane)
{
    image_t image = picture_plane(&warp->picture, plane);
    if (!warp_converts(warp))
        return image;
    if (!picture_is_yuv(warp->picture.format))
        image.format = IMAGE_XRGB8888;
    image.data = warp->converted + (ptrdiff_t)plane * IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT;
    image.stride = image.width * (int32_t)image.format;
    return image;
}

void warp_take(warp_t *warp, worker_t worker)
{
    const picture_t *picture = &warp->picture;
    const warp_kernels_t *kernels = warp->kernels;
    const image_t *to = &warp->plane[0].picture, *chroma = &warp->plane[1].picture;
    const share_t rows = share_of(worker, picture->height);
    for (int32_t y = rows.begin; y < rows.end; y++) {
        const uint8_t *from = picture->data[0] + (ptrdiff_t)y * picture->stride[0];
        if (picture->format == PICTURE_RGB888)
            kernels->xrgb_from_rgb888(image_row(to, y), from, picture->width);
        else if (picture->format == PICTURE_BGR888)
            kernels->xrgb_from_bgr888(image_row(to, y), from, picture->width);
        else if (picture->format == PICTURE_YUYV)
            kernels->planes_from_yuyv(image_row(to, y), image_row(chroma, y), from, picture->width / 2);
        else
            kernels->planes_from_uyvy(image_row(to, y), image_row(chroma, y), from, picture->width / 2);
    }
}

warp_target_t warp_target(warp_t *warp, int plane, int32_t worker, int32_t first_row)
{
    warp_scratch_t *scratch = &warp->scratch[worker];
    warp_target_t target = {warp->plane[plane].panel, 0};
    if (target.image.data == NULL) {
        target.image.data = plane == 0 ? scratch->luma : scratch->chroma;
        target.image.stride = IMAGE_MAX_WIDTH;
        target.first_row = first_row;
    }
    return target;
}

/* Lit pixels, widened to pairs, are converted; the others have the border's colour as the room file has it. */
static void pack_xrgb(const warp_t *warp, int32_t j, const uint8_t *luma, const uint8_t *chroma)
{
    const grid_row_t *lit = &warp->plane[0].grid.row[j];
    const picture_t *panel = &warp->panel;
    uint8_t *row = panel->data[0] + (ptrdiff_t)j * panel->stride[0];
    const int32_t begin = lit->begin & ~1, end = (lit->end + 1) & ~1;
    const color_matrix_t matrix = color_matrix(warp->picture.matrix);
    warp->kernels->xrgb_from_yuv(row + (ptrdiff_t)begin * 4, luma + begin, chroma + begin, &matrix, (end - begin) / 2);
    fill_pixels(row, warp->border, IMAGE_XRGB8888, lit->begin);
    fill_pixels(row + (ptrdiff_t)lit->end * 4, warp->border, IMAGE_XRGB8888, panel->width - lit->end);
}

void warp_pack(warp_t *warp, int32_t worker, int32_t first_row)
{
    const picture_t *panel = &warp->panel;
    const warp_scratch_t *scratch = &warp->scratch[worker];
    const int32_t rows = warp->unit_bands * WARP_BAND_ROWS, left = panel->height - first_row;
    for (int32_t r = 0; r < rows && r < left; r++) {
        const uint8_t *luma = scratch->luma + (ptrdiff_t)r * IMAGE_MAX_WIDTH;
        const uint8_t *chroma = scratch->chroma + (ptrdiff_t)(r / warp->unit_bands) * IMAGE_MAX_WIDTH;
        const int32_t j = first_row + r;
        if (panel->format == PICTURE_YUYV)
            warp->kernels->yuyv_from_planes(panel->data[0] + (ptrdiff_t)j * panel->stride[0], luma, chroma,
                                            panel->width / 2);
        else
            pack_xrgb(warp, j, luma, chroma);
    }
}
