// SPDX-License-Identifier: Apache-2.0
// Fuzzes frames of any two formats and sizes: what does not fit is refused untouched, else no byte outside the panel,
// and the same bytes by every table of loops, any number of workers, and from the same picture in a format like its
// own.
#include <stdlib.h>
#include <string.h>

#include "tests/fuzz/input_homography.h"
#include "warp_fixed/color.h"
#include "warp_fixed/warp.h"

enum { GUARD_BYTE = 0xa5, LOWEST = 100, STEP_ALL = 1, BY_NUMBERS = 2, GENTLE = 4, ODD = 8, BT601 = 16 };

static const uint8_t border_bgr[4] = {200, 90, 17};

/* One for each method, made once: their tables take milliseconds. */
static warp_t *warps[WARP_METHODS];

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    const uint8_t border[3] = {border_bgr[2], border_bgr[1], border_bgr[0]};
    (void)argc;
    (void)argv;
    for (int m = 0; m < WARP_METHODS; m++) {
        warps[m] = malloc(sizeof *warps[m]);
        if (warps[m] == NULL)
            abort();
        warp_init(warps[m], warp_methods[m], false, border);
    }
    return 0;
}

/* Bytes of a row of a plane, and its rows, with room for what is left over of an odd size. */
static int32_t row_bytes(const picture_t *p, int plane)
{
    static const int32_t pixel_bytes[PICTURE_FORMATS] = {4, 1, 3, 3, 2, 2, 1};
    return plane == 0 ? p->width * pixel_bytes[p->format] : (p->width + 1) / 2 * 2;
}

static int32_t plane_rows(const picture_t *p, int plane)
{
    return plane == 0 ? p->height : (p->height + 1) / 2;
}

static int planes_of(const picture_t *p)
{
    return p->format == PICTURE_NV12 ? 2 : 1;
}

static uint8_t *row_of(const picture_t *p, int plane, int32_t y)
{
    return p->data[plane] + (ptrdiff_t)y * p->stride[plane];
}

/* With guard bytes behind each row, and each plane in memory of exactly its size. */
static picture_t new_picture(picture_format_t format, const int32_t size[2], int32_t guard)
{
    picture_t p = {.format = format, .width = size[0], .height = size[1]};
    for (int plane = 0; plane < planes_of(&p); plane++) {
        p.stride[plane] = row_bytes(&p, plane) + guard;
        const size_t bytes = (size_t)p.stride[plane] * (size_t)plane_rows(&p, plane);
        p.data[plane] = malloc(bytes);
        fuzz_check(p.data[plane] != NULL, "memory for a small picture");
        memset(p.data[plane], GUARD_BYTE, bytes);
    }
    return p;
}

static void free_picture(const picture_t *p)
{
    free(p->data[0]);
    free(p->data[1]);
}

static void fill(const picture_t *p, uint8_t range, uint32_t seed)
{
    for (int plane = 0; plane < planes_of(p); plane++)
        for (int32_t y = 0; y < plane_rows(p, plane); y++)
            for (int32_t i = 0; i < row_bytes(p, plane); i++) {
                seed = seed * 1664525 + 1013904223;
                row_of(p, plane, y)[i] = (uint8_t)(LOWEST + (seed >> 24) * range / 255);
            }
}

/* Are all bytes from there on in each row the guard's? */
static bool is_untouched(const picture_t *p, bool rows_too)
{
    bool untouched = true;
    for (int plane = 0; plane < planes_of(p); plane++)
        for (int32_t y = 0; y < plane_rows(p, plane); y++)
            for (int32_t i = rows_too ? 0 : row_bytes(p, plane); i < p->stride[plane]; i++)
                untouched &= row_of(p, plane, y)[i] == GUARD_BYTE;
    return untouched;
}

static bool is_even(const picture_t *p, bool rows_too)
{
    return p->width % 2 == 0 && !(rows_too && p->height % 2 != 0);
}

