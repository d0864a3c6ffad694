// SPDX-License-Identifier: Apache-2.0
// The filter before resampling: a low-pass for the step k, with or without B-spline coefficients of what it makes.
#include "warp_fixed/prefilter.h"

#include "warp_fixed/fixed.h"

void prefilter_init(prefilter_t *prefilter)
{
    for (int n = 0; n < PREFILTER_DESIGNS; n++)
        prefilter->design[n].kind = (prefilter_kind_t){WARP_FILTER_NONE, -1, false};
}

static bool is_kind(const prefilter_design_t *design, const prefilter_kind_t *kind)
{
    return design->kind.filter == kind->filter && design->kind.k_q16 == kind->k_q16 &&
           design->kind.splines == kind->splines;
}

/* Have a design, which may be that of one before it. @return Does it do anything? */
static bool begin(prefilter_t *prefilter, int number, warp_filter_t filter, int32_t k_q16, bool splines)
{
    prefilter_kind_t kind = {filter, k_q16 < FIR_MAX_K_Q16 ? k_q16 : FIR_MAX_K_Q16, splines};
    if (filter == WARP_FILTER_NONE || k_q16 <= 1 << 16)
        kind = (prefilter_kind_t){WARP_FILTER_NONE, 0, splines};
    prefilter_design_t *design = &prefilter->design[number];
    int same = 0;
    while (same < number && !is_kind(&prefilter->design[same], &kind))
        same++;
    if (!is_kind(design, &kind)) {
        if (same < number)
            design->fir = prefilter->design[same].fir;
        else
            fir_design(&design->fir, kind.filter, kind.k_q16, splines);
        design->kind = kind;
    }
    return splines || kind.filter != WARP_FILTER_NONE;
}

bool prefilter_begin(prefilter_t *prefilter, warp_filter_t filter, int32_t k_q16, bool splines)
{
    return begin(prefilter, 0, filter, k_q16, splines);
}

bool prefilter_begin_chroma(prefilter_t *prefilter, warp_filter_t filter, chroma_step_t step, bool splines)
{
    const bool along_x = begin(prefilter, 1, filter, step.x_q16, splines);
    const bool along_y = begin(prefilter, 2, filter, step.y_q16, splines);
    return along_x || along_y;
}

/* A row of sums continued by mirroring: beyond one width, what is mirrored has been so before. */
static void mirror_ends(int16_t *sums, int32_t width, int32_t channels, int32_t radius)
{
    for (int32_t d = 1; d <= radius; d++) {
        for (int32_t channel = 0; channel < channels; channel++) {
            sums[-d * channels + channel] = sums[(d - 1) * channels + channel];
            sums[(width - 1 + d) * channels + channel] = sums[(width - d) * channels + channel];
        }
    }
}

/* One worker's filtering of one plane. */
typedef struct {
    const warp_kernels_t *kernels;
    const image_t *picture;
    const fir_t *along_x, *along_y;
    prefilter_rows_t *memory;
} pass_t;

static pass_t pass_of(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture, int plane,
                      worker_t worker)
{
    const prefilter_design_t *x = &prefilter->design[plane], *y = &prefilter->design[2 * plane];
    return (pass_t){kernels, picture, &x->fir, &y->fir, &prefilter->rows[worker.index]};
}

/* The first pass along rows y and after, of which the picture may have none: sums[i] is the first one of row y + i. */
static void sums_of_rows(int16_t *sums[FILTER_ROWS], const pass_t *pass, int32_t y)
{
    const image_t *picture = pass->picture;
    const fir_t *fir = pass->along_y;
    const int32_t channels = (int32_t)picture->format;
    const uint8_t *rows[2 * PREFILTER_MAX_RADIUS + FILTER_ROWS];
    for (int32_t i = 0; i < 2 * fir->radius + FILTER_ROWS; i++)
        rows[i] = image_row(picture, mirror_index(y - fir->radius + i, picture->height));
    for (int i = 0; i < FILTER_ROWS; i++)
        sums[i] = pass->memory->sums[i] + PREFILTER_MAX_RADIUS * channels;
    pass->kernels->filter_columns(sums, rows, fir, picture->width * channels);
    for (int i = 0; i < FILTER_ROWS; i++)
        mirror_ends(sums[i], picture->width, channels, pass->along_x->radius);
}

/* Where a plane begins, in channels: the second one has half of them at most. */
static ptrdiff_t plane_offset(int plane)
{
    return (ptrdiff_t)plane * IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888 / 2;
}

image_t prefilter_pixels(prefilter_t *prefilter, const image_t *picture, int plane)
{
    return (image_t){prefilter->pixels + plane_offset(plane), picture->width, picture->height,
                     picture->width * (int32_t)picture->format, picture->format};
}

void prefilter_make_pixels(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture, int plane,
                           worker_t worker)
{
    const image_t filtered = prefilter_pixels(prefilter, picture, plane);
    const pass_t pass = pass_of(prefilter, kernels, picture, plane, worker);
    const share_t share = share_of(worker, picture->height);
    for (int32_t y = share.begin; y < share.end; y += FILTER_ROWS) {
        int16_t *sums[FILTER_ROWS];
        sums_of_rows(sums, &pass, y);
        for (int32_t i = 0; i < FILTER_ROWS && y + i < share.end; i++)
            kernels->filter_row_bytes(image_row(&filtered, y + i), sums[i], pass.along_x, filtered.stride,
                                      (int32_t)picture->format);
    }
}

coefficients_t prefilter_coefficients(prefilter_t *prefilter, const image_t *picture, level_t level)
{
    const ptrdiff_t whole = (ptrdiff_t)IMAGE_MAX_WIDTH * IMAGE_MAX_HEIGHT * IMAGE_XRGB8888;
    const ptrdiff_t offset = level.x == 0 && level.y == 0 ? plane_offset(level.plane) : whole + levels_offset(level);
    return (coefficients_t){prefilter->coefficients + offset, picture->width, picture->height,
                            (int32_t)picture->format};
}

void prefilter_make_coefficients(prefilter_t *prefilter, const warp_kernels_t *kernels, const image_t *picture,
                                 level_t level, worker_t worker)
{
    const coefficients_t made = prefilter_coefficients(prefilter, picture, level);
    const int32_t count = made.width * made.channels;
    const pass_t pass = pass_of(prefilter, kernels, picture, level.plane, worker);
    const share_t share = share_of(worker, picture->height);
    for (int32_t y = share.begin; y < share.end; y += FILTER_ROWS) {
        int16_t *sums[FILTER_ROWS];
        sums_of_rows(sums, &pass, y);
        for (int32_t i = 0; i < FILTER_ROWS && y + i < share.end; i++)
            kernels->filter_row(made.data + (ptrdiff_t)(y + i) * count, sums[i], pass.along_x, count, made.channels);
    }
}
