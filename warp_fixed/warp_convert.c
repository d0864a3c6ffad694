// SPDX-License-Identifier: Apache-2.0
// Pictures and panels of other formats than their planes: taken apart before the warp, put together after it.
#include "warp_fixed/warp_convert.h"

#include <stddef.h>

#include "warp_fixed/color.h"
#include "warp_fixed/fill_pixels.h"
#include "warp_fixed/fixed.h"
#include "warp_fixed/real_vector.h"

/* A window reaches half its taps to each side of its point; chroma's are two pixels apart along x. */
enum { MARGIN = WINDOW_MAX_TAPS + 4 };

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

/* Columns and rows of the picture. */
typedef struct {
    int32_t begin[2], end[2];
} part_t;

/* Is more than windows of the picture itself read? */
static bool reads_all(const warp_t *warp)
{
    bool all = warp->resampler == WARP_LS;
    for (int p = 0; p < warp->planes; p++) {
        all |= warp->plane[p].filtered;
        for (int w = 0; w < WORKERS_MAX; w++)
            for (int n = 1; n < LEVELS * LEVELS; n++)
                all |= warp->scratch[w].wanted[p][n / LEVELS][n % LEVELS];
    }
    return all;
}

/* A corner of the panel: its point in the picture, times the depth, and the depth. */
typedef struct {
    real_t value[2], depth;
    bool in_front;
} corner_t;

static corner_t corner_of(const homography_t *h, int number)
{
    const bool right = number == 1 || number == 2, lower = number >= 2;
    const real_t at[3] = {real_from_int(right ? h->panel_width : 0, 0), real_from_int(lower ? h->panel_height : 0, 0),
                          real_from_int(1, 0)};
    const real_t depth = vector_dot(h->row[2], at);
    return (corner_t){{vector_dot(h->row[0], at), vector_dot(h->row[1], at)}, depth, real_sign(depth) > 0};
}

static void include(part_t *part, int axis, int32_t pixel, int32_t size)
{
    const int32_t begin = clamp_i32(pixel - MARGIN, 0, size), end = clamp_i32(pixel + MARGIN, 0, size);
    part->begin[axis] = begin < part->begin[axis] ? begin : part->begin[axis];
    part->end[axis] = end > part->end[axis] ? end : part->end[axis];
}

/*
 * What is in front of the viewer is a convex figure in the picture, and none of it beyond its corners. Where an edge of
 * the panel goes from a to b, behind the viewer, it leaves for infinity: to where a.depth b.value - b.depth a.value
 * points.
 */
static part_t part_read(const warp_t *warp)
{
    const homography_t *h = &warp->homography;
    const int32_t size[2] = {h->picture_width, h->picture_height}, far = 2 * IMAGE_MAX_WIDTH;
    part_t part = {{size[0], size[1]}, {0, 0}};
    if (reads_all(warp))
        return (part_t){{0, 0}, {size[0], size[1]}};
    for (int number = 0; number < 8; number++) {
        const corner_t a = corner_of(h, number / 2), b = corner_of(h, (number / 2 + (number % 2 == 0 ? 1 : 3)) % 4);
        for (int axis = 0; axis < 2 && a.in_front; axis++) {
            include(&part, axis, (int32_t)real_to_fixed(real_div(a.value[axis], a.depth), 0, far), size[axis]);
            const real_t way = real_sub(real_mul(a.depth, b.value[axis]), real_mul(b.depth, a.value[axis]));
            if (!b.in_front)
                include(&part, axis, real_sign(way) > 0 ? far : -far, size[axis]);
        }
    }
    return part;
}

void warp_take(warp_t *warp, worker_t worker)
{
    const picture_t *picture = &warp->picture;
    const warp_kernels_t *kernels = warp->kernels;
    const image_t *to = &warp->plane[0].picture, *chroma = &warp->plane[1].picture;
    const part_t part = part_read(warp);
    const share_t rows = share_of(worker, part.end[1] - part.begin[1]); /* something is lit: some corner is in front */
    const ptrdiff_t x = part.begin[0] & ~1;
    const int32_t count = part.end[0] - (int32_t)x, pairs = (count + 1) / 2;
    for (int32_t y = part.begin[1] + rows.begin; y < part.begin[1] + rows.end; y++) {
        const uint8_t *from = picture->data[0] + (ptrdiff_t)y * picture->stride[0];
        if (picture->format == PICTURE_RGB888)
            kernels->xrgb_from_rgb888(image_row(to, y) + 4 * x, from + 3 * x, count);
        else if (picture->format == PICTURE_BGR888)
            kernels->xrgb_from_bgr888(image_row(to, y) + 4 * x, from + 3 * x, count);
        else if (picture->format == PICTURE_YUYV)
            kernels->planes_from_yuyv(image_row(to, y) + x, image_row(chroma, y) + x, from + 2 * x, pairs);
        else
            kernels->planes_from_uyvy(image_row(to, y) + x, image_row(chroma, y) + x, from + 2 * x, pairs);
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