/* As warp.h has it. */
static bool fits(const picture_t *panel, const picture_t *picture)
{
    if (!picture_is_yuv(picture->format))
        return panel->format == (picture->format == PICTURE_GRAY8 ? PICTURE_GRAY8 : PICTURE_XRGB8888);
    const picture_format_t chroma = panel->format == PICTURE_XRGB8888 ? picture->format : panel->format;
    const bool taken =
        panel->format == PICTURE_XRGB8888 || panel->format == PICTURE_YUYV || panel->format == PICTURE_NV12;
    return taken && is_even(picture, picture->format == PICTURE_NV12) && is_even(panel, chroma == PICTURE_NV12);
}

/* A pixel of a plane of the panel that is not lit has the border's colour; a lit one is `lit`, unless NULL. */
static void check_pixels(const warp_t *warp, const picture_t *panel, int plane, const uint8_t *lit)
{
    const image_t *as_plane = &warp->plane[plane].panel;
    const bool yuyv = panel->format == PICTURE_YUYV, packs = panel->format == PICTURE_XRGB8888;
    const int32_t bytes = packs ? 4 : yuyv ? 2 : (int32_t)as_plane->format, channels = yuyv ? plane + 1 : bytes;
    uint8_t yuv[3];
    color_yuv_from_bgr(yuv, border_bgr, warp->picture.matrix);
    const uint8_t *border = picture_is_yuv(panel->format) ? yuv + plane : border_bgr;
    for (int32_t j = 0; j < as_plane->height; j++) {
        const grid_row_t *row = &warp->plane[plane].grid.row[j];
        fuzz_check(row->begin >= 0 && row->begin <= row->end && row->end <= as_plane->width,
                   "lit pixels are in the panel");
        const uint8_t *at = row_of(panel, yuyv ? 0 : plane, j);
        for (int32_t i = 0; i < as_plane->width; i++) {
            const bool is_lit = i >= row->begin && i < row->end;
            for (int32_t c = 0; c < channels; c++) {
                const int32_t where = yuyv && plane == 1 ? 4 * i + 1 + 2 * c : bytes * i + c;
                if (!is_lit)
                    fuzz_check(at[where] == border[c], "a pixel that is not lit shows the border");
                else if (lit != NULL)
                    fuzz_check(at[where] == lit[c], "a picture of one colour is shown as that");
            }
        }
    }
}

/* What pixels of a plane are when all bytes of the picture are LOWEST. */
static void check_panel(const warp_t *warp, const picture_t *panel, const picture_t *picture, bool one_colour)
{
    const bool apart = picture->format == PICTURE_RGB888 || picture->format == PICTURE_BGR888;
    uint8_t pixels[8] = {LOWEST, LOWEST, LOWEST, apart ? 0 : LOWEST};
    const uint8_t pair[2] = {LOWEST, LOWEST};
    const color_matrix_t matrix = color_matrix(picture->matrix);
    if (panel->format == PICTURE_XRGB8888 && picture_is_yuv(picture->format)) {
        warp_kernels_scalar.xrgb_from_yuv(pixels, pair, pair, &matrix, 1);
        check_pixels(warp, panel, 0, NULL); /* at the border of its pair, chroma may be none of the picture's */
        return;
    }
    for (int plane = 0; plane < warp->planes; plane++)
        check_pixels(warp, panel, plane, one_colour ? pixels : NULL);
}

/* Make a frame by so many workers, one after the other. @return Whether it was made. */
static bool make_frame(warp_t *warp, const warp_kernels_t *kernels, const homography_t *homography,
                       const picture_t *panel, const picture_t *picture, int32_t workers)
{
    warp_report_t report;
    if (!warp_plan(warp, kernels, &report, homography, panel, picture))
        return false;
    fuzz_check(report.k_in_q16 >= 0 && report.k_in_q16 <= FOOTPRINT_MAX_STEP_Q16, "k is in range");
    for (warp_step_t step = WARP_MEASURE; step <= WARP_DRAW; step++)
        for (int32_t w = 0; w < workers && warp_needs(warp, step); w++)
            warp_work(warp, step, (worker_t){w, workers});
    return true;
}

