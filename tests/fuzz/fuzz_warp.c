// SPDX-License-Identifier: Apache-2.0
// Fuzzes the way from corners and pose to pixels with any numbers: no byte outside the panel, no strange colours, and
// the same bytes by every table of loops.
#include "warp_fixed/warp.h"

#include <stdlib.h>
#include <string.h>

#include "tests/fuzz/input_homography.h"

enum { GUARD_BYTE = 0xa5, LOWEST = 100, BORDER = 17 };

/* One for each method, made once: their tables take milliseconds. */
static warp_t *warps[WARP_METHODS];

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    static const uint8_t border[3] = {BORDER, BORDER, BORDER};
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

/* A picture with guard bytes behind each row, in memory of exactly its size. */
static image_t new_image(int32_t width, int32_t height, image_format_t format, int32_t guard)
{
    const int32_t stride = width * (int32_t)format + guard;
    const size_t size = (size_t)stride * (size_t)height;
    image_t image = {malloc(size), width, height, stride, format};
    fuzz_check(image.data != NULL, "memory for a small picture");
    memset(image.data, GUARD_BYTE, size);
    return image;
}

static void fill(const image_t *picture, uint8_t range, uint32_t seed)
{
    for (int32_t y = 0; y < picture->height; y++) {
        for (int32_t i = 0; i < picture->width * (int32_t)picture->format; i++) {
            seed = seed * 1664525 + 1013904223;
            image_row(picture, y)[i] = (uint8_t)(LOWEST + (seed >> 24) * range / 255);
        }
    }
}

/*
 * How far beyond the picture's colours a method may reach. Half of what the weights' absolute sum exceeds 1 by, which
 * is 1.25^2 for Keys' cubic along two axes; below 7 for filters that ring. Least squares extrapolate over the last half
 * pixel, where near k = 1.25 any noise fills the range.
 */
static int32_t overshoot(const warp_method_t *method, int32_t range)
{
    const bool calm_filter = method->filter == WARP_FILTER_NONE || method->filter == WARP_FILTER_GAUSS;
    if (range == 0)
        return 0;
    if (!calm_filter)
        return 3 * range + 2;
    switch (method->resampler) {
    case WARP_NEAREST:
    case WARP_LINEAR:
    case WARP_AREA:
        return 1;
    case WARP_LS:
        return 255;
    case WARP_CUBIC:
    case WARP_MEAN_CUBIC:
        return range * 9 / 32 + 2;
    case WARP_SPLINE:
    case WARP_MEAN_SPLINE:
    case WARP_AUTO:
        break;
    }
    return 3 * range + 2;
}

static void check_guards(const image_t *image)
{
    for (int32_t y = 0; y < image->height; y++)
        for (int32_t i = image->width * (int32_t)image->format; i < image->stride; i++)
            fuzz_check(image_row(image, y)[i] == GUARD_BYTE, "nothing is written between the rows");
}

static int32_t check_pixels(const warp_t *warp, const image_t *panel, int32_t range)
{
    int32_t lit = 0;
    const int32_t channels = (int32_t)panel->format, slack = overshoot(&warp->method, range);
    for (int32_t j = 0; j < panel->height; j++) {
        const grid_row_t *row = &warp->plane[0].grid.row[j];
        fuzz_check(row->begin >= 0 && row->begin <= row->end && row->end <= panel->width,
                   "lit pixels are in the panel");
        for (int32_t i = 0; i < panel->width; i++) {
            const bool is_lit = i >= row->begin && i < row->end;
            lit += is_lit;
            for (int32_t c = 0; c < channels; c++) {
                const int32_t value = image_row(panel, j)[i * channels + c];
                if (is_lit)
                    fuzz_check(value >= LOWEST - slack && value <= LOWEST + range + slack, "a lit pixel shows picture");
                else
                    fuzz_check(value == (c < 3 ? BORDER : 0), "every other pixel shows the border");
            }
        }
    }
    return lit;
}

/* What the first level writes; the levels after it must write the same. */
static void make_frames(warp_t *warp, const homography_t *homography, const image_t *picture, int32_t guard,
                        int32_t top)
{
    image_t first = {0};
    for (int level = 0; level < WARP_KERNELS_LEVELS; level++) {
        const warp_kernels_t *kernels = warp_kernels_levels[level];
        const image_t panel = new_image(homography->panel_width, homography->panel_height, picture->format, guard);
        warp_report_t report;
        fuzz_check(warp_frame(warp, kernels, &report, homography, &panel, picture), "the frame is made");
        check_guards(&panel);
        check_guards(picture);
        fuzz_check(check_pixels(warp, &panel, top) == report.lit_pixels, "lit pixels are counted");
        fuzz_check(report.k_in_q16 >= 0 && report.k_in_q16 <= FOOTPRINT_MAX_STEP_Q16, "k is in range");
        fuzz_check(report.k_all_q16 >= 0 && report.k_all_q16 <= FOOTPRINT_MAX_STEP_Q16, "k is in range over the wall");
        if (level == 0) {
            first = panel;
            continue;
        }
        fuzz_check(memcmp(first.data, panel.data, (size_t)(panel.stride * panel.height)) == 0,
                   "every table of loops makes the same frame");
        free(panel.data);
    }
    free(first.data);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input_t input = {data, size};
    homography_t homography;
    const uint8_t kind = input_byte(&input), range = input_byte(&input);
    warp_t *warp = warps[input_byte(&input) % WARP_METHODS];
    const image_format_t format = kind & 1 ? IMAGE_GRAY8 : IMAGE_XRGB8888;
    const int32_t guard = kind >> 4, top = range % 120;
    warp->step_all = (kind & 2) != 0;
    if (warp->method.resampler != WARP_LS)
        prefilter_init(&warp->prefilter);
    if (!input_homography(&homography, &input, (input_homography_t){(kind & 4) != 0, (kind & 8) != 0, false}))
        return 0;
    const image_t picture = new_image(homography.picture_width, homography.picture_height, format, guard);
    fill(&picture, (uint8_t)top, kind);
    make_frames(warp, &homography, &picture, guard, top);
    free(picture.data);
    return 0;
}