/* The same pixels in a format that is alike. */
static picture_t picture_like(const picture_t *p, const int32_t size[2], int32_t guard)
{
    static const picture_format_t like[PICTURE_FORMATS] = {
        [PICTURE_XRGB8888] = PICTURE_XRGB8888, [PICTURE_GRAY8] = PICTURE_GRAY8, [PICTURE_RGB888] = PICTURE_BGR888,
        [PICTURE_BGR888] = PICTURE_RGB888,     [PICTURE_YUYV] = PICTURE_UYVY,   [PICTURE_UYVY] = PICTURE_YUYV,
        [PICTURE_NV12] = PICTURE_NV12,
    };
    picture_t other = new_picture(like[p->format], size, guard);
    other.matrix = p->matrix;
    const int32_t group = p->format == other.format ? 1 : picture_is_yuv(p->format) ? 2 : 3;
    for (int plane = 0; plane < planes_of(p); plane++)
        for (int32_t y = 0; y < plane_rows(p, plane); y++)
            for (int32_t i = 0; i < row_bytes(p, plane); i++)
                row_of(&other, plane, y)[i] = row_of(p, plane, y)[i / group * group + group - 1 - i % group];
    return other;
}

static bool same_bytes(const picture_t *a, const picture_t *b)
{
    bool same = true;
    for (int plane = 0; plane < planes_of(a); plane++)
        same &= memcmp(a->data[plane], b->data[plane], (size_t)a->stride[plane] * (size_t)plane_rows(a, plane)) == 0;
    return same;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    homography_t homography;
    const uint8_t kind = input_byte(&input), range = input_byte(&input) % 120;
    warp_t *warp = warps[input_byte(&input) % WARP_METHODS];
    const picture_format_t from = input_byte(&input) % PICTURE_FORMATS, to = input_byte(&input) % PICTURE_FORMATS;
    const int32_t workers = input_range(&input, 1, WORKERS_MAX), guard = input_range(&input, 0, 15);
    warp->step_all = (kind & STEP_ALL) != 0;
    if (warp->method.resampler != WARP_LS)
        prefilter_init(&warp->prefilter);
    const input_homography_t how = {(kind & BY_NUMBERS) != 0, (kind & GENTLE) != 0, (kind & ODD) == 0};
    if (!input_homography(&homography, &input, how))
        return 0;
    const int32_t picture_size[2] = {homography.picture_width, homography.picture_height};
    const int32_t panel_size[2] = {homography.panel_width, homography.panel_height};
    picture_t picture = new_picture(from, picture_size, guard);
    picture.matrix = kind & BT601 ? PICTURE_BT601 : PICTURE_BT709;
    fill(&picture, range, kind);
    const picture_t like = picture_like(&picture, picture_size, guard);
    const picture_t first = new_picture(to, panel_size, guard), again = new_picture(to, panel_size, guard);

    const bool made = make_frame(warp, warp_kernels_levels[0], &homography, &first, &picture, 1);
    fuzz_check(made == fits(&first, &picture), "a frame is made when formats and sizes fit");
    if (!made)
        fuzz_check(is_untouched(&first, true), "what is refused is untouched");
    for (int level = 0; made && level < WARP_KERNELS_LEVELS; level++) {
        check_panel(warp, &first, &picture, range == 0);
        fuzz_check(make_frame(warp, warp_kernels_levels[level], &homography, &again, level ? &like : &picture, workers),
                   "the frame is made again");
        fuzz_check(same_bytes(&first, &again), "workers, tables of loops and formats like it make the same frame");
    }
    fuzz_check(is_untouched(&first, false) && is_untouched(&picture, false), "nothing is written between the rows");
    free_picture(&first);
    free_picture(&again);
    free_picture(&like);
    free_picture(&picture);
    return 0;
}
